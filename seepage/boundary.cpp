// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/boundary.h"

#include "core/error.h"
#include "meshes/boundary_walk.h"
#include "meshes/planar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
/// Horizontal width of the edge as rain from above meets it [m]; 0 if it faces down.
double width_under_sky(const meshes::TriangleMesh& mesh, std::size_t edge)
{
  const auto [a, b] = mesh.boundary[edge]; // soil on the left: ground runs from right to left
  return std::max(mesh.nodes[static_cast<std::size_t>(a)].x() -
                      mesh.nodes[static_cast<std::size_t>(b)].x(),
                  0.0);
}

/// A part of the mesh that no water connects with the rest.
struct Piece
{
  bool head = false, face = false;
  double put_in = 0, taken_out = 0;                        ///< prescribed [m2/s]
  double lowest = std::numeric_limits<double>::infinity(); ///< [m]
  double area = 0;                                         ///< [m2]
  Vec2 moment = Vec2::Zero();                              ///< centroid times area [m3]

  [[nodiscard]] std::string name() const
  {
    const Vec2 centre = moment / area;
    return fmt::format("the piece of the section of {:.4g} m2 about ({:.4g}, {:.4g})", area,
                       centre.x(), centre.y());
  }
};

std::vector<Piece> survey(const meshes::TriangleMesh& mesh, const NodeConditions& conditions,
                          const std::vector<std::size_t>& piece_of)
{
  std::vector<Piece> found(*std::ranges::max_element(piece_of) + 1);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
  {
    Piece& piece = found[piece_of[i]];
    piece.head = piece.head || conditions.kind[i] == NodeKind::head;
    piece.face = piece.face || conditions.kind[i] == NodeKind::face;
    piece.put_in += std::max(conditions.load[i], 0.0);
    piece.taken_out += std::max(-conditions.load[i], 0.0);
    piece.lowest = std::min(piece.lowest, mesh.nodes[i].y());
  }
  for (const auto& [i, j, k] : mesh.triangles)
  {
    Piece& piece = found[piece_of[static_cast<std::size_t>(i)]];
    const Vec2 &a = mesh.nodes[static_cast<std::size_t>(i)],
               &b = mesh.nodes[static_cast<std::size_t>(j)],
               &c = mesh.nodes[static_cast<std::size_t>(k)];
    const double area = 0.5 * meshes::cross(b - a, c - a);
    piece.area += area;
    piece.moment += area * (a + b + c) / 3;
  }
  return found;
}

/// Give the nodes of pieces that no water reaches the head of their lowest point: there, any head
/// below the seepage face solves the problem.
/// @throws InputError for a piece whose head nothing determines.
void settle_dry_pieces(const meshes::TriangleMesh& mesh, NodeConditions& conditions)
{
  const std::vector<std::size_t> piece_of = meshes::pieces(mesh);
  std::vector<Piece> pieces = survey(mesh, conditions, piece_of);
  std::vector<Mistake> mistakes;
  for (const Piece& piece : pieces)
  {
    const std::string name = pieces.size() > 1 ? piece.name() : "the section";
    if (!piece.head && !piece.face)
      mistakes.push_back({.key = "seepage.boundary",
                          .problem = name + " has neither a head nor a seepage face: nothing tells "
                                            "how high its water stands",
                          .allowed = "a pool, open ground, or a boundary of kind head or "
                                     "seepage_face on every piece that walls cut off",
                          .hint = "end the wall inside the soil, or mark a part of the boundary"});
    else if (!piece.head && piece.taken_out > 0 && piece.put_in == 0)
      mistakes.push_back({.key = "seepage.boundary",
                          .problem = "water is taken out of " + name + ", which gets none",
                          .allowed = "an inflow < 0 only where a head, rain or another inflow "
                                     "gives water"});
  }
  if (!mistakes.empty())
    throw InputError(std::move(mistakes));

  for (const Piece& piece : pieces)
    if (!piece.head && piece.put_in == 0)
      conditions.warnings.push_back(pieces.size() > 1
                                        ? "no water reaches " + piece.name() + ": it is dry"
                                        : "no water reaches the soil: it is dry");
  for (std::size_t i = 0; i < piece_of.size(); ++i)
    if (const Piece& piece = pieces[piece_of[i]]; !piece.head && piece.put_in == 0)
    {
      conditions.kind[i] = NodeKind::head;
      conditions.pressure_head[i] = piece.lowest - mesh.nodes[i].y();
    }
}
} // namespace

bool may_hold_pressure(BoundaryKind kind)
{
  return kind != BoundaryKind::impervious && kind != BoundaryKind::inflow;
}

std::vector<Boundary> boundary_conditions(const meshes::Section& section,
                                          const std::vector<Boundary>& marked, double rain)
{
  std::vector<Boundary> boundary;
  boundary.reserve(section.stretches.size());
  for (const meshes::Stretch& stretch : section.stretches)
  {
    switch (stretch.kind)
    {
    case meshes::StretchKind::ground:
      if (rain > 0)
        boundary.push_back({BoundaryKind::rain, rain});
      else
        boundary.push_back({BoundaryKind::seepage_face, 0});
      break;
    case meshes::StretchKind::overflow:
      boundary.push_back({BoundaryKind::overflow, section.overflow.value().depth,
                          section.overflow.value().crest.x()});
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
  constexpr double none = -std::numeric_limits<double>::infinity();
  NodeConditions conditions{.kind = std::vector(n, NodeKind::interior),
                            .pressure_head = std::vector<double>(n, 0),
                            .load = std::vector<double>(n, 0),
                            .rain = std::vector<double>(n, 0),
                            .face_edges = {},
                            .highest_head = none,
                            .heaviest_rain = 0,
                            .warnings = {}};

  double size = 0;
  for (const Vec2& x : mesh.nodes)
    size = std::max(size, x.cwiseAbs().maxCoeff());
  const double tolerance = level_tolerance * size;

  std::vector<double> head(n, none);
  const auto give_head = [&](std::size_t i, double value)
  {
    head[i] = std::max(head[i], value);
    conditions.highest_head = std::max(conditions.highest_head, value);
  };
  double highest_face = none;
  for (std::size_t edge = 0; edge < mesh.boundary.size(); ++edge)
  {
    const Boundary& condition = boundary[static_cast<std::size_t>(mesh.boundary_stretch[edge])];
    const std::array<std::size_t, 2> ends{static_cast<std::size_t>(mesh.boundary[edge][0]),
                                          static_cast<std::size_t>(mesh.boundary[edge][1])};
    const double lowest = std::min(mesh.nodes[ends[0]].y(), mesh.nodes[ends[1]].y());
    const double highest = std::max(mesh.nodes[ends[0]].y(), mesh.nodes[ends[1]].y());
    bool face = false;
    switch (condition.kind)
    {
    case BoundaryKind::impervious:
      break;
    case BoundaryKind::head:
      if (lowest < condition.value - tolerance)
        for (const std::size_t i : ends)
          if (mesh.nodes[i].y() <= condition.value + tolerance)
            give_head(i, condition.value);
      face = highest > condition.value + tolerance || lowest >= condition.value - tolerance;
      break;
    case BoundaryKind::seepage_face:
      face = true;
      break;
    case BoundaryKind::inflow:
      for (const std::size_t i : ends)
        conditions.load[i] += 0.5 * condition.value * edge_length(mesh, static_cast<Index>(edge));
      break;
    case BoundaryKind::rain:
      face = true;
      conditions.heaviest_rain = std::max(conditions.heaviest_rain, condition.value);
      for (const std::size_t i : ends)
      {
        conditions.load[i] += 0.5 * condition.value * width_under_sky(mesh, edge);
        conditions.rain[i] += 0.5 * condition.value * width_under_sky(mesh, edge);
      }
      break;
    case BoundaryKind::overflow: // docs/theory.md eq. (2.36); the film is rain without limit
      conditions.heaviest_rain = std::numeric_limits<double>::infinity();
      for (const std::size_t i : ends)
        give_head(i, mesh.nodes[i].y() +
                         std::max(0.0, condition.value -
                                           std::abs(mesh.nodes[i].x() - condition.crest_x)));
      break;
    }
    if (face)
    {
      highest_face = std::max(highest_face, highest);
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
    conditions.highest_head = highest_face;
  settle_dry_pieces(mesh, conditions);
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

void limit_weight(const meshes::TriangleMesh& mesh, std::span<const double> vertical_conductivity,
                  double rain, std::vector<double>& weight)
{
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const Index i : mesh.triangles[t])
    {
      double& w = weight[static_cast<std::size_t>(i)];
      w = std::min(w, 1 - std::min(rain / vertical_conductivity[t], 1.0));
    }
}

StretchWater stretch_water(const meshes::TriangleMesh& mesh, std::span<const Boundary> boundary,
                           const NodeConditions& conditions, std::span<const double> reaction)
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
      return kind == BoundaryKind::head || kind == BoundaryKind::overflow;
    case NodeKind::face:
      return static_cast<bool>(is_face[edge]);
    case NodeKind::interior:
      break;
    }
    return false;
  };
  // docs/theory.md eq. (2.32): of the rain at a node, what enters.
  const auto entering_rain = [&](std::size_t i)
  { return std::clamp(reaction[i], 0.0, conditions.rain[i]); };

  std::vector<double> length(mesh.nodes.size(), 0);
  for (std::size_t edge = 0; edge < mesh.boundary.size(); ++edge)
    for (const Index i : mesh.boundary[edge])
      if (imposes(edge, i))
        length[static_cast<std::size_t>(i)] += edge_length(mesh, static_cast<Index>(edge));

  StretchWater water{.inflow = std::vector<double>(boundary.size(), 0),
                     .runoff = std::vector<double>(boundary.size(), 0)};
  for (std::size_t edge = 0; edge < mesh.boundary.size(); ++edge)
  {
    const auto stretch = static_cast<std::size_t>(mesh.boundary_stretch[edge]);
    const Boundary& condition = boundary[stretch];
    const double edge_l = edge_length(mesh, static_cast<Index>(edge));
    for (const Index node : mesh.boundary[edge])
    {
      const auto i = static_cast<std::size_t>(node);
      if (imposes(edge, node))
        water.inflow[stretch] += (reaction[i] - entering_rain(i)) * edge_l / length[i];
      if (condition.kind == BoundaryKind::rain && conditions.rain[i] > 0)
      {
        const double rain = 0.5 * condition.value * width_under_sky(mesh, edge);
        const double entering = rain * entering_rain(i) / conditions.rain[i];
        water.inflow[stretch] += entering;
        water.runoff[stretch] += rain - entering;
      }
    }
    if (condition.kind == BoundaryKind::inflow)
      water.inflow[stretch] += condition.value * edge_l;
  }
  return water;
}
} // namespace berm::seepage
