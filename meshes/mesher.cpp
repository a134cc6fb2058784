// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/mesher.h"

#include "core/error.h"
#include "meshes/gmsh_session.h"
#include "meshes/planar.h"
#include "meshes/planar_graph.h"
#include "meshes/refine.h"
#include "meshes/slit.h"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace berm::meshes
{
namespace
{
//------------------------------------------------------------------------------------------------
// gmsh
//------------------------------------------------------------------------------------------------

/// Edge length wanted at a point [m].
/// What the caller asks for, but where two parts of the drawing come close to each other (a thin
/// zone, a short edge) no more than the local feature size: the radius of the smallest disk at the
/// point that touches two edges without a common vertex (Ruppert 1995). It grows no faster than the
/// distance, so the triangles do so too. Not below a tenth of what is asked for: a membrane gets
/// stretched triangles.
class SizeField
{
public:
  SizeField(double edge_length, const PlanarGraph& graph, std::size_t outline)
      : edge_length_(edge_length)
  {
    for (std::size_t i = 0; i < outline; ++i)
      edges_.push_back({graph.points[i], graph.points[next(i, outline)], i, next(i, outline)});
    for (const InsideEdge& edge : graph.inside)
      edges_.push_back({graph.points[edge.from], graph.points[edge.to], edge.from, edge.to});
  }

  /// @param[in] factor  The wanted size is this many times as large.
  [[nodiscard]] double at(const Vec2& p, double factor) const
  {
    const double asked = factor * edge_length_;
    return std::clamp(feature_size(p, asked), 0.1 * asked, asked);
  }

private:
  struct Edge
  {
    Vec2 a, b;
    std::size_t from, to;
  };

  /// The local feature size if it is below `limit`, else `limit`.
  [[nodiscard]] double feature_size(const Vec2& p, double limit) const
  {
    thread_local std::vector<std::pair<double, const Edge*>> touched;
    touched.clear();
    for (const Edge& edge : edges_)
      if (const double d = distance(p, edge.a, edge.b); d < limit)
        touched.emplace_back(d, &edge);
    for (std::size_t m = 1; m < touched.size(); ++m)
      for (std::size_t k = 0; k < m; ++k)
      {
        const Edge &e = *touched[k].second, &f = *touched[m].second;
        if (e.from != f.from && e.from != f.to && e.to != f.from && e.to != f.to)
          limit = std::min(limit, std::max(touched[k].first, touched[m].first));
      }
    return limit;
  }

  double edge_length_; ///< [m]
  std::vector<Edge> edges_;
};

int tag(std::size_t i)
{
  return static_cast<int>(i) + 1;
}

/// A mesh and those of its edges that lie on inner lines.
struct Meshed
{
  TriangleMesh mesh;
  std::vector<SlitEdge> slits;
};

Meshed mesh_with(int algorithm, const Section& section, const PlanarGraph& graph,
                 const SizeField& field, double factor)
{
  const GmshSession session;
  gmsh::option::setNumber("Mesh.Algorithm", algorithm);
  gmsh::model::add("section");

  const std::size_t n = section.outline.size();
  std::vector<bool> used(graph.points.size(), false);
  std::fill_n(used.begin(), n, true);
  for (const InsideEdge& edge : graph.inside)
    used[edge.from] = used[edge.to] = true;
  for (std::size_t i = 0; i < graph.points.size(); ++i)
    if (used[i])
      gmsh::model::geo::addPoint(graph.points[i].x(), graph.points[i].y(), 0, 0, tag(i));
  std::vector<int> outline, inside;
  for (std::size_t i = 0; i < n; ++i)
    outline.push_back(gmsh::model::geo::addLine(tag(i), tag(next(i, n)), tag(i)));
  for (const InsideEdge& edge : graph.inside)
    inside.push_back(gmsh::model::geo::addLine(tag(edge.from), tag(edge.to)));
  gmsh::model::geo::addCurveLoop(outline, 1);
  gmsh::model::geo::addPlaneSurface({1}, 1);
  gmsh::model::geo::synchronize();
  if (!inside.empty())
    gmsh::model::mesh::embed(1, inside, 2, 1);
  gmsh::model::mesh::setSizeCallback(
      // Newer releases give z and the size without the callback, gmsh 4.8 z alone.
      [&field, factor](int, int, double x, double y, auto...) {
        return field.at({x, y}, factor);
      });
  gmsh::model::mesh::generate(2);

  std::vector<std::size_t> node_tags, element_tags, corners;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(node_tags, coordinates, parameters);
  gmsh::model::mesh::getElementsByType(2, element_tags, corners);

  // gmsh numbers from 1, with gaps; nodes that no triangle uses are left out.
  std::size_t largest = 0;
  for (const std::size_t t : node_tags)
    largest = std::max(largest, t);
  std::vector<Index> index(largest + 1, -1);
  for (const std::size_t t : corners)
    index.at(t) = 0;
  Meshed result;
  TriangleMesh& mesh = result.mesh;
  for (std::size_t i = 0; i < node_tags.size(); ++i)
    if (index[node_tags[i]] == 0)
    {
      index[node_tags[i]] = static_cast<Index>(mesh.nodes.size());
      mesh.nodes.emplace_back(coordinates[3 * i], coordinates[3 * i + 1]);
    }
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3)
    mesh.triangles.push_back({index[corners[t]], index[corners[t + 1]], index[corners[t + 2]]});
  const auto edges_of = [&](int line)
  {
    element_tags.clear(); // gmsh fills what it is given without making it smaller
    corners.clear();
    gmsh::model::mesh::getElementsByType(1, element_tags, corners, line);
    std::vector<std::array<Index, 2>> edges;
    for (std::size_t e = 0; e + 1 < corners.size(); e += 2)
      edges.push_back({index.at(corners[e]), index.at(corners[e + 1])});
    return edges;
  };
  for (std::size_t k = 0; k < n; ++k)
    for (const std::array<Index, 2>& edge : edges_of(tag(k)))
    {
      mesh.boundary.push_back(edge);
      mesh.boundary_stretch.push_back(section.edge_stretch[k]);
    }
  for (std::size_t k = 0; k < inside.size(); ++k)
    if (graph.inside[k].stretch >= 0)
      for (const std::array<Index, 2>& edge : edges_of(inside[k]))
        result.slits.push_back({edge, graph.inside[k].stretch});
  return result;
}

//------------------------------------------------------------------------------------------------
// Checks
//------------------------------------------------------------------------------------------------

const Vec2& node(const TriangleMesh& mesh, Index i)
{
  return mesh.nodes[static_cast<std::size_t>(i)];
}

/// Turn all triangles counter-clockwise and give them their soil. What is wrong, or nothing.
std::string finish(const Section& section, TriangleMesh& mesh)
{
  double area = 0;
  for (auto& t : mesh.triangles)
  {
    const Vec2 &a = node(mesh, t[0]), &b = node(mesh, t[1]), &c = node(mesh, t[2]);
    const double twice = cross(b - a, c - a);
    if (!(twice != 0))
      return fmt::format("a triangle without area at ({:.6g}, {:.6g})", a.x(), a.y());
    area += 0.5 * std::abs(twice);
    mesh.triangle_soil.push_back(soil_at(section, (a + b + c) / 3));
    if (twice < 0)
      std::swap(t[1], t[2]);
  }
  const double exact = polygon_area(section.outline);
  if (!(std::abs(area - exact) <= 1e-9 * exact))
    return fmt::format("the triangles cover {:.10g} m2 of {:.10g} m2", area, exact);
  for (const auto& edge : mesh.boundary)
    if (edge[0] < 0 || edge[1] < 0)
      return "a boundary edge belongs to no triangle";
  return "";
}

/// Mesh with the algorithm that works, edges `factor` times as long as wanted.
TriangleMesh mesh_at(double factor, const Section& section, const PlanarGraph& graph,
                     const SizeField& field)
{
  std::string problem;
  for (const int algorithm :
       {6, 5, 1}) // frontal, Delaunay, MeshAdapt: worse or slower, each in turn
  {
    try
    {
      Meshed result = mesh_with(algorithm, section, graph, field, factor);
      problem = finish(section, result.mesh);
      if (problem.empty())
      {
        cut_open(result.mesh, result.slits);
        return std::move(result.mesh);
      }
    }
    catch (const std::exception& error)
    {
      problem = error.what();
    }
    catch (...) // gmsh throws plain values in some builds
    {
      problem = "unknown failure";
    }
  }
  throw NotConverged("gmsh could not triangulate the section: " + problem);
}
} // namespace

TriangleMesh triangulate(const Section& section, double edge_length)
{
  if (!(edge_length > 0) || !std::isfinite(edge_length))
    throw InputError({{"seepage.element_size_m", fmt::format("{:.10g}", edge_length),
                       "no edge length", "> 0", ""}});
  const PlanarGraph graph = planar_graph(section);
  const SizeField field(edge_length, graph, section.outline.size());
  // gmsh takes 30 to 75 us a node, halving the edges of a coarser mesh a tenth of that.
  constexpr double largest = 12000; // nodes that gmsh is asked for
  TriangleMesh mesh = mesh_at(4, section, graph, field);
  const double expected = 16 * static_cast<double>(mesh.nodes.size());
  const int halvings = expected <= largest ? 0 : expected <= 4 * largest ? 1 : 2;
  if (halvings < 2)
    mesh = mesh_at(halvings == 1 ? 2 : 1, section, graph, field);
  for (int k = 0; k < halvings; ++k)
    mesh = refined(mesh, std::vector<std::uint8_t>(mesh.triangles.size(), 1)).mesh;
  return mesh;
}
} // namespace berm::meshes
