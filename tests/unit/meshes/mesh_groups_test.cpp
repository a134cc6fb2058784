// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/mesh_groups.h"

#include "core/error.h"
#include "meshes/drawing_text.h"
#include "meshes/section.h"

#include <gtest/gtest.h>

namespace berm::meshes
{
namespace
{
/// Nodes 1, 2, ... of a grid of squares of 1 m, row by row.
MeshGroups grid(int columns, int rows)
{
  MeshGroups groups;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c)
      groups.nodes[groups.nodes.size() + 1] = Vec2(c, r);
  return groups;
}

std::string refusal(const MeshGroups& groups)
{
  try
  {
    static_cast<void>(drawing_of(groups));
  }
  catch (const InputError& e)
  {
    return e.mistakes().front().problem;
  }
  return "accepted";
}

// 3 - 4
// |   |
// 1 - 2
TEST(MeshGroups, CornersMayBeGivenEitherWayRound)
{
  MeshGroups groups = grid(1, 1);
  groups.surfaces = {{.name = "fill", .elements = {{1, 2, 4}, {3, 4, 1}}}};
  const GmshDrawing drawing = drawing_of(groups);
  EXPECT_EQ(drawing.outline.size(), 4u);
  EXPECT_EQ(polygon_area(drawing.outline), 1);
}

TEST(MeshGroups, AnElementOfANodeThatIsNotThereIsRefused)
{
  MeshGroups groups = grid(1, 1);
  groups.surfaces = {{.name = "fill", .elements = {{1, 2, 7}}}};
  EXPECT_EQ(refusal(groups), "an element has node 7, which is not there");
  groups.surfaces = {{.name = "fill", .elements = {{1, 2, 4, 3}}}};
  groups.curves = {{.name = "drain", .elements = {{1, 9}}}};
  EXPECT_EQ(refusal(groups), "an element has node 9, which is not there");
}

TEST(MeshGroups, ElementsThatLieOnEachOtherAreRefused)
{
  MeshGroups groups = grid(1, 1);
  groups.surfaces = {{.name = "fill", .elements = {{1, 2, 4, 3}, {1, 2, 4}}}};
  EXPECT_EQ(refusal(groups), "areas lie on each other at (0, 0)");
}

TEST(MeshGroups, AHoleThatNoSurfaceFillsIsRefused)
{
  MeshGroups groups = grid(3, 3);
  MeshGroup fill{.name = "fill", .elements = {}};
  for (const std::size_t corner : {1, 2, 3, 5, 7, 9, 10, 11})
    fill.elements.push_back({corner, corner + 1, corner + 5, corner + 4});
  groups.surfaces = {fill};
  EXPECT_EQ(refusal(groups).substr(0, 26), "the surfaces leave a hole ");
  groups.surfaces.push_back({.name = "core", .elements = {{6, 7, 11, 10}}});
  const GmshDrawing drawing = drawing_of(groups);
  EXPECT_EQ(drawing.outline.size(), 4u);
  ASSERT_EQ(drawing.regions.size(), 2u);
  EXPECT_EQ(drawing.regions[1].name, "core");
}

TEST(MeshGroups, ACurveIsOneLineOrRefused)
{
  MeshGroups groups = grid(2, 1); // 4 - 5 - 6 above 1 - 2 - 3
  groups.surfaces = {{.name = "fill", .elements = {{1, 2, 5, 4}, {2, 3, 6, 5}}}};
  const auto with_curve = [&](std::vector<std::vector<std::size_t>> edges) -> const MeshGroups&
  {
    groups.curves = {{.name = "line", .elements = std::move(edges)}};
    return groups;
  };
  const auto line = [](const MeshGroups& g) { return drawing_of(g).curves.at(0).line; };
  EXPECT_EQ(line(with_curve({{2, 3}, {1, 2}, {3, 6}})), (Polyline{{0, 0}, {2, 0}, {2, 1}}));
  EXPECT_EQ(line(with_curve({{1, 2}, {2, 1}, {2, 5}})), (Polyline{{0, 0}, {1, 0}, {1, 1}}));
  EXPECT_EQ(line(with_curve({{1, 2}, {5, 4}, {2, 5}, {4, 1}})), // closed
            (Polyline{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}));
  const std::string refused = "physical curve \"line\" is not one line";
  EXPECT_EQ(refusal(with_curve({{1, 2}, {4, 5}})), refused);                         // two pieces
  EXPECT_EQ(refusal(with_curve({{1, 2}, {2, 3}, {2, 5}})), refused);                 // a branch
  EXPECT_EQ(refusal(with_curve({{1, 2}, {2, 5}, {5, 4}, {4, 1}, {1, 5}})), refused); // a chord
  EXPECT_EQ(refusal(with_curve({{3, 2}, {2, 5}, {5, 4}, {4, 1}, {1, 2}})), refused); // a noose
}

TEST(DrawingText, GivesTheSameDrawingToTheLastBit)
{
  const GmshDrawing drawing{.outline = {{0, 0}, {1. / 3, 1e-300}, {0, 1}},
                            .regions = {{.name = "a name\n3 with 1 2\" all", .polygon = {{1, 2}}}},
                            .curves = {{.name = "", .line = {}}}};
  const GmshDrawing again = drawing_from(drawing_text(drawing));
  EXPECT_EQ(again.outline, drawing.outline);
  EXPECT_EQ(again.regions.at(0).name, drawing.regions[0].name);
  EXPECT_EQ(again.regions.at(0).polygon, drawing.regions[0].polygon);
  EXPECT_EQ(again.curves.size(), 1u);
}
} // namespace
} // namespace berm::meshes
