// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/discretisation.h"

#include "sph/fill.h"
#include "sph/kernel.h"
#include "tests/support/sections.h"

#include <gtest/gtest.h>
#include <random>

namespace berm::sph
{
namespace
{
Particles embankment_particles(double dx)
{
  Particles p = fill(meshes::build_section(tests::embankment()), dx, "columns");
  tests::set_density(p, 2000);
  return p;
}
} // namespace

TEST(GradientCorrection, MakesGradientsOfLinearFieldsExactOnDisorderedPoints)
{
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  std::vector<double> x, y, V;
  for (int a = 0; a < 12; ++a)
    for (int b = 0; b < 9; ++b)
    {
      x.push_back(a + jitter(engine));
      y.push_back(b + jitter(engine));
      V.push_back(1 + 0.5 * jitter(engine));
    }
  const CubicSpline W{1.2};
  const auto n = static_cast<Index>(x.size());
  const NeighbourList list = find_neighbours(x, y, n, W.radius());
  const auto B = gradient_correction(x, y, V, list, W.h);
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    double sx = 0, sy = 0;
    for (const Index jj : list.of(static_cast<Index>(i)))
    {
      const auto j = static_cast<std::size_t>(jj);
      const double dx = x[i] - x[j], dy = y[i] - y[j], r = std::hypot(dx, dy);
      const double df = (3 * x[j] - 7 * y[j]) - (3 * x[i] - 7 * y[i]);
      sx += V[j] * df * W.dW(r) * dx / r;
      sy += V[j] * df * W.dW(r) * dy / r;
    }
    EXPECT_NEAR(B[i].xx * sx + B[i].xy * sy, 3, 1e-11);
    EXPECT_NEAR(B[i].xy * sx + B[i].yy * sy, -7, 1e-11);
  }
}

TEST(GradientCorrection, StaysFiniteWhereNeighboursLieOnALine)
{
  const std::vector<double> x = {0, 1, 2, 3}, y = {0, 0, 0, 0}, V = {1, 1, 1, 1};
  const auto B = gradient_correction(x, y, V, find_neighbours(x, y, 4, 2.4), 1.2);
  for (const SymTensor& b : B)
  {
    EXPECT_TRUE(std::isfinite(b.xx) && std::isfinite(b.xy));
    EXPECT_EQ(b.yy, 1);
  }
}

TEST(PorePressureAcceleration, AUniformOffsetChangesNothing)
{
  const Particles p = embankment_particles(1.5);
  std::vector<double> p_w(p.size()), shifted(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    p_w[i] = 1e3 * std::sin(0.1 * p.x[i]) * p.y[i];
    shifted[i] = p_w[i] + 1e6;
  }
  const double h = 1.2 * 1.5;
  const auto a = pore_pressure_acceleration(p, p_w, h);
  const auto b = pore_pressure_acceleration(p, shifted, h);
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_LT((a[i] - b[i]).norm(),
              1e-9); // 1e6 Pa x 1e-16 / (1 m x 2000 kg/m3), times a few hundred
}

TEST(PorePressureAcceleration, ALinearFieldIsExactUpToTheSurface)
{
  const Particles p = embankment_particles(1.5);
  std::vector<double> p_w(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    p_w[i] = 5e5 - 9810 * p.y[i] + 300 * p.x[i];
  for (const Vec2& a : pore_pressure_acceleration(p, p_w, 1.2 * 1.5))
  {
    EXPECT_NEAR(a.x(), -300. / 2000, 1e-9);
    EXPECT_NEAR(a.y(), 9810. / 2000, 1e-9);
  }
}

TEST(Discretisation, PairsPullEquallyOnBothParticles)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  const Particles p = embankment_particles(2);
  const std::vector<Soil> soils = {tests::embankment_soil()};
  const Discretisation d = discretise(p, soils, std::vector<double>(p.size(), 0.0), section);
  // V_i G_ij = -V_j G_ji between particles: momentum is conserved pair by pair.
  const auto pair_of = [&](Index i, Index j)
  {
    for (auto k = d.neighbours.begin[std::size_t(i)]; k < d.neighbours.begin[std::size_t(i) + 1];
         ++k)
      if (d.neighbours.index[std::size_t(k)] == j)
        return std::size_t(k);
    ADD_FAILURE() << "no pair";
    return std::size_t(0);
  };
  for (Index i = 0; i < d.n; i += 7)
    for (const Index j : d.neighbours.of(i))
      if (j < d.n)
      {
        const auto G_ij = d.G[pair_of(i, j)], G_ji = d.G[pair_of(j, i)];
        for (std::size_t c = 0; c < 2; ++c)
          EXPECT_NEAR(p.volume[std::size_t(i)] * G_ij[c], -p.volume[std::size_t(j)] * G_ji[c],
                      1e-14);
      }
}
} // namespace berm::sph
