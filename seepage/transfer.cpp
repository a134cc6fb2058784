// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/transfer.h"

#include "meshes/planar.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

namespace berm::seepage
{
namespace
{
constexpr double inside_tolerance =
    1e-9; ///< of a barycentric coordinate: rounding of boundary nodes

std::array<double, 3> barycentric(const meshes::TriangleMesh& mesh, std::size_t t,
                                  const Vec2& point)
{
  const auto& [i, j, k] = mesh.triangles[t];
  const Vec2 &a = mesh.nodes[static_cast<std::size_t>(i)],
             &b = mesh.nodes[static_cast<std::size_t>(j)],
             &c = mesh.nodes[static_cast<std::size_t>(k)];
  const double area = meshes::cross(b - a, c - a);
  const double s_a = meshes::cross(b - point, c - point) / area;
  const double s_b = meshes::cross(c - point, a - point) / area;
  return {s_a, s_b, 1 - s_a - s_b};
}

/// Triangle on the other side of the edge opposite to each corner; -1 on the boundary.
std::vector<std::array<Index, 3>> neighbours(const meshes::TriangleMesh& mesh)
{
  std::vector<std::array<Index, 3>> across(mesh.triangles.size(), {-1, -1, -1});
  std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>>
      open; // edge -> triangle, corner
  open.reserve(2 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const auto [low, high] =
          std::minmax(mesh.triangles[t][(corner + 1) % 3], mesh.triangles[t][(corner + 2) % 3]);
      const std::uint64_t key =
          (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint64_t>(high);
      const auto [other, is_new] = open.try_emplace(key, t, corner);
      if (is_new)
        continue;
      across[t][corner] = static_cast<Index>(other->second.first);
      across[other->second.first][other->second.second] = static_cast<Index>(t);
    }
  return across;
}
} // namespace

std::vector<double> transfer(const meshes::TriangleMesh& mesh, std::span<const double> nodal,
                             std::span<const Vec2> points)
{
  const std::vector<std::array<Index, 3>> across = neighbours(mesh);
  std::vector<double> values;
  values.reserve(points.size());
  std::size_t t = 0;
  for (const Vec2& point : points)
  {
    std::array<double, 3> s{};
    bool found = false;
    for (std::size_t steps = 0; steps < mesh.triangles.size(); ++steps)
    {
      s = barycentric(mesh, t, point);
      const auto lowest = static_cast<std::size_t>(std::ranges::min_element(s) - s.begin());
      found = s[lowest] >= -inside_tolerance;
      if (found || across[t][lowest] < 0)
        break;
      t = static_cast<std::size_t>(across[t][lowest]);
    }
    if (!found) // the straight way left the section, or the point is outside
    {
      double best = -std::numeric_limits<double>::infinity();
      for (std::size_t candidate = 0; candidate < mesh.triangles.size(); ++candidate)
        if (const double lowest = std::ranges::min(barycentric(mesh, candidate, point));
            lowest > best)
        {
          best = lowest;
          t = candidate;
        }
      s = barycentric(mesh, t, point);
    }
    double value = 0;
    for (std::size_t corner = 0; corner < 3; ++corner)
      value += s[corner] * nodal[static_cast<std::size_t>(mesh.triangles[t][corner])];
    values.push_back(value);
  }
  return values;
}
} // namespace berm::seepage
