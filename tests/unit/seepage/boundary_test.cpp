// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/boundary.h"

#include "core/error.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace berm::seepage
{
namespace
{
constexpr Boundary impervious{BoundaryKind::impervious, 0};
constexpr Boundary face{BoundaryKind::seepage_face, 0};

Boundary head(double value)
{
  return {BoundaryKind::head, value};
}

/// 4 m x 2 m in cells of 1 m, with the left face, the right face and the base marked: four
/// stretches in the order of `stretch_of`.
struct Box
{
  meshes::Section section;
  meshes::TriangleMesh mesh;

  Box()
  {
    meshes::SectionInput input = tests::rectangle_input(4, 2);
    input.marked_lines = {{{0, 0}, {0, 2}}, {{4, 0}, {4, 2}}, {{0, 0}, {4, 0}}};
    section = meshes::build_section(input);
    mesh = tests::rectangle_mesh(section, 4, 2);
  }

  [[nodiscard]] std::vector<Boundary> conditions(Boundary left, Boundary right, Boundary base) const
  {
    return boundary_conditions(section, {left, right, base});
  }
  [[nodiscard]] std::size_t node(Index i, Index j) const
  {
    return static_cast<std::size_t>(5 * j + i);
  }
  [[nodiscard]] std::size_t stretch(Index marked_line) const
  {
    const auto it =
        std::ranges::find(section.stretches, marked_line, &meshes::Stretch::marked_line);
    return static_cast<std::size_t>(it - section.stretches.begin());
  }
};

TEST(BoundaryConditions, PoolsAreHeadsGroundIsASeepageFaceTheRestIsImpervious)
{
  meshes::SectionInput input = tests::rectangle_input(4, 2);
  input.left_pool_level = 1.5;
  input.right_pool_level = 0.5;
  const meshes::Section section = meshes::build_section(input);
  const std::vector<Boundary> boundary = boundary_conditions(section, {});
  ASSERT_EQ(boundary.size(), section.stretches.size());
  for (std::size_t s = 0; s < boundary.size(); ++s)
    switch (section.stretches[s].kind)
    {
    case meshes::StretchKind::left_pool:
      EXPECT_EQ(boundary[s].kind, BoundaryKind::head);
      EXPECT_EQ(boundary[s].value, 1.5);
      break;
    case meshes::StretchKind::right_pool:
      EXPECT_EQ(boundary[s].kind, BoundaryKind::head);
      EXPECT_EQ(boundary[s].value, 0.5);
      break;
    case meshes::StretchKind::ground:
      EXPECT_EQ(boundary[s].kind, BoundaryKind::seepage_face);
      break;
    default:
      EXPECT_EQ(boundary[s].kind, BoundaryKind::impervious);
    }
}

TEST(BoundaryConditions, MarkedLinesAreWhatTheUserSaid)
{
  const Box box;
  const std::vector<Boundary> boundary =
      box.conditions(head(2), face, {BoundaryKind::inflow, 1e-7});
  EXPECT_EQ(boundary[box.stretch(0)].kind, BoundaryKind::head);
  EXPECT_EQ(boundary[box.stretch(1)].kind, BoundaryKind::seepage_face);
  EXPECT_EQ(boundary[box.stretch(2)].kind, BoundaryKind::inflow);
  EXPECT_EQ(boundary[box.stretch(2)].value, 1e-7);
}

TEST(NodeConditions, AHeadAboveItsLevelIsAPotentialSeepageFace)
{
  const Box box;
  const NodeConditions c =
      node_conditions(box.mesh, box.conditions(head(1), impervious, impervious));
  EXPECT_EQ(c.kind[box.node(0, 0)], NodeKind::head);
  EXPECT_EQ(c.pressure_head[box.node(0, 0)], 1);
  EXPECT_EQ(c.kind[box.node(0, 1)], NodeKind::head); // at the level
  EXPECT_EQ(c.pressure_head[box.node(0, 1)], 0);
  EXPECT_EQ(c.kind[box.node(0, 2)], NodeKind::face);
  EXPECT_EQ(c.kind[box.node(2, 0)], NodeKind::interior);
  EXPECT_EQ(c.highest_head, 1);
}

TEST(NodeConditions, AHeadAtTheLevelOfItsBoundaryIsADrain)
{
  const Box box; // water at pressure zero along the base can leave, not enter
  const NodeConditions c = node_conditions(box.mesh, box.conditions(head(2), impervious, head(0)));
  EXPECT_EQ(c.kind[box.node(2, 0)], NodeKind::face);
  EXPECT_EQ(c.kind[box.node(0, 0)], NodeKind::head);
}

TEST(NodeConditions, WhereStretchesMeetHeadPrevailsOverFaceAndTheHigherHeadOverTheLower)
{
  const Box box;
  const NodeConditions c = node_conditions(box.mesh, box.conditions(head(2), face, head(1.5)));
  EXPECT_EQ(c.kind[box.node(4, 0)], NodeKind::head);
  EXPECT_EQ(c.pressure_head[box.node(4, 0)], 1.5);
  EXPECT_EQ(c.pressure_head[box.node(0, 0)], 2);
}

TEST(NodeConditions, InflowIsSharedByTheEndsOfEachEdge)
{
  const Box box;
  const NodeConditions c =
      node_conditions(box.mesh, box.conditions(head(2), impervious, {BoundaryKind::inflow, 3}));
  EXPECT_DOUBLE_EQ(c.load[box.node(0, 0)], 1.5);
  EXPECT_DOUBLE_EQ(c.load[box.node(1, 0)], 3);
  EXPECT_DOUBLE_EQ(std::accumulate(c.load.begin(), c.load.end(), 0.0), 12);
}

/// Everywhere the head of the lowest point, at y = 0, given; the user warned.
void expect_dry(const Box& box, const NodeConditions& c)
{
  for (std::size_t i = 0; i < box.mesh.nodes.size(); ++i)
  {
    EXPECT_EQ(c.kind[i], NodeKind::head);
    EXPECT_EQ(c.pressure_head[i], -box.mesh.nodes[i].y());
  }
  ASSERT_EQ(c.warnings.size(), 1u);
  EXPECT_NE(c.warnings[0].find("no water reaches the soil"), std::string::npos);
}

TEST(NodeConditions, WithoutWaterTheSoilIsDry)
{
  const Box box;
  expect_dry(box, node_conditions(box.mesh, box.conditions(face, face, impervious)));
}

TEST(NodeConditions, UnderHeadsBelowTheirBoundaryTheSoilIsDry)
{
  const Box box;
  expect_dry(box, node_conditions(box.mesh, box.conditions(head(-3), face, impervious)));
}

TEST(NodeConditions, NeitherHeadNorSeepageFaceIsAnInputError)
{
  const Box box;
  std::vector<Boundary> boundary = box.conditions(impervious, impervious, impervious);
  std::ranges::fill(boundary, impervious);
  EXPECT_THROW(static_cast<void>(node_conditions(box.mesh, boundary)), InputError);
}

TEST(NodeConditions, WaterTakenOutOfSoilThatGetsNoneIsAnInputError)
{
  const Box box;
  EXPECT_THROW(static_cast<void>(node_conditions(
                   box.mesh, box.conditions(face, face, {BoundaryKind::inflow, -1e-7}))),
               InputError);
}

TEST(NodeConditions, RainIsALoadOnWhatFacesTheSky)
{
  const Box box; // the left face is vertical, the base faces down: both stay without
  std::vector<Boundary> boundary(box.section.stretches.size(), {BoundaryKind::rain, 3});
  const NodeConditions c = node_conditions(box.mesh, boundary);
  EXPECT_DOUBLE_EQ(c.rain[box.node(0, 2)], 1.5);
  EXPECT_DOUBLE_EQ(c.rain[box.node(1, 2)], 3);
  EXPECT_EQ(c.rain[box.node(0, 1)], 0);
  EXPECT_EQ(c.rain[box.node(1, 0)], 0);
  EXPECT_EQ(c.load, c.rain);
  EXPECT_EQ(c.kind[box.node(1, 2)], NodeKind::face);
  EXPECT_EQ(c.highest_head, 2); // of the face: nothing else says how high water may stand
  EXPECT_EQ(c.heaviest_rain, 3);
}

TEST(NodeConditions, AnOverflowIsAsDeepAsTheDistanceFromTheCrestLeavesIt)
{
  const Box box;
  std::vector<Boundary> boundary = box.conditions(impervious, impervious, impervious);
  for (Boundary& b : boundary) // the top alone is open ground
    if (b.kind == BoundaryKind::seepage_face)
      b = {BoundaryKind::overflow, 2.5, 0};
  const NodeConditions c = node_conditions(box.mesh, boundary);
  for (const auto& [i, depth] : {std::pair{0, 2.5}, {1, 1.5}, {2, 0.5}, {3, 0.0}, {4, 0.0}})
  {
    EXPECT_EQ(c.kind[box.node(i, 2)], NodeKind::head);
    EXPECT_DOUBLE_EQ(c.pressure_head[box.node(i, 2)], depth);
  }
}

TEST(FaceWeight, IsZeroOnTheFaceAndOneAnEdgeLengthAway)
{
  const Box box;
  const NodeConditions c =
      node_conditions(box.mesh, box.conditions(head(2), impervious, impervious));
  const std::vector<double> w = face_weight(box.mesh, c.face_edges); // the top, edges of 1 m
  for (Index i = 0; i <= 4; ++i)
  {
    EXPECT_EQ(w[box.node(i, 2)], 0);
    EXPECT_EQ(w[box.node(i, 1)], 1);
    EXPECT_EQ(w[box.node(i, 0)], 1);
  }
}

TEST(FaceWeight, GrowsWithTheDistanceFromTheNearestEdgeMeasuredByItsLength)
{
  const meshes::TriangleMesh mesh =
      tests::rectangle_mesh(4, 2, 2, 8); // top edges of 2 m, rows of 0.25 m
  std::vector<Index> top;
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    if (mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][0])].y() == 2 &&
        mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][1])].y() == 2)
      top.push_back(static_cast<Index>(e));
  const std::vector<double> w = face_weight(mesh, top);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    EXPECT_DOUBLE_EQ(w[i], (2 - mesh.nodes[i].y()) / 2);
}

TEST(StretchWater, SharesACornerInProportionToTheEdgesThatImposeItsCondition)
{
  const Box box;
  const std::vector<Boundary> boundary = box.conditions(head(2), impervious, head(2));
  const NodeConditions c = node_conditions(box.mesh, boundary);
  std::vector<double> reaction(box.mesh.nodes.size(), 0);
  reaction[box.node(0, 0)] = 4; // both edges there are 1 m long
  reaction[box.node(2, 0)] = 1;
  reaction[box.node(0, 1)] = 10;
  const std::vector<double> inflow = stretch_water(box.mesh, boundary, c, reaction).inflow;
  EXPECT_DOUBLE_EQ(inflow[box.stretch(0)], 12);
  EXPECT_DOUBLE_EQ(inflow[box.stretch(2)], 3);
  EXPECT_DOUBLE_EQ(inflow[box.stretch(1)], 0);
}

TEST(StretchWater, CountsThePrescribedInflow)
{
  const Box box;
  const std::vector<Boundary> boundary =
      box.conditions(head(2), impervious, {BoundaryKind::inflow, 0.25});
  const NodeConditions c = node_conditions(box.mesh, boundary);
  const std::vector<double> inflow =
      stretch_water(box.mesh, boundary, c, std::vector<double>(box.mesh.nodes.size(), 0)).inflow;
  EXPECT_DOUBLE_EQ(inflow[box.stretch(2)], 1);
}

TEST(StretchWater, DividesRainIntoWhatEntersAndWhatRunsOff)
{
  const Box box;
  std::vector<Boundary> boundary = box.conditions(face, impervious, impervious);
  const std::size_t ground = box.stretch(-1); // the top, 4 m
  boundary[ground] = {BoundaryKind::rain, 1};
  const NodeConditions c = node_conditions(box.mesh, boundary);
  std::vector<double> reaction = c.rain; // what enters at each node, net
  reaction[box.node(1, 2)] = 0.25;       // of 1
  reaction[box.node(2, 2)] = -2;         // all of it runs off, and water comes out
  const StretchWater water = stretch_water(box.mesh, boundary, c, reaction);
  EXPECT_DOUBLE_EQ(water.runoff[ground], 0.75 + 1);
  EXPECT_DOUBLE_EQ(water.inflow[ground], 0.5 + 0.25 - 2 + 1 + 0.5);
  EXPECT_DOUBLE_EQ(water.inflow[box.stretch(0)], 0);
  EXPECT_DOUBLE_EQ(water.runoff[box.stretch(0)], 0);
}

TEST(LimitWeight, LeavesNoneWhereRainIsAsHeavyAsTheSoilCanTake)
{
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(1, 1, 1, 1);
  const std::vector<double> k(mesh.triangles.size(), 4);
  for (const auto& [rain, w] : {std::pair{0.0, 1.0}, {1.0, 0.75}, {4.0, 0.0}, {9.0, 0.0}})
  {
    std::vector<double> weight(mesh.nodes.size(), 1);
    limit_weight(mesh, k, rain, weight);
    for (const double value : weight)
      EXPECT_EQ(value, w);
  }
}
} // namespace
} // namespace berm::seepage
