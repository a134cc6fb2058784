// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/mesh_file.h"

#include "core/error.h"
#include "core/sandbox.h"
#include "meshes/drawing.h"
#include "meshes/drawing_text.h"
#include "meshes/gmsh_session.h"
#include "meshes/mesh_groups.h"

#include <fmt/format.h>
#include <gmsh.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace berm::meshes
{
namespace
{
constexpr double farthest = 1e5; ///< [m], as in a case file
constexpr double flat = 1e-9;    ///< |z| of the section's extent that is taken for 0

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
    refuse_mesh(fmt::format("has {} MB", size / 1'000'000), "at most 100 MB", "use a coarser mesh");
  if (path.extension() != ".geo")
  {
    // gmsh would run as a geometry whatever does not begin like a mesh.
    constexpr std::string_view begins = "$MeshFormat";
    std::string first(begins.size(), ' ');
    if (!file.read(first.data(), static_cast<std::streamsize>(first.size())) || first != begins)
      refuse_mesh("does not begin with $MeshFormat", "a mesh in gmsh's format 2 or 4",
                  "a geometry's name ends in .geo");
    return;
  }
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  if (!text.ends_with('\n'))
    refuse_mesh("the last line does not end, and gmsh would not read it", "",
                "add an empty line at the end");
  for (const std::string_view word :
       {"SystemCall", "System", "OnelabRun", "Include", "Merge", "Save", "Print", "Plugin",
        "ShapeFromFile", "CreateDir", "Open", "SendToServer", "Exit", "Sleep", "ListFromFile",
        "GetEnv"})
    if (text.find(word) != std::string::npos)
      refuse_mesh(fmt::format("holds the word {}", word),
                  "a geometry of points, curves, surfaces and physical groups alone",
                  "mesh it with gmsh, and give the .msh");
}

void open_mesh(const std::filesystem::path& path)
{
  try
  {
    gmsh::open(path.string()); // runs PATH.opt as well, if it is there
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
    refuse_mesh("gmsh cannot read it" + (said.empty() ? "" : ": " + said), "", "");
  }
}

std::map<std::size_t, Vec2> nodes()
{
  std::vector<std::size_t> tags;
  std::vector<double> xyz, parameters;
  gmsh::model::mesh::getNodes(tags, xyz, parameters);
  std::map<std::size_t, Vec2> result;
  Vec2 low = Vec2::Constant(INFINITY), high = -low;
  double z_largest = 0;
  for (std::size_t i = 0; i < tags.size(); ++i)
  {
    const Vec2 x(xyz[3 * i], xyz[3 * i + 1]);
    if (!x.allFinite() || !std::isfinite(xyz[3 * i + 2]))
      refuse_mesh(fmt::format("node {} is at {}", tags[i], text(x)), "finite numbers", "");
    result[tags[i]] = x;
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
    z_largest = std::max(z_largest, std::abs(xyz[3 * i + 2]));
  }
  const double extent = tags.empty() ? 0 : (high - low).maxCoeff();
  if (!tags.empty() && !(low.minCoeff() >= -farthest && high.maxCoeff() <= farthest))
    refuse_mesh(fmt::format("its nodes reach from {} to {}", text(low), text(high)),
                fmt::format("-{0} <= x, y <= {0}", farthest), "lengths are in m");
  if (z_largest > flat * extent)
    refuse_mesh(fmt::format("a node at z = {:.4g} m", z_largest),
                "a section in the plane z = 0, x to the right and y upwards", "");
  return result;
}

/// Add the corners of all elements of an entity, element by element.
void add_elements(int dimension, int entity, std::vector<std::vector<std::size_t>>& result)
{
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
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
}

std::vector<MeshGroup> groups(int dimension)
{
  gmsh::vectorpair tags;
  gmsh::model::getPhysicalGroups(tags, dimension);
  std::vector<MeshGroup> result;
  for (const auto& [dim, tag] : tags)
  {
    MeshGroup& group = result.emplace_back();
    group.tag = tag;
    gmsh::model::getPhysicalName(dim, tag, group.name);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dim, tag, entities);
    for (const int entity : entities)
      add_elements(dimension, entity, group.elements);
  }
  return result;
}

/// What runs in the sandbox.
std::string drawing_in(const std::filesystem::path& path)
{
  const GmshSession session;
  open_mesh(path);
  return drawing_text(drawing_of({nodes(), groups(2), groups(1)}));
}
} // namespace

GmshDrawing read_gmsh(const std::filesystem::path& path)
{
  std::vector<Mistake> mistakes;
  try
  {
    check_file(path);
    // A geometry that goes on for ever is given 4 s, a large mesh more.
    const auto seconds = static_cast<unsigned>(4 + std::filesystem::file_size(path) / 5'000'000);
    return drawing_from(in_sandbox([&path] { return drawing_in(path); }, seconds));
  }
  catch (const InputError& e)
  {
    mistakes = e.mistakes();
  }
  catch (const SandboxFailure& e)
  {
    mistakes = {{.key = "section.mesh_file",
                 .problem = fmt::format("gmsh cannot read it: it {}", e.what())}};
  }
  for (Mistake& m : mistakes)
    m.value = "\"" + path.string() + "\"";
  throw InputError(mistakes);
}
} // namespace berm::meshes
