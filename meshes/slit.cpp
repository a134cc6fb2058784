// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/slit.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <map>
#include <set>

namespace berm::meshes
{
namespace
{
using Edge = std::array<Index, 2>;

/// A directed edge as a triangle has it: from its corner to the next one.
struct Side
{
  std::size_t triangle = 0, corner = 0;
};

std::size_t as_size(Index i)
{
  return static_cast<std::size_t>(i);
}

class Cut
{
public:
  Cut(TriangleMesh& mesh, const std::vector<SlitEdge>& edges) : mesh_(mesh), edges_(edges)
  {
    std::vector<bool> on_line(mesh.nodes.size(), false);
    for (const SlitEdge& edge : edges)
      for (const Index i : edge.nodes)
      {
        on_line[as_size(i)] = true;
        nodes_.insert(i);
      }
    for (const SlitEdge& edge : edges)
    {
      cut_.insert(edge.nodes);
      cut_.insert({edge.nodes[1], edge.nodes[0]});
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
      {
        const Index i = mesh.triangles[t][k], j = mesh.triangles[t][(k + 1) % 3];
        if (on_line[as_size(i)] || on_line[as_size(j)])
          sides_[{i, j}] = {t, k};
      }
  }

  void run()
  {
    std::vector<std::array<Index, 3>> renumbered = mesh_.triangles;
    for (const Index node : nodes_)
      split(node, renumbered);
    const auto row = [&](const Edge& edge) -> Edge
    {
      const Side side = sides_.at(edge);
      const auto& corners = renumbered[side.triangle];
      return {corners[side.corner], corners[(side.corner + 1) % 3]};
    };
    for (Edge& edge : mesh_.boundary)
      if (nodes_.contains(edge[0]) || nodes_.contains(edge[1]))
        edge = row(edge);
    for (const SlitEdge& edge : edges_)
    {
      const Edge one = row(edge.nodes), other = row({edge.nodes[1], edge.nodes[0]});
      assert(one[0] != other[1] || one[1] != other[0]);
      mesh_.boundary.push_back(one);
      mesh_.boundary.push_back(other);
      mesh_.boundary_stretch.insert(mesh_.boundary_stretch.end(), 2, edge.stretch);
    }
    mesh_.triangles = std::move(renumbered);
  }

private:
  /// Walk each fan around the node counter-clockwise, from the edge that it starts at.
  void split(Index node, std::vector<std::array<Index, 3>>& renumbered)
  {
    bool first = true;
    for (auto start = sides_.lower_bound({node, 0});
         start != sides_.end() && start->first[0] == node; ++start)
    {
      const Edge from = start->first; // node -> neighbour: the fan's first edge if nothing lies
                                      // on its other side
      if (!cut_.contains(from) && sides_.contains({from[1], from[0]}))
        continue;
      Index copy = node;
      if (!first)
      {
        copy = static_cast<Index>(mesh_.nodes.size());
        mesh_.nodes.push_back(Vec2(mesh_.nodes[as_size(node)]));
      }
      first = false;
      for (Side side = start->second;;)
      {
        renumbered[side.triangle][side.corner] = copy;
        const Index last = mesh_.triangles[side.triangle][(side.corner + 2) % 3];
        const auto beyond = sides_.find({node, last});
        if (cut_.contains({last, node}) || beyond == sides_.end())
          break;
        side = beyond->second;
      }
    }
  }

  TriangleMesh& mesh_;
  const std::vector<SlitEdge>& edges_;
  std::set<Index> nodes_;      ///< on the lines
  std::set<Edge> cut_;         ///< both directions
  std::map<Edge, Side> sides_; ///< of edges with an end on a line
};
} // namespace

void cut_open(TriangleMesh& mesh, const std::vector<SlitEdge>& edges)
{
  if (!edges.empty())
    Cut(mesh, edges).run();
}
} // namespace berm::meshes
