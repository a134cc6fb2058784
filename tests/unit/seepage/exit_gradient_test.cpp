// SPDX-License-Identifier: GPL-3.0-or-later
// Gradients of fields that linear elements hold exactly: all tolerances are rounding.
#include "seepage/exit_gradient.h"

#include "exact_flow.h"

#include <gtest/gtest.h>

namespace berm::seepage
{
namespace
{
using test::ExactFlow;

const Outlet& outlet_of(const std::vector<Outlet>& outlets, Index stretch)
{
  const auto found = std::ranges::find(outlets, stretch, &Outlet::stretch);
  EXPECT_NE(found, outlets.end()) << "no outlet in stretch " << stretch;
  return *found;
}

TEST(ExitGradient, OfUniformlyRisingWaterIsThatGradientEverywhere)
{
  const std::vector<Outlet> outlets = test::rising_water(0.25, 0.25).find_outlets();
  ASSERT_EQ(outlets.size(), 1u);
  const Outlet& top = outlets.front();
  EXPECT_EQ(top.stretch, 0);
  EXPECT_NEAR(top.outflow, 4, 1e-13); // k i = 1 m/s
  EXPECT_EQ(top.points.size(), 10u);
  for (const ExitPoint& p : top.points)
  {
    EXPECT_NEAR(p.normal, 0.25, 1e-13);
    EXPECT_NEAR(p.upward, 0.25, 1e-13);
    EXPECT_NEAR(p.flux, 1, 1e-13);
    EXPECT_NEAR(p.distance, 4 - p.at.x(), 1e-13); // the soil on the left: from right to left
    EXPECT_EQ(p.head, 5);
    EXPECT_EQ(p.soil, 1);
    EXPECT_TRUE(p.faces_up);
    EXPECT_FALSE(p.beside_singularity);
  }
}

/// Uniform gradient (1, -1) in turned anisotropic soil. The quadrilateral (0, 0), (3, 0), (4, 1),
/// (4, 2), (2, 2) has a head of 4 m on its left side, one of 1 m from (3, 0) to (4, 1), both along
/// equipotentials, and a seepage face above that.
ExactFlow slanting_flow()
{
  const Conductivity k{3, 1, 0.4};
  meshes::TriangleMesh mesh = tests::rectangle_mesh(4, 2, 9, 6);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
  {
    const Vec2 at = test::middle(mesh, e);
    mesh.boundary_stretch[e] = at.x() == 0 ? 0 : at.x() == 4 ? (at.y() > 1 ? 1 : 2) : 3;
  }
  for (Vec2& x : mesh.nodes)
    x.x() = x.y() + x.x() / 4 * (3 + std::min(x.y(), 1.0) - x.y());
  const auto outflow = [k](const Vec2& at) {
    return test::flux_of(k, {1, -1}).dot(Vec2(0, at.y() > 1 ? 1 : -1));
  };
  return test::exact_flow(
      std::move(mesh),
      {{BoundaryKind::head, 4},
       {BoundaryKind::seepage_face, 0},
       {BoundaryKind::head, 1},
       {BoundaryKind::impervious, 0}},
      {k}, [](const Vec2& x) { return x.y() - x.x() + 4; }, outflow);
}

TEST(ExitGradient, OfUniformFlowIsExactInTurnedAnisotropicSoilAndAtACorner)
{
  const ExactFlow flow = slanting_flow();
  const Vec2 q = test::flux_of(flow.conductivity[0], {1, -1});
  const std::vector<Outlet> outlets = flow.find_outlets();
  ASSERT_EQ(outlets.size(), 2u);
  const Outlet &face = outlet_of(outlets, 1), &below = outlet_of(outlets, 2);
  const Vec2 normal = Vec2(1, -1).normalized();
  for (const ExitPoint& p : face.points)
  {
    EXPECT_NEAR(p.normal, 1, 1e-12);
    EXPECT_NEAR(p.upward, -1, 1e-12);
    EXPECT_NEAR(p.flux, q.x(), 1e-12);
    EXPECT_FALSE(p.faces_up);
  }
  for (const ExitPoint& p : below.points)
  {
    EXPECT_NEAR(p.normal, std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(p.upward, -1, 1e-12);
    EXPECT_NEAR(p.flux, q.dot(normal), 1e-12);
    EXPECT_FALSE(p.faces_up);
  }
  EXPECT_NEAR(face.outflow, q.x(), 1e-12);
  EXPECT_NEAR(below.outflow, q.dot(normal) * std::sqrt(2.0), 1e-12);
  EXPECT_LT((face.points.front().at - Vec2(4, 1)).norm(), 1e-14);
  EXPECT_LT((below.points.back().at - Vec2(4, 1)).norm(), 1e-14);
}

// The middle of the top of uniformly rising water gets the flow given: where the kind of condition
// changes on a straight boundary, the exact gradient of any other flow has no bound.
TEST(ExitGradient, DoesNotCountBesideASingularity)
{
  ExactFlow flow = test::rising_water(0.25, 0.25);
  const meshes::TriangleMesh& mesh = flow.solution.mesh;
  meshes::TriangleMesh split = mesh;
  for (std::size_t e = 0; e < split.boundary.size(); ++e)
    if (const Vec2 at = test::middle(mesh, e); at.y() == 2 && at.x() > 1.7 && at.x() < 2.3)
      split.boundary_stretch[e] = 3;
  flow.boundary.push_back({BoundaryKind::inflow, -1});
  flow = test::exact_flow(
      std::move(split), flow.boundary, flow.conductivity,
      [](const Vec2& x) { return 5 + 0.25 * (2 - x.y()); },
      [](const Vec2& x) { return x.y() == 2 ? 1 : 0; });
  const std::vector<Outlet> outlets = flow.find_outlets();
  ASSERT_EQ(outlets.size(), 2u);
  for (const Outlet& outlet : outlets)
  {
    EXPECT_DOUBLE_EQ(outlet.kept_away, 0.04); // a fiftieth of the height
    int beside = 0;
    for (const ExitPoint& p : outlet.points)
    {
      EXPECT_NEAR(p.normal, 0.25, 1e-12); // this flow is uniform all the same
      const double distance = std::abs(p.at.x() - 2) - 4. / 18;
      EXPECT_EQ(p.beside_singularity.has_value(), distance < 0.04 - 1e-12) << p.at.x();
      beside += p.beside_singularity ? 1 : 0;
    }
    EXPECT_EQ(beside, 1);
    ASSERT_EQ(outlet.unbounded.size(), 1u);
    EXPECT_NEAR(std::abs(outlet.unbounded[0].x() - 2), 4. / 18, 1e-12);
    ASSERT_TRUE(outlet.steepest);
    EXPECT_FALSE(outlet.points[*outlet.steepest].beside_singularity);
    // Where points begin to count there is one.
    EXPECT_EQ(std::ranges::count_if(
                  outlet.points, [](const ExitPoint& p)
                  { return std::abs(std::abs(p.at.x() - 2) - 4. / 18 - 0.04) < 1e-12; }),
              1);
  }
}

TEST(ExitGradient, OfStillWaterIsNowhere)
{
  ExactFlow flow = test::rising_water(1, 1);
  flow.boundary[1].value = 5;
  flow = test::exact_flow(
      flow.solution.mesh, flow.boundary, flow.conductivity, [](const Vec2&) { return 5; },
      [](const Vec2&) { return 0; });
  flow.solution.discharge = 0; // as a solve says where only rounding flows
  flow.solution.reaction[3] = -1e-17;
  EXPECT_TRUE(flow.find_outlets().empty());
}
} // namespace
} // namespace berm::seepage
