// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim D-6 of docs/verification.md: a rigid block slides down a dry incline of 30 degrees with
/// friction of 20 degrees, a = g (sin b - cos b tan(phi)).
#include "sph/trial.h"
#include "tests/support/moving_soil.h"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
constexpr double slope_angle = 30 * pi / 180, friction = 20 * pi / 180;
constexpr double length = 4, height = 0.5;

/// A strong block on a thin layer without cohesion. With psi = 0 soil that is sheared along a plane
/// carries sigma_n sin(phi) there (Davis 1968), so the layer has sin(phi) = tan(20 deg).
std::vector<Soil> block_and_layer()
{
  Soil block = tests::embankment_soil();
  block.density = block.saturated_density = 2000;
  block.young_modulus = 2e7;
  block.cohesion = 1e6;
  Soil layer = block;
  layer.cohesion = 0;
  layer.friction_angle = std::asin(std::tan(friction));
  return {block, layer};
}

/// Mean acceleration down the slope [m/s2], the layer two rows thick.
double slide(double dx, double alpha, bool sloping_base)
{
  const std::vector<Soil> soils = block_and_layer();
  const double fall = sloping_base ? std::tan(slope_angle) : 0, end = 20;
  const double across = sloping_base ? height / std::cos(slope_angle) : height;
  meshes::SectionInput input;
  input.base = {{0, length * fall}, {length, 0}};
  input.ground = {{0, length * fall + across}, {length, across}};
  const meshes::Section section = meshes::build_section(input);
  Particles particles = fill(section, dx, "columns");
  tests::set_density(particles, soils[0].density);
  const double row = across / std::round(across / dx);
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles.soil[i] = particles.y[i] - (length - particles.x[i]) * fall < 2 * row ? 1 : 0;
  const double down = sloping_base ? 1 : std::cos(slope_angle);
  MovingBody body = moving_body(
      particles, soils, {}, section,
      {.gradient_correction = true, .alpha = alpha, .beta = 0, .gravity = gravity * down});
  body.walls.left.reset();
  body.walls.right.reset();
  body.walls.base = {{-end, (length + end) * fall}, {length + end, -end * fall}};
  UpdatedLagrangian soil(body, reduced_cones(soils, 1, "fitted"), tests::at_rest(body));
  if (!sloping_base)
    soil.set_shake(gravity * std::sin(slope_angle)); // gravity is turned instead of the base
  const double mass = tests::total(particles.volume) * soils[0].density;
  const Vec2 along =
      sloping_base ? Vec2{std::cos(slope_angle), -std::sin(slope_angle)} : Vec2{1, 0};
  std::vector<double> time, speed;
  soil.advance_for(0.1); // the weight comes on, and swings for a while
  for (int k = 0; k < 40; ++k)
  {
    soil.advance_for(0.01);
    time.push_back(soil.time());
    speed.push_back(soil.momentum().dot(along) / mass);
  }
  const double a = tests::slope(time, speed);
  std::printf("  dx = %.3f m, alpha %.2f, base %s: a = %.4f m/s2\n", dx, alpha,
              sloping_base ? "sloping" : "level", a);
  return a;
}

const double exact =
    gravity * (std::sin(slope_angle) - std::cos(slope_angle) * std::tan(friction)); // 1.8128
} // namespace

/// Without viscosity, of which (9.6) would add a third of its friction in a layer of two rows.
TEST(Incline, ABlockSlidesWithTheFrictionOfItsBase)
{
  std::vector<double> a;
  for (const double dx : {0.1, 0.05, 0.025})
    a.push_back(slide(dx, 0, false));
  // First order in dx, and the limit within 3 %: the error of the extrapolation.
  EXPECT_NEAR(tests::observed_order(a[0] - exact, a[1] - exact), 1, 0.3);
  EXPECT_NEAR(tests::observed_order(a[1] - exact, a[2] - exact), 1, 0.3);
  EXPECT_NEAR(2 * a[2] - a[1], exact, 0.03 * exact);
}

TEST(Incline, OnASlopingBaseABlockSlidesLikewise)
{
  std::vector<double> a;
  for (const double dx : {0.1, 0.05, 0.025})
    a.push_back(slide(dx, 0, true));
  EXPECT_NEAR(2 * a[2] - a[1], exact, 0.03 * exact);
}

/// A known limit: in a shear band of given rows the linear viscosity of eq. (9.6), alpha c h rho /
/// 8 times the jump of velocity over the band's width, is the same for every dx.
TEST(Incline, TheDefaultViscosityDragsAtAnySpacing)
{
  EXPECT_LT(slide(0.1, 0.1, false), 0.7 * exact);
  EXPECT_LT(slide(0.05, 0.1, false), 0.7 * exact);
}
} // namespace berm::sph
