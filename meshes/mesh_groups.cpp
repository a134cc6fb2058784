// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/mesh_groups.h"

#include "core/error.h"
#include "meshes/drawing.h"
#include "meshes/planar.h"
#include "meshes/section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace berm::meshes
{
namespace
{
using Node = std::size_t; // gmsh's tag
using Edge = std::pair<Node, Node>;

constexpr double flat = 1e-9; ///< of the mesh's extent: points nearer to a line are on it

/// The borders and lines of one mesh.
class Borders
{
public:
  explicit Borders(const MeshGroups& groups) : groups_(groups)
  {
    Polyline points;
    for (const auto& [tag, at] : groups.nodes)
      points.push_back(at);
    extent_ = extent(points);
  }

  GmshDrawing drawing()
  {
    GmshDrawing result;
    std::set<Edge> all;
    for (const auto& [name, edges] : surfaces())
    {
      for (Polyline& loop : loops(edges))
        if (polygon_area(loop) > 0)
          result.regions.push_back({name, std::move(loop)});
      merge(all, edges);
    }
    std::ranges::stable_sort(result.regions, std::ranges::greater{},
                             [](const DrawnRegion& r) { return polygon_area(r.polygon); });
    std::vector<Polyline> outlines = loops(all);
    if (const auto hole = std::ranges::find_if(outlines, [](const Polyline& loop)
                                               { return polygon_area(loop) < 0; });
        hole != outlines.end())
      refuse_mesh(fmt::format("the surfaces leave a hole at {}", text(hole->front())),
                  "surfaces that fill the section",
                  "are the points of neighbouring surfaces the same points?");
    if (outlines.size() != 1)
      refuse_mesh(fmt::format("the surfaces are in {} pieces", outlines.size()),
                  "one connected section", "");
    result.outline = std::move(outlines.front());
    result.curves = curves();
    return result;
  }

private:
  const Vec2& at(Node node) const
  {
    const auto it = groups_.nodes.find(node);
    if (it == groups_.nodes.end())
      refuse_mesh(fmt::format("an element has node {}, which is not there", node), "", "");
    return it->second;
  }

  /// The edges of each surface that have it on their left and not on their right.
  std::vector<std::pair<std::string, std::set<Edge>>> surfaces() const
  {
    std::vector<std::pair<std::string, std::set<Edge>>> result;
    for (const MeshGroup& surface : groups_.surfaces)
    {
      if (surface.name.empty())
        refuse_mesh(fmt::format("physical surface {} has no name", surface.tag),
                    "the name of a soil", "in a .geo: Physical Surface(\"fill\") = {1};");
      std::set<Edge> border;
      for (std::vector<Node> corners : surface.elements)
      {
        Polyline polygon;
        for (const Node node : corners)
          polygon.push_back(at(node));
        if (polygon_area(polygon) < 0)
          std::ranges::reverse(corners);
        std::set<Edge> edges;
        for (std::size_t k = 0; k < corners.size(); ++k)
          edges.insert({corners[k], corners[next(k, corners.size())]});
        merge(border, edges);
      }
      result.emplace_back(surface.name, std::move(border));
    }
    if (result.empty())
      refuse_mesh("has no physical surfaces", "a physical surface for each soil, named after it",
                  "in a .geo: Physical Surface(\"fill\") = {1};");
    return result;
  }

  /// Edges that two areas run through in opposite directions are inside both together.
  void merge(std::set<Edge>& border, const std::set<Edge>& more) const
  {
    for (const auto& [from, to] : more)
      if (border.erase({to, from}) == 0 && !border.insert({from, to}).second)
        refuse_mesh(fmt::format("areas lie on each other at {}", text(at(from))),
                    "surfaces without overlaps", "");
  }

  /// Closed chains of edges, the area on their left, without needless points.
  std::vector<Polyline> loops(std::set<Edge> edges) const
  {
    std::vector<Polyline> result;
    while (!edges.empty())
    {
      const auto [first, second] = *edges.begin();
      edges.erase(edges.begin());
      std::vector<Node> chain{first, second};
      while (chain.back() != first)
      {
        const auto ahead = leftmost(edges, chain[chain.size() - 2], chain.back());
        if (ahead == edges.end())
          refuse_mesh(fmt::format("the border of a surface ends at {}", text(at(chain.back()))),
                      "surfaces without overlaps", "");
        chain.push_back(ahead->second);
        edges.erase(ahead);
      }
      chain.pop_back();
      result.push_back(without_needless(chain, true));
    }
    return result;
  }

  /// Of the edges that go on from b, the one that turns most to the left, coming from a: where an
  /// area touches itself in a point, its loops stay apart.
  std::set<Edge>::const_iterator leftmost(const std::set<Edge>& edges, Node a, Node b) const
  {
    const Vec2 before = at(b) - at(a);
    auto best = edges.end();
    double largest = -INFINITY;
    for (auto it = edges.lower_bound({b, 0}); it != edges.end() && it->first == b; ++it)
    {
      const Vec2 after = at(it->second) - at(b);
      const double turn = std::atan2(cross(before, after), before.dot(after));
      if (turn > largest)
      {
        largest = turn;
        best = it;
      }
    }
    return best;
  }

  /// Without points between two others on a straight line.
  Polyline without_needless(const std::vector<Node>& chain, bool closed) const
  {
    Polyline points, kept;
    for (const Node node : chain)
      points.push_back(at(node));
    const std::size_t n = points.size();
    for (std::size_t k = 0; k < n; ++k)
    {
      const bool end = !closed && (k == 0 || k + 1 == n);
      const Vec2& before = kept.empty() ? points[(k + n - 1) % n] : kept.back();
      if (end || distance(points[k], before, points[next(k, n)]) > flat * extent_)
        kept.push_back(points[k]);
    }
    return kept;
  }

  /// The chain through all edges between neighbours, closed if it ends where it begins; none if
  /// they branch or are in pieces.
  static std::vector<Node> chain_through(std::map<Node, std::set<Node>> beside)
  {
    const auto branches = [](const auto& node) { return node.second.size() > 2; };
    const auto ends = [](const auto& node) { return node.second.size() == 1; };
    if (std::ranges::any_of(beside, branches))
      return {};
    auto start = std::ranges::find_if(beside, ends);
    if (start == beside.end())
      start = beside.begin();
    std::vector<Node> chain{start->first};
    while (!beside.at(chain.back()).empty())
    {
      const Node from = chain.back(), to = *beside.at(from).begin();
      beside.at(from).erase(to);
      beside.at(to).erase(from);
      chain.push_back(to);
    }
    const auto passed = [](const auto& node) { return node.second.empty(); };
    return std::ranges::all_of(beside, passed) ? chain : std::vector<Node>{};
  }

  /// Each curve as one line.
  std::vector<DrawnCurve> curves() const
  {
    std::vector<DrawnCurve> result;
    for (const MeshGroup& curve : groups_.curves)
    {
      std::map<Node, std::set<Node>> beside;
      for (const std::vector<Node>& ends : curve.elements)
        if (ends[0] != ends[1])
        {
          beside[ends[0]].insert(ends[1]);
          beside[ends[1]].insert(ends[0]);
        }
      if (curve.name.empty() || beside.empty())
        continue;
      const std::vector<Node> chain = chain_through(std::move(beside));
      if (chain.empty())
        refuse_mesh(fmt::format("physical curve \"{}\" is not one line", curve.name),
                    "curves that follow each other, without branches",
                    "give each piece a name of its own");
      result.push_back({curve.name, without_needless(chain, false)});
    }
    return result;
  }

  const MeshGroups& groups_;
  double extent_ = 0; ///< [m]
};
} // namespace

void refuse_mesh(std::string problem, std::string allowed, std::string hint)
{
  throw InputError({{.key = "section.mesh_file",
                     .problem = std::move(problem),
                     .allowed = std::move(allowed),
                     .hint = std::move(hint)}});
}

GmshDrawing drawing_of(const MeshGroups& groups)
{
  return Borders(groups).drawing();
}
} // namespace berm::meshes
