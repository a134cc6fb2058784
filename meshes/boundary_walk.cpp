// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/boundary_walk.h"

namespace berm::meshes
{
std::vector<std::size_t> edges_along(const TriangleMesh& mesh)
{
  std::vector<std::size_t> starting_at(mesh.nodes.size(), 0);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    starting_at[static_cast<std::size_t>(mesh.boundary[e][0])] = e;
  std::vector<std::size_t> edges;
  edges.reserve(mesh.boundary.size());
  std::size_t edge = 0;
  for (std::size_t k = 0; k < mesh.boundary.size(); ++k)
  {
    edges.push_back(edge);
    edge = starting_at[static_cast<std::size_t>(mesh.boundary[edge][1])];
  }
  return edges;
}
} // namespace berm::meshes
