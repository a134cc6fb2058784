// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/slit.h"

#include "meshes/boundary_walk.h"
#include "meshes/planar_graph.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace berm::meshes
{
namespace
{
/// 4 m x 4 m in cells of 1 m, node (i, j) at x = i, y = j.
TriangleMesh square()
{
  return tests::rectangle_mesh(4, 4, 4, 4);
}

Index at(Index i, Index j)
{
  return 5 * j + i;
}

/// Edges from node to node along a way of cell corners.
std::vector<SlitEdge> along(std::initializer_list<Index> nodes, Index stretch)
{
  std::vector<SlitEdge> edges;
  for (auto i = nodes.begin(); i + 1 != nodes.end(); ++i)
    edges.push_back({{*i, *(i + 1)}, stretch});
  return edges;
}

std::vector<SlitEdge> operator+(std::vector<SlitEdge> a, const std::vector<SlitEdge>& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::size_t copies(const TriangleMesh& mesh, double x, double y)
{
  return static_cast<std::size_t>(std::ranges::count(mesh.nodes, Vec2(x, y)));
}

/// The boundary is exactly the triangles' edges without a partner, and every node is used.
void expect_sound(const TriangleMesh& mesh)
{
  std::set<std::array<Index, 2>> directed, outer;
  std::set<Index> used;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
    {
      EXPECT_TRUE(directed.insert({t[k], t[(k + 1) % 3]}).second);
      used.insert(t[k]);
    }
  for (const auto& edge : directed)
    if (!directed.contains({edge[1], edge[0]}))
      outer.insert(edge);
  EXPECT_EQ(outer, std::set(mesh.boundary.begin(), mesh.boundary.end()));
  EXPECT_EQ(outer.size(), mesh.boundary.size());
  EXPECT_EQ(mesh.boundary.size(), mesh.boundary_stretch.size());
  EXPECT_EQ(used.size(), mesh.nodes.size());
}

TEST(Slit, InTheSoilKeepsItsTipsAndIsALoopOfItsOwn)
{
  TriangleMesh mesh = square();
  cut_open(mesh, along({at(1, 2), at(2, 2), at(3, 2)}, 7));
  expect_sound(mesh);
  EXPECT_EQ(copies(mesh, 1, 2), 1u);
  EXPECT_EQ(copies(mesh, 2, 2), 2u);
  EXPECT_EQ(copies(mesh, 3, 2), 1u);
  EXPECT_EQ(mesh.boundary.size(), 16u + 4u);
  EXPECT_EQ(std::ranges::count(mesh.boundary_stretch, 7), 4);
  const auto loops = boundary_loops(mesh);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].size(), 16u);
  EXPECT_EQ(loops[1].size(), 4u);
  EXPECT_EQ(std::ranges::max(pieces(mesh)), 0u);
}

TEST(Slit, FromTheOutlineSplitsItsEndThereAndKeepsOneLoop)
{
  TriangleMesh mesh = square();
  cut_open(mesh, along({at(2, 4), at(2, 3), at(2, 2)}, 7));
  expect_sound(mesh);
  EXPECT_EQ(copies(mesh, 2, 4), 2u);
  EXPECT_EQ(copies(mesh, 2, 3), 2u);
  EXPECT_EQ(copies(mesh, 2, 2), 1u);
  ASSERT_EQ(boundary_loops(mesh).size(), 1u);
  EXPECT_EQ(boundary_loops(mesh)[0].size(), 16u + 4u);
}

TEST(Slit, OfASingleEdgeFromTheOutlineIsOpen)
{
  TriangleMesh mesh = square();
  cut_open(mesh, along({at(2, 4), at(2, 3)}, 7));
  expect_sound(mesh);
  EXPECT_EQ(copies(mesh, 2, 4), 2u);
  EXPECT_EQ(copies(mesh, 2, 3), 1u);
}

TEST(Slit, RightThroughMakesTwoPieces)
{
  TriangleMesh mesh = square();
  cut_open(mesh, along({at(2, 0), at(2, 1), at(2, 2), at(2, 3), at(2, 4)}, 7));
  expect_sound(mesh);
  EXPECT_EQ(mesh.nodes.size(), 25u + 5u);
  EXPECT_EQ(boundary_loops(mesh).size(), 2u);
  const std::vector<std::size_t> piece = pieces(mesh);
  EXPECT_EQ(std::ranges::max(piece), 1u);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (mesh.nodes[i].x() != 2)
    {
      EXPECT_EQ(piece[i], mesh.nodes[i].x() < 2 ? 0u : 1u);
    }
}

TEST(Slit, ThatMeetsAnotherIsOneCopyForEachFan)
{
  TriangleMesh tee = square(), cross = square();
  const auto across = along({at(1, 2), at(2, 2), at(3, 2)}, 7);
  cut_open(tee, across + along({at(2, 2), at(2, 3)}, 8));
  cut_open(cross, across + along({at(2, 1), at(2, 2), at(2, 3)}, 8));
  for (const TriangleMesh* mesh : {&tee, &cross})
  {
    expect_sound(*mesh);
    EXPECT_EQ(boundary_loops(*mesh).size(), 2u); // the outline, and round both lines
  }
  EXPECT_EQ(copies(tee, 2, 2), 3u);
  EXPECT_EQ(copies(cross, 2, 2), 4u);
}

TEST(Slit, ClosedRoundAPieceCutsItOut)
{
  TriangleMesh mesh = square();
  cut_open(mesh, along({at(1, 1), at(2, 1), at(3, 1), at(3, 2), at(3, 3), at(2, 3), at(1, 3),
                        at(1, 2), at(1, 1)},
                       7));
  expect_sound(mesh);
  EXPECT_EQ(std::ranges::max(pieces(mesh)), 1u);
  EXPECT_EQ(boundary_loops(mesh).size(), 3u);
}

TEST(PlanarGraph, CutsInnerLinesAtZonesAndAtEachOther)
{
  SectionInput input = tests::rectangle_input(10, 10);
  input.zones = {{1, {{4, 0}, {6, 0}, {6, 10}, {4, 10}}}};
  input.marked_lines = {{{1, 5}, {9, 5}}, {{5, 10}, {5, 2}}, {{2, 8}, {3, 8}}};
  const PlanarGraph graph = planar_graph(build_section(input));
  std::map<Index, int> edges;
  double longest = 0;
  for (const InsideEdge& e : graph.inside)
  {
    ++edges[e.stretch];
    longest = std::max(longest, (graph.points[e.to] - graph.points[e.from]).norm());
  }
  const Section section = build_section(input);
  EXPECT_EQ(edges[section.inner_lines[0].stretch], 4); // 1 - 4 - 5 - 6 - 9
  EXPECT_EQ(edges[section.inner_lines[1].stretch], 2); // 10 - 5 - 2
  EXPECT_EQ(edges[section.inner_lines[2].stretch], 2); // its tips keep one node: a middle between
  EXPECT_EQ(edges[-1], 4);                             // the zone's sides, each cut once
  EXPECT_EQ(longest, 5);
}
} // namespace
} // namespace berm::meshes
