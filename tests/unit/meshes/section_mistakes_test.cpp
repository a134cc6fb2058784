// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "meshes/section.h"

#include "sections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace berm::meshes
{
namespace
{
using namespace berm::tests;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<Mistake> mistakes_of(const SectionInput& input)
{
  try
  {
    (void)build_section(input);
  }
  catch (const InputError& error)
  {
    return error.mistakes();
  }
  return {};
}

struct BadSection
{
  std::string name;
  std::function<void(SectionInput&)> spoil; ///< applied to the two-sided embankment
  std::string key, value, problem;          ///< parts of the first mistake's texts
};

void PrintTo(const BadSection& bad, std::ostream* stream)
{
  *stream << bad.name;
}

void use_outline(SectionInput& input, Polyline outline)
{
  input.ground.clear();
  input.base.clear();
  input.outline = std::move(outline);
}

class SectionMistake : public testing::TestWithParam<BadSection>
{
};

TEST_P(SectionMistake, IsReportedWithKeyValueAndProblem)
{
  SectionInput input = two_sided_embankment();
  GetParam().spoil(input);
  const auto mistakes = mistakes_of(input);
  ASSERT_FALSE(mistakes.empty());
  for (const Mistake& mistake :
       mistakes) // a corner that touches an edge is reported by both its edges
    EXPECT_EQ(mistake.key, GetParam().key) << mistake.problem;
  EXPECT_LE(mistakes.size(), 2U);
  EXPECT_EQ(mistakes[0].key, GetParam().key);
  EXPECT_NE(mistakes[0].value.find(GetParam().value), std::string::npos) << mistakes[0].value;
  EXPECT_NE(mistakes[0].problem.find(GetParam().problem), std::string::npos) << mistakes[0].problem;
}

const std::string ground = "section.ground_m", base = "section.base_m";
const std::string outline = "section.outline_m", zone = "section.zone[1].polygon_m";
const std::string line = "seepage.boundary[1].line_m";

INSTANTIATE_TEST_SUITE_P(
    Each, SectionMistake,
    testing::Values(
        BadSection{"NothingDrawn", [](SectionInput& s) { s = {}; }, ground, "", "not drawn"},
        BadSection{"OneGroundPoint", [](SectionInput& s) { s.ground.resize(1); }, ground,
                   "1 points", "too few"},
        BadSection{"NoBase", [](SectionInput& s) { s.base.clear(); }, base, "0 points", "too few"},
        BadSection{"GroundNotANumber", [](SectionInput& s) { s.ground[2].y() = nan; }, ground,
                   "(99.83, nan)", "point 3"},
        BadSection{"BaseInfinite", [](SectionInput& s) { s.base[1].y() = -1 / 0.0; }, base, "-inf",
                   "point 2"},
        BadSection{"RepeatedGroundPoint",
                   [](SectionInput& s) { s.ground.insert(s.ground.begin() + 1, s.ground[1]); },
                   ground, "(33.5, 7.3)", "points 2 and 3 are the same"},
        BadSection{"GroundGoesBack",
                   [](SectionInput& s) {
                     s.ground[2] = {20, 12};
                   },
                   ground, "(20, 12)", "x falls from point 2 to point 3"},
        BadSection{"BaseGoesBack",
                   [](SectionInput& s) {
                     s.base = {{0, 0}, {50, -1}, {40, -2}, {191.4, 0}};
                   },
                   base, "(40, -2)", "x falls from point 2 to point 3"},
        BadSection{"GroundFoldsBack",
                   [](SectionInput& s) {
                     s.ground = {{0, 7.3}, {50, 7.3}, {50, 20}, {50, 12}, {191.4, 7.3}};
                   },
                   ground, "(50, 7.3) - (50, 20)", "edge 2 touches edge 3, (50, 20) - (50, 12)"},
        BadSection{"GroundWithoutWidth",
                   [](SectionInput& s) {
                     s.ground = {{5, 0}, {5, 9}};
                   },
                   ground, "(5, 0)", "no width"},
        BadSection{"BaseTooShort", [](SectionInput& s) { s.base[1].x() = 180; }, base, "(180, 0)",
                   "does not end where the ground ends"},
        BadSection{"BentBaseTooLong",
                   [](SectionInput& s) {
                     s.base = {{0, 0}, {50, 1}, {200, 0}};
                   },
                   base, "(200, 0)", "does not end where the ground ends"},
        BadSection{"BaseAboveGround",
                   [](SectionInput& s) {
                     s.base = {{0, 0}, {20, 9}, {191.4, 0}};
                   },
                   base, "9", "1.7 m above the ground at x = 20"},
        BadSection{"BaseTouchesGround",
                   [](SectionInput& s) {
                     s.base = {{0, 0}, {20, 7.3}, {191.4, 0}};
                   },
                   ground, "", "touches"},
        BadSection{"NoSoil", [](SectionInput& s) { s.base = s.ground; }, ground, "", "no soil"},
        BadSection{"OutlineOfTwoPoints",
                   [](SectionInput& s) {
                     use_outline(s, {{0, 0}, {1, 1}});
                   },
                   outline, "2 points", "too few"},
        BadSection{"OutlineWithoutArea",
                   [](SectionInput& s) {
                     use_outline(s, {{0, 0}, {1, 1}, {2, 2}});
                   },
                   outline, "", "no area"},
        BadSection{"OutlineCrossesItself",
                   [](SectionInput& s) {
                     use_outline(s, {{0, 0}, {9, 0}, {9, 4}, {4, -4}, {0, 5}});
                   },
                   outline, "(0, 0) - (9, 0)", "crosses edge"},
        BadSection{"ZoneCrossesItself",
                   [](SectionInput& s) {
                     s.zones = {{1, {{50, 0}, {60, 5}, {60, 0}, {50, 5}}}};
                   },
                   zone, "(50, 0) - (60, 5)", "edge 1 crosses edge 3, (60, 0) - (50, 5)"},
        BadSection{"ZoneOfTwoPoints",
                   [](SectionInput& s) {
                     s.zones = {{1, {{50, 0}, {60, 5}}}};
                   },
                   zone, "2 points", "too few"},
        BadSection{"ZoneBeside",
                   [](SectionInput& s) {
                     s.zones = {{1, {{200, 0}, {210, 0}, {205, 5}}}};
                   },
                   zone, "(200, 0)", "outside the section"},
        BadSection{"ZoneThatOnlyTouches",
                   [](SectionInput& s) {
                     s.zones = {{1, {{0, 0}, {50, 0}, {50, -5}, {0, -5}}}};
                   },
                   zone, "", "outside the section"},
        BadSection{"LeftPoolBelowGround", [](SectionInput& s) { s.left_pool_level = 7; },
                   "water.left_level_m", "7",
                   "below the ground at its end of the section, (0, 7.3)"},
        BadSection{"RightPoolBelowGround", [](SectionInput& s) { s.right_pool_level = -1; },
                   "water.right_level_m", "-1",
                   "below the ground at its end of the section, (191.4, 7.3)"},
        BadSection{"PoolLevelNotANumber", [](SectionInput& s) { s.left_pool_level = nan; },
                   "water.left_level_m", "nan", "not a number"},
        BadSection{"LeftPoolOverGroundThatNothingDams",
                   [](SectionInput& s)
                   {
                     s.ground = {{0, 7.3}, {50, 20}, {191.4, 20}};
                     s.left_pool_level = 30;
                     s.right_pool_level = 20;
                   },
                   "water.left_level_m", "30",
                   "no crest to hold it, and water.right_level_m = 20 is another level"},
        BadSection{"MarkedPointOutside",
                   [](SectionInput& s) {
                     s.marked_lines = {{{0, 0}, {40, -2}}};
                   },
                   line, "(40, -2)", "lies 2 m outside the section"},
        BadSection{"MarkedLineHalfInHalfOut",
                   [](SectionInput& s) {
                     s.marked_lines = {{{103, 20}, {103, 40}}};
                   },
                   line, "(103, 40)", "lies 11.4 m outside the section"},
        BadSection{"MarkedLineAlongTheOutlineAndThenIn",
                   [](SectionInput& s) {
                     s.marked_lines = {{{0, 7.3}, {33.5, 7.3}, {40, 3}}};
                   },
                   line, "(33.5, 7.3)", "a line through the soil meets the outline here"},
        BadSection{
            "InnerLineThroughTheAir",
            [](SectionInput& s) { // from one slope to the other, over the toe's ground
              use_outline(s, {{0, 0}, {20, 0}, {20, 10}, {11, 10}, {10, 4}, {9, 10}, {0, 10}});
              s.marked_lines = {{{5, 8}, {15, 8}}};
            },
            line, "(5, 8) - (15, 8)", "leaves or touches the section at"},
        BadSection{
            "InnerLineTouchesACorner",
            [](SectionInput& s)
            {
              use_outline(s, {{0, 0}, {20, 0}, {20, 10}, {11, 10}, {10, 4}, {9, 10}, {0, 10}});
              s.marked_lines = {{{5, 4}, {15, 4}}};
            },
            line, "(5, 4) - (15, 4)", "leaves or touches the section at (10, 4)"},
        BadSection{"InnerLineCrossesItself",
                   [](SectionInput& s) {
                     s.marked_lines = {{{90, 5}, {100, 5}, {100, 10}, {95, 10}, {95, 2}}};
                   },
                   line, "(90, 5) - (100, 5)", "edge 1 crosses edge 4"},
        BadSection{"InnerLineTouchesItself",
                   [](SectionInput& s) {
                     s.marked_lines = {{{90, 5}, {100, 5}, {100, 10}, {95, 5}}};
                   },
                   line, "(90, 5) - (100, 5)", "edge 1 touches edge 3"},
        BadSection{"InnerLineOnAnother",
                   [](SectionInput& s) {
                     s.marked_lines = {{{90, 5}, {100, 5}}, {{95, 5}, {110, 5}}};
                   },
                   "seepage.boundary[2].line_m", "(95, 5) - (110, 5)",
                   "runs along seepage.boundary[1].line_m"},
        BadSection{"MarkedLineAcross",
                   [](SectionInput& s) {
                     s.marked_lines = {{{33.5, 7.3}, {107.13, 28.6}}};
                   },
                   line, "(33.5, 7.3) - (107.13, 28.6)", "the outline leaves this line by 2.0"},
        BadSection{"MarkedPoint",
                   [](SectionInput& s) {
                     s.marked_lines = {{{0, 0}}};
                   },
                   line, "1 points", "too few"}),
    [](const testing::TestParamInfo<BadSection>& instance) { return instance.param.name; });

TEST(SectionMistakes, AreAllReportedAtOnceAndCountedFromOne)
{
  SectionInput input = two_sided_embankment();
  input.left_pool_level = 3;
  input.right_pool_level = 5;
  input.zones = {{1, {{50, 0}, {60, 0}, {55, 5}}},
                 {1, {{50, 40}, {60, 40}, {55, 50}}},
                 {2, {{0, 0}, {nan, 1}, {0, 1}}}};
  input.marked_lines = {{{0, 0}, {50, 0}}, {{0, 3}, {-5, 3}}};
  std::vector<std::string> keys;
  for (const Mistake& mistake : mistakes_of(input))
    keys.push_back(mistake.key);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(keys, (std::vector<std::string>{
                      "section.zone[2].polygon_m", "section.zone[3].polygon_m",
                      "seepage.boundary[2].line_m", "water.left_level_m", "water.right_level_m"}));
}

TEST(SectionMistakes, InGroundAndBaseAreReportedTogetherWithThoseInZones)
{
  SectionInput input = two_sided_embankment();
  input.ground[1] = input.ground[0];
  input.base = {{0, 0}};
  input.zones = {{1, {{50, 0}, {60, 5}, {60, 0}, {50, 5}}}};
  EXPECT_EQ(mistakes_of(input).size(), 3U);
}
} // namespace
} // namespace berm::meshes
