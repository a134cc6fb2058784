// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"
#include "meshes/triangle_mesh.h"

#include <algorithm>
#include <cstddef>

namespace berm::tests
{
/// The rectangle 0 <= x <= length, 0 <= y <= height whose top and vertical faces are ground [m].
[[nodiscard]] inline meshes::SectionInput rectangle_input(double length, double height)
{
  meshes::SectionInput input;
  input.ground = {{0, 0}, {0, height}, {length, height}, {length, 0}};
  input.base = {{0, 0}, {length, 0}};
  return input;
}

/// @brief Structured mesh of a rectangular section: nx x ny cells of two triangles each.
/// Cell (i, j) has the corners i, i+1 and j, j+1; node (i, j) has index j (nx + 1) + i. The
/// diagonal runs up to the right. Soils come from the centroids, stretches from the outline edge at
/// the middle of each outer edge: waterlines and zone borders must lie on grid lines.
[[nodiscard]] inline meshes::TriangleMesh rectangle_mesh(const meshes::Section& section, Index nx,
                                                         Index ny)
{
  meshes::TriangleMesh mesh;
  const Vec2 origin(section.x_min, section.y_min);
  const Vec2 size(section.x_max - section.x_min, section.y_max - section.y_min);
  const auto node = [nx](Index i, Index j) { return j * (nx + 1) + i; };
  for (Index j = 0; j <= ny; ++j)
    for (Index i = 0; i <= nx; ++i)
      mesh.nodes.emplace_back(origin.x() + size.x() * i / nx, origin.y() + size.y() * j / ny);
  const auto at = [&mesh](Index n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i)
    {
      mesh.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      mesh.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  for (const auto& t : mesh.triangles)
    mesh.triangle_soil.push_back(meshes::soil_at(section, (at(t[0]) + at(t[1]) + at(t[2])) / 3));

  for (Index i = 0; i < nx; ++i)
    mesh.boundary.push_back({node(i, 0), node(i + 1, 0)});
  for (Index j = 0; j < ny; ++j)
    mesh.boundary.push_back({node(nx, j), node(nx, j + 1)});
  for (Index i = nx; i > 0; --i)
    mesh.boundary.push_back({node(i, ny), node(i - 1, ny)});
  for (Index j = ny; j > 0; --j)
    mesh.boundary.push_back({node(0, j), node(0, j - 1)});
  for (const auto& edge : mesh.boundary)
  {
    const Vec2 middle = (at(edge[0]) + at(edge[1])) / 2;
    std::size_t best = 0;
    double best_distance = 1e300;
    for (std::size_t k = 0; k < section.outline.size(); ++k)
    {
      const Vec2& a = section.outline[k];
      const Vec2 ab = section.outline[(k + 1) % section.outline.size()] - a;
      const double t = std::min(1.0, std::max(0.0, (middle - a).dot(ab) / ab.squaredNorm()));
      const double distance = (middle - a - t * ab).norm();
      if (distance < best_distance)
      {
        best_distance = distance;
        best = k;
      }
    }
    mesh.boundary_stretch.push_back(section.edge_stretch[best]);
  }
  return mesh;
}

/// The same for a dry rectangle of one soil.
[[nodiscard]] inline meshes::TriangleMesh rectangle_mesh(double length, double height, Index nx,
                                                         Index ny)
{
  return rectangle_mesh(meshes::build_section(rectangle_input(length, height)), nx, ny);
}
} // namespace berm::tests
