// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_file.h"

#include "app/case_check.h"
#include "app/case_lines.h"
#include "app/case_mesh_file.h"
#include "app/case_soils.h"
#include "app/toml_document.h"
#include "app/version.h"
#include "meshes/drawing.h"
#include "sph/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

namespace berm::app
{
namespace
{
using coupling::PorePressureKind;

/// From checked values to a Case; rules that concern more than one key.
class Assembler
{
public:
  Assembler(const CheckedValues& values, const std::filesystem::path& path, bool seepage_only,
            std::vector<Mistake>& mistakes)
      : values_(values), folder_(path.parent_path()), seepage_only_(seepage_only),
        mistakes_(mistakes)
  {
  }

  coupling::Case assemble()
  {
    assemble_water();
    case_.soils =
        assemble_soils(values_, case_.water.pore_pressure == PorePressureKind::seepage, mistakes_);
    assemble_section();
    assemble_boundaries();
    assemble_settings();
    if (drawing_is_readable())
      check_against_section();
    return std::move(case_);
  }

private:
  double number(const std::string& path, double otherwise) const
  {
    return values_.get<double>(path).value_or(otherwise);
  }
  void add(Mistake mistake) { mistakes_.push_back(std::move(mistake)); }

  void assemble_water()
  {
    const auto kind = values_.get<std::string>("water.pore_pressure").value_or("none");
    auto& water = case_.water;
    water.pore_pressure = kind == "seepage"       ? PorePressureKind::seepage
                          : kind == "hydrostatic" ? PorePressureKind::hydrostatic
                                                  : PorePressureKind::none;
    if (seepage_only_)
      water.pore_pressure = PorePressureKind::seepage;
    if (water.pore_pressure == PorePressureKind::seepage && !seepage_built_in())
      add({.key = "water.pore_pressure",
           .value = "\"seepage\"",
           .problem = "this build has no seepage stage",
           .hint = "build berm with -DBERM_WITH_SEEPAGE=ON; \"none\" and \"hydrostatic\" need no "
                   "such build"});
    water.free_surface = values_.get<Polyline>("water.free_surface_m").value_or(Polyline{});
    for (std::size_t i = 1; i < water.free_surface.size(); ++i)
      if (water.free_surface[i].x() <= water.free_surface[i - 1].x())
      {
        add({.key = "water.free_surface_m",
             .problem = fmt::format("x does not increase from point {} to point {}", i, i + 1)});
        break;
      }
    if (water.pore_pressure == PorePressureKind::none)
      return;
    water.left_level = values_.get<double>("water.left_level_m");
    water.right_level = values_.get<double>("water.right_level_m");
    if (water.pore_pressure == PorePressureKind::hydrostatic &&
        !values_.has("water.free_surface_m") && !water.left_level && !water.right_level)
      add({.key = "water.pore_pressure",
           .value = "\"hydrostatic\"",
           .problem = "there is no water",
           .hint = "give water.free_surface_m, or a pool by water.left_level_m or "
                   "water.right_level_m"});
  }

  void assemble_section()
  {
    auto& section = case_.section;
    check_drawing_keys();
    section.ground = values_.get<Polyline>("section.ground_m").value_or(Polyline{});
    section.outline = values_.get<Polyline>("section.outline_m").value_or(Polyline{});
    section.base = values_.get<Polyline>("section.base_m").value_or(Polyline{});
    if (const auto level = values_.get<double>("section.base_m"); level && !section.ground.empty())
      section.base = {{section.ground.front().x(), *level}, {section.ground.back().x(), *level}};
    if (const auto file = values_.get<std::string>("section.mesh_file"))
      curves_ = read_section(*file, folder_, values_.soils, section, mistakes_);
    section.left_pool_level = case_.water.left_level;
    section.right_pool_level = case_.water.right_level;
    for (std::size_t i = 1; i <= values_.count("section.zone"); ++i)
      assemble_zone(fmt::format("section.zone[{}].", i));
  }

  /// The section is drawn in one of three ways.
  void check_drawing_keys()
  {
    constexpr const char* ways = "either ground_m and base_m, or outline_m, or mesh_file";
    const bool outline = given("section.outline_m"), file = given("section.mesh_file");
    const bool ground = given("section.ground_m"), base = given("section.base_m");
    if (file && (outline || ground || base || values_.count("section.zone") > 0))
      add({.key = "section.mesh_file",
           .problem = "given together with ground_m, base_m, outline_m or a zone",
           .allowed = ways});
    else if (outline && (ground || base))
      add({.key = "section.outline_m",
           .problem = "given together with ground_m or base_m",
           .allowed = ways});
    else if (!file && !outline && (!ground || !base))
      add({.key = ground ? "section.base_m" : "section.ground_m",
           .problem = std::string(missing_key),
           .allowed = ways});
  }

  void assemble_zone(const std::string& at)
  {
    meshes::Zone zone;
    zone.polygon = values_.get<Polyline>(at + "polygon_m").value_or(Polyline{});
    if (const auto name = values_.get<std::string>(at + "soil"))
    {
      const auto& soils = values_.soils;
      const auto it = std::find(soils.begin(), soils.end(), *name);
      if (it == soils.end())
      {
        const std::vector<std::string_view> known(soils.begin(), soils.end());
        const std::string_view near = nearest(*name, known);
        add({.key = at + "soil",
             .value = "\"" + *name + "\"",
             .problem = "there is no such soil",
             .allowed = fmt::format("{}", fmt::join(known, " | ")),
             .hint = near.empty() ? "" : fmt::format("did you mean \"{}\"?", near)});
      }
      zone.soil = static_cast<Index>(it - soils.begin());
    }
    case_.section.zones.push_back(std::move(zone));
  }

  void assemble_boundaries()
  {
    for (std::size_t i = 1; i <= values_.count("seepage.boundary"); ++i)
    {
      const std::string at = fmt::format("seepage.boundary[{}].", i);
      const auto kind = values_.get<std::string>(at + "kind").value_or("");
      seepage::Boundary boundary;
      boundary.kind = kind == "head"           ? seepage::BoundaryKind::head
                      : kind == "seepage_face" ? seepage::BoundaryKind::seepage_face
                      : kind == "inflow"       ? seepage::BoundaryKind::inflow
                      : kind == "rain"         ? seepage::BoundaryKind::rain
                                               : seepage::BoundaryKind::impervious;
      boundary.value = number(at + "value", 0);
      const bool wants_value = kind == "head" || kind == "inflow" || kind == "rain";
      if (wants_value && !given(at + "value"))
        add({.key = at + "value",
             .problem = std::string(missing_key),
             .hint = kind == "head"   ? "the head in m above y = 0"
                     : kind == "rain" ? "the rain on the horizontal in m/s"
                                      : "the Darcy flux into the soil in m/s"});
      else if (!kind.empty() && !wants_value && given(at + "value"))
        add({.key = at + "value",
             .value = fmt::format("{}", boundary.value),
             .problem = fmt::format("kind = \"{}\" takes no value", kind)});
      if (kind == "inflow" && std::abs(boundary.value) > 1)
        add({.key = at + "value",
             .value = fmt::format("{}", boundary.value),
             .allowed = "-1 <= value <= 1 for an inflow in m/s"});
      if (kind == "rain" && !(boundary.value >= 0 && boundary.value <= 1))
        add({.key = at + "value",
             .value = fmt::format("{}", boundary.value),
             .allowed = "0 <= value <= 1 for rain in m/s"});
      case_.marked_boundaries.push_back(boundary);
      case_.section.marked_lines.push_back(boundary_line(at));
    }
    case_.rain = number("seepage.rain_m_s", 0);
    if (case_.water.pore_pressure != PorePressureKind::seepage)
    {
      case_.marked_boundaries.clear();
      case_.section.marked_lines.clear();
      case_.rain = 0;
    }
  }

  /// Drawn in the case, or a curve of the mesh file.
  Polyline boundary_line(const std::string& at)
  {
    const auto name = values_.get<std::string>(at + "curve");
    const bool line = given(at + "line_m");
    if (line == given(at + "curve"))
      add({.key = at + "line_m",
           .problem = line ? "given together with curve" : std::string(missing_key),
           .allowed = "either line_m, or curve where the section has a mesh_file"});
    if (!name)
      return values_.get<Polyline>(at + "line_m").value_or(Polyline{});
    if (const auto curve = curves_.find(*name); curve != curves_.end())
      return curve->second;
    std::vector<std::string> known;
    for (const auto& [curve, points] : curves_)
      known.push_back(curve);
    add({.key = at + "curve",
         .value = "\"" + *name + "\"",
         .problem = "the mesh file has no such physical curve",
         .allowed = known.empty() ? "it has none" : fmt::format("{}", fmt::join(known, " | "))});
    return {};
  }

  void assemble_settings()
  {
    const auto text = [this](const char* path) { return *values_.get<std::string>(path); };
    case_.seepage.element_size = number("seepage.element_size_m", 0);
    case_.seepage.adaptive = values_.get<bool>("seepage.adaptive").value_or(true);
    case_.seepage.tolerance = number("seepage.tolerance", case_.seepage.tolerance);
    case_.seepage.phreatic_tolerance = number("seepage.phreatic_tolerance_m", 0);
    if (const auto most = values_.get<std::int64_t>("seepage.max_unknowns"))
      case_.seepage.most_unknowns = static_cast<Index>(*most);
    case_.sph.spacing = number("sph.spacing_m", 0);
    if (values_.has("sph.packing"))
      case_.sph.packing = text("sph.packing");
    if (values_.has("sph.cone"))
      case_.sph.cone = text("sph.cone");
    if (values_.has("sph.formulation"))
      case_.sph.formulation = text("sph.formulation");
    case_.sph.threads = static_cast<int>(values_.get<std::int64_t>("sph.threads").value_or(0));
    if (const auto range = values_.get<std::vector<double>>("stability.factor_range"))
    {
      case_.search.lower = (*range)[0];
      case_.search.upper = (*range)[1];
    }
    case_.search.tolerance = number("stability.tolerance", case_.search.tolerance);
    case_.flow_rule_spread = values_.get<bool>("stability.flow_rule_spread").value_or(false);
    assemble_scope();
    case_.stability = values_.get<bool>("stability.enabled").value_or(true) && !seepage_only_;
    if (!case_.stability && !values_.run_out &&
        case_.water.pore_pressure != PorePressureKind::seepage)
      add({.key = "stability.enabled",
           .value = "false",
           .problem = "nothing is left to compute",
           .hint = "without a seepage solve, the factor of safety is all there is"});
    assemble_run_out();
    case_.output.probes = values_.get<Polyline>("output.probes_m").value_or(Polyline{});
    case_.output.lines = assemble_lines(values_, mistakes_);
    case_.output.figures = values_.get<bool>("output.figures").value_or(true);
    if (const auto formats = values_.get<std::vector<std::string>>("output.figure_formats"))
      case_.output.figure_formats = *formats;
    case_.output.msh = values_.get<bool>("output.msh").value_or(false);
    case_.output.report = values_.get<bool>("output.report").value_or(true);
  }

  void assemble_scope()
  {
    using coupling::Side;
    auto& scope = case_.scope;
    const auto side = values_.get<std::string>("stability.side").value_or("any");
    scope.side = side == "left"    ? Side::left
                 : side == "right" ? Side::right
                 : side == "both"  ? Side::both
                                   : Side::any;
    scope.inside = polygons("stability.search_region_m");
    scope.outside = polygons("stability.exclude_region_m");
    scope.min_depth = number("stability.min_depth_m", 0);
  }

  /// Simple polygons; what is not is reported and left out.
  std::vector<Polyline> polygons(const char* key)
  {
    std::vector<Polyline> list;
    auto given = values_.get<std::vector<Polyline>>(key).value_or(std::vector<Polyline>{});
    for (std::size_t i = 0; i < given.size(); ++i)
    {
      const Polyline polygon = meshes::opened(given[i]);
      std::vector<Mistake> wrong;
      if (meshes::check_points(key, polygon, true, wrong))
        meshes::check_simple(key, polygon, true, wrong);
      for (Mistake& mistake : wrong)
      {
        if (given.size() > 1)
          mistake.problem = fmt::format("polygon {}: {}", i + 1, mistake.problem);
        add(std::move(mistake));
      }
      if (wrong.empty())
        list.push_back(polygon);
    }
    return list;
  }

  void assemble_run_out()
  {
    if (!values_.run_out || seepage_only_)
      return;
    auto& run_out = case_.run_out.emplace();
    run_out.factor = values_.get<double>("runout.factor");
    run_out.motion = {.longest = number("runout.duration_s", 0),
                      .frame_interval = number("runout.frame_interval_s", 0),
                      .shake = number("runout.shake_g", 0) * gravity,
                      .shake_duration = number("runout.shake_duration_s", 0)};
    const auto& motion = run_out.motion;
    if (!case_.stability && !given("runout.factor"))
      add({.key = "runout.factor",
           .problem = std::string(missing_key),
           .hint = "with stability.enabled = false there is no failing trial to go on from"});
    if (motion.longest > 0 && motion.frame_interval > motion.longest)
      add({.key = "runout.frame_interval_s",
           .value = fmt::format("{}", motion.frame_interval),
           .allowed = fmt::format("frame_interval_s <= duration_s = {}", motion.longest)});
    if (motion.longest > 0 && motion.longest > 1e5 * motion.frame_interval &&
        motion.frame_interval > 0)
      add({.key = "runout.frame_interval_s",
           .value = fmt::format("{}", motion.frame_interval),
           .problem = "more than 100000 frames"});
    if ((motion.shake != 0) != (motion.shake_duration > 0))
      add({.key = motion.shake != 0 ? "runout.shake_duration_s" : "runout.shake_g",
           .value = "0",
           .problem = "a shake needs an acceleration and a duration",
           .hint = "give both runout.shake_g and runout.shake_duration_s, or neither"});
  }

  /// Nothing that the section is built from is wrong by itself.
  bool drawing_is_readable() const
  {
    return std::none_of(mistakes_.begin(), mistakes_.end(),
                        [](const Mistake& m)
                        {
                          return m.key.starts_with("section") || m.key == "water.left_level_m" ||
                                 m.key == "water.right_level_m" ||
                                 m.key.starts_with("seepage.boundary");
                        });
  }

  /// Rules that need the section; it is built here to find its mistakes together with these.
  void check_against_section()
  {
    meshes::Section section;
    try
    {
      section = meshes::build_section(case_.section);
    }
    catch (const InputError& e)
    {
      mistakes_.insert(mistakes_.end(), e.mistakes().begin(), e.mistakes().end());
      return;
    }
    check_sizes(section);
    check_scope(section);
    check_water(section);
    const Polyline& probes = case_.output.probes;
    for (std::size_t i = 0; i < probes.size(); ++i)
      if (!meshes::contains(section, probes[i]))
        add({.key = "output.probes_m",
             .value = fmt::format("[{}, {}]", probes[i].x(), probes[i].y()),
             .problem = fmt::format("point {} lies outside the section", i + 1)});
    check_lines(case_.output.lines, section, mistakes_);
  }

  /// Coarser than a quarter of the section there is nothing to see; far finer, no memory holds it.
  void check_sizes(const meshes::Section& section)
  {
    constexpr double most = 4e6; // particles or triangles
    const double area = std::abs(meshes::polygon_area(section.outline));
    const double extent = std::min(section.x_max - section.x_min, section.y_max - section.y_min);
    const auto check = [&](const char* key, double size, double per_area)
    {
      const double least = std::sqrt(area * per_area / most);
      if (size > 0 && (size < least || size > extent / 4))
        add({.key = key,
             .value = fmt::format("{}", size),
             .allowed = fmt::format(
                 "{:.2g} <= {} <= {:.3g} for a section of this size", least,
                 std::string_view(key).substr(std::string_view(key).find('.') + 1), extent / 4)});
    };
    check("sph.spacing_m", case_.sph.spacing, 1);
    if (case_.water.pore_pressure == PorePressureKind::seepage)
      check("seepage.element_size_m", case_.seepage.element_size, 2.3);
  }

  /// Every search has soil to weaken.
  void check_scope(const meshes::Section& section)
  {
    const auto& scope = case_.scope;
    const auto check_polygons = [&](const char* key, const std::vector<Polyline>& list)
    {
      for (std::size_t i = 0; i < list.size(); ++i)
        if (!coupling::holds_soil({.inside = {list[i]}, .outside = {}, .ground = {}}, section))
          add({.key = key,
               .value = meshes::text(list[i].front()) + " ...",
               .problem = list.size() > 1
                              ? fmt::format("polygon {} holds no part of the section", i + 1)
                              : "holds no part of the section"});
    };
    check_polygons("stability.search_region_m", scope.inside);
    check_polygons("stability.exclude_region_m", scope.outside);
    const double spacing =
        case_.sph.spacing > 0 ? case_.sph.spacing : sph::default_spacing(section);
    if (scope.min_depth > 0 && scope.min_depth < 2 * spacing)
      add({.key = "stability.min_depth_m",
           .value = fmt::format("{}", scope.min_depth),
           .allowed =
               fmt::format("min_depth_m >= {:.4g}, two spacings of the particles", 2 * spacing)});
    const bool right_so_far =
        std::none_of(mistakes_.begin(), mistakes_.end(),
                     [](const Mistake& m) { return m.key.starts_with("stability."); });
    if (!right_so_far)
      return;
    try
    {
      for (const coupling::Region& region : coupling::regions(scope, section))
        if (!coupling::holds_soil(region, section))
          add({.key = region.min_depth > 0   ? "stability.min_depth_m"
                      : scope.inside.empty() ? "stability.exclude_region_m"
                                             : "stability.search_region_m",
               .problem = fmt::format("leaves no soil to weaken: {}", region.name),
               .hint = "side, search_region_m, exclude_region_m and min_depth_m hold together"});
    }
    catch (const InputError& e)
    {
      mistakes_.insert(mistakes_.end(), e.mistakes().begin(), e.mistakes().end());
    }
  }

  /// Rain falls on the outline, and some water is named, be it none in effect.
  void check_water(const meshes::Section& section)
  {
    if (case_.water.pore_pressure != PorePressureKind::seepage)
      return;
    const auto& marked = case_.marked_boundaries;
    for (const meshes::InnerLine& line : section.inner_lines)
    {
      const Index l = section.stretches[static_cast<std::size_t>(line.stretch)].marked_line;
      if (marked[static_cast<std::size_t>(l)].kind == seepage::BoundaryKind::rain)
        add({.key = fmt::format("seepage.boundary[{}].kind", l + 1),
             .value = "\"rain\"",
             .problem = "it does not rain inside the soil, and this line runs through it",
             .allowed = "rain on a part of the outline",
             .hint = "a line in the soil that gives water is an \"inflow\""});
    }
    const bool named = std::any_of(marked.begin(), marked.end(),
                                   [](const seepage::Boundary& b)
                                   {
                                     return b.kind == seepage::BoundaryKind::head ||
                                            ((b.kind == seepage::BoundaryKind::inflow ||
                                              b.kind == seepage::BoundaryKind::rain) &&
                                             b.value > 0);
                                   });
    if (!named && case_.rain == 0 && !case_.water.left_level && !case_.water.right_level)
      add({.key = "water.pore_pressure",
           .value = "\"seepage\"",
           .problem = "no water is given anywhere",
           .hint =
               "give a pool by water.left_level_m or water.right_level_m, seepage.rain_m_s, or a "
               "[[seepage.boundary]] of kind = \"head\", \"inflow\" or \"rain\""});
  }

  bool given(const std::string& path) const { return was_given(values_, mistakes_, path); }

  const CheckedValues& values_;
  std::filesystem::path folder_;           ///< of the case file
  std::map<std::string, Polyline> curves_; ///< of the mesh file
  bool seepage_only_;
  std::vector<Mistake>& mistakes_;
  coupling::Case case_;
};
} // namespace

std::string read_case_text(const std::string& path)
{
  constexpr std::size_t most = 2'000'000; // bytes; a case has thousands
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw IoError(path + ": is a directory, not a case file");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw IoError(path + ": cannot be opened");
  std::string text;
  std::vector<char> block(65536);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
  {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > most)
      throw IoError(path + ": is larger than 2 MB; not a case file");
  }
  if (file.bad())
    throw IoError(path + ": cannot be read");
  return text;
}

coupling::Case parse_case(const std::string& text, const std::string& path,
                          const ReadOptions& options, KeyPlaces& places)
{
  TomlValue document = parse_toml(text, path, places);
  std::vector<Mistake> mistakes = apply_overrides(document, options.overrides, places);
  const CheckedValues values = check_values(document, places, mistakes);
  coupling::Case input = Assembler(values, path, options.seepage_only, mistakes).assemble();
  if (!mistakes.empty())
    throw InputError(std::move(mistakes));
  input.title =
      values.get<std::string>("title").value_or(std::filesystem::path(path).stem().string());
  input.path = path;
  input.text = text;
  input.overrides = options.overrides;
  return input;
}

coupling::Case read_case(const std::string& path, const ReadOptions& options, KeyPlaces& places)
{
  return parse_case(read_case_text(path), path, options, places);
}
} // namespace berm::app
