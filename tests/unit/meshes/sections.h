// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace berm::tests
{
/// The two-sided embankment (Griffiths and Lane 1999, example 6), dry [m].
inline meshes::SectionInput two_sided_embankment()
{
  meshes::SectionInput input;
  input.ground = {{0, 7.3}, {33.5, 7.3}, {99.83, 28.6}, {107.13, 28.6}, {157.9, 7.3}, {191.4, 7.3}};
  input.base = {{0, 0}, {191.4, 0}};
  return input;
}

/// A trapezoidal dam on its base, toe to toe [m].
inline meshes::SectionInput trapezoidal_dam()
{
  meshes::SectionInput input;
  input.ground = {{0, 0}, {50, 20}, {60, 20}, {100, 0}};
  input.base = {{0, 0}, {100, 0}};
  return input;
}

inline Polyline mirrored(Polyline line)
{
  for (Vec2& p : line)
    p.x() = -p.x();
  std::reverse(line.begin(), line.end());
  return line;
}

/// The same drawing seen from behind: x -> -x, left and right exchanged.
inline meshes::SectionInput mirrored(meshes::SectionInput input)
{
  for (Polyline* line : {&input.ground, &input.base, &input.outline})
    *line = mirrored(*line);
  for (meshes::Zone& zone : input.zones)
    zone.polygon = mirrored(zone.polygon);
  for (Polyline& line : input.marked_lines)
    line = mirrored(line);
  std::swap(input.left_pool_level, input.right_pool_level);
  return input;
}

/// Length of the outline on the stretches of this name [m].
inline double stretch_length(const meshes::Section& section, std::string_view name)
{
  double length = 0;
  const std::size_t n = section.outline.size();
  for (std::size_t k = 0; k < n; ++k)
    if (section.stretches[static_cast<std::size_t>(section.edge_stretch[k])].name == name)
      length += (section.outline[(k + 1) % n] - section.outline[k]).norm();
  return length;
}

/// Whether the outline has a vertex within 1e-9 m of the point.
inline bool has_vertex(const meshes::Section& section, const Vec2& p)
{
  return std::any_of(section.outline.begin(), section.outline.end(),
                     [&](const Vec2& q) { return (p - q).norm() < 1e-9; });
}
} // namespace berm::tests
