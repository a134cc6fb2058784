// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/mesh_file.h"

#include "core/error.h"
#include "core/sandbox.h"
#include "meshes/drawing.h"
#include "meshes/drawing_text.h"
#include "meshes/gmsh_session.h"
#include "meshes/planar.h"
#include "meshes/section.h"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace berm::meshes
{
namespace
{
using Node = std::size_t; // gmsh's tag
using Edge = std::pair<Node, Node>;

constexpr double farthest = 1e5; ///< [m], as in a case file
constexpr double flat = 1e-9;    ///< of the section's extent: points nearer to a line are on it

[[noreturn]] void refuse(const std::filesystem::path& path, std::string problem,
                         std::string allowed, std::string hint)
{
  throw InputError({{.key = "section.mesh_file",
                     .value = "\"" + path.string() + "\"",
                     .problem = std::move(problem),
                     .allowed = std::move(allowed),
                     .hint = std::move(hint)}});
}

/// What gmsh would not read, what it would take for something else, and words of a geometry that
/// start programs, or read and write other files.
void check_file(const std::filesystem::path& path)
{
  constexpr std::uintmax_t most = 100'000'000; // bytes; a million triangles take half of it
  std::ifstream file(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!file || error)
    throw IoError(path.string() + ": cannot be opened");
  if (size > most)
    refuse(path, fmt::format("has {} MB", size / 1'000'000), "at most 100 MB",
           "use a coarser mesh");
  if (path.extension() != ".geo")
  {
    // gmsh would run as a geometry whatever does not begin like a mesh.
    constexpr std::string_view begins = "$MeshFormat";
    std::string first(begins.size(), ' ');
    if (!file.read(first.data(), static_cast<std::streamsize>(first.size())) || first != begins)
      refuse(path, "does not begin with $MeshFormat", "a mesh in gmsh's format 2 or 4",
             "a geometry's name ends in .geo");
    return;
  }
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  if (!text.ends_with('\n'))
    refuse(path, "the last line does not end, and gmsh would not read it", "",
           "add an empty line at the end");
  for (const std::string_view word :
       {"SystemCall", "System", "OnelabRun", "Include", "Merge", "Save", "Print", "Plugin",
        "ShapeFromFile", "CreateDir", "Open", "SendToServer", "Exit", "Sleep", "ListFromFile",
        "GetEnv"})
    if (text.find(word) != std::string::npos)
      refuse(path, fmt::format("holds the word {}", word),
             "a geometry of points, curves, surfaces and physical groups alone",
             "mesh it with gmsh, and give the .msh");
}

/// The mesh between opening the file and reading the drawing off it.
class Reader
{
public:
  explicit Reader(std::filesystem::path path) : path_(std::move(path))
  {
    try
    {
      gmsh::open(path_.string()); // runs PATH.opt as well, if it is there
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, 2);
      if (types.empty())
        gmsh::model::mesh::generate(2);
      gmsh::model::mesh::removeDuplicateNodes();
    }
    catch (...) // plain values in some builds
    {
      std::string said;
      gmsh::logger::getLastError(said);
      refuse(path_, "gmsh cannot read it" + (said.empty() ? "" : ": " + said), "", "");
    }
    read_nodes();
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
      refuse(path_, fmt::format("the surfaces leave a hole at {}", text(hole->front())),
             "surfaces that fill the section",
             "are the points of neighbouring surfaces the same points?");
    if (outlines.size() != 1)
      refuse(path_, fmt::format("the surfaces are in {} pieces", outlines.size()),
             "one connected section", "");
    result.outline = std::move(outlines.front());
    result.curves = curves();
    return result;
  }

private:
  void read_nodes()
  {
    std::vector<std::size_t> tags;
    std::vector<double> xyz, parameters;
    gmsh::model::mesh::getNodes(tags, xyz, parameters);
    Vec2 low = Vec2::Constant(INFINITY), high = -low;
    double z_largest = 0;
    for (std::size_t i = 0; i < tags.size(); ++i)
    {
      const Vec2 x(xyz[3 * i], xyz[3 * i + 1]);
      if (!x.allFinite() || !std::isfinite(xyz[3 * i + 2]))
        refuse(path_, fmt::format("node {} is at {}", tags[i], text(x)), "finite numbers", "");
      at_[tags[i]] = x;
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
      z_largest = std::max(z_largest, std::abs(xyz[3 * i + 2]));
    }
    extent_ = tags.empty() ? 0 : (high - low).maxCoeff();
    if (!tags.empty() && !(low.minCoeff() >= -farthest && high.maxCoeff() <= farthest))
      refuse(path_, fmt::format("its nodes reach from {} to {}", text(low), text(high)),
             fmt::format("-{0} <= x, y <= {0}", farthest), "lengths are in m");
    if (z_largest > flat * extent_)
      refuse(path_, fmt::format("a node at z = {:.4g} m", z_largest),
             "a section in the plane z = 0, x to the right and y upwards", "");
  }

  /// Group names with their entities of a dimension; a group without a name is refused.
  std::vector<std::pair<std::string, std::vector<int>>> groups(int dimension) const
  {
    gmsh::vectorpair tags;
    gmsh::model::getPhysicalGroups(tags, dimension);
    std::vector<std::pair<std::string, std::vector<int>>> result;
    for (const auto& [dim, tag] : tags)
    {
      auto& [name, entities] = result.emplace_back();
      gmsh::model::getPhysicalName(dim, tag, name);
      gmsh::model::getEntitiesForPhysicalGroup(dim, tag, entities);
      if (name.empty() && dimension == 2)
        refuse(path_, fmt::format("physical surface {} has no name", tag), "the name of a soil",
               "in a .geo: Physical Surface(\"fill\") = {1};");
    }
    return result;
  }

  /// Corners of all elements of an entity, element by element.
  static std::vector<std::vector<Node>> elements(int dimension, int entity)
  {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    std::vector<std::vector<Node>> result;
    for (std::size_t t = 0; t < types.size(); ++t)
    {
      std::string name;
      int dim = 0, order = 0, all = 0, corners = 0;
      std::vector<double> local;
      gmsh::model::mesh::getElementProperties(types[t], name, dim, order, all, local, corners);
      const auto stride = static_cast<std::size_t>(all);
      for (std::size_t first = 0; first < nodes[t].size(); first += stride)
        result.emplace_back(nodes[t].begin() + static_cast<std::ptrdiff_t>(first),
                            nodes[t].begin() + static_cast<std::ptrdiff_t>(first) + corners);
    }
    return result;
  }

  /// The edges of a surface that have it on their left and not on their right.
  std::vector<std::pair<std::string, std::set<Edge>>> surfaces() const
  {
    std::vector<std::pair<std::string, std::set<Edge>>> result;
    for (const auto& [name, entities] : groups(2))
    {
      std::set<Edge> border;
      for (const int entity : entities)
        for (std::vector<Node> corners : elements(2, entity))
        {
          Polyline polygon;
          for (const Node node : corners)
            polygon.push_back(at_.at(node));
          if (polygon_area(polygon) < 0)
            std::ranges::reverse(corners);
          std::set<Edge> edges;
          for (std::size_t k = 0; k < corners.size(); ++k)
            edges.insert({corners[k], corners[next(k, corners.size())]});
          merge(border, edges);
        }
      result.emplace_back(name, std::move(border));
    }
    if (result.empty())
      refuse(path_, "has no physical surfaces", "a physical surface for each soil, named after it",
             "in a .geo: Physical Surface(\"fill\") = {1};");
    return result;
  }

  /// Edges that two areas run through in opposite directions are inside both together.
  void merge(std::set<Edge>& border, const std::set<Edge>& more) const
  {
    for (const auto& [from, to] : more)
      if (border.erase({to, from}) == 0 && !border.insert({from, to}).second)
        refuse(path_, fmt::format("areas lie on each other at {}", text(at_.at(from))),
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
          refuse(path_,
                 fmt::format("the border of a surface ends at {}", text(at_.at(chain.back()))),
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
    const Vec2 before = at_.at(b) - at_.at(a);
    auto best = edges.end();
    double largest = -INFINITY;
    for (auto it = edges.lower_bound({b, 0}); it != edges.end() && it->first == b; ++it)
    {
      const Vec2 after = at_.at(it->second) - at_.at(b);
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
      points.push_back(at_.at(node));
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

  /// Each physical curve as one chain.
  std::vector<DrawnCurve> curves() const
  {
    std::vector<DrawnCurve> result;
    for (const auto& [name, entities] : groups(1))
    {
      std::map<Node, std::vector<Node>> beside;
      for (const int entity : entities)
        for (const std::vector<Node>& ends : elements(1, entity))
        {
          beside[ends[0]].push_back(ends[1]);
          beside[ends[1]].push_back(ends[0]);
        }
      if (name.empty() || beside.empty())
        continue;
      auto start =
          std::ranges::find_if(beside, [](const auto& node) { return node.second.size() == 1; });
      if (start == beside.end())
        start = beside.begin(); // a closed curve
      std::vector<Node> chain{start->first};
      std::set<Node> seen{start->first};
      for (bool goes_on = true; goes_on;)
      {
        goes_on = false;
        for (const Node ahead : beside.at(chain.back()))
          if (!goes_on && seen.insert(ahead).second)
          {
            chain.push_back(ahead);
            goes_on = true;
          }
      }
      if (seen.size() != beside.size())
        refuse(path_, fmt::format("physical curve \"{}\" is not one line", name),
               "curves that follow each other, without branches",
               "give each piece a name of its own");
      result.push_back({name, without_needless(chain, false)});
    }
    return result;
  }

  std::filesystem::path path_;
  std::map<Node, Vec2> at_;
  double extent_ = 0; ///< [m]
};
} // namespace

GmshDrawing read_gmsh(const std::filesystem::path& path)
{
  check_file(path);
  const auto read = [&path]
  {
    const GmshSession session;
    return drawing_text(Reader(path).drawing());
  };
  // A geometry that goes on for ever is given 4 s, a large mesh more.
  const auto seconds = static_cast<unsigned>(4 + std::filesystem::file_size(path) / 5'000'000);
  try
  {
    return drawing_from(in_sandbox(read, seconds));
  }
  catch (const SandboxFailure& e)
  {
    refuse(path, fmt::format("gmsh cannot read it: it {}", e.what()), "", "");
  }
}
} // namespace berm::meshes
