// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "seepage/seepage.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace berm::seepage
{
namespace
{
/// A dam 4 m long with 3 m of water.
meshes::Section dam()
{
  meshes::SectionInput input = tests::rectangle_input(4, 3.5);
  input.left_pool_level = 3;
  return meshes::build_section(input);
}

/// Coarse: these tests ask what solve does, not how accurate it is.
constexpr Settings quick{.element_size = 0.5, .tolerance = 5e-3};

TEST(Solve, TellsTheObserverAboutEachMesh)
{
  struct Notes : Observer
  {
    std::vector<std::string> notes;
    double fraction = 0;
    void note(std::string_view text) override { notes.emplace_back(text); }
    void progress(double f, std::string_view) override { fraction = f; }
  } observer;
  const meshes::Section section = dam();
  const Solution s = solve(section, {{1, 1, 0}}, boundary_conditions(section, {}), quick, observer);
  ASSERT_EQ(observer.notes.size(), s.history.size());
  EXPECT_EQ(
      observer.notes[0].rfind("mesh 1: " + std::to_string(s.history[0].unknowns) + " unknowns", 0),
      0)
      << observer.notes[0];
  EXPECT_EQ(observer.fraction, 1);
}

TEST(Solve, RefinesUntilTheToleranceIsMetUnlessToldNotTo)
{
  const meshes::Section section = dam();
  Observer observer;
  const auto solve_with = [&](const Settings& settings) {
    return solve(section, {{1, 1, 0}}, boundary_conditions(section, {}), settings, observer);
  };
  const Solution coarse = solve_with({.element_size = 0.5, .adaptive = false});
  EXPECT_EQ(coarse.history.size(), 1);
  EXPECT_FALSE(coarse.error.discharge); // one mesh does not tell
  EXPECT_TRUE(coarse.error.head.empty());
  for (const double tolerance : {1e-2, 1e-3})
  {
    const Solution s =
        solve_with({.element_size = 0.5, .tolerance = tolerance, .phreatic_tolerance = 0.1});
    EXPECT_GE(s.history.size(), 2);
    EXPECT_TRUE(s.error.within_tolerance);
    EXPECT_LE(s.error.discharge.value(), tolerance * s.discharge);
    EXPECT_LE(s.error.phreatic_line.value(), 0.1);
    EXPECT_EQ(s.error.head.size(), s.head.size());
    EXPECT_NEAR(s.discharge, 9 / 8., tolerance * 9 / 8.); // Charny: k H^2 / (2 L)
  }
}

TEST(Solve, SaysThatTheToleranceIsNotMetWhereTheMeshMayNotGrow)
{
  struct Warned : Observer
  {
    int warnings = 0;
    void warn(std::string_view) override { ++warnings; }
  } observer;
  const meshes::Section section = dam();
  const Solution s =
      solve(section, {{1, 1, 0}}, boundary_conditions(section, {}),
            {.element_size = 0.5, .tolerance = 1e-6, .most_unknowns = 300}, observer);
  EXPECT_FALSE(s.error.within_tolerance);
  EXPECT_EQ(observer.warnings, 1);
  EXPECT_GT(s.error.discharge.value(), 1e-6 * s.discharge);
}

TEST(Solve, ArraysBelongToTheMesh)
{
  const meshes::Section section = dam();
  Observer observer;
  const Solution s = solve(section, {{1, 1, 0}}, boundary_conditions(section, {}), quick, observer);
  ASSERT_EQ(s.head.size(), s.mesh.nodes.size());
  ASSERT_EQ(s.pore_pressure.size(), s.mesh.nodes.size());
  ASSERT_EQ(s.flux.size(), s.mesh.triangles.size());
  ASSERT_EQ(s.stretch_inflow.size(), section.stretches.size());
  for (std::size_t i = 0; i < s.head.size(); ++i)
    EXPECT_NEAR(s.pore_pressure[i], water_unit_weight * (s.head[i] - s.mesh.nodes[i].y()), 1e-9);
}

TEST(Solve, PutsANodeWhereASideMeetsItsHead)
{
  // The whole right face is marked with a head of 0.6 m: tailwater below, seepage face above.
  meshes::SectionInput input = tests::rectangle_input(4, 3.5);
  input.left_pool_level = 3;
  input.marked_lines = {{{4, 0}, {4, 3.5}}};
  const meshes::Section section = meshes::build_section(input);
  Observer observer;
  const Solution s =
      solve(section, {{1, 1, 0}}, boundary_conditions(section, {{BoundaryKind::head, 0.6}}), quick,
            observer);
  EXPECT_NE(std::ranges::find(s.mesh.nodes, Vec2(4, 0.6)), s.mesh.nodes.end());
  ASSERT_TRUE(s.exit_point);
  EXPECT_GT(s.exit_point->y(), 0.6);
}

/// A levee on a plain of 200 m on either side.
meshes::SectionInput levee()
{
  meshes::SectionInput input;
  input.ground = {{0, 5}, {200, 5}, {208, 9}, {211, 9}, {219, 5}, {419, 5}};
  input.base = {{0, 0}, {419, 0}};
  return input;
}

TEST(Solve, EqualPoolsMoveNothing)
{
  meshes::SectionInput input = levee();
  input.left_pool_level = input.right_pool_level = 8;
  const meshes::Section section = meshes::build_section(input);
  Observer observer;
  const Solution s =
      solve(section, {{1e-6, 1e-6, 0}}, boundary_conditions(section, {}), {}, observer);
  EXPECT_EQ(s.discharge, 0);
  EXPECT_EQ(s.balance, 0);
  EXPECT_FALSE(s.exit_point);
  // Nothing flows: the hydrostatic state is exact, to the rounding of a linear solve [m].
  for (const double head : s.head)
    EXPECT_NEAR(head, 8, 1e-10);
  EXPECT_NEAR(phreatic_level(s, 210).value(), 8, 1e-10);
}

TEST(Solve, OutflowThatFadesBelowRoundingDoesNotUnsettleTheSeepageFace)
{
  // Far out on the plain water comes up at 1e-17 of the discharge.
  meshes::SectionInput input = levee();
  input.left_pool_level = 8;
  const meshes::Section section = meshes::build_section(input);
  Observer observer;
  const Solution s =
      solve(section, {{1e-6, 1e-6, 0}}, boundary_conditions(section, {}), {}, observer);
  EXPECT_LT(s.balance, 1e-8);
  for (const SolveHistory& mesh : s.history)
    EXPECT_LT(mesh.newton_steps, 30); // about ten and fifteen
}

TEST(Solve, WithoutConductivityIsAnInputError)
{
  const meshes::Section section = dam();
  Observer observer;
  for (const std::vector<Conductivity>& k :
       {std::vector<Conductivity>{}, {{0, 1, 0}}, {{1, -1, 0}}, {{1, NAN, 0}}})
    EXPECT_THROW(
        static_cast<void>(solve(section, k, boundary_conditions(section, {}), quick, observer)),
        InputError);
}

TEST(Solve, WithoutAnAnswerIsNotConvergedAndTellsItsHistory)
{
  // More water is to leave through the dry top than dry soil conducts.
  meshes::SectionInput input = tests::rectangle_input(4, 3.5);
  input.left_pool_level = 3;
  input.marked_lines = {{{0, 3.5}, {4, 3.5}}};
  const meshes::Section section = meshes::build_section(input);
  Observer observer;
  try
  {
    static_cast<void>(solve(section, {{1, 1, 0}},
                            boundary_conditions(section, {{BoundaryKind::inflow, -0.5}}), quick,
                            observer));
    FAIL() << "no error";
  }
  catch (const NotConverged& error)
  {
    EXPECT_NE(std::string(error.what()).find("residual"), std::string::npos) << error.what();
  }
}

TEST(Solve, StopsWhenAsked)
{
  struct Stop : Observer
  {
    [[nodiscard]] bool stop_requested() const override { return true; }
  } observer;
  const meshes::Section section = dam();
  EXPECT_THROW(static_cast<void>(
                   solve(section, {{1, 1, 0}}, boundary_conditions(section, {}), quick, observer)),
               NotConverged);
}

TEST(Solve, GivesTheSameBitsTwice)
{
  const meshes::Section section = dam();
  Observer observer;
  const Solution a = solve(section, {{1, 1, 0}}, boundary_conditions(section, {}), quick, observer);
  const Solution b = solve(section, {{1, 1, 0}}, boundary_conditions(section, {}), quick, observer);
  EXPECT_EQ(a.head, b.head);
  EXPECT_EQ(a.discharge, b.discharge);
}
} // namespace
} // namespace berm::seepage
