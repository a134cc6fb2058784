// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/boundary_walk.h"

#include <algorithm>
#include <numeric>

namespace berm::meshes
{
std::vector<std::vector<std::size_t>> boundary_loops(const TriangleMesh& mesh)
{
  // Each node of the boundary belongs to one fan of triangles: one edge starts at it.
  std::vector<std::size_t> starting_at(mesh.nodes.size(), 0);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    starting_at[static_cast<std::size_t>(mesh.boundary[e][0])] = e;
  std::vector<bool> seen(mesh.boundary.size(), false);
  std::vector<std::vector<std::size_t>> loops;
  for (std::size_t first = 0; first < mesh.boundary.size(); ++first)
  {
    if (seen[first])
      continue;
    loops.emplace_back();
    for (std::size_t e = first; !seen[e];
         e = starting_at[static_cast<std::size_t>(mesh.boundary[e][1])])
    {
      seen[e] = true;
      loops.back().push_back(e);
    }
  }
  return loops;
}

std::vector<std::size_t> pieces(const TriangleMesh& mesh)
{
  // Each node points to one of its piece with a smaller number, the smallest to itself.
  std::vector<std::size_t> towards(mesh.nodes.size());
  std::iota(towards.begin(), towards.end(), std::size_t{0});
  const auto root = [&towards](std::size_t i)
  {
    while (towards[i] != i)
      i = towards[i] = towards[towards[i]];
    return i;
  };
  for (const auto& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 2; ++k)
    {
      const std::size_t a = root(static_cast<std::size_t>(triangle[k])),
                        b = root(static_cast<std::size_t>(triangle[k + 1]));
      towards[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::size_t> piece(mesh.nodes.size(), 0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < piece.size(); ++i)
    piece[i] = root(i) == i ? count++ : piece[root(i)];
  return piece;
}
} // namespace berm::meshes
