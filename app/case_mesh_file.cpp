// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_mesh_file.h"

#ifdef BERM_WITH_SEEPAGE
#include "meshes/mesh_file.h"
#endif

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* key = "section.mesh_file";

/// Whether a relative path ends outside the folder, by its dots or by links. A case from elsewhere
/// must not reach for what lies around it.
bool leads_out(const fs::path& path, const fs::path& folder)
{
  const auto goes_up = [](const fs::path& p)
  { return !p.empty() && p.lexically_normal().begin()->string() == ".."; };
  if (path.is_absolute())
    return false;
  std::error_code error; // what is not there is told later
  const fs::path root = fs::canonical(folder.empty() ? "." : folder, error);
  const fs::path end = error ? fs::path() : fs::canonical(root / path, error);
  return goes_up(path) || (!error && goes_up(end.lexically_relative(root)));
}

#ifdef BERM_WITH_SEEPAGE
/// Soil of each region; names that are no soil's are reported.
void add_zones(const meshes::GmshDrawing& drawing, const std::vector<std::string>& soils,
               meshes::SectionInput& section, std::vector<Mistake>& mistakes)
{
  for (const meshes::DrawnRegion& region : drawing.regions)
  {
    const auto it = std::ranges::find(soils, region.name);
    if (it == soils.end())
      mistakes.push_back({.key = key,
                          .value = "\"" + region.name + "\"",
                          .problem = "a physical surface has this name, but no soil has",
                          .allowed = fmt::format("{}", fmt::join(soils, " | ")),
                          .hint = "name each physical surface after the soil in it"});
    section.zones.push_back({static_cast<Index>(it - soils.begin()), region.polygon});
  }
}
#endif
} // namespace

std::map<std::string, Polyline> read_section(const std::string& file,
                                             const std::filesystem::path& folder,
                                             const std::vector<std::string>& soils,
                                             meshes::SectionInput& section,
                                             std::vector<Mistake>& mistakes)
{
  std::map<std::string, Polyline> curves;
  const auto add = [&](const char* problem, const char* allowed, const char* hint)
  {
    mistakes.push_back({.key = key,
                        .value = "\"" + file + "\"",
                        .problem = problem,
                        .allowed = allowed,
                        .hint = hint});
  };
  const fs::path path(file);
  if (path.extension() != ".geo" && path.extension() != ".msh")
    add("no file that berm reads", "a .geo or .msh of gmsh", "");
  else if (leads_out(path, folder))
    add("leads out of the case file's folder", "a path within it, or an absolute one", "");
  else
  {
#ifdef BERM_WITH_SEEPAGE
    const fs::path full = path.is_absolute() ? path : folder / path;
    if (std::error_code error; !fs::is_regular_file(full, error))
    {
      add("there is no such file", "", full.c_str());
      return curves;
    }
    try
    {
      const meshes::GmshDrawing drawing = meshes::read_gmsh(full);
      section.outline = drawing.outline;
      add_zones(drawing, soils, section, mistakes);
      for (const meshes::DrawnCurve& curve : drawing.curves)
        curves[curve.name] = curve.line;
    }
    catch (const InputError& e)
    {
      mistakes.insert(mistakes.end(), e.mistakes().begin(), e.mistakes().end());
    }
#else
    static_cast<void>(folder);
    static_cast<void>(soils);
    static_cast<void>(section);
    add("this build has no gmsh to read it", "ground_m and base_m, or outline_m",
        "build berm with -DBERM_WITH_SEEPAGE=ON");
#endif
  }
  return curves;
}

std::optional<std::filesystem::path> relative_mesh_file(const TomlValue& document)
{
  const TomlValue* value = find_value(document, key);
  const auto* file = value == nullptr ? nullptr : std::get_if<std::string>(&value->data);
  if (file == nullptr || std::filesystem::path(*file).is_absolute())
    return std::nullopt;
  return *file;
}

std::optional<std::filesystem::path> relative_mesh_file(const std::string& case_text)
{
  KeyPlaces places;
  try
  {
    return relative_mesh_file(parse_toml(case_text, "", places));
  }
  catch (const InputError&)
  {
    return std::nullopt;
  }
}
} // namespace berm::app
