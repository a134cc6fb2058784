// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/region.h"

#include "core/error.h"
#include "coupling/analysis.h"
#include "sph/fill.h"
#include "sph/trial.h"
#include "tests/support/sections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace berm::coupling
{
namespace
{
meshes::Section section_of(Polyline ground, double base = 0)
{
  meshes::SectionInput input;
  input.base = {{ground.front().x(), base}, {ground.back().x(), base}};
  input.ground = std::move(ground);
  return meshes::build_section(input);
}

/// Whether the angles under which a polygon's edges are seen add up to a full turn.
bool winds_around(const Polyline& polygon, const Vec2& p)
{
  double turn = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const Vec2 a = polygon[k] - p, b = polygon[(k + 1) % polygon.size()] - p;
    turn += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(turn) > pi;
}

/// Distance from a line by brute force, to 1e-3 of an edge.
double distance_by_sampling(const Polyline& line, const Vec2& p)
{
  double least = 1e300;
  for (std::size_t k = 1; k < line.size(); ++k)
    for (int s = 0; s <= 1000; ++s)
      least = std::min(least, (line[k - 1] + s / 1000. * (line[k] - line[k - 1]) - p).norm());
  return least;
}

void expect_no_slope(const meshes::Section& section, Side side)
{
  try
  {
    (void)regions({.side = side, .inside = {}, .outside = {}}, section);
    ADD_FAILURE() << "no mistake";
  }
  catch (const InputError& e)
  {
    ASSERT_EQ(e.mistakes().size(), 1u);
    EXPECT_EQ(e.mistakes()[0].key, "stability.side");
    EXPECT_NE(e.mistakes()[0].problem.find("there is no slope"), std::string::npos);
  }
}

SearchScope on(Side side)
{
  SearchScope scope;
  scope.side = side;
  return scope;
}
} // namespace

TEST(Region, IsEverywhereUnlessAskedOtherwise)
{
  const auto list = regions({}, meshes::build_section(tests::embankment()));
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].name, "everywhere");
  for (const Vec2& p : {Vec2{0, 0}, Vec2{100, 28.6}, Vec2{-1e4, 1e4}})
    EXPECT_TRUE(list[0].contains(p));
}

TEST(Region, OfASideHasAllOfTheCrest)
{
  // The crest of the embankment, and the ground down to a twentieth of 21.3 m below it.
  const auto both = regions(on(Side::both), meshes::build_section(tests::embankment()));
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].name, "left side");
  EXPECT_EQ(both[1].name, "right side");
  const double drop = 0.05 * 21.3;
  const double left_end = 99.83 - drop * (99.83 - 33.5) / 21.3;
  const double right_end = 107.13 + drop * (157.9 - 107.13) / 21.3;
  EXPECT_NEAR(both[0].x_right, right_end, 1e-9);
  EXPECT_NEAR(both[1].x_left, left_end, 1e-9);
  EXPECT_TRUE(both[0].contains({0, 3}) && both[0].contains({107, 3}));
  EXPECT_FALSE(both[0].contains({120, 3}));
  EXPECT_TRUE(both[1].contains({191, 3}) && both[1].contains({100, 3}));
  EXPECT_FALSE(both[1].contains({80, 3}));
}

TEST(Region, OfASideKnowsPointedCamberedAndSeveralCrests)
{
  // A point: the side reaches a twentieth of 10 m beyond it.
  const meshes::Section pointed = section_of({{0, 5}, {20, 15}, {40, 5}});
  EXPECT_NEAR(regions(on(Side::left), pointed)[0].x_right, 21, 1e-9);
  EXPECT_NEAR(regions(on(Side::right), pointed)[0].x_left, 19, 1e-9);
  // A crest that falls by 0.2 m to the left is one crest.
  const meshes::Section cambered = section_of({{0, 5}, {20, 14.8}, {26, 15}, {46, 5}});
  EXPECT_NEAR(regions(on(Side::left), cambered)[0].x_right, 27, 1e-9);
  EXPECT_LT(regions(on(Side::right), cambered)[0].x_left, 20);
  // Of two hills the higher one counts; of two equal ones the far one.
  const meshes::Section hills = section_of({{0, 5}, {10, 12}, {20, 5}, {40, 15}, {60, 5}});
  EXPECT_NEAR(regions(on(Side::right), hills)[0].x_left, 39, 1e-9);
  const meshes::Section twins = section_of({{0, 5}, {20, 15}, {30, 5}, {40, 15}, {60, 5}});
  EXPECT_NEAR(regions(on(Side::left), twins)[0].x_right, 41, 1e-9);
}

TEST(Region, OfASideWithoutASlopeIsAMistake)
{
  const meshes::Section one_sided = section_of({{0, 10}, {12, 10}, {32, 0}, {40, 0}}, -5);
  expect_no_slope(one_sided, Side::left);
  expect_no_slope(one_sided, Side::both);
  EXPECT_EQ(regions(on(Side::right), one_sided).size(), 1u);
  const meshes::Section cut = section_of({{0, 10}, {20, 10}, {20, 20}, {40, 20}});
  expect_no_slope(cut, Side::right);
  EXPECT_EQ(regions(on(Side::left), cut).size(), 1u);
  expect_no_slope(section_of({{0, 10}, {40, 10}}), Side::left);
}

TEST(Region, OfPolygonsHoldsWhatTheyWindAround)
{
  SearchScope scope;
  scope.inside = {{{10, 1}, {60, 2}, {50, 20}, {30, 6}, {12, 9}}, {{100, 0}, {150, 0}, {120, 25}}};
  scope.outside = {{{40, 3}, {48, 3}, {48, 9}, {44, 5}, {40, 9}}};
  const Region region = regions(scope, meshes::build_section(tests::embankment()))[0];
  EXPECT_EQ(region.name, "search region");
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(0, 191.4), y(0, 28.6);
  int inside = 0;
  for (int k = 0; k < 20000; ++k)
  {
    const Vec2 p{x(random), y(random)};
    const bool expected = (winds_around(scope.inside[0], p) || winds_around(scope.inside[1], p)) &&
                          !winds_around(scope.outside[0], p);
    EXPECT_EQ(region.contains(p), expected) << p.transpose();
    inside += expected ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
}

TEST(Region, BelowADepthKeepsItsDistanceFromTheGround)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  SearchScope scope = on(Side::both);
  scope.min_depth = 3;
  const auto list = regions(scope, section);
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0].name, "left side");
  EXPECT_EQ(list[1].name, "left side, below 3 m");
  EXPECT_EQ(list[3].name, "right side, below 3 m");
  const Polyline ground = tests::embankment().ground;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(110, 191.4), y(0, 28.6);
  int deep = 0;
  for (int k = 0; k < 500; ++k)
  {
    const Vec2 p{x(random), y(random)};
    const double distance = distance_by_sampling(ground, p);
    if (std::abs(distance - 3) < 1e-3) // what the sampling cannot tell
      continue;
    EXPECT_EQ(list[3].contains(p), distance > 3) << p.transpose();
    deep += distance > 3 && meshes::contains(section, p) ? 1 : 0;
  }
  EXPECT_GT(deep, 100);
}

TEST(Region, WithoutSoilIsNoticed)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  Region region;
  EXPECT_TRUE(holds_soil(region, section));
  region.inside = {{{150, 20}, {180, 20}, {180, 25}}}; // above the ground
  EXPECT_FALSE(holds_soil(region, section));
  region.inside = {{{100, 0}, {160, 25}, {160, 25.3}, {100, 0.3}}}; // thin, but there
  EXPECT_TRUE(holds_soil(region, section));
  region.outside = {{{0, -1}, {191.4, -1}, {191.4, 40}, {0, 40}}};
  EXPECT_FALSE(holds_soil(region, section));
}

TEST(Region, ThinnerThanTheParticlesShowIsAMistake)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  const sph::Particles p = sph::fill(section, 2, "columns");
  Region region;
  EXPECT_NO_THROW(require_particles(region, p));
  const double between = p.x[0] + 1; // columns stand 2 m apart
  region.inside = {{{between - 0.2, 0}, {between + 0.2, 0}, {between + 0.2, 7}, {between, 7}}};
  EXPECT_TRUE(holds_soil(region, section));
  EXPECT_THROW(require_particles(region, p), InputError);
}

TEST(Governing, IsTheWeakestUnlessAnotherMayBeWeaker)
{
  Stability stability;
  const auto found = [](std::optional<double> stands, std::optional<double> fails, bool complete)
  {
    FoundFactor f;
    f.F.stands = stands;
    f.F.fails = fails;
    f.F.complete = complete;
    return f;
  };
  auto& all = stability.searches;
  all = {found(1.7, 1.72, true), found(1.5, 1.52, true), found(1.5, 1.52, true)};
  EXPECT_EQ(&stability.governing(), &all[1]);    // the first of equals
  all.push_back(found(20, std::nullopt, false)); // it stands even at 20
  EXPECT_EQ(&stability.governing(), &all[1]);
  all.push_back(found(1.4, 1.9, false)); // it may have failed at 1.41
  EXPECT_EQ(&stability.governing(), &all[4]);
  all.push_back(found(std::nullopt, std::nullopt, false));
  EXPECT_EQ(&stability.governing(), &all[5]);
}

TEST(Region, HeldSoilHasItsFullStrengthAndIsNeverTheWeaker)
{
  std::vector<sph::Soil> soils(2, tests::embankment_soil());
  soils[1].cohesion = 5e3;
  for (const double F : {0.5, 1.0, 2.0})
  {
    const auto cones = cones_in_region(soils, F, "fitted");
    ASSERT_EQ(cones.size(), 4u);
    const auto reduced = sph::reduced_cones(soils, F, "fitted");
    const auto full = sph::reduced_cones(soils, 1, "fitted");
    for (std::size_t s = 0; s < 2; ++s)
    {
      EXPECT_EQ(cones[s].k, reduced[s].k);
      EXPECT_EQ(cones[s + 2].k, F > 1 ? full[s].k : reduced[s].k);
      EXPECT_EQ(cones[s + 2].alpha, F > 1 ? full[s].alpha : reduced[s].alpha);
    }
  }
}

TEST(Region, CountsHeldParticlesBehindTheSoils)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  sph::Particles p = sph::fill(section, 2, "columns");
  for (std::size_t i = 0; i < p.size(); ++i)
    p.soil[i] = p.y[i] > 10 ? 1 : 0;
  const Region left = regions(on(Side::left), section)[0];
  const std::vector<Index> index = strength_index(left, p, 2);
  ASSERT_EQ(index.size(), p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_EQ(index[i], p.soil[i] + (p.x[i] > left.x_right ? 2 : 0));
}
} // namespace berm::coupling
