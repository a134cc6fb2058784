// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/drucker_prager.h"

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

/// Strain a material point in plane strain along its flow rule until the stress stays; return it.
SymTensor collapse_stress(double c, double phi, double psi)
{
  const Cone cone = fit_plane_strain(c, phi, psi);
  const Elastic e = elastic_moduli(1e7, 0.3);
  SymTensor sig{-50e3, -50e3, -50e3, 0};
  // Plane-strain flow: volume strain = shear strain times sin(psi).
  const double step = 1e-6, exx = step * (1 + std::sin(psi)), eyy = -step * (1 - std::sin(psi));
  for (int k = 0; k < 400000; ++k)
  {
    const double rate = (e.K - 2 * e.G / 3) * (exx + eyy);
    const SymTensor trial = {sig.xx + rate + 2 * e.G * exx, sig.yy + rate + 2 * e.G * eyy,
                             sig.zz + rate, sig.xy};
    const SymTensor next = return_to_cone(trial, cone, e).sig;
    const bool steady = k > 1000 && std::abs(next.yy - sig.yy) < 1e-9 * std::abs(sig.yy);
    sig = next;
    if (steady)
      break;
  }
  return sig;
}
} // namespace

class ConeFit : public testing::TestWithParam<Angles>
{
};

TEST_P(ConeFit, CollapsesAtMohrCoulombInPlaneStrain)
{
  const double c = 10e3, phi = GetParam().phi * degree, psi = GetParam().psi * degree;
  const SymTensor sig = collapse_stress(c, phi, psi);
  const double radius = 0.5 * std::abs(sig.xx - sig.yy), centre = 0.5 * (sig.xx + sig.yy);
  const double mohr_coulomb = c * std::cos(phi) - centre * std::sin(phi);
  EXPECT_NEAR(radius / mohr_coulomb, 1, 1e-4); // what is left of the elastic transient
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
  const Returned r = return_to_cone({50e3, 40e3, 45e3, 3e3}, cone, elastic_moduli(1e7, 0.3));
  EXPECT_NEAR(I1(r.sig), cone.k / cone.alpha, 1e-9);
  EXPECT_NEAR(J2(r.sig), 0, 1e-9);
  EXPECT_GT(r.plastic_strain, 0);
}

TEST(ReturnToCone, CohesionlessSoilBearsNoTension)
{
  const Cone cone = fit_plane_strain(0, 37 * degree, 0);
  const Returned r = return_to_cone({1e3, 2e3, 1e3, 0}, cone, elastic_moduli(1e7, 0.3));
  EXPECT_EQ(I1(r.sig), 0);
}
} // namespace berm::sph
