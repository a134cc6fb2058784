// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_schema.h"

#include <fmt/format.h>

namespace berm::app
{
namespace
{
constexpr Range coordinate{-1e5, 1e5}; // [m]
constexpr Range length{1e-3, 1e4};     // [m]
using enum Presence;
using enum ValueType;

// Angles stop short of 90 degrees and nu short of 0.5: tan(phi) and the bulk modulus go to
// infinity.
const std::vector<Key> table = {
    {.path = "format",
     .type = integer,
     .range = {1, 1},
     .sentence = "Version of the case file's format."},
    {.path = "title",
     .type = text,
     .presence = optional,
     .otherwise = "the file's name",
     .sentence = "What the case is, for reports and figures."},

    {.path = "section.ground_m",
     .unit = "m",
     .type = points,
     .range = coordinate,
     .presence = optional,
     .otherwise = "`outline_m` or `mesh_file` is given",
     .sentence = "Ground surface from left to right; vertical steps are allowed."},
    {.path = "section.base_m",
     .unit = "m",
     .type = level_or_polyline,
     .range = coordinate,
     .presence = optional,
     .otherwise = "`outline_m` or `mesh_file` is given",
     .sentence = "Rigid, impervious base: a level, or a line over the ground's range of x."},
    {.path = "section.outline_m",
     .unit = "m",
     .type = points,
     .range = coordinate,
     .least_points = 3,
     .presence = optional,
     .otherwise = "`ground_m` and `base_m`, or `mesh_file`, are given",
     .sentence = "Closed outline of the section, in place of `ground_m` and `base_m`."},
    {.path = "section.mesh_file",
     .type = text,
     .presence = optional,
     .otherwise = "the section is drawn in the case file",
     .sentence = "Geometry (.geo) or mesh (.msh) of gmsh, in m, in place of `ground_m`, `base_m` "
                 "and zones: "
                 "physical surfaces are named after soils. In the case file's folder or below it, "
                 "or an absolute path."},
    {.path = "section.zone[].soil",
     .type = text,
     .sentence = "Name of the soil that fills the zone; a later zone covers an earlier one."},
    {.path = "section.zone[].polygon_m",
     .unit = "m",
     .type = points,
     .range = coordinate,
     .least_points = 3,
     .sentence = "Outline of the zone; what lies outside the section is ignored."},

    {.path = "soil.*.unit_weight_kN_m3",
     .unit = "kN/m3",
     .type = number,
     .range = {1, 100},
     .sentence = "Unit weight above the water."},
    {.path = "soil.*.saturated_unit_weight_kN_m3",
     .unit = "kN/m3",
     .type = number,
     .range = {1, 100},
     .presence = optional,
     .otherwise = "the same as `unit_weight_kN_m3`",
     .sentence = "Unit weight below the water, the water in it included."},
    {.path = "soil.*.cohesion_kPa",
     .unit = "kPa",
     .type = number,
     .range = {0, 1e6},
     .sentence = "Effective cohesion."},
    {.path = "soil.*.friction_angle_deg",
     .unit = "deg",
     .type = number,
     .range = {.lower = 0, .upper = 90, .upper_open = true},
     .sentence = "Effective angle of internal friction."},
    {.path = "soil.*.dilation_angle_deg",
     .unit = "deg",
     .type = number,
     .range = {.lower = 0, .upper = 90, .upper_open = true},
     .sentence = "Angle of dilation, at most the friction angle."},
    {.path = "soil.*.young_modulus_kPa",
     .unit = "kPa",
     .type = number,
     .range = {1, 1e9},
     .sentence = "Young's modulus."},
    {.path = "soil.*.poisson_ratio",
     .unit = "-",
     .type = number,
     .range = {.lower = 0, .upper = 0.5, .upper_open = true},
     .sentence = "Poisson's ratio."},
    {.path = "soil.*.tensile_strength_kPa",
     .unit = "kPa",
     .type = number,
     .range = {0, 1e6},
     .presence = optional,
     .otherwise = "the cone's apex, about `c / tan(phi)`",
     .sentence = "Tension cut-off: the largest mean effective tension; reduced like the cohesion."},
    {.path = "soil.*.conductivity_m_s",
     .unit = "m/s",
     .type = conductivity,
     .range = {1e-16, 1e2},
     .presence = optional,
     .otherwise = "required where seepage is asked for",
     .sentence = "Saturated hydraulic conductivity: a number, or the principal values `[kx, ky]`."},
    {.path = "soil.*.conductivity_angle_deg",
     .unit = "deg",
     .type = number,
     .range = {-180, 180},
     .presence = defaulted,
     .otherwise = "0.0",
     .sentence = "Turns the axes of `[kx, ky]` from x, counter-clockwise."},
    {.path = "soil.*.retention.model",
     .type = choice,
     .choices = {"sharp", "gardner", "van_genuchten"},
     .presence = defaulted,
     .otherwise = "\"sharp\"",
     .sentence =
         "How the conductivity falls with the suction s: at once, a `sharp` free surface without "
         "capillary fringe; `gardner`: exp(-alpha s); `van_genuchten`: Mualem's conductivity for "
         "van Genuchten's curve."},
    {.path = "soil.*.retention.alpha_1_m",
     .unit = "1/m",
     .type = number,
     .range = {1e-2, 1e3},
     .presence = optional,
     .otherwise = "required for `gardner` and `van_genuchten`, not allowed for `sharp`",
     .sentence = "Inverse length of the curve."},
    {.path = "soil.*.retention.van_genuchten_n",
     .unit = "-",
     .type = number,
     .range = {1.05, 20},
     .presence = optional,
     .otherwise = "required for `van_genuchten`, not allowed for the others",
     .sentence = "Van Genuchten's exponent n; m = 1 - 1/n."},
    {.path = "soil.*.retention.mualem_l",
     .unit = "-",
     .type = number,
     .range = {-1, 10},
     .presence = optional,
     .otherwise = "0.5; not allowed unless `van_genuchten`",
     .sentence = "Mualem's exponent of the saturation."},
    {.path = "soil.*.retention.air_entry_m",
     .unit = "m",
     .type = number,
     .range = {1e-3, 1},
     .presence = optional,
     .otherwise = "0.02 where n < 2, else none; not allowed unless `van_genuchten`",
     .sentence = "Suction below which the soil stays saturated; the conductivity is 1 up to there "
                 "and keeps the curve's shape beyond (Vogel et al. 2001)."},

    {.path = "water.pore_pressure",
     .type = choice,
     .choices = {"none", "hydrostatic", "seepage"},
     .sentence =
         "`none`: dry, pools are left out of account; `hydrostatic`: unit weight of water times "
         "the vertical depth below `free_surface_m`; `seepage`: from a steady unconfined "
         "seepage solve."},
    {.path = "water.left_level_m",
     .unit = "m",
     .type = number,
     .range = coordinate,
     .presence = optional,
     .otherwise = "no pool",
     .sentence =
         "Level of the pool on the ground at the left end. Above a crest that has lower ground on "
         "both sides it runs over (with a warning), down to the other pool or end; give the same "
         "level on both sides for a section that is all under water."},
    {.path = "water.right_level_m",
     .unit = "m",
     .type = number,
     .range = coordinate,
     .presence = optional,
     .otherwise = "no pool",
     .sentence = "The same at the right end."},
    {.path = "water.free_surface_m",
     .unit = "m",
     .type = points,
     .range = coordinate,
     .presence = optional,
     .otherwise = "the straight line from waterline to waterline or toe",
     .sentence = "Free surface of the hydrostatic mode, x increasing; its level goes on beyond its "
                 "ends."},

    {.path = "seepage.boundary[].line_m",
     .unit = "m",
     .type = points,
     .range = coordinate,
     .presence = optional,
     .otherwise = "required without `curve`",
     .sentence =
         "Part of the outline that is neither a pool, nor open ground, nor impervious; or a line "
         "through the soil, which may begin and end on the outline: a wall, a drain or a well of "
         "no thickness."},
    {.path = "seepage.boundary[].curve",
     .type = text,
     .presence = optional,
     .otherwise = "`line_m` is given",
     .sentence = "Name of a physical curve of `section.mesh_file`, in place of `line_m`."},
    {.path = "seepage.boundary[].kind",
     .type = choice,
     .choices = {"head", "seepage_face", "inflow", "impervious", "rain"},
     .sentence =
         "`head`: given head, in a well or drain its water level; `seepage_face`: water may leave "
         "at "
         "p = 0, as into a drain; `inflow`: given flux, from a line in the soil to each of its "
         "sides; `impervious`: no flow, as through a cut-off wall; `rain`: enters as far as the "
         "soil "
         "takes it, the rest runs off (not in the soil)."},
    {.path = "seepage.boundary[].value",
     .unit = "m or m/s",
     .type = number,
     .range = coordinate,
     .presence = optional,
     .otherwise = "required for `head`, `inflow` and `rain`, not allowed for the others",
     .sentence =
         "Head in m above y = 0, Darcy flux into the soil in m/s, or rain on the horizontal "
         "in m/s."},
    {.path = "seepage.rain_m_s",
     .unit = "m/s",
     .type = number,
     .range = {0, 1},
     .presence = defaulted,
     .otherwise = "0.0",
     .sentence = "Rain on the horizontal, on all open ground that no boundary covers: it enters as "
                 "far as the soil takes it, the rest runs off."},
    {.path = "seepage.element_size_m",
     .unit = "m",
     .type = number,
     .range = length,
     .presence = optional,
     .otherwise = "chosen from the section",
     .sentence =
         "Edge length of the triangles of the first mesh; of the only one unless `adaptive`."},
    {.path = "seepage.adaptive",
     .type = boolean,
     .presence = defaulted,
     .otherwise = "true",
     .sentence = "Refine the mesh where the error comes from and solve again, until the tolerances "
                 "are met."},
    {.path = "seepage.tolerance",
     .unit = "-",
     .type = number,
     .range = {1e-6, 1},
     .presence = defaulted,
     .otherwise = "3e-4",
     .sentence = "Largest estimated error of the discharge, relative to it, when `adaptive`."},
    {.path = "seepage.phreatic_tolerance_m",
     .unit = "m",
     .type = number,
     .range = {1e-6, 1e4},
     .presence = optional,
     .otherwise = "a thousandth of the height of the water",
     .sentence =
         "Largest estimated error of the phreatic line, in the mean along it, when `adaptive`."},
    {.path = "seepage.max_unknowns",
     .type = integer,
     .range = {100, 1e7},
     .presence = defaulted,
     .otherwise = "100000",
     .sentence = "A mesh with as many nodes is not refined further: tolerances that are not met "
                 "then are reported as such."},

    {.path = "sph.spacing_m",
     .unit = "m",
     .type = number,
     .range = length,
     .presence = optional,
     .otherwise = "chosen from the section",
     .sentence = "Distance between particles."},
    {.path = "sph.packing",
     .type = choice,
     .choices = {"auto", "columns", "lattice", "hexagonal", "mesh"},
     .presence = defaulted,
     .otherwise = "\"auto\"",
     .sentence =
         "`columns`: columns that end at the ground; `lattice`, `hexagonal`: a square or hexagonal "
         "lattice relaxed to fit the outline; `mesh`: the nodes of a triangle mesh, relaxed; "
         "`auto`: columns, or the lattice where there are overhangs."},
    {.path = "sph.cone",
     .type = choice,
     .choices = {"fitted", "paper"},
     .presence = defaulted,
     .otherwise = "\"fitted\"",
     .sentence =
         "Drucker-Prager cone, `fitted` to Mohr-Coulomb collapse in plane strain at the given "
         "dilation, or as in the `paper` (Bui et al. 2009, eq. 14), which is weaker."},
    {.path = "sph.formulation",
     .type = choice,
     .choices = {"total_lagrangian", "paper"},
     .presence = defaulted,
     .otherwise = "\"total_lagrangian\"",
     .sentence =
         "`total_lagrangian`: kernels between reference positions; `paper`: kernels between "
         "current "
         "positions, term by term as in Bui et al. 2009, to compare with what they printed."},
    {.path = "sph.threads",
     .type = integer,
     .range = {0, 1024},
     .presence = defaulted,
     .otherwise = "0",
     .sentence =
         "Threads of the particle loops, 0 for one on each processor; no result depends on it."},

    {.path = "stability.enabled",
     .type = boolean,
     .presence = defaulted,
     .otherwise = "true",
     .sentence = "Whether to look for the factor of safety after the seepage solve."},
    {.path = "stability.factor_range",
     .unit = "-",
     .type = interval,
     .range = {0.05, 20},
     .presence = defaulted,
     .otherwise = "[0.5, 3.0]",
     .sentence = "Where to start looking; widened if the answer lies outside."},
    {.path = "stability.tolerance",
     .unit = "-",
     .type = number,
     .range = {1e-4, 1},
     .presence = defaulted,
     .otherwise = "0.005",
     .sentence = "Half the width of the final bracket of the factor of safety."},
    {.path = "stability.flow_rule_spread",
     .type = boolean,
     .presence = defaulted,
     .otherwise = "false",
     .sentence = "Whether to find the factor with `dilation_angle_deg` = 0 and = "
                 "`friction_angle_deg`, too: what the flow rule makes of it."},
    {.path = "stability.side",
     .type = choice,
     .choices = {"any", "left", "right", "both"},
     .presence = defaulted,
     .otherwise = "\"any\"",
     .sentence =
         "Where the strength is reduced: everywhere; only on the `left` or `right` side, the crest "
         "included; or on `both`, each in a search of its own, the weaker one governing. The crest "
         "is the ground at most a twentieth of the relief below its highest point."},
    {.path = "stability.search_region_m",
     .unit = "m",
     .type = polygons,
     .range = coordinate,
     .least_points = 3,
     .presence = optional,
     .otherwise = "everywhere",
     .sentence = "Polygon, or list of polygons, outside which soil keeps its strength."},
    {.path = "stability.exclude_region_m",
     .unit = "m",
     .type = polygons,
     .range = coordinate,
     .least_points = 3,
     .presence = optional,
     .otherwise = "nothing",
     .sentence = "Polygon, or list of polygons, inside which soil keeps its strength."},
    {.path = "stability.min_depth_m",
     .unit = "m",
     .type = number,
     .range = length,
     .presence = optional,
     .otherwise = "no further search",
     .sentence =
         "Asks for a further search, in which soil nearer than this to the ground keeps its "
         "strength: the mechanism below a skin. At least two spacings."},

    {.path = "runout.factor",
     .unit = "-",
     .type = number,
     .range = {0.05, 20},
     .presence = optional,
     .otherwise = "go on from the failing trial, with its factor",
     .sentence =
         "Divides the strength of soil that runs out from the settled state; 1 with a shake "
         "as the trigger, more for soil that has lost strength."},
    {.path = "runout.duration_s",
     .unit = "s",
     .type = number,
     .range = {1e-3, 1e6},
     .presence = optional,
     .otherwise = "40 sqrt(H/g), H being the height of the section",
     .sentence = "Longest time to follow the soil; it ends sooner where the soil comes to rest."},
    {.path = "runout.frame_interval_s",
     .unit = "s",
     .type = number,
     .range = {1e-3, 1e6},
     .presence = optional,
     .otherwise = "sqrt(H/g) / 2",
     .sentence = "Time between two frames: fields on file, energies, and whether the soil rests."},
    {.path = "runout.shake_g",
     .unit = "g",
     .type = number,
     .range = {-5, 5},
     .presence = defaulted,
     .otherwise = "0.0",
     .sentence = "Trigger: horizontal acceleration at the start that throws the soil to the right, "
                 "or if negative to the left."},
    {.path = "runout.shake_duration_s",
     .unit = "s",
     .type = number,
     .range = {0, 1e4},
     .presence = defaulted,
     .otherwise = "0.0",
     .sentence = "How long the ground shakes."},

    {.path = "output.probes_m",
     .unit = "m",
     .type = points,
     .range = coordinate,
     .least_points = 1,
     .presence = optional,
     .otherwise = "none",
     .sentence = "Points at which the report gives head and pore pressure of the seepage solve."},
    {.path = "output.figures",
     .type = boolean,
     .presence = defaulted,
     .otherwise = "true",
     .sentence =
         "Whether to draw figures beside the results, where Python with matplotlib is there."},
    {.path = "output.figure_formats",
     .type = choice_list,
     .choices = {"png", "svg"},
     .presence = defaulted,
     .otherwise = "[\"png\"]",
     .sentence = "Kinds of files to draw each figure to. SVG, for print and for drawing programs, "
                 "takes half as long again."},
    {.path = "output.msh",
     .type = boolean,
     .presence = defaulted,
     .otherwise = "false",
     .sentence = "Whether to write the seepage mesh as `mesh.msh`, for gmsh."},
    {.path = "output.report",
     .type = boolean,
     .presence = defaulted,
     .otherwise = "true",
     .sentence = "Whether to write report.html beside the results: all of it on one page for a "
                 "browser."},
    {.path = "output.line[].name",
     .type = text,
     .presence = optional,
     .otherwise = "`line_1` and so on",
     .sentence = "Name of the line, for the report and its file `lines/NAME.csv`; what is neither "
                 "letter nor digit becomes `_` there."},
    {.path = "output.line[].points_m",
     .unit = "m",
     .type = points,
     .range = coordinate,
     .sentence = "Line through the section or on its outline, along which the seepage solution is "
                 "read: head, pore pressure, flux, gradient; what passes to its left; the push of "
                 "the water."},
    {.path = "output.line[].samples",
     .type = integer,
     .range = {2, 100000},
     .presence = defaulted,
     .otherwise = "101",
     .sentence = "Number of equally spaced points in the line's file."},
};

std::string range_text(const Range& range, std::string_view name)
{
  if (range.lower == range.upper)
    return fmt::format("{} = {}", name, range.lower);
  return fmt::format("{} {} {} {} {}", range.lower, range.lower_open ? "<" : "<=", name,
                     range.upper_open ? "<" : "<=", range.upper);
}
} // namespace

std::span<const Key> keys()
{
  return table;
}

std::string_view last_part(std::string_view path)
{
  return path.substr(path.rfind('.') + 1); // npos + 1 is 0: the whole path
}

std::string allowed_text(const Key& key)
{
  const std::string_view name = last_part(key.path);
  switch (key.type)
  {
  case text:
    return "a line of text in quotes, at most 200 characters";
  case choice:
  case choice_list:
  {
    std::string names;
    for (const std::string_view c : key.choices)
      names += fmt::format("{}\"{}\"", names.empty() ? "" : " | ", c);
    return key.type == choice ? names : "a list of " + names + ", each once";
  }
  case number:
    return range_text(key.range, name);
  case integer:
    return "a whole number, " + range_text(key.range, name);
  case boolean:
    return "true | false";
  case points:
    return fmt::format("[[x, y], ...], at least {} {}, {}", key.least_points,
                       key.least_points == 1 ? "point" : "points", range_text(key.range, "x, y"));
  case polygons:
    return fmt::format("[[x, y], ...], at least {} points, or a list of such, {}", key.least_points,
                       range_text(key.range, "x, y"));
  case level_or_polyline:
    return fmt::format("a level or [[x, y], ...], {}", range_text(key.range, "x, y"));
  case conductivity:
    return fmt::format("a number or [kx, ky], {}", range_text(key.range, "k"));
  case interval:
    return fmt::format("[lower, upper], {} <= lower < upper <= {}", key.range.lower,
                       key.range.upper);
  }
  return {};
}
} // namespace berm::app
