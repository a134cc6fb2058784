// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/drucker_prager.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
constexpr double degree = pi / 180;

struct Angles
{
  double phi, psi; // degrees
};

/// A soil, its state before shearing and the direction in which it is sheared.
struct Shearing
{
  double c, phi, psi; ///< Pa, rad
  SymTensor start;    ///< Pa
  double direction;   ///< of the largest principal strain rate, from x [rad]
};

struct Collapse
{
  SymTensor sig;
  double off_cone = 0; ///< largest |f| on the way [Pa]
};

/// Strain a material point in plane strain along its flow rule until the stress stays.
Collapse collapse(const Shearing& s)
{
  const Cone cone = fit_plane_strain(s.c, s.phi, s.psi);
  const Elastic e = elastic_moduli(1e7, 0.3);
  // Plane-strain flow: volume strain = shear strain times sin(psi).
  const double size = s.c - I1(s.start) / 3, step = 0.1 * size / e.G / 1000;
  const double volume = 2 * step * std::sin(s.psi), rate = (e.K - 2 * e.G / 3) * volume;
  const double exx = step * std::cos(2 * s.direction), exy = step * std::sin(2 * s.direction);
  const SymTensor strained{rate + e.G * (volume + 2 * exx), rate + e.G * (volume - 2 * exx), rate,
                           2 * e.G * exy};
  Collapse result{.sig = return_to_cone(s.start, cone, e).sig};
  bool steady = false;
  for (int k = 0; k < 400000 && !steady; ++k)
  {
    const Returned next = return_to_cone(result.sig + strained, cone, e);
    const SymTensor change = next.sig + (-1.) * result.sig;
    steady = next.plastic_strain > 0 && std::sqrt(J2(change)) + std::abs(I1(change)) < 1e-10 * size;
    result.sig = next.sig;
    if (next.plastic_strain > 0)
      result.off_cone = std::max(
          result.off_cone, std::abs(std::sqrt(J2(next.sig)) + cone.alpha * I1(next.sig) - cone.k));
  }
  EXPECT_TRUE(steady);
  return result;
}

/// Radius and centre of Mohr's circle in the plane.
double radius(const SymTensor& sig)
{
  return std::hypot(0.5 * (sig.xx - sig.yy), sig.xy);
}
double centre(const SymTensor& sig)
{
  return 0.5 * (sig.xx + sig.yy);
}
} // namespace

class ConeFit : public testing::TestWithParam<Angles>
{
};

/// Isotropic and K0 states from 10 kPa to 1 MPa, sheared in five directions: compression along y
/// and along x, simple shear and in between.
TEST_P(ConeFit, CollapsesAtMohrCoulombInPlaneStrainFromAnyStateInAnyDirection)
{
  const double c = 10e3, phi = GetParam().phi * degree, psi = GetParam().psi * degree;
  const double a = associated_constant(psi);
  for (const double p : {10e3, 50e3, 200e3, 1e6})
    for (const double K0 : {1., 0.5})
      for (const double direction : {0., 22.5, 45., 70., 90.})
      {
        const SymTensor start{-K0 * p, -p, -K0 * p, 0};
        const auto [sig, off_cone] = collapse({c, phi, psi, start, direction * degree});
        const double mohr_coulomb = c * std::cos(phi) - centre(sig) * std::sin(phi);
        // Bounds of 1e-4 and 1e-3 rad: what is left of the elastic transient, which fades with the
        // strain but never ends; rates below 1e-10 of the stress count as steady.
        EXPECT_NEAR(radius(sig) / mohr_coulomb, 1, 1e-4) << p << " " << K0 << " " << direction;
        // The Lode angle of collapse, eq. (4.3), and no flow along z.
        const double s_zz = sig.zz - I1(sig) / 3;
        EXPECT_NEAR(s_zz / (2 * std::sqrt(J2(sig))), -a, 1e-4);
        // Coaxial: stress turns into the direction of the strain rate.
        EXPECT_NEAR(std::atan2(sig.xy, 0.5 * (sig.xx - sig.yy)) / 2, direction * degree, 1e-3);
        EXPECT_LT(off_cone, 1e-9 * (c + p)); // rounding, all the way
      }
}

INSTANTIATE_TEST_SUITE_P(FlowRules, ConeFit,
                         testing::Values(Angles{0, 0}, Angles{10, 0}, Angles{20, 0}, Angles{37, 0},
                                         Angles{20, 20}, Angles{35, 10}, Angles{37, 37},
                                         Angles{45, 15}));

TEST(Cone, AssociatedFitIsEquation14OfThePaper)
{
  const double c = 13.8e3, phi = 37 * degree, t = std::tan(phi);
  const Cone fitted = fit_plane_strain(c, phi, phi);
  EXPECT_NEAR(fitted.alpha, t / std::sqrt(9 + 12 * t * t), 1e-14);
  EXPECT_NEAR(fitted.k, 3 * c / std::sqrt(9 + 12 * t * t), 1e-9);
  const Cone paper = paper_cone(c, phi, phi);
  EXPECT_NEAR(fitted.alpha, paper.alpha, 1e-14);
  EXPECT_NEAR(fitted.k, paper.k, 1e-9);
}

TEST(Cone, PaperConstantsWithoutDilationAreWeakerByTheKnownRatio)
{
  for (const double phi : {20 * degree, 30 * degree, 37 * degree})
  {
    const Cone fitted = fit_plane_strain(1e3, phi, 0), paper = paper_cone(1e3, phi, 0);
    // alpha / alpha_paper = sin(phi)/3 sqrt(9 + 12 t^2)/t = cos(phi) sqrt(1 + 4/3 t^2)
    const double t = std::tan(phi), ratio = std::cos(phi) * std::sqrt(1 + 4 * t * t / 3);
    EXPECT_NEAR(fitted.alpha / paper.alpha, ratio, 1e-13);
    EXPECT_NEAR(fitted.k / paper.k, ratio, 1e-13);
    EXPECT_GT(ratio, 1.01);
  }
}

TEST(ReturnToCone, LeavesStressInsideAlone)
{
  const Cone cone = fit_plane_strain(10e3, 30 * degree, 0);
  const SymTensor sig{-100e3, -120e3, -105e3, 4e3};
  const Returned r = return_to_cone(sig, cone, elastic_moduli(1e8, 0.3));
  EXPECT_EQ(r.sig.yy, sig.yy);
  EXPECT_EQ(r.plastic_strain, 0);
}

TEST(ReturnToCone, EndsOnTheConeWithTheFlowRulesDirection)
{
  const double phi = 35 * degree, psi = 10 * degree;
  const Cone cone = fit_plane_strain(5e3, phi, psi);
  const Elastic e = elastic_moduli(2e7, 0.25);
  const SymTensor trial{-100e3, -400e3, -180e3, 60e3};
  const Returned r = return_to_cone(trial, cone, e);
  EXPECT_NEAR(std::sqrt(J2(r.sig)) + cone.alpha * I1(r.sig), cone.k, 1e-9 * 100e3);
  // Plastic strain: volume part 3 alpha_psi dgamma; sqrt(2/3 e:e) of the deviator is dgamma /
  // sqrt(3).
  const double volume = (I1(trial) - I1(r.sig)) / (3 * e.K);
  EXPECT_NEAR(volume, 3 * cone.alpha_psi * std::sqrt(3.) * r.plastic_strain, 1e-12);
}

TEST(ReturnToCone, TensionBeyondTheApexReturnsToIt)
{
  const Cone cone = fit_plane_strain(5e3, 30 * degree, 0);
  const Elastic e = elastic_moduli(1e7, 0.3);
  const Returned r = return_to_cone({50e3, 40e3, 45e3, 3e3}, cone, e);
  EXPECT_NEAR(r.gap, (135e3 - cone.k / cone.alpha) / (3 * e.K), 1e-15);
  EXPECT_NEAR(I1(r.sig), cone.k / cone.alpha, 1e-9);
  EXPECT_NEAR(J2(r.sig), 0, 1e-9);
  EXPECT_GT(r.plastic_strain, 0);
}

TEST(ReturnToCone, BeyondTheTensionCutOffEndsWhereItMeetsTheCone)
{
  Cone cone = fit_plane_strain(5e3, 30 * degree, 0);
  cone.most_tension = 3 * 2e3;
  const Elastic e = elastic_moduli(1e7, 0.3);
  const SymTensor much{50e3, 40e3, 45e3, 30e3}; // far outside both
  const Returned corner = return_to_cone(much, cone, e);
  EXPECT_NEAR(I1(corner.sig), 6e3, 1e-9); // rounding of kPa, here and below
  EXPECT_NEAR(std::sqrt(J2(corner.sig)), cone.k - cone.alpha * 6e3, 1e-9);
  EXPECT_NEAR(corner.sig.xy / (corner.sig.xx - corner.sig.yy), 30. / 10, 1e-12); // same direction

  const Returned flat = return_to_cone({4e3, 3e3, 3.5e3, 0.1e3}, cone, e); // within the cone
  EXPECT_NEAR(I1(flat.sig), 6e3, 1e-9);
  EXPECT_NEAR(flat.sig.xy, 0.1e3, 1e-9);
  EXPECT_EQ(flat.plastic_strain, 0); // a change of volume alone

  const SymTensor inside{1e3, 0.5e3, 0.8e3, 0.2e3};
  EXPECT_EQ(return_to_cone(inside, cone, e).sig.xx, inside.xx);
}

TEST(ReturnToCone, CohesionlessSoilBearsNoTension)
{
  const Cone cone = fit_plane_strain(0, 37 * degree, 0);
  const Returned r = return_to_cone({1e3, 2e3, 1e3, 0}, cone, elastic_moduli(1e7, 0.3));
  EXPECT_EQ(I1(r.sig), 0);
}
} // namespace berm::sph
