// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/phreatic.h"

#include <algorithm>
#include <array>
#include <cmath>
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
  std::vector<bool> wet(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    wet[i] = p[i] > 0;
  for (const auto& triangle : mesh.triangles)
    if (std::ranges::any_of(triangle, [&](Index i) { return p[static_cast<std::size_t>(i)] > 0; }))
      for (const Index i : triangle)
        if (p[static_cast<std::size_t>(i)] == 0)
          wet[static_cast<std::size_t>(i)] = true;

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
      // From the wet end, so that a wet node with p = 0 is hit exactly.
      auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      if (!wet[a])
        std::swap(a, b);
      const double share = p[a] > 0 ? p[a] / (p[a] - p[b]) : 0;
      crossings.push_back({.point = mesh.nodes[a] + share * (mesh.nodes[b] - mesh.nodes[a])});
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
      if (wet[static_cast<std::size_t>(i)] != wet[static_cast<std::size_t>(j)])
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

std::optional<Vec2> find_exit(const meshes::TriangleMesh& mesh, const NodeConditions& conditions,
                              std::span<const double> entering, std::vector<Polyline>& contours)
{
  if (contours.empty())
    return std::nullopt;
  const auto node = [&](Index i) -> const Vec2& { return mesh.nodes[static_cast<std::size_t>(i)]; };
  const auto outflow = [&](Index i)
  { return std::max(-entering[static_cast<std::size_t>(i)], 0.0); };

  // A: the lower end of the longest contour that is a node of the face.
  Index last = -1;
  for (const Index edge : conditions.face_edges)
    for (const Index i : mesh.boundary[static_cast<std::size_t>(edge)])
      if ((node(i) == contours.front().front() || node(i) == contours.front().back()) &&
          conditions.kind[static_cast<std::size_t>(i)] == NodeKind::face &&
          (last < 0 || node(i).y() < node(last).y()))
        last = i;
  if (last < 0)
    return std::nullopt;

  // B: its neighbour on the boundary where more water comes out, and the length of face around B.
  Index before = -1;
  for (const auto& [i, j] : mesh.boundary)
    if (i == last || j == last)
    {
      const Index other = i == last ? j : i;
      if (before < 0 || outflow(other) > outflow(before))
        before = other;
    }
  double around = 0;
  for (const Index edge : conditions.face_edges)
  {
    const auto& [i, j] = mesh.boundary[static_cast<std::size_t>(edge)];
    if (i == before || j == before)
      around += 0.5 * (node(j) - node(i)).norm();
  }
  const double length = (node(last) - node(before)).norm();
  double share = 0.5;
  if (conditions.kind[static_cast<std::size_t>(before)] == NodeKind::face && outflow(before) > 0)
    share = std::min(std::sqrt(2 * outflow(last) * around / (outflow(before) * length)), 1.0);
  const Vec2 exit = node(before) + share * (node(last) - node(before));
  for (Polyline& contour : contours)
    for (Vec2* end : {&contour.front(), &contour.back()})
      if (*end == node(last))
        *end = exit;
  return exit;
}
} // namespace berm::seepage
