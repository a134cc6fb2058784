// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/seeds.h"

#include "meshes/planar.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace berm::sph
{
namespace
{
/// Seeds nearer to the outline than this, relative to dx, are left out: their cells would be
/// slivers.
constexpr double margin = 0.2;

/// Rows from the lowest point up, `pitch` apart and `rise` above each other; every second row is
/// shifted by half a pitch if asked for.
std::vector<Vec2> rows(const meshes::Section& section, double spacing, double pitch, double rise,
                       bool shifted)
{
  std::vector<Vec2> points;
  const int columns = static_cast<int>(std::ceil((section.x_max - section.x_min) / pitch)) + 1;
  const int levels = static_cast<int>(std::ceil((section.y_max - section.y_min) / rise));
  for (int c = 0; c < columns; ++c)
    for (int r = 0; r < levels; ++r)
    {
      const double offset = !shifted ? 0.5 : r % 2 == 0 ? 0.25 : 0.75;
      const Vec2 p{section.x_min + (c + offset) * pitch, section.y_min + (r + 0.5) * rise};
      if (meshes::polygon_contains(section.outline, p) &&
          meshes::nearest_edge(section.outline, p).distance > margin * spacing)
        points.push_back(p);
    }
  return points;
}
} // namespace

double mesh_size(double spacing)
{
  return spacing * std::sqrt(2 / std::numbers::sqrt3);
}

std::vector<Vec2> square_seeds(const meshes::Section& section, double spacing)
{
  const double length = section.x_max - section.x_min;
  const double columns = std::max(1.0, std::round(length / spacing));
  return rows(section, spacing, length / columns, spacing, false);
}

std::vector<Vec2> hexagonal_seeds(const meshes::Section& section, double spacing)
{
  const double pitch = mesh_size(spacing);
  return rows(section, spacing, pitch, 0.5 * std::numbers::sqrt3 * pitch, true);
}

std::vector<Vec2> mesh_seeds(const meshes::TriangleMesh& mesh)
{
  std::vector<bool> on_boundary(mesh.nodes.size(), false);
  for (const auto& edge : mesh.boundary)
    for (const Index node : edge)
      on_boundary[static_cast<std::size_t>(node)] = true;
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (!on_boundary[i])
      points.push_back(mesh.nodes[i]);
  return points;
}

std::vector<Vec2> jittered(const meshes::Section& section, std::vector<Vec2> points, double width,
                           std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  const auto random = [&] // in [-width / 2, width / 2), the same with every library
  { return width * (static_cast<double>(engine() >> 11) * 0x1p-53 - 0.5); };
  for (Vec2& p : points)
  {
    const double x = random(), y = random();
    if (meshes::polygon_contains(section.outline, p + Vec2{x, y}))
      p += Vec2{x, y};
  }
  return points;
}
} // namespace berm::sph
