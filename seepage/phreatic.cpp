// SPDX-License-Identifier: GPL-2.0-or-later
#include "seepage/phreatic.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

namespace berm::seepage
{
namespace
{
double length(const Polyline& line)
{
  double sum = 0;
  for (std::size_t k = 1; k < line.size(); ++k)
    sum += (line[k] - line[k - 1]).norm();
  return sum;
}

/// A mesh edge that the contour crosses, and the edges that it goes on to.
struct Crossing
{
  Vec2 point;
  std::array<std::size_t, 2> next{};
  int count = 0;
  bool used = false;
};
} // namespace

std::vector<Polyline> zero_contours(const meshes::TriangleMesh& mesh, std::span<const double> p)
{
  std::vector<Crossing> crossings;
  std::unordered_map<std::uint64_t, std::size_t> crossing_of_edge;
  const auto crossing = [&](Index i, Index j)
  {
    const auto [low, high] = std::minmax(i, j);
    const std::uint64_t key =
        (static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint64_t>(high);
    const auto [entry, is_new] = crossing_of_edge.try_emplace(key, crossings.size());
    if (is_new)
    {
      const auto a = static_cast<std::size_t>(low), b = static_cast<std::size_t>(high);
      crossings.push_back(
          {.point = mesh.nodes[a] + p[a] / (p[a] - p[b]) * (mesh.nodes[b] - mesh.nodes[a])});
    }
    return entry->second;
  };

  for (const auto& triangle : mesh.triangles)
  {
    std::array<std::size_t, 2> ends{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Index i = triangle[k], j = triangle[(k + 1) % 3];
      if ((p[static_cast<std::size_t>(i)] >= 0) != (p[static_cast<std::size_t>(j)] >= 0))
        ends[count++] = crossing(i, j);
    }
    if (count == 2)
      for (std::size_t k = 0; k < 2; ++k)
      {
        Crossing& c = crossings[ends[k]];
        c.next[static_cast<std::size_t>(c.count++)] = ends[1 - k];
      }
  }

  std::vector<Polyline> lines;
  const auto walk = [&](std::size_t start)
  {
    Polyline line;
    for (std::size_t at = start;;)
    {
      Crossing& c = crossings[at];
      c.used = true;
      if (line.empty() || line.back() != c.point)
        line.push_back(c.point);
      if (c.count > 0 && !crossings[c.next[0]].used)
        at = c.next[0];
      else if (c.count > 1 && !crossings[c.next[1]].used)
        at = c.next[1];
      else
      {
        const bool closed = crossings[start].count == 2;
        if (closed && line.size() > 2)
          line.push_back(line.front());
        break;
      }
    }
    if (line.size() < 2)
      return;
    if (line.front().x() > line.back().x())
      std::ranges::reverse(line);
    lines.push_back(std::move(line));
  };
  for (std::size_t k = 0; k < crossings.size(); ++k) // open lines from their ends
    if (!crossings[k].used && crossings[k].count == 1)
      walk(k);
  for (std::size_t k = 0; k < crossings.size(); ++k) // what is left is closed
    if (!crossings[k].used)
      walk(k);

  std::ranges::stable_sort(lines, std::ranges::greater{}, length);
  return lines;
}
} // namespace berm::seepage
