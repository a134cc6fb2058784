// SPDX-License-Identifier: GPL-3.0-or-later
// Columns in fields that linear elements hold exactly: all tolerances are rounding.
#include "seepage/heave.h"

#include "exact_flow.h"

#include <gtest/gtest.h>

namespace berm::seepage
{
namespace
{
using test::ExactFlow;
constexpr double gamma_w = water_unit_weight;

Heave heave_of(const ExactFlow& flow, const std::vector<double>& buoyant_weight)
{
  return heave(flow.solution, flow.find_outlets(), buoyant_weight);
}

TEST(Heave, OfUniformlyRisingWaterIsTheCriticalGradientOverTheGradient)
{
  for (const double i : {0.25, 1.0, 2.0})
  {
    const Heave h = heave_of(test::rising_water(i, i), {10e3, 10e3});
    ASSERT_TRUE(h.surface && h.column);
    EXPECT_NEAR(h.surface->factor, 10e3 / gamma_w / i, 1e-11);
    EXPECT_NEAR(h.surface->gradient, i, 1e-12);
    EXPECT_NEAR(h.surface->critical_gradient, 10e3 / gamma_w, 1e-15);
    EXPECT_NEAR(h.column->factor, 10e3 / gamma_w / i, 1e-11);
    EXPECT_NEAR(*h.factor(), 10e3 / gamma_w / i, 1e-11);
    EXPECT_EQ(h.surface->at.y(), 2);
    EXPECT_EQ(h.column->at.y(), 2);
  }
}

// A pervious, heavy layer of 1.2 m on one that holds the water back: nothing at the surface, but
// both layers together are lifted at the base.
TEST(Heave, OfALayerThatHoldsWaterBackIsFoundBelowIt)
{
  const double below = 2.5, above = 0.1;
  const Heave h = heave_of(test::rising_water(below, above), {8e3, 11e3});
  ASSERT_TRUE(h.surface && h.column);
  EXPECT_NEAR(h.surface->factor, 11e3 / gamma_w / above, 1e-10);
  EXPECT_NEAR(h.column->depth, 2, 1e-12);
  EXPECT_NEAR(h.column->excess_head, 0.8 * below + 1.2 * above, 1e-12);
  EXPECT_NEAR(h.column->factor, (0.8 * 8e3 + 1.2 * 11e3) / (gamma_w * (0.8 * below + 1.2 * above)),
              1e-12);
  EXPECT_EQ(*h.factor(), h.column->factor);
}

// A blanket over pervious ground: nothing is worse than the blanket alone.
TEST(Heave, OfABlanketIsThatOfTheBlanketAlone)
{
  const double below = 0.05, above = 0.8;
  const Heave h = heave_of(test::rising_water(below, above), {10e3, 9e3});
  ASSERT_TRUE(h.column);
  EXPECT_LE(h.column->depth, 1.2 + 1e-12);
  EXPECT_NEAR(h.column->factor, 9e3 / gamma_w / above, 1e-11);
}

TEST(Heave, OfSoilThatFloatsIsNegative)
{
  const Heave h = heave_of(test::rising_water(0.5, 0.5), {-1e3, -1e3});
  EXPECT_LT(*h.factor(), 0);
}

TEST(Heave, IsNoneWhereWaterSinks)
{
  ExactFlow flow = test::rising_water(1, 1);
  std::swap(flow.boundary[0].value, flow.boundary[1].value); // 5 below, 7 above
  flow = test::exact_flow(
      flow.solution.mesh, flow.boundary, flow.conductivity, [](const Vec2& x) { return 5 + x.y(); },
      [](const Vec2&) { return 0; });
  const std::vector<Outlet> outlets = flow.find_outlets();
  ASSERT_EQ(outlets.size(), 1u); // out through the base
  EXPECT_NEAR(outlets[0].points[0].normal, 1, 1e-12);
  EXPECT_NEAR(outlets[0].points[0].upward, -1, 1e-12);
  const Heave h = heave(flow.solution, outlets, std::vector<double>{10e3, 10e3});
  EXPECT_FALSE(h.surface || h.column || h.factor());
}

TEST(Heave, LeavesOutWhatIsBesideASingularity)
{
  const ExactFlow flow = test::rising_water(0.5, 0.5);
  std::vector<Outlet> outlets = flow.find_outlets();
  for (ExitPoint& p : outlets[0].points)
    if (p.at.x() < 3)
    {
      p.beside_singularity = Vec2(0, 2);
      p.upward *= 10;
    }
  const Heave h = heave(flow.solution, outlets, std::vector<double>{10e3, 10e3});
  EXPECT_NEAR(h.surface->factor, 10e3 / gamma_w / 0.5, 1e-11);
  EXPECT_GE(h.surface->at.x(), 3);
  EXPECT_GE(h.column->at.x(), 3);
}

// The column ends where the soil does: the lower 0.8 m are taken away.
TEST(Heave, DoesNotReachAcrossAGap)
{
  ExactFlow flow = test::rising_water(2.5, 0.1);
  const std::vector<Outlet> outlets = flow.find_outlets();
  meshes::TriangleMesh& mesh = flow.solution.mesh;
  const auto lower = [&](const std::array<Index, 3>& t)
  {
    return std::ranges::all_of(
        t, [&](Index i) { return mesh.nodes[static_cast<std::size_t>(i)].y() < 0.8 + 1e-9; });
  };
  mesh.triangle_soil.assign(mesh.triangles.size(), 1);
  // Triangles of the second row of cells alone are taken out, so that soil lies below the gap.
  std::erase_if(mesh.triangles,
                [&](const std::array<Index, 3>& t)
                {
                  return lower(t) &&
                         std::ranges::any_of(
                             t, [&](Index i)
                             { return mesh.nodes[static_cast<std::size_t>(i)].y() > 0.5; });
                });
  const Heave h = heave(flow.solution, outlets, std::vector<double>{8e3, 11e3});
  EXPECT_NEAR(h.column->factor, 11e3 / gamma_w / 0.1, 1e-9);
  EXPECT_LE(h.column->depth, 1.2 + 1e-12);
}

// On the other side of a wall of no thickness the head is 5 m higher: the column along the wall
// stays on its own side.
TEST(Heave, StaysOnItsSideOfAWall)
{
  ExactFlow flow = test::rising_water(0.5, 0.5);
  const double wall = flow.find_outlets()[0].points[1].at.x();
  std::vector<Outlet> outlets = flow.find_outlets();
  std::erase_if(outlets[0].points, [&](const ExitPoint& p) { return p.at.x() != wall; });
  ASSERT_FALSE(outlets[0].points.empty());
  Solution& solution = flow.solution;
  meshes::TriangleMesh& mesh = solution.mesh;
  std::vector<Index> twin(mesh.nodes.size(), -1);
  for (std::size_t i = 0, n = mesh.nodes.size(); i < n; ++i)
    if (mesh.nodes[i].x() == wall)
    {
      twin[i] = static_cast<Index>(mesh.nodes.size());
      mesh.nodes.emplace_back(mesh.nodes[i]);
      solution.head.push_back(solution.head[i] + 5);
    }
  for (auto& triangle : mesh.triangles)
  {
    const bool other_side = std::ranges::any_of(
        triangle, [&](Index i) { return mesh.nodes[static_cast<std::size_t>(i)].x() < wall; });
    for (Index& i : triangle)
      if (other_side && twin[static_cast<std::size_t>(i)] >= 0)
        i = twin[static_cast<std::size_t>(i)];
  }
  const Heave h = heave(solution, outlets, std::vector<double>{10e3, 10e3});
  ASSERT_TRUE(h.column);
  EXPECT_NEAR(h.column->factor, 10e3 / gamma_w / 0.5, 1e-11);
}
} // namespace
} // namespace berm::seepage
