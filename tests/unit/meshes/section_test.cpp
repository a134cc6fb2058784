// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/section.h"

#include "sections.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace berm::meshes
{
namespace
{
using namespace berm::tests;

/// Where the upstream slope of the two-sided embankment has this level [m].
double upstream_x(double level)
{
  return 33.5 + (level - 7.3) / (28.6 - 7.3) * (99.83 - 33.5);
}

std::set<std::string> names(const Section& section)
{
  std::set<std::string> all;
  for (const Stretch& stretch : section.stretches)
    all.insert(stretch.name);
  return all;
}

void expect_same(const Section& a, const Section& b)
{
  EXPECT_EQ(a.outline, b.outline);
  EXPECT_EQ(a.edge_stretch, b.edge_stretch);
  EXPECT_EQ(names(a), names(b));
  EXPECT_EQ(a.ground, b.ground);
  EXPECT_EQ(a.base, b.base);
  EXPECT_EQ(a.single_valued, b.single_valued);
  EXPECT_EQ(a.left_side_top, b.left_side_top);
  EXPECT_EQ(a.right_side_top, b.right_side_top);
}

//------------------------------------------------------------------------------------------------
// Outline
//------------------------------------------------------------------------------------------------

TEST(Section, RunsCounterClockwiseFromTheLeftEndOfTheBase)
{
  const Section section = build_section(two_sided_embankment());
  const Polyline expected = {{0, 0},         {191.4, 0},    {191.4, 7.3}, {157.9, 7.3},
                             {107.13, 28.6}, {99.83, 28.6}, {33.5, 7.3},  {0, 7.3}};
  EXPECT_EQ(section.outline, expected);
  // Foundation, and a trapezoid on it.
  EXPECT_NEAR(polygon_area(section.outline),
              191.4 * 7.3 + 0.5 * (28.6 - 7.3) * (157.9 - 33.5 + 107.13 - 99.83), 1e-9);
  EXPECT_EQ(section.x_min, 0);
  EXPECT_EQ(section.x_max, 191.4);
  EXPECT_EQ(section.y_min, 0);
  EXPECT_EQ(section.y_max, 28.6);
  EXPECT_EQ(section.left_side_top, 7.3);
  EXPECT_EQ(section.right_side_top, 7.3);
  EXPECT_TRUE(section.single_valued);
}

TEST(Section, FromAnOutlineIsTheSameForBothOrientationsAndEveryFirstPoint)
{
  SectionInput input;
  input.outline = build_section(two_sided_embankment()).outline;
  const Section expected = build_section(two_sided_embankment());
  for (std::size_t first = 0; first < input.outline.size(); ++first)
  {
    std::rotate(input.outline.begin(), input.outline.begin() + 1, input.outline.end());
    expect_same(build_section(input), expected);
    SectionInput reversed = input;
    std::reverse(reversed.outline.begin(), reversed.outline.end());
    expect_same(build_section(reversed), expected);
  }
}

TEST(Section, TakesAnOutlineWhoseFirstPointIsRepeatedAtTheEnd)
{
  SectionInput input;
  input.outline = {{0, 0}, {4, 0}, {4, 3}, {0, 0}};
  EXPECT_EQ(build_section(input).outline.size(), 3U);
}

TEST(Section, OfAMirroredDrawingIsTheMirrorImage)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = 24.4;
  input.right_pool_level = 9;
  input.zones = {{1, {{80, -2}, {101, 40}, {105, 40}, {120, -2}}},
                 {2, {{10, 0}, {12, 0}, {11, 5}}}};
  input.marked_lines = {{{191.4, 0}, {191.4, 3}}, {{99.83, 28.6}, {107.13, 28.6}}};
  const Section one = build_section(input), other = build_section(mirrored(input));
  ASSERT_EQ(one.outline.size(), other.outline.size());
  for (const Vec2& p : one.outline)
    EXPECT_TRUE(has_vertex(other, {-p.x(), p.y()})) << p.transpose();
  for (const auto& [here, there] : {std::pair{"left_pool", "right_pool"},
                                    {"right_pool", "left_pool"},
                                    {"left_side", "right_side"},
                                    {"right_side", "left_side"},
                                    {"ground", "ground"},
                                    {"base", "base"},
                                    {"marked_1", "marked_1"},
                                    {"marked_2", "marked_2"}})
    EXPECT_NEAR(stretch_length(one, here), stretch_length(other, there), 1e-11) << here;
  for (const double x : {0.0, 20.0, 86.75, 103.0, 150.0, 191.4})
    EXPECT_NEAR(ground_level(one, x), ground_level(other, -x), 1e-13) << x;
  for (const Vec2& p : {Vec2(103, 10), Vec2(11, 1), Vec2(11, 6), Vec2(150, 3)})
    EXPECT_EQ(soil_at(one, p), soil_at(other, {-p.x(), p.y()})) << p.transpose();
}

TEST(Section, WithVerticalFacesDrawnAsGroundHasNoSides)
{
  const Section section = build_section(rectangle_input(16, 24));
  EXPECT_EQ(names(section), (std::set<std::string>{"ground", "base"}));
  EXPECT_DOUBLE_EQ(stretch_length(section, "ground"), 24 + 16 + 24);
  EXPECT_EQ(section.left_side_top, 0);
  EXPECT_EQ(section.right_side_top, 0);
}

TEST(Section, WithVerticalEndsOfItsOutlineHasSides)
{
  SectionInput input;
  input.outline = {{0, 0}, {16, 0}, {16, 20}, {0, 24}};
  const Section section = build_section(input);
  EXPECT_EQ(names(section), (std::set<std::string>{"ground", "base", "left_side", "right_side"}));
  EXPECT_DOUBLE_EQ(stretch_length(section, "left_side"), 24);
  EXPECT_DOUBLE_EQ(stretch_length(section, "right_side"), 20);
  EXPECT_EQ(section.left_side_top, 24);
  EXPECT_EQ(section.right_side_top, 20);
}

TEST(Section, OfATrapezoidalDamHasNoSides)
{
  SectionInput as_outline;
  as_outline.outline = trapezoidal_dam().ground;
  for (const SectionInput& input : {trapezoidal_dam(), as_outline})
  {
    const Section section = build_section(input);
    EXPECT_EQ(section.outline, (Polyline{{0, 0}, {100, 0}, {60, 20}, {50, 20}}));
    EXPECT_EQ(names(section), (std::set<std::string>{"ground", "base"}));
    EXPECT_DOUBLE_EQ(stretch_length(section, "base"), 100);
  }
}

TEST(Section, CutsALevelBaseToTheGround)
{
  SectionInput input = two_sided_embankment();
  input.base = {{-50, 0}, {300, 0}};
  expect_same(build_section(input), build_section(two_sided_embankment()));
}

TEST(Section, WithAnOverhangIsNotSingleValued)
{
  SectionInput input;
  input.outline = {{0, 0}, {10, 0}, {10, 5}, {6, 5}, {7, 8}, {5, 8}, {4, 5}, {0, 5}};
  EXPECT_FALSE(build_section(input).single_valued); // (6, 5) lies under (7, 8)
  input.outline[4] = {6, 8};
  EXPECT_TRUE(build_section(input).single_valued);
  input.outline = {{0, 0}, {10, 0}, {10, 6}, {0, 6}, {0, 5}, {3, 3}, {0, 2}}; // a notch in the end
  EXPECT_FALSE(build_section(input).single_valued);
}

//------------------------------------------------------------------------------------------------
// Pools
//------------------------------------------------------------------------------------------------

TEST(Section, HasAVertexWhereTheLevelMeetsTheSlope)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = 24.4;
  const Section section = build_section(input);
  const double x = upstream_x(24.4);
  EXPECT_NEAR(x, 86.75, 0.002); // the paper's rounded 86.75
  EXPECT_TRUE(has_vertex(section, {x, 24.4}));
  EXPECT_EQ(section.outline.size(), 9U);
  EXPECT_NEAR(stretch_length(section, "left_pool"), 33.5 + std::hypot(x - 33.5, 24.4 - 7.3), 1e-12);
  EXPECT_EQ(section.left_pool_level, 24.4);
  EXPECT_FALSE(section.right_pool_level);
  EXPECT_EQ(section.ground.size(), 6U); // as drawn
}

TEST(Section, OfARectangularDamHasItsPoolsOnTheVerticalFaces)
{
  SectionInput input = rectangle_input(16, 24);
  input.left_pool_level = 24; // up to the crest, not over it
  input.right_pool_level = 4;
  const Section section = build_section(input);
  EXPECT_DOUBLE_EQ(stretch_length(section, "left_pool"), 24);
  EXPECT_DOUBLE_EQ(stretch_length(section, "right_pool"), 4);
  EXPECT_DOUBLE_EQ(stretch_length(section, "ground"), 16 + 20);
  EXPECT_TRUE(has_vertex(section, {16, 4}));
  EXPECT_EQ(section.outline.size(), 5U);
}

TEST(Section, UsesACornerThatTheWaterlineMeetsWithinTheTolerance)
{
  for (const double off : {-1e-8, 0.0, 1e-8}) // the tolerance is 1e-9 of 191.4 m
  {
    SectionInput input = two_sided_embankment();
    input.left_pool_level = 28.6 + off;
    const Section section = build_section(input);
    EXPECT_EQ(section.outline.size(), 8U) << off;
    EXPECT_NEAR(stretch_length(section, "left_pool"), 33.5 + std::hypot(99.83 - 33.5, 28.6 - 7.3),
                1e-12);
  }
}

TEST(Section, EndsAPoolAtTheFirstGroundAboveIt)
{
  SectionInput input;
  input.ground = {{0, 2}, {4, 6}, {8, 1}, {12, 8}, {20, 0}}; // a cofferdam before the dam
  input.base = {{0, 0}, {20, 0}};
  input.left_pool_level = 5;
  input.right_pool_level = 7;
  const Section section = build_section(input);
  EXPECT_NEAR(stretch_length(section, "left_pool"), 3 * std::sqrt(2.0), 1e-12);  // (0,2) to (3,5)
  EXPECT_NEAR(stretch_length(section, "right_pool"), 7 * std::sqrt(2.0), 1e-12); // (20,0) to (13,7)
  input.left_pool_level = 6; // up to the crown, the hollow behind it stays dry
  EXPECT_NEAR(stretch_length(build_section(input), "left_pool"), 4 * std::sqrt(2.0), 1e-12);
}

TEST(Section, HasNoPoolWhereTheLevelIsTheGround)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = input.right_pool_level = 7.3;
  const Section section = build_section(input);
  EXPECT_FALSE(section.left_pool_level);
  EXPECT_FALSE(section.right_pool_level);
  expect_same(section, build_section(two_sided_embankment()));
}

TEST(Section, UnderADeepPoolIsCoveredFromEndToEnd)
{
  SectionInput input; // a submerged slope, lengths in feet
  input.ground = {{0, 15}, {30, 15}, {105, 45}, {140, 45}};
  input.base = {{0, 0}, {140, 0}};
  const double length = 30 + std::hypot(75, 30) + 35;
  for (const double level : {75.0, 105.0})
  {
    input.left_pool_level = level;
    input.right_pool_level = std::nullopt;
    EXPECT_DOUBLE_EQ(stretch_length(build_section(input), "left_pool"), length);
    input.right_pool_level = level; // the same water
    const Section both = build_section(input);
    EXPECT_DOUBLE_EQ(stretch_length(both, "left_pool"), length);
    EXPECT_FALSE(both.right_pool_level);
    input.left_pool_level = std::nullopt;
    EXPECT_DOUBLE_EQ(stretch_length(build_section(input), "right_pool"), length);
  }
}

/// Length under the right pool where the left one, at 31 m, runs over the crest of 28.6 m.
double under_right_pool(double level)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = 31;
  input.right_pool_level = level;
  return stretch_length(build_section(input), "right_pool");
}

TEST(Section, LetsAPoolAboveTheCrestRunDownToTheOtherEnd)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = 31;
  const Section section = build_section(input);
  ASSERT_TRUE(section.overflow);
  EXPECT_EQ(section.overflow->crest, Vec2(99.83, 28.6));
  EXPECT_NEAR(section.overflow->depth, 2.4, 1e-12);
  EXPECT_NEAR(stretch_length(section, "left_pool"), 33.5 + std::hypot(66.33, 21.3), 1e-12);
  EXPECT_NEAR(stretch_length(section, "overflow"), 7.3 + std::hypot(50.77, 21.3) + 33.5, 1e-12);
  EXPECT_EQ(stretch_length(section, "ground"), 0);
  EXPECT_TRUE(has_vertex(section, {99.83 + 2.4, 28.6})); // where the water is down to a film
  ASSERT_EQ(section.warnings.size(), 1U);
  EXPECT_NE(section.warnings[0].find("the left pool, 31 m, stands above the crest, 28.6 m, at "
                                     "(99.83, 28.6): overtopping"),
            std::string::npos)
      << section.warnings[0];
}

TEST(Section, EndsWhatRunsOverWhereTheOtherPoolStandsAsHigh)
{
  // On the slope the film meets the pool at its waterline.
  EXPECT_NEAR(under_right_pool(10), 33.5 + (10 - 7.3) / 21.3 * std::hypot(50.77, 21.3), 1e-9);
  EXPECT_EQ(under_right_pool(7.3), 0); // no pool
  // Above the crest, on the falling water: 31 - 0.6 = 30.4, and 1.8 m deep on the crest.
  EXPECT_NEAR(under_right_pool(30.4), 7.3 - 0.6 + std::hypot(50.77, 21.3) + 33.5, 1e-9);
}

TEST(Section, MirroredOvertopsTheOtherWay)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = 31;
  input.right_pool_level = 12;
  const Section a = build_section(input), b = build_section(mirrored(input));
  EXPECT_EQ(b.overflow->crest, Vec2(-99.83, 28.6));
  EXPECT_NEAR(stretch_length(a, "overflow"), stretch_length(b, "overflow"), 1e-9);
  EXPECT_NEAR(stretch_length(a, "left_pool"), stretch_length(b, "right_pool"), 1e-9);
}

TEST(Section, UpToTheCrestExactlyIsNotOvertopped)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = 28.6;
  const Section section = build_section(input);
  EXPECT_FALSE(section.overflow);
  EXPECT_TRUE(section.warnings.empty());
  EXPECT_NEAR(stretch_length(section, "ground"), 7.3 + std::hypot(50.77, 21.3) + 33.5, 1e-12);
}

TEST(Section, UnderOneLevelOnBothSidesIsSubmerged)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = input.right_pool_level = 31;
  const Section section = build_section(input);
  EXPECT_FALSE(section.overflow);
  EXPECT_EQ(stretch_length(section, "ground") + stretch_length(section, "overflow"), 0);
}

//------------------------------------------------------------------------------------------------
// Lines through the soil
//------------------------------------------------------------------------------------------------

TEST(Section, TakesALineInTheSoilForAnInnerOne)
{
  SectionInput input = two_sided_embankment();
  input.marked_lines = {{{0, 0}, {0, 7.3}}, {{90, 5}, {100, 8}, {110, 5}}};
  const Section section = build_section(input);
  ASSERT_EQ(section.inner_lines.size(), 1U);
  EXPECT_EQ(section.inner_lines[0].points, input.marked_lines[1]);
  EXPECT_EQ(section.stretches[static_cast<std::size_t>(section.inner_lines[0].stretch)].name,
            "marked_2");
  EXPECT_EQ(stretch_length(section, "marked_2"), 0); // none of the outline
  EXPECT_EQ(stretch_length(section, "marked_1"), 7.3);
}

TEST(Section, GivesAnInnerLineThatBeginsOnTheOutlineAVertexThere)
{
  SectionInput input = two_sided_embankment();
  input.marked_lines = {{{103, 28.605}, {103, 10}}}; // drawn 5 mm above the crest
  const Section section = build_section(input);
  ASSERT_EQ(section.inner_lines.size(), 1U);
  EXPECT_TRUE(has_vertex(section, {103, 28.6}));
  EXPECT_EQ(section.inner_lines[0].points.front(), Vec2(103, 28.6));
}

TEST(Section, TakesAWallRightThroughForAnInnerLine)
{
  SectionInput input = two_sided_embankment();
  input.marked_lines = {{{103, 28.6}, {103, 0}}};
  EXPECT_EQ(build_section(input).inner_lines.size(), 1U);
}

//------------------------------------------------------------------------------------------------
// Zones and marked lines
//------------------------------------------------------------------------------------------------

TEST(Section, HasVerticesWhereZoneBordersMeetTheOutline)
{
  SectionInput input = trapezoidal_dam();
  input.zones = {{1, {{45, -1}, {45, 30}, {55, 30}, {55, -1}}}};
  const Section section = build_section(input);
  for (const Vec2& p : {Vec2(45, 0), Vec2(45, 18), Vec2(55, 0), Vec2(55, 20)})
    EXPECT_TRUE(has_vertex(section, p)) << p.transpose();
  EXPECT_EQ(section.outline.size(), 8U);
  EXPECT_GT(polygon_area(section.zones[0].polygon), 0);
}

TEST(Section, CutsNoEdgeTwiceWhereTwoZonesMeetItAtOnePoint)
{
  SectionInput input = trapezoidal_dam();
  input.zones = {{1, {{40, 0}, {50, 0}, {50, 20}}}, {2, {{50, 0}, {60, 0}, {50, 20}}}};
  EXPECT_EQ(build_section(input).outline.size(), 4U + 3U); // at x = 40, 50, 60
  input.zones[1].polygon[1] = {60.0000001, 0};
  input.zones.push_back({1, {{60, 0}, {70, 0}, {60, 10}}});
  EXPECT_EQ(build_section(input).outline.size(), 4U + 4U);
}

TEST(Section, MovesZoneCornersDrawnToTheMillimetreOntoTheOutline)
{
  SectionInput input = two_sided_embankment();
  const double y = 7.3 + (60 - 33.5) * (28.6 - 7.3) / (99.83 - 33.5); // on the slope at x = 60
  input.zones = {{1, {{60, 0}, {80, 0}, {60, std::round(1e3 * y) / 1e3}}}};
  const Section section = build_section(input);
  const auto& polygon = section.zones[0].polygon;
  EXPECT_NEAR(polygon_area(polygon), 0.5 * 20 * y, 20 * 1e-3);
  EXPECT_TRUE(std::any_of(polygon.begin(), polygon.end(),
                          [&](const Vec2& p)
                          { return p.x() > 59 && p.y() > 1 && has_vertex(section, p); }));
}

TEST(Section, KeepsAZoneThinnerThanTheHealingReach)
{
  SectionInput input = two_sided_embankment();
  input.zones = {{1, {{60, 0}, {60.001, 0}, {60.001, 5}, {60, 5}}}}; // 1 mm in 191 m
  EXPECT_NEAR(polygon_area(build_section(input).zones[0].polygon), 0.005, 1e-9);
}

TEST(Section, GivesEachPointTheLastZoneThatCoversIt)
{
  SectionInput input = trapezoidal_dam();
  input.zones = {{1, {{40, 0}, {40, 30}, {60, 30}, {60, 0}}},
                 {2, {{50, 5}, {70, 5}, {70, -5}, {50, -5}}}};
  const Section section = build_section(input);
  EXPECT_EQ(soil_at(section, {20, 2}), 0);
  EXPECT_EQ(soil_at(section, {45, 2}), 1);
  EXPECT_EQ(soil_at(section, {55, 10}), 1);
  EXPECT_EQ(soil_at(section, {55, 2}), 2);
  EXPECT_EQ(soil_at(section, {65, 2}), 2);
}

TEST(Section, LetsMarkedLinesTakePrecedence)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = 24.4;
  // The right side as drawn; part of the base from right to left; the pool's floor round a corner.
  input.marked_lines = {
      {{191.4, 0}, {191.4, 7.3}}, {{170, 0}, {150, 0}}, {{20, 7.3}, {33.5, 7.3}, {66.665, 17.95}}};
  const Section section = build_section(input);
  EXPECT_DOUBLE_EQ(stretch_length(section, "marked_1"), 7.3);
  EXPECT_DOUBLE_EQ(stretch_length(section, "marked_2"), 20);
  EXPECT_DOUBLE_EQ(stretch_length(section, "marked_3"), 13.5 + std::hypot(33.165, 10.65));
  EXPECT_EQ(stretch_length(section, "right_side"), 0);
  EXPECT_DOUBLE_EQ(stretch_length(section, "base"), 171.4);
  EXPECT_NEAR(stretch_length(section, "left_pool"),
              33.5 + std::hypot(upstream_x(24.4) - 33.5, 17.1) -
                  stretch_length(section, "marked_3"),
              1e-12);
  const auto& marked = section.stretches.back();
  EXPECT_EQ(marked.kind, StretchKind::marked);
  EXPECT_EQ(marked.marked_line, 2);
}

TEST(Section, MovesAMarkedLineDrawnToTheCentimetreOntoTheOutline)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = 24.4;
  input.marked_lines = {{{33.5, 7.3}, {86.75, 24.4}}}; // the paper's rounded waterline
  const Section section = build_section(input);
  EXPECT_EQ(section.outline.size(), 9U);
  EXPECT_DOUBLE_EQ(stretch_length(section, "left_pool"), 33.5);
}

TEST(Section, GivesALineMarkedTwiceToTheLaterOne)
{
  SectionInput input = trapezoidal_dam();
  input.marked_lines = {{{0, 0}, {100, 0}}, {{30, 0}, {40, 0}}};
  const Section section = build_section(input);
  EXPECT_DOUBLE_EQ(stretch_length(section, "marked_1"), 90);
  EXPECT_DOUBLE_EQ(stretch_length(section, "marked_2"), 10);
}

TEST(Section, CutsItsOutlineIntoStretchesThatAddUp)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = 24.4;
  input.right_pool_level = 10;
  input.marked_lines = {{{180, 0}, {191.4, 0}, {191.4, 7.3}}};
  const Section section = build_section(input);
  double sum = 0, perimeter = 0;
  for (const Stretch& stretch : section.stretches)
    sum += stretch_length(section, stretch.name);
  for (std::size_t k = 0; k < section.outline.size(); ++k)
    perimeter += (section.outline[(k + 1) % section.outline.size()] - section.outline[k]).norm();
  EXPECT_NEAR(sum, perimeter, 1e-11);
  EXPECT_EQ(section.edge_stretch.size(), section.outline.size());
  EXPECT_EQ(names(section), (std::set<std::string>{"ground", "left_pool", "right_pool", "base",
                                                   "left_side", "marked_1"}));
}

//------------------------------------------------------------------------------------------------
// Questions
//------------------------------------------------------------------------------------------------

TEST(Section, InterpolatesGroundAndBase)
{
  SectionInput input;
  input.ground = {{0, 10}, {4, 12}, {4, 20}, {10, 20}, {10, 15}, {12, 15}};
  input.base = {{0, 2}, {6, 5}, {6, 1}, {12, 1}};
  const Section section = build_section(input);
  EXPECT_DOUBLE_EQ(ground_level(section, 1), 10.5);
  EXPECT_DOUBLE_EQ(ground_level(section, 4), 20); // the highest at a step
  EXPECT_DOUBLE_EQ(ground_level(section, 10), 20);
  EXPECT_DOUBLE_EQ(ground_level(section, 12), 15);
  EXPECT_DOUBLE_EQ(base_level(section, 2), 3);
  EXPECT_DOUBLE_EQ(base_level(section, 6), 1); // the lowest at a step
  EXPECT_DOUBLE_EQ(base_level(section, 0), 2);
}

TEST(Section, ContainsItsInsideAndItsBorder)
{
  const Section section = build_section(trapezoidal_dam());
  for (const Vec2& p :
       {Vec2(55, 10), Vec2(0, 0), Vec2(25, 10), Vec2(55, 20), Vec2(80, 10), Vec2(50, 0)})
    EXPECT_TRUE(contains(section, p)) << p.transpose();
  for (const Vec2& p : {Vec2(55, 20.001), Vec2(-0.001, 0), Vec2(25, 10.001), Vec2(50, -0.001)})
    EXPECT_FALSE(contains(section, p)) << p.transpose();
}
} // namespace
} // namespace berm::meshes
