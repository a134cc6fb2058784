// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/boundary.h"

#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace berm::seepage
{
namespace
{
/// Nodes within this of a head level are at it: rounding of coordinates, relative to the largest of
/// them.
constexpr double level_tolerance = 1e-10;

double edge_length(const meshes::TriangleMesh& mesh, Index edge)
{
  const auto [a, b] = mesh.boundary[static_cast<std::size_t>(edge)];
  return (mesh.nodes[static_cast<std::size_t>(b)] - mesh.nodes[static_cast<std::size_t>(a)]).norm();
}

double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b)
{
  const Vec2 ab = b - a;
  const double t = std::clamp((point - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (point - a - t * ab).norm();
}

/// Triangles' edges as an adjacency of nodes: the neighbours of node i are node[first[i]] ..
/// node[first[i + 1] - 1].
struct NodeGraph
{
  std::vector<std::size_t> first;
  std::vector<Index> node;
};

NodeGraph node_graph(const meshes::TriangleMesh& mesh)
{
  NodeGraph graph;
  graph.first.assign(mesh.nodes.size() + 1, 0);
  for (const auto& triangle : mesh.triangles)
    for (const Index i : triangle)
      graph.first[static_cast<std::size_t>(i) + 1] += 2;
  for (std::size_t i = 1; i < graph.first.size(); ++i)
    graph.first[i] += graph.first[i - 1];
  graph.node.resize(graph.first.back());
  std::vector<std::size_t> next(graph.first.begin(), graph.first.end() - 1);
  for (const auto& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto i = static_cast<std::size_t>(triangle[k]);
      graph.node[next[i]++] = triangle[(k + 1) % 3];
      graph.node[next[i]++] = triangle[(k + 2) % 3];
    }
  return graph;
}
} // namespace

std::vector<Boundary> boundary_conditions(const meshes::Section& section,
                                          const std::vector<Boundary>& marked)
{
  std::vector<Boundary> boundary;
  boundary.reserve(section.stretches.size());
  for (const meshes::Stretch& stretch : section.stretches)
  {
    switch (stretch.kind)
    {
    case meshes::StretchKind::ground:
      boundary.push_back({BoundaryKind::seepage_face, 0});
      break;
    case meshes::StretchKind::left_pool:
      boundary.push_back({BoundaryKind::head, section.left_pool_level.value()});
      break;
    case meshes::StretchKind::right_pool:
      boundary.push_back({BoundaryKind::head, section.right_pool_level.value()});
      break;
    case meshes::StretchKind::base:
    case meshes::StretchKind::left_side:
    case meshes::StretchKind::right_side:
      boundary.push_back({BoundaryKind::impervious, 0});
      break;
    case meshes::StretchKind::marked:
      boundary.push_back(marked.at(static_cast<std::size_t>(stretch.marked_line)));
      break;
    }
  }
  return boundary;
}

NodeConditions node_conditions(const meshes::TriangleMesh& mesh, std::span<const Boundary> boundary)
{
  const std::size_t n = mesh.nodes.size();
  NodeConditions conditions{.kind = std::vector(n, NodeKind::interior),
                            .pressure_head = std::vector<double>(n, 0),
                            .load = std::vector<double>(n, 0),
                            .face_edges = {},
                            .highest_head = -std::numeric_limits<double>::infinity()};

  double size = 0;
  for (const Vec2& x : mesh.nodes)
    size = std::max(size, x.cwiseAbs().maxCoeff());
  const double tolerance = level_tolerance * size;

  std::vector<double> head(n, -std::numeric_limits<double>::infinity());
  for (std::size_t edge = 0; edge < mesh.boundary.size(); ++edge)
  {
    const Boundary& condition = boundary[static_cast<std::size_t>(mesh.boundary_stretch[edge])];
    const std::array<std::size_t, 2> ends{static_cast<std::size_t>(mesh.boundary[edge][0]),
                                          static_cast<std::size_t>(mesh.boundary[edge][1])};
    bool face = condition.kind == BoundaryKind::seepage_face;
    if (condition.kind == BoundaryKind::inflow)
      for (const std::size_t i : ends)
        conditions.load[i] += 0.5 * condition.value * edge_length(mesh, static_cast<Index>(edge));
    if (condition.kind == BoundaryKind::head)
    {
      const double lowest = std::min(mesh.nodes[ends[0]].y(), mesh.nodes[ends[1]].y());
      const double highest = std::max(mesh.nodes[ends[0]].y(), mesh.nodes[ends[1]].y());
      if (lowest < condition.value - tolerance)
        for (const std::size_t i : ends)
          if (mesh.nodes[i].y() <= condition.value + tolerance)
          {
            head[i] = std::max(head[i], condition.value);
            conditions.highest_head = std::max(conditions.highest_head, condition.value);
          }
      face = highest > condition.value + tolerance || lowest >= condition.value - tolerance;
    }
    if (face)
    {
      conditions.face_edges.push_back(static_cast<Index>(edge));
      for (const std::size_t i : ends)
        conditions.kind[i] = NodeKind::face;
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    if (std::isfinite(head[i]))
    {
      conditions.kind[i] = NodeKind::head;
      conditions.pressure_head[i] = std::max(head[i] - mesh.nodes[i].y(), 0.0);
    }
  if (!std::isfinite(conditions.highest_head))
  {
    std::string heads;
    for (const Boundary& condition : boundary)
      if (condition.kind == BoundaryKind::head)
        heads += fmt::format("{}{:.6g}", heads.empty() ? "" : ", ", condition.value);
    throw InputError(
        {{.key = "seepage.boundary",
          .value = heads,
          .problem = heads.empty()
                         ? "no head is given anywhere: nothing tells how high the water stands"
                         : "every head lies below the boundary it acts on: no soil is under water",
          .allowed = "at least one pool or boundary of kind head with soil below its level",
          .hint = "give left_level_m, right_level_m or a [[seepage.boundary]] of kind \"head\""}});
  }
  return conditions;
}

std::vector<double> face_weight(const meshes::TriangleMesh& mesh, std::span<const Index> face_edges)
{
  std::vector<double> weight(mesh.nodes.size(), 1);
  const NodeGraph graph = node_graph(mesh);
  std::vector<Index> visited_by(mesh.nodes.size(), -1);
  std::vector<Index> queue;
  // From each edge outwards, over nodes nearer than four of its lengths.
  for (const Index edge : face_edges)
  {
    const auto& ends = mesh.boundary[static_cast<std::size_t>(edge)];
    const Vec2& a = mesh.nodes[static_cast<std::size_t>(ends[0])];
    const Vec2& b = mesh.nodes[static_cast<std::size_t>(ends[1])];
    const double reach = (b - a).norm();
    queue.assign(ends.begin(), ends.end());
    for (const Index i : ends)
      visited_by[static_cast<std::size_t>(i)] = edge;
    while (!queue.empty())
    {
      const auto i = static_cast<std::size_t>(queue.back());
      queue.pop_back();
      const double distance = distance_to_segment(mesh.nodes[i], a, b);
      if (distance >= reach)
        continue;
      weight[i] = std::min(weight[i], distance / reach);
      for (std::size_t k = graph.first[i]; k < graph.first[i + 1]; ++k)
      {
        Index& mark = visited_by[static_cast<std::size_t>(graph.node[k])];
        if (mark != edge)
          queue.push_back(graph.node[k]);
        mark = edge;
      }
    }
  }
  return weight;
}

std::vector<double> stretch_inflow(const meshes::TriangleMesh& mesh,
                                   std::span<const Boundary> boundary,
                                   const NodeConditions& conditions,
                                   std::span<const double> reaction)
{
  std::vector<bool> is_face(mesh.boundary.size(), false);
  for (const Index edge : conditions.face_edges)
    is_face[static_cast<std::size_t>(edge)] = true;
  const auto imposes = [&](std::size_t edge, Index node)
  {
    const BoundaryKind kind = boundary[static_cast<std::size_t>(mesh.boundary_stretch[edge])].kind;
    switch (conditions.kind[static_cast<std::size_t>(node)])
    {
    case NodeKind::head:
      return kind == BoundaryKind::head;
    case NodeKind::face:
      return static_cast<bool>(is_face[edge]);
    case NodeKind::interior:
      break;
    }
    return false;
  };

  std::vector<double> length(mesh.nodes.size(), 0);
  for (std::size_t edge = 0; edge < mesh.boundary.size(); ++edge)
    for (const Index i : mesh.boundary[edge])
      if (imposes(edge, i))
        length[static_cast<std::size_t>(i)] += edge_length(mesh, static_cast<Index>(edge));

  std::vector<double> inflow(boundary.size(), 0);
  for (std::size_t edge = 0; edge < mesh.boundary.size(); ++edge)
  {
    const auto stretch = static_cast<std::size_t>(mesh.boundary_stretch[edge]);
    const double edge_l = edge_length(mesh, static_cast<Index>(edge));
    for (const Index i : mesh.boundary[edge])
      if (imposes(edge, i))
        inflow[stretch] +=
            reaction[static_cast<std::size_t>(i)] * edge_l / length[static_cast<std::size_t>(i)];
    if (boundary[stretch].kind == BoundaryKind::inflow)
      inflow[stretch] += boundary[stretch].value * edge_l;
  }
  return inflow;
}
} // namespace berm::seepage
