// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/sides.h"

#include <algorithm>

namespace berm::meshes
{
namespace
{
std::array<Index, 2> ordered(Index i, Index j)
{
  return {std::min(i, j), std::max(i, j)};
}
} // namespace

Sides::Sides(const TriangleMesh& mesh)
{
  struct Use
  {
    std::array<Index, 2> ends;
    std::size_t triangle, corner;
  };
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t a = 0; a < 3; ++a)
      uses.push_back({ordered(mesh.triangles[t][a], mesh.triangles[t][(a + 1) % 3]), t, a});
  std::ranges::stable_sort(uses, {}, &Use::ends);
  of.resize(mesh.triangles.size());
  for (const Use& use : uses)
  {
    if (ends.empty() || ends.back() != use.ends)
    {
      ends.push_back(use.ends);
      touches.push_back({use.triangle, use.triangle});
    }
    touches.back()[1] = use.triangle;
    of[use.triangle][use.corner] = ends.size() - 1;
  }
}

std::size_t Sides::between(Index i, Index j) const
{
  return static_cast<std::size_t>(std::ranges::lower_bound(ends, ordered(i, j)) - ends.begin());
}
} // namespace berm::meshes
