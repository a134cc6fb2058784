// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/refine.h"

#include "meshes/sides.h"

#include <cstddef>

namespace berm::meshes
{
namespace
{
/// Which side of each triangle is its longest; the first of equals.
std::vector<std::size_t> longest_sides(const TriangleMesh& mesh, const Sides& sides)
{
  std::vector<double> length2;
  length2.reserve(sides.ends.size());
  for (const auto& [i, j] : sides.ends)
    length2.push_back(
        (mesh.nodes[static_cast<std::size_t>(j)] - mesh.nodes[static_cast<std::size_t>(i)])
            .squaredNorm());
  std::vector<std::size_t> longest;
  longest.reserve(sides.of.size());
  for (const auto& of : sides.of)
  {
    std::size_t a = 0;
    for (std::size_t b = 1; b < 3; ++b)
      if (length2[of[b]] > length2[of[a]])
        a = b;
    longest.push_back(a);
  }
  return longest;
}

/// The sides of the marked triangles, and the longest of every triangle that has a cut side.
std::vector<std::uint8_t> sides_to_cut(const Sides& sides, const std::vector<std::size_t>& longest,
                                       std::span<const std::uint8_t> marked)
{
  std::vector<std::uint8_t> cut(sides.ends.size(), 0);
  std::vector<std::size_t> fresh;
  const auto add = [&](std::size_t side)
  {
    if (!cut[side])
      fresh.push_back(side);
    cut[side] = 1;
  };
  for (std::size_t t = 0; t < marked.size(); ++t)
    if (marked[t])
      for (const std::size_t side : sides.of[t])
        add(side);
  while (!fresh.empty())
  {
    const std::size_t side = fresh.back();
    fresh.pop_back();
    for (const std::size_t t : sides.touches[side])
      add(sides.of[t][longest[t]]);
  }
  return cut;
}
} // namespace

RefinedMesh refined(const TriangleMesh& mesh, std::span<const std::uint8_t> marked)
{
  const Sides sides(mesh);
  const std::vector<std::size_t> longest = longest_sides(mesh, sides);
  const std::vector<std::uint8_t> cut = sides_to_cut(sides, longest, marked);

  RefinedMesh result;
  TriangleMesh& fine = result.mesh;
  fine.nodes = mesh.nodes;
  std::vector<Index> middle(cut.size(), -1);
  for (std::size_t s = 0; s < cut.size(); ++s)
    if (cut[s])
    {
      const auto [i, j] = sides.ends[s];
      middle[s] = static_cast<Index>(fine.nodes.size());
      result.parents.push_back({i, j});
      fine.nodes.emplace_back(0.5 * (mesh.nodes[static_cast<std::size_t>(i)] +
                                     mesh.nodes[static_cast<std::size_t>(j)]));
    }

  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto add = [&](Index i, Index j, Index k)
    {
      fine.triangles.push_back({i, j, k});
      fine.triangle_soil.push_back(mesh.triangle_soil[t]);
      result.origin.push_back(static_cast<Index>(t));
    };
    // Corners a, b, c with the longest side from a to b, and the middles of its sides.
    const std::size_t k = longest[t];
    const auto corner = [&](std::size_t m) { return mesh.triangles[t][(k + m) % 3]; };
    const auto half = [&](std::size_t m) { return middle[sides.of[t][(k + m) % 3]]; };
    const Index a = corner(0), b = corner(1), c = corner(2);
    const Index ab = half(0), bc = half(1), ca = half(2);
    if (ab < 0)
      add(a, b, c);
    else if (bc >= 0 && ca >= 0)
    {
      add(a, ab, ca);
      add(ab, b, bc);
      add(ca, bc, c);
      add(ab, bc, ca);
    }
    else
    {
      if (ca < 0)
        add(a, ab, c);
      else
      {
        add(a, ab, ca);
        add(ca, ab, c);
      }
      if (bc < 0)
        add(ab, b, c);
      else
      {
        add(ab, b, bc);
        add(ab, bc, c);
      }
    }
  }

  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
  {
    const auto [i, j] = mesh.boundary[e];
    const Index m = middle[sides.between(i, j)];
    if (m < 0)
      fine.boundary.push_back({i, j});
    else
    {
      fine.boundary.push_back({i, m});
      fine.boundary.push_back({m, j});
    }
    fine.boundary_stretch.insert(fine.boundary_stretch.end(), m < 0 ? 1 : 2,
                                 mesh.boundary_stretch[e]);
  }
  return result;
}

void prolong(const RefinedMesh& refined, std::vector<double>& nodal)
{
  nodal.reserve(nodal.size() + refined.parents.size());
  for (const auto& [i, j] : refined.parents)
    nodal.push_back(0.5 *
                    (nodal[static_cast<std::size_t>(i)] + nodal[static_cast<std::size_t>(j)]));
}
} // namespace berm::meshes
