// SPDX-License-Identifier: GPL-3.0-or-later
// Walls, drains and wells of no thickness inside the section: docs/verification.md S-14.
#include "core/error.h"
#include "meshes/mesher.h"
#include "tests/support/measured.h"
#include "tests/verification/seepage_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace berm
{
namespace
{
using seepage::Boundary;
using seepage::BoundaryKind;
using seepage::Solution;
using tests::rectangle_input;

constexpr Boundary impervious{BoundaryKind::impervious, 0};

Boundary head(double value)
{
  return {BoundaryKind::head, value};
}

/// On the mesh that the default tolerance asks for.
Solution solved(const meshes::SectionInput& input, const std::vector<Boundary>& marked)
{
  const meshes::Section section = meshes::build_section(input);
  Observer observer;
  return seepage::solve(section, {{1, 1, 0}}, seepage::boundary_conditions(section, marked), {},
                        observer);
}

/// Inflow through the stretch of a marked line [m2/s].
double inflow_of(const meshes::SectionInput& input, const Solution& s, Index marked_line)
{
  const meshes::Section section = meshes::build_section(input);
  const auto it = std::ranges::find(section.stretches, marked_line, &meshes::Stretch::marked_line);
  return s.stretch_inflow.at(static_cast<std::size_t>(it - section.stretches.begin()));
}

//------------------------------------------------------------------------------------------------
// A sheet pile of depth s in a layer of thickness T, ground at the top.
//------------------------------------------------------------------------------------------------

constexpr double layer = 20, drop = 10, half = 3 * layer;

meshes::SectionInput sheet_pile(double depth)
{
  meshes::SectionInput input;
  input.outline = {{-half, 0}, {half, 0}, {half, layer}, {-half, layer}};
  input.marked_lines = {
      {{-half, layer}, {0, layer}}, {{0, layer}, {half, layer}}, {{0, layer}, {0, layer - depth}}};
  return input;
}

Solution solved_sheet_pile(double depth)
{
  return solved(sheet_pile(depth), {head(layer + drop), head(layer), impervious});
}

class SheetPileOfNoThickness : public testing::TestWithParam<std::pair<double, double>>
{
};

// q / (k H) for s / T: closed form with elliptic integrals. First order in the edge at the tip,
// here of T / 640, and the edges of T / 16 away from it: 0.3 %.
TEST_P(SheetPileOfNoThickness, HasItsExactDischarge)
{
  const auto [depth, discharge] = GetParam();
  const Solution s = solved_sheet_pile(depth * layer);
  tests::expect_measured("S-14 sheet pile: discharge / k [m]", s.discharge, drop * discharge,
                         3e-3 * drop * discharge);
  EXPECT_LT(s.balance, 1e-8);
  EXPECT_EQ(inflow_of(sheet_pile(depth * layer), s, 2), 0);
}
INSTANTIATE_TEST_SUITE_P(Depths, SheetPileOfNoThickness,
                         testing::Values(std::pair{0.25, 0.734609}, std::pair{0.5, 0.5},
                                         std::pair{0.75, 0.340317}));

TEST(SheetPileOfNoThickness, HasHalfTheDropBelowItsTipAndAStepAcross)
{
  const Solution s = solved_sheet_pile(layer / 2);
  tests::expect_error(
      "S-14 sheet pile: heads below its tip, largest error [m]",
      tests::largest_head_error(s, {{0, 2, layer + drop / 2}, {0, 7, layer + drop / 2}}),
      2e-3 * drop); // half the drop by symmetry
  const double a = seepage::value_at(s, s.head, {-0.01, 15}, 0).value(),
               b = seepage::value_at(s, s.head, {0.01, 15}, 0).value();
  EXPECT_GT(a - b, 0.4 * drop);
  EXPECT_NEAR(a + b, 2 * layer + drop, 4e-3 * drop); // antisymmetric
}

TEST(SheetPileOfNoThickness, IsAStreamLineAndTheRangeOfPsiIsTheDischarge)
{
  const Solution s = solved_sheet_pile(layer / 2);
  const auto [low, high] = std::ranges::minmax(s.stream_function);
  EXPECT_NEAR(high - low, s.discharge, 1e-6 * s.discharge);
  for (std::size_t i = 0; i < s.mesh.nodes.size(); ++i)
    if (const Vec2& x = s.mesh.nodes[i]; x.x() == 0 && x.y() > layer / 2 && x.y() < layer)
    {
      EXPECT_NEAR(s.stream_function[i], high, 1e-6 * s.discharge);
    }
}

TEST(SheetPileOfNoThickness, MirroredHasMirroredHeads)
{
  const meshes::SectionInput input = sheet_pile(layer / 2);
  const meshes::Section section = meshes::build_section(input);
  meshes::TriangleMesh mesh = meshes::triangulate(section, 2);
  const std::vector<Boundary> boundary =
      seepage::boundary_conditions(section, {head(layer + drop), head(layer), impervious});
  Observer observer;
  const Solution a = seepage::solve_on_mesh(mesh, {{1, 2, 0.3}}, boundary, observer);
  for (Vec2& x : mesh.nodes)
    x.x() *= -1;
  for (auto& t : mesh.triangles)
    std::swap(t[1], t[2]);
  for (auto& edge : mesh.boundary)
    std::swap(edge[0], edge[1]);
  const Solution b = seepage::solve_on_mesh(mesh, {{1, 2, -0.3}}, boundary, observer);
  EXPECT_NEAR(a.discharge, b.discharge, 1e-7 * a.discharge);
  for (std::size_t i = 0; i < a.head.size(); ++i)
    ASSERT_NEAR(a.head[i], b.head[i], 1e-7 * drop); // the tolerance of the solve
}

//------------------------------------------------------------------------------------------------
// A line x in [-a, a] in a confined disk whose rim is a confocal ellipse: z = a cosh(xi + i eta),
// head linear in xi, so that q = 2 pi k (H - h) / xi_rim. Heads are lifted above all soil.
//------------------------------------------------------------------------------------------------

constexpr double half_line = 5, rim = 1.5, datum = 100;

meshes::SectionInput confocal()
{
  meshes::SectionInput input;
  constexpr int sides = 240; // the polygon's area is 1e-4 short, its head no more than that off
  for (int k = 0; k < sides; ++k)
    input.outline.emplace_back(half_line * std::cosh(rim) * std::cos(2 * pi * k / sides),
                               half_line * std::sinh(rim) * std::sin(2 * pi * k / sides));
  Polyline around = input.outline;
  around.push_back(around.front());
  input.marked_lines = {around, {{-half_line, 0}, {half_line, 0}}};
  return input;
}

const Polyline tips{{-half_line, 0}, {half_line, 0}};

TEST(LineOfGivenHead, TakesItsExactDischarge)
{
  const Solution s = solved(confocal(), {head(datum + 6), head(datum)});
  const double exact = 2 * pi * 6 / rim;
  tests::expect_measured("S-14 line of given head: discharge / k [m]", s.discharge, exact,
                         4e-3 * exact); // as above; the polygon takes 0.01 %
  EXPECT_NEAR(inflow_of(confocal(), s, 1), -s.discharge, 1e-8 * exact);
  EXPECT_LT(s.balance, 1e-8);
  const double xi = 0.75; // on the axes
  tests::expect_error("S-14 line of given head: heads, largest error [m]",
                      tests::largest_head_error(s, {{half_line * std::cosh(xi), 0, datum + 3},
                                                    {0, half_line * std::sinh(xi), datum + 3}}),
                      0.01 * 6);
  EXPECT_TRUE(s.stream_function.empty()); // psi grows by q with every turn
}

TEST(LineOfInflow, GivesItsFluxOnBothSides)
{
  const Solution s = solved(confocal(), {head(datum), {BoundaryKind::inflow, 0.25}});
  EXPECT_NEAR(s.discharge, 2 * 0.25 * 2 * half_line, 1e-7 * s.discharge);
  EXPECT_NEAR(inflow_of(confocal(), s, 0), -5, 1e-6);
  EXPECT_TRUE(s.stream_function.empty());
}

//------------------------------------------------------------------------------------------------
// A wall in the soil that reaches neither ground nor base
//------------------------------------------------------------------------------------------------

TEST(FloatingWall, HasThePsiOfTheWaterThatPassesBelow)
{
  // 40 m x 20 m between heads; wall at x = 0 from y = 6 to 18. By symmetry the rest of x = 0 is the
  // equipotential of half the drop: the right half alone, without any inner line, tells what passes
  // above and below.
  constexpr double l = 20, t = 20, y1 = 6, y2 = 18;
  meshes::SectionInput half_input;
  half_input.outline = {{0, 0}, {l, 0}, {l, t}, {0, t}};
  half_input.marked_lines = {
      {{0, 0}, {0, y1}}, {{0, y2}, {0, t}}, {{l, 0}, {l, t}}, {{0, t}, {l, t}}};
  const Solution part = solved(half_input, {head(t + 5), head(t + 5), head(t + 1), impervious});
  meshes::SectionInput input;
  input.outline = {{-l, 0}, {l, 0}, {l, t}, {-l, t}};
  input.marked_lines = {
      {{-l, 0}, {-l, t}}, {{l, 0}, {l, t}}, {{-l, t}, {l, t}}, {{0, y1}, {0, y2}}};
  const Solution s = solved(input, {head(t + 9), head(t + 1), impervious, impervious});
  EXPECT_NEAR(s.discharge, part.discharge, 3e-3 * part.discharge); // each first order at the tips
  const double below = inflow_of(half_input, part, 0);
  ASSERT_FALSE(s.stream_function.empty());
  const auto [low, high] = std::ranges::minmax(s.stream_function);
  EXPECT_NEAR(high - low, s.discharge, 1e-6 * s.discharge);
  double on_wall = -1;
  for (std::size_t i = 0; i < s.mesh.nodes.size(); ++i)
    if (const Vec2& x = s.mesh.nodes[i]; x.x() == 0 && x.y() >= y1 && x.y() <= y2)
    {
      if (on_wall < 0)
        on_wall = s.stream_function[i];
      EXPECT_NEAR(s.stream_function[i], on_wall, 1e-9 * s.discharge);
    }
  tests::expect_measured("S-14 floating wall: psi on it [m2/s]", on_wall, below,
                         5e-3 * s.discharge);
}

TEST(FloatingWalls, EachHaveTheirOwnPsi)
{
  // Two levels of symmetric walls in uniform flow to the right: psi on them by symmetry.
  meshes::SectionInput input = rectangle_input(40, 20);
  input.marked_lines = {{{0, 0}, {0, 20}},
                        {{40, 0}, {40, 20}},
                        {{0, 20}, {40, 20}},
                        {{20, 2}, {20, 8}},
                        {{20, 12}, {20, 18}}};
  const Solution s = solved(input, {head(25), head(22), impervious, impervious, impervious});
  const double lower = seepage::value_at(s, s.stream_function, {20, 5}, 0).value(),
               upper = seepage::value_at(s, s.stream_function, {20, 15}, 0).value();
  EXPECT_NEAR(lower + upper, s.discharge, 2e-3 * s.discharge); // the mesh is not symmetric
  EXPECT_LT(lower, 0.4 * s.discharge);
  EXPECT_GT(lower, 0.1 * s.discharge);
}

//------------------------------------------------------------------------------------------------
// Right through, and drains in unconfined flow
//------------------------------------------------------------------------------------------------

TEST(WallRightThrough, KeepsTheWaterOnItsSide)
{
  meshes::SectionInput input = rectangle_input(16, 10);
  input.left_pool_level = 8;
  input.right_pool_level = 3;
  input.marked_lines = {{{6, 10}, {6, 0}}};
  const Solution s = tests::solved(input, {{1, 1, 0}}, {impervious});
  EXPECT_EQ(s.discharge, 0);
  for (std::size_t i = 0; i < s.mesh.nodes.size(); ++i)
    if (const Vec2& x = s.mesh.nodes[i]; x.x() != 6)
    {
      EXPECT_NEAR(s.head[i], x.x() < 6 ? 8 : 3, 1e-8);
    }
}

TEST(WallRightThrough, LeavesDrySoilBehindAndWarns)
{
  struct Listener : Observer
  {
    void warn(std::string_view text) override { warnings.emplace_back(text); }
    std::vector<std::string> warnings;
  } listener;
  meshes::SectionInput input = rectangle_input(16, 10);
  input.left_pool_level = 8;
  input.marked_lines = {{{6, 10}, {6, 0}}};
  const meshes::Section section = meshes::build_section(input);
  const Solution s = seepage::solve(
      section, {{1, 1, 0}}, seepage::boundary_conditions(section, {impervious}), {}, listener);
  EXPECT_EQ(s.discharge, 0);
  EXPECT_NEAR(seepage::value_at(s, s.head, {3, 5}, 0).value(), 8, 1e-8);
  EXPECT_NEAR(seepage::value_at(s, s.head, {12, 5}, 0).value(), 0, 1e-8);
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_NE(listener.warnings[0].find("100 m2 about (11, 5)"), std::string::npos)
      << listener.warnings[0];
}

TEST(WallRightThrough, ThatLeavesAPieceWithoutHeadOrFaceIsRefusedByName)
{
  meshes::SectionInput input = rectangle_input(16, 10);
  input.left_pool_level = 8;
  input.marked_lines = {{{6, 10}, {6, 0}}, {{6, 10}, {16, 10}}, {{16, 0}, {16, 10}}};
  try
  {
    static_cast<void>(tests::solved(input, {{1, 1, 0}}, {impervious, impervious, impervious}));
    FAIL() << "no error";
  }
  catch (const InputError& error)
  {
    EXPECT_NE(error.mistakes().at(0).problem.find("100 m2 about (11, 5)"), std::string::npos)
        << error.mistakes().at(0).problem;
  }
}

TEST(ReliefDrain, DrawsTheFreeSurfaceDownAndTakesItsShareOfTheWater)
{
  meshes::SectionInput input = tests::rectangular_dam(30, 10, 2);
  const double before = seepage::phreatic_level(tests::solved(input, {{1, 1, 0}}), 15).value();
  input.marked_lines = {{{15, 0}, {15, 9}}}; // a chimney drain that stands on the base
  const Solution s = tests::solved(input, {{1, 1, 0}}, {{BoundaryKind::seepage_face, 0}});
  EXPECT_LT(s.balance, 1e-7);
  EXPECT_NEAR(std::accumulate(s.stretch_inflow.begin(), s.stretch_inflow.end(), 0.0), 0,
              1e-7 * s.discharge);
  // Each half is a rectangular dam of its own, without tailwater at the drain: Charny's exact
  // discharge H^2 / (2 L) each, here k = 1.
  const double left = 10. * 10 / (2 * 15), right = 2. * 2 / (2 * 15);
  tests::expect_measured("S-14 relief drain: discharge / k [m]", s.discharge, left + right,
                         2e-3 * left);
  EXPECT_NEAR(inflow_of(input, s, 0), -(left + right), 2e-3 * left);
  EXPECT_LT(seepage::phreatic_level(s, 16).value(), before - 3);
  // The drain begins on the outline: one line round the section, psi has one value.
  const auto [low, high] = std::ranges::minmax(s.stream_function);
  EXPECT_NEAR(high - low, s.discharge, 1e-6 * s.discharge);
}

TEST(WellScreen, AboveItsLevelIsASeepageFace)
{
  // Water in the screen stands at 3 m: Charny's discharge from 10 m to 3 m on either side.
  meshes::SectionInput input = tests::rectangular_dam(30, 10, 10);
  input.marked_lines = {{{15, 0}, {15, 11}}};
  const Solution s = tests::solved(input, {{1, 1, 0}}, {head(3)});
  const double exact = 2 * (10. * 10 - 3 * 3) / (2 * 15);
  tests::expect_measured("S-14 well screen: discharge / k [m]", s.discharge, exact, 2e-3 * exact);
}
} // namespace
} // namespace berm
