// SPDX-License-Identifier: GPL-3.0-or-later
// Any nodes and elements as the groups of a mesh: their borders, and the section they make.
#include "core/error.h"
#include "meshes/drawing_text.h"
#include "meshes/mesh_groups.h"
#include "meshes/section.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

namespace
{
using namespace berm;

/// Bytes as a mesh: the number of nodes; x and y of each, in quarters of a metre; then six for each
/// element: its group (three surfaces, two curves, the last of each without a name), its number of
/// corners, and those.
meshes::MeshGroups mesh_of(std::span<const std::uint8_t> bytes)
{
  const auto take = [&bytes]
  {
    const std::uint8_t first = bytes.empty() ? 0 : bytes.front();
    bytes = bytes.subspan(bytes.empty() ? 0 : 1);
    return first;
  };
  meshes::MeshGroups groups;
  groups.surfaces = {{.name = "fill", .tag = 1, .elements = {}},
                     {.name = "core", .tag = 2, .elements = {}}};
  groups.curves = {{.name = "drain", .tag = 3, .elements = {}}};
  const std::size_t nodes = take();
  for (std::size_t tag = 1; tag <= nodes; ++tag)
  {
    const auto x = static_cast<std::int8_t>(take()), y = static_cast<std::int8_t>(take());
    groups.nodes[tag] = Vec2(x, y) / 4;
  }
  while (bytes.size() >= 6)
  {
    const unsigned group = take() % 5, four = take() % 2;
    std::array<std::size_t, 4> corners{};
    for (std::size_t& corner : corners)
      corner = take();
    const auto add = [&](std::vector<meshes::MeshGroup>& list, std::size_t which, unsigned count)
    {
      if (which == list.size())
        list.push_back({.name = "", .tag = 9, .elements = {}});
      list[which].elements.emplace_back(corners.begin(), corners.begin() + count);
    };
    if (group < 3)
      add(groups.surfaces, group, 3 + four);
    else
      add(groups.curves, group - 3, 2);
  }
  return groups;
}

void expect(bool holds)
{
  if (!holds)
    std::abort();
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const meshes::MeshGroups groups = mesh_of({data, size});
  try
  {
    const meshes::GmshDrawing drawing = meshes::drawing_of(groups);
    const meshes::GmshDrawing again = meshes::drawing_from(meshes::drawing_text(drawing));
    expect(again.outline == drawing.outline && again.regions.size() == drawing.regions.size() &&
           again.curves.size() == drawing.curves.size());

    meshes::SectionInput input;
    input.outline = drawing.outline;
    for (const meshes::DrawnRegion& region : drawing.regions)
      input.zones.push_back({.soil = region.name == "core" ? 1 : 0, .polygon = region.polygon});
    for (const meshes::DrawnCurve& curve : drawing.curves)
      input.marked_lines.push_back(curve.line);
    const meshes::Section section = meshes::build_section(input);
    const double area = meshes::polygon_area(drawing.outline);
    expect(area > 0 && std::abs(meshes::polygon_area(section.outline) - area) <= 1e-6 * area);
  }
  catch (const InputError& e)
  {
    expect(!e.mistakes().empty() && !e.mistakes().front().problem.empty());
  }
  return 0;
}
