// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/mechanism.h"

#include "sph/fill.h"
#include "tests/support/sections.h"

#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
struct Circle
{
  Vec2 centre;
  double radius;
  [[nodiscard]] bool holds(double x, double y) const
  {
    return (Vec2{x, y} - centre).norm() < radius;
  }
};

/// A state in which the inside of a circle turns about its centre and the rest is still.
State turning(const Particles& p, const Circle& circle, double rate)
{
  State state;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const bool in = circle.holds(p.x[i], p.y[i]);
    state.vx.push_back(in ? -rate * (p.y[i] - circle.centre.y()) : 0);
    state.vy.push_back(in ? rate * (p.x[i] - circle.centre.x()) : 0);
  }
  return state;
}
} // namespace

TEST(Mechanism, FindsTheCircleOnWhichTheSoilTurns)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  Particles p = fill(section, 0.5, "columns");
  tests::set_density(p, 2000);
  const Circle circle{{146.84, 51.2}, 47.09};
  const auto m = find_mechanism(p, turning(p, circle, 1e-3), section);
  ASSERT_TRUE(m.has_value());
  for (std::size_t k = 1; k + 1 < m->slip_line.size(); ++k)
    EXPECT_NEAR((m->slip_line[k] - circle.centre).norm(), circle.radius, 0.5) << "point " << k;
  EXPECT_EQ(m->side, "right");
  EXPECT_EQ(m->kind, "deep slide");
  EXPECT_NEAR(m->entry.y(), 28.6, 1e-9);
  EXPECT_NEAR(m->entry.x(), 146.84 - std::sqrt(47.09 * 47.09 - 22.6 * 22.6), 0.5);
  EXPECT_NEAR(m->exit.y(), 7.3, 1e-9);
  EXPECT_NEAR(m->exit.x(), 146.84 + std::sqrt(47.09 * 47.09 - 43.9 * 43.9), 0.5);
}

TEST(Mechanism, HasTheVolumeThicknessAndCircleOfWhatTurns)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  const Circle circle{{146.84, 51.2}, 47.09};
  double area = 0; // of the ground above the arc, by the midpoint rule
  for (double x = 100.005; x < 170; x += 0.01)
    area += 0.01 * std::max(0.0, meshes::ground_level(section, x) - 51.2 +
                                     std::sqrt(std::pow(47.09, 2) - std::pow(x - 146.84, 2)));
  for (const double spacing : {1.0, 0.5})
  {
    Particles p = fill(section, spacing, "columns");
    tests::set_density(p, 2000);
    const auto m = find_mechanism(p, turning(p, circle, 1e-3), section);
    ASSERT_TRUE(m.has_value());
    // The border is known to half a spacing; to either side of it over its length of some 70 m.
    EXPECT_NEAR(m->volume, area, 0.25 * spacing * 70);
    EXPECT_EQ(m->length, (m->exit - m->entry).norm());
    EXPECT_LT(m->thickness, m->depth);
    ASSERT_TRUE(m->circle.has_value());
    EXPECT_NEAR(m->circle->centre.x(), 146.84, 2 * spacing);
    EXPECT_NEAR(m->circle->radius, 47.09, 2 * spacing);
    EXPECT_LT(m->circle->misfit, 0.5 * spacing);
  }
}

TEST(Mechanism, IsASkinWhereItIsThinForItsLengthWhateverTheSpacing)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  const Vec2 a{110, meshes::ground_level(section, 110)}, b{155, meshes::ground_level(section, 155)};
  const double half = 0.5 * (b - a).norm();
  const Vec2 up = Vec2{-(b - a).y(), (b - a).x()} / (2 * half);
  for (const double ratio : {0.06, 0.15})
    for (const double spacing : {1.0, 0.5, 0.25})
    {
      const double sagitta = ratio * 2 * half;
      const double radius = (half * half + sagitta * sagitta) / (2 * sagitta);
      const Circle circle{0.5 * (a + b) + (radius - sagitta) * up, radius};
      Particles p = fill(section, spacing, "columns");
      tests::set_density(p, 2000);
      const auto m = find_mechanism(p, turning(p, circle, 1e-3), section);
      ASSERT_TRUE(m.has_value());
      EXPECT_NEAR(m->thickness, sagitta, 0.6 * spacing); // to the middle between two rows
      EXPECT_EQ(m->kind, ratio < 0.1 ? "surface skin" : "deep slide") << spacing;
    }
}

TEST(Mechanism, OnAPlaneHasNoCircle)
{
  // A slab 4 m thick on the slope, sliding along it.
  const meshes::Section section = meshes::build_section(tests::embankment());
  Particles p = fill(section, 0.5, "columns");
  tests::set_density(p, 2000);
  State state;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const bool in =
        p.x[i] > 107.13 && p.x[i] < 157.9 && meshes::ground_level(section, p.x[i]) - p.y[i] < 4;
    state.vx.push_back(in ? 50.77e-3 : 0);
    state.vy.push_back(in ? -21.3e-3 : 0);
  }
  const auto m = find_mechanism(p, state, section);
  ASSERT_TRUE(m.has_value());
  EXPECT_FALSE(m->circle.has_value());
  EXPECT_EQ(m->kind, "surface skin"); // 3.7 m of 55 m
}

TEST(Mechanism, OfTheMirroredSectionIsTheMirroredMechanism)
{
  meshes::SectionInput mirrored = tests::embankment();
  for (Polyline* line : {&mirrored.ground, &mirrored.base})
  {
    std::reverse(line->begin(), line->end());
    for (Vec2& v : *line)
      v.x() = 191.4 - v.x();
  }
  const meshes::Section section = meshes::build_section(mirrored);
  Particles p = fill(section, 1, "columns");
  tests::set_density(p, 2000);
  const auto m = find_mechanism(p, turning(p, {{191.4 - 146.84, 51.2}, 47.09}, -1e-3), section);
  ASSERT_TRUE(m.has_value());
  EXPECT_EQ(m->side, "left");
  EXPECT_GT(m->entry.x(), m->exit.x());
}

TEST(Mechanism, OfTwoMassesTheHeavierIsTaken)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  Particles p = fill(section, 1, "columns");
  tests::set_density(p, 2000);
  State both = turning(p, {{146.84, 51.2}, 47.09}, 1e-3);
  const State left = turning(p, {{50, 40}, 30}, -1e-3);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (left.vx[i] != 0)
    {
      both.vx[i] = left.vx[i];
      both.vy[i] = left.vy[i];
    }
  const auto m = find_mechanism(p, both, section);
  ASSERT_TRUE(m.has_value());
  EXPECT_EQ(m->side, "right");
}

TEST(Mechanism, SoilAtRestHasNone)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  Particles p = fill(section, 2, "columns");
  tests::set_density(p, 2000);
  State still;
  still.vx = still.vy = std::vector<double>(p.size(), 0.0);
  EXPECT_FALSE(find_mechanism(p, still, section).has_value());
}
} // namespace berm::sph
