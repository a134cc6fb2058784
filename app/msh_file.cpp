// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/msh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace berm::app
{
namespace
{
constexpr int line = 1, triangle = 2; // element types of the format

/// gmsh ends a name at a quotation mark.
std::string quotable(std::string name)
{
  std::ranges::replace(name, '"', '_');
  return name;
}
} // namespace

std::string msh_text(const coupling::Case& input, const meshes::Section& section,
                     const meshes::TriangleMesh& mesh)
{
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n";
  const auto put = std::back_inserter(text);
  fmt::format_to(put, "{}\n", section.stretches.size() + input.soils.size());
  for (std::size_t s = 0; s < section.stretches.size(); ++s)
    fmt::format_to(put, "1 {} \"{}\"\n", s + 1, quotable(section.stretches[s].name));
  for (std::size_t s = 0; s < input.soils.size(); ++s)
    fmt::format_to(put, "2 {} \"{}\"\n", s + 1, quotable(input.soils[s].name));
  fmt::format_to(put, "$EndPhysicalNames\n$Nodes\n{}\n", mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    fmt::format_to(put, "{} {} {} 0\n", i + 1, mesh.nodes[i].x(), mesh.nodes[i].y());
  fmt::format_to(put, "$EndNodes\n$Elements\n{}\n", mesh.boundary.size() + mesh.triangles.size());
  std::size_t number = 0;
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
  {
    const Index group = mesh.boundary_stretch[e] + 1;
    fmt::format_to(put, "{} {} 2 {} {} {} {}\n", ++number, line, group, group,
                   mesh.boundary[e][0] + 1, mesh.boundary[e][1] + 1);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Index group = mesh.triangle_soil[t] + 1;
    const auto& [a, b, c] = mesh.triangles[t];
    fmt::format_to(put, "{} {} 2 {} {} {} {} {}\n", ++number, triangle, group, group, a + 1, b + 1,
                   c + 1);
  }
  return text + "$EndElements\n";
}
} // namespace berm::app
