// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report.h"

#include "app/readings_report.h"
#include "app/result_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace berm::app
{
namespace
{
constexpr double seconds_per_day = 86400;

/// Gathers lines: a heading, then rows of a label and a text.
class Page
{
public:
  void heading(std::string_view text) { text_ += fmt::format("\n{}\n", text); }
  void row(std::string_view label, std::string_view text)
  {
    text_ += fmt::format("  {:<16}  {}\n", label, text);
  }
  template <typename... Args>
  void line(fmt::format_string<Args...> format, Args&&... args)
  {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
  }
  std::string text_;
};

std::string water_text(const coupling::Case& input, const meshes::Section& section)
{
  std::string text;
  switch (input.water.pore_pressure)
  {
  case coupling::PorePressureKind::none:
    return "none: the soil is dry";
  case coupling::PorePressureKind::hydrostatic:
    text = input.water.free_surface.empty() ? "hydrostatic below the straight line"
                                            : "hydrostatic below the given line";
    break;
  case coupling::PorePressureKind::seepage:
    text = "steady seepage";
    break;
  }
  if (section.left_pool_level)
    text += fmt::format("; left pool at {:g} m", *section.left_pool_level);
  if (section.right_pool_level)
    text += fmt::format("; right pool at {:g} m", *section.right_pool_level);
  return text;
}

void add_scene(Page& page, const coupling::Case& input, const meshes::Section& section)
{
  page.line("{}", input.title);
  page.line("{}", std::string(input.title.size(), '='));
  page.row("section", fmt::format("{:g} m x {:g} m, {:.6g} m2", section.x_max - section.x_min,
                                  section.y_max - section.y_min,
                                  std::abs(meshes::polygon_area(section.outline))));
  page.row("water", water_text(input, section));
  for (const std::string& text : input.overrides)
    page.row("set", text);
}

void add_phreatic_line(Page& page, const seepage::Solution& solution)
{
  if (solution.phreatic_lines.empty())
  {
    page.row("phreatic line", "none inside the soil");
    return;
  }
  const Polyline& line = solution.phreatic_lines.front();
  const auto [left, right] = std::minmax_element(
      line.begin(), line.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  std::string x_row = "x [m]", y_row = "y [m]";
  for (const double x : round_positions(left->x(), right->x()))
    if (const auto y = seepage::phreatic_level(solution, x))
    {
      x_row += fmt::format("{:>9.6g}", x);
      y_row += fmt::format("{:>9.2f}", *y);
    }
  page.row("phreatic line", x_row);
  page.row("", y_row);
}

/// Steps of all meshes, and from where those were solved that were not by the first strategy.
void add_meshes(Page& page, const seepage::Solution& s)
{
  int steps = 0;
  std::string others;
  for (std::size_t k = 0; k < s.history.size(); ++k)
  {
    const seepage::SolveHistory& h = s.history[k];
    steps += h.newton_steps;
    if (h.strategy != (k == 0 ? "full section" : "coarser mesh"))
      others += fmt::format("; mesh {} from the {}", k + 1, h.strategy);
  }
  page.row("mesh",
           fmt::format("{} nodes, {} triangles; {} Newton steps on {} {}{}", s.mesh.nodes.size(),
                       s.mesh.triangles.size(), steps, s.history.size(),
                       s.history.size() == 1 ? "mesh" : "meshes", others));
}

std::string error_text(const seepage::Solution& s)
{
  const seepage::ErrorEstimate& e = s.error;
  std::string text;
  if (s.discharge > 0)
    text = fmt::format("discharge {:.2g} %, ", 100 * *e.discharge / s.discharge);
  text += fmt::format("heads {:.2g} m", e.head.empty() ? 0 : std::ranges::max(e.head));
  if (!s.phreatic_lines.empty())
    text += fmt::format(", phreatic line {:.2g} m in the mean", e.phreatic_line.value_or(0));
  if (e.exit_point)
    text += fmt::format(", exit point {:.2g} m", *e.exit_point);
  return text + (e.within_tolerance ? "" : "; MORE than the tolerance");
}

void add_seepage(Page& page, const coupling::Case& input, const coupling::Analysis& analysis)
{
  const seepage::Solution& s = *analysis.seepage;
  page.heading("Seepage");
  std::string q =
      fmt::format("{:.4g} m2/s = {:.4g} m3/day per m", s.discharge, s.discharge * seconds_per_day);
  if (const auto q_over_k = discharge_over_k(input, analysis))
    q += fmt::format(", q/k = {:.4f} m", *q_over_k);
  page.row("discharge", q);
  if (s.rain > 0)
  {
    const double runoff = std::accumulate(s.stretch_runoff.begin(), s.stretch_runoff.end(), 0.0);
    page.row("rain",
             fmt::format("{:.4g} m2/s, of which {:.4g} m2/s enters and {:.4g} m2/s runs off",
                         s.rain, s.rain - runoff, runoff));
  }
  if (s.error.discharge)
    page.row("estimated error", error_text(s));
  page.row("water balance",
           fmt::format("inflow and outflow differ by {:.1e} of the inflow", s.balance));
  page.row("exit point", s.exit_point    ? point_text(*s.exit_point)
                         : s.outflow > 0 ? "none: no free surface ends on a seepage face"
                                         : "none: the seepage face is dry");
  add_phreatic_line(page, s);
  for (const Probe& p : probes(input, analysis))
    page.row("probe", fmt::format("{:<18}  head {:>8.3f} m  pore pressure {:>8.2f} kPa",
                                  point_text(p.at), p.head, p.pore_pressure / 1e3));
  for (const ReportRow& row : reading_rows(input, analysis))
    page.row(row.label, row.text);
  add_meshes(page, s);
}

void add_mechanism(Page& page, const std::optional<sph::Mechanism>& mechanism)
{
  if (!mechanism)
  {
    page.row("slip surface", "none found: no connected mass moves");
    return;
  }
  page.row("slip surface",
           fmt::format("{} to the {}: enters {}, leaves {}", mechanism->kind, mechanism->side,
                       point_text(mechanism->entry), point_text(mechanism->exit)));
  page.row("", fmt::format("depth {:.2f} m, {:.2f} m across; volume {:.4g} m3 per m",
                           mechanism->depth, mechanism->thickness, mechanism->volume));
  if (const auto& circle = mechanism->circle)
    page.row("",
             fmt::format("circle about ({:.1f}, {:.1f}), radius {:.1f} m, misfit {:.2g} m",
                         circle->centre.x(), circle->centre.y(), circle->radius, circle->misfit));
  else
    page.row("", "near to no circle");
}

void add_critical_circle(Page& page, const std::optional<coupling::SlipCircle>& circle)
{
  if (!circle)
    return;
  page.row("critical circle",
           fmt::format("Bishop {:.3f}, Spencer {}: about ({:.1f}, {:.1f}), radius {:.1f} m",
                       circle->bishop,
                       circle->spencer ? fmt::format("{:.3f}", *circle->spencer) : "not converged",
                       circle->centre.x(), circle->centre.y(), circle->radius));
  page.row("", fmt::format("from x = {:.1f} to {:.1f}; to compare with, not the answer",
                           circle->x_left, circle->x_right));
}

/// "2.385, 2.381 at 0.5, 1 m"
std::string factors_text(const coupling::FoundFactor& found)
{
  std::vector<std::string> factors = {fmt::format("{:.3f}", found.bracket()->factor())};
  std::vector<std::string> spacings = {fmt::format("{:g}", found.spacing)};
  for (const coupling::SpacingFactor& level : found.coarser)
  {
    factors.push_back(fmt::format("{:.3f}", level.F.factor()));
    spacings.push_back(fmt::format("{:g}", level.spacing));
  }
  return fmt::format("{} at {} m", fmt::join(factors, ", "), fmt::join(spacings, ", "));
}

void add_uncertainty(Page& page, const coupling::FoundFactor& found)
{
  const auto range = found.range();
  if (!range)
    return;
  const auto error = found.discretisation();
  page.row("may lie",
           fmt::format("from {:.3f} to {:.3f}: by the bracket{}{}", range->low, range->high,
                       error ? ", the spacing" : "", found.flow_rule ? ", the flow rule" : ""));
  if (!error)
    page.row("", "the section is too coarse for an estimate from a second spacing");
  else if (error->order)
    page.row("spacing",
             fmt::format("{}: order {:.1f}, limit {:.3f}, +- {:.3f}", factors_text(found),
                         *error->order, *error->extrapolated, error->error));
  else
    page.row("spacing",
             fmt::format("{}: no clear order, +- {:.3f}", factors_text(found), error->error));
  if (found.flow_rule)
    page.row("flow rule", fmt::format("{:.3f} without dilation, {:.3f} with psi = phi",
                                      found.flow_rule->no_dilation.factor(),
                                      found.flow_rule->associated.factor()));
}

void add_found(Page& page, const coupling::FoundFactor& found)
{
  const sph::FactorOfSafety& F = found.F;
  page.row("factor of safety", factor_text(F));
  add_uncertainty(page, found);
  if (F.fails)
    add_mechanism(page, found.mechanism);
  add_critical_circle(page, found.critical_circle);
}

void add_trials(Page& page, const sph::FactorOfSafety& F)
{
  if (F.trials.empty())
    return;
  page.line("\n  {:>8}  {:<9}  {:>8}  {:>7}  {:>14}  why", "factor", "outcome", "time [s]", "steps",
            "moved by [m]");
  for (const sph::Trial& t : F.trials)
    page.line("  {:>8.4f}  {:<9}  {:>8.2f}  {:>7}  {:>14.4g}  {}", t.factor,
              t.interrupted ? "stopped" : sph::to_string(t.outcome), t.time, t.steps,
              t.max_displacement, t.reason);
}

/// All searches side by side, then each with its evidence.
void add_stability(Page& page, const coupling::Stability& s)
{
  page.heading("Stability");
  const std::string particles = fmt::format("{} at {:g} m, packed in {}", s.particles.size(),
                                            s.particles.spacing, s.particles.packing);
  if (s.searches.empty())
    page.row("factor of safety", "not asked for");
  if (s.searches.size() == 1)
    add_found(page, s.searches.front());
  std::size_t width = 16;
  for (const coupling::FoundFactor& found : s.searches)
    width = std::max(width, found.region.name.size());
  for (const coupling::FoundFactor& found : s.searches)
    if (s.searches.size() > 1)
      page.line("  {:<{}}  {}{}", found.region.name, width, factor_text(found.F),
                &found == &s.governing() ? "; governs" : "");
  page.row("particles", particles);
  for (const coupling::FoundFactor& found : s.searches)
  {
    if (s.searches.size() > 1)
    {
      page.heading("Stability, " + found.region.name);
      add_found(page, found);
    }
    add_trials(page, found.F);
  }
}

void add_run_out(Page& page, const coupling::RunOut& r, const meshes::Section& section)
{
  const sph::FinalShape& shape = r.shape;
  page.heading("Run-out");
  page.row("start",
           fmt::format("{}, strength / {:.4g}",
                       r.from_trial ? "the failing trial" : "the settled state", r.factor));
  page.row("end", r.motion.at_rest
                      ? fmt::format("at rest since {:.4g} s", r.motion.time_to_rest)
                      : fmt::format("STILL MOVING after {:.4g} s: what follows is not the end",
                                    r.motion.time));
  if (shape.run_out)
    page.row("run-out", fmt::format("{:.2f} m beyond the toe {}, to {} on the {}", *shape.run_out,
                                    point_text(*shape.toe), point_text(*shape.tip), shape.side));
  else
    page.row("run-out", "none: the surface rises nowhere by 1 % of the height");
  if (!shape.run_out && r.from_trial)
    page.row("", "a slope just past its limit soon rests; runout.factor follows a larger failure");
  std::string crest = fmt::format("lower by {:.2f} m", shape.crest_settlement);
  if (const auto left = freeboard(r, section))
    crest += *left > 0 ? fmt::format(", {:.2f} m above the pool", *left)
                       : fmt::format(", {:.2f} m BELOW the pool: it is overtopped", -*left);
  page.row("crest", crest);
  page.row("moved", fmt::format("{:.4g} m3 per m, by {:.2f} m at most", shape.moved_volume,
                                shape.max_displacement));
  const sph::Energies &first = r.motion.history.front().energies,
                      &last = r.motion.history.back().energies;
  const double dissipated = last.plastic + last.viscous + last.damping;
  page.row("energy",
           fmt::format("{:.3g} kJ per m dissipated, {:.1f} % of it by artificial viscosity; the "
                       "balance is off by {:.2g} kJ",
                       dissipated / 1e3, dissipated > 0 ? 100 * last.viscous / dissipated : 0.0,
                       (last.total() - first.total()) / 1e3));
  page.row("frames", fmt::format("{}; {} steps", r.motion.history.size(), r.motion.steps));
}

void add_times(Page& page, const coupling::Analysis& analysis)
{
  std::size_t width = 18;
  for (const coupling::StageSeconds& stage : analysis.stages)
    width = std::max(width, stage.stage.size());
  page.line("\n{:<{}}{:>10}{:>10}", "Stage", width + 2, "wall [s]", "CPU [s]");
  Seconds sum;
  for (const coupling::StageSeconds& stage : analysis.stages)
  {
    page.line("  {:<{}}{:>10.2f}{:>10.2f}", stage.stage, width, stage.seconds.wall,
              stage.seconds.cpu);
    sum.wall += stage.seconds.wall;
    sum.cpu += stage.seconds.cpu;
  }
  page.line("  {:<{}}{:>10.2f}{:>10.2f}", "all", width, sum.wall, sum.cpu);
  if (const auto rate = particle_steps_per_cpu_second(analysis))
    page.line("  {:.3g} particle steps per CPU second", *rate);
}
} // namespace

std::vector<double> round_positions(double lower, double upper)
{
  if (!(upper > lower))
    return {lower};
  // The coarsest round step that gives at least five positions; one finer gives at most twice as
  // many.
  const double decade = std::pow(10, std::floor(std::log10(upper - lower)));
  std::vector<double> positions;
  for (const double step : {decade, decade / 2, decade / 5, decade / 10})
  {
    positions.clear();
    const auto first = static_cast<long>(std::ceil(lower / step * (1 - 1e-12)));
    for (long i = first; static_cast<double>(i) * step <= upper; ++i)
      positions.push_back(static_cast<double>(i) * step);
    if (positions.size() >= 5)
      break;
  }
  if (positions.size() > 8) // every other one
    for (std::size_t i = 1; i < positions.size(); ++i)
      positions.erase(positions.begin() + static_cast<std::ptrdiff_t>(i));
  return positions;
}

std::string factor_text(const sph::FactorOfSafety& factor)
{
  std::string bracket;
  if (factor.stands)
    bracket += fmt::format("stands at {:.3f}", *factor.stands);
  if (factor.fails)
    bracket += fmt::format("{}fails at {:.3f}", bracket.empty() ? "" : ", ", *factor.fails);
  if (factor.complete && factor.factor())
    return fmt::format("F = {:.3f} ({})", *factor.factor(), bracket);
  if (bracket.empty())
    bracket = "no trial was decided";
  return fmt::format("UNDECIDED: {}{}{}", factor.reason, factor.reason.empty() ? "" : "; ",
                     bracket);
}

std::string report(const coupling::Case& input, const coupling::Analysis& analysis,
                   const std::vector<std::string>& warnings)
{
  Page page;
  page.text_ = "\n";
  add_scene(page, input, analysis.section);
  if (analysis.seepage)
    add_seepage(page, input, analysis);
  if (analysis.stability)
    add_stability(page, *analysis.stability);
  if (analysis.run_out)
    add_run_out(page, *analysis.run_out, analysis.section);
  add_times(page, analysis);
  if (!warnings.empty())
    page.heading("Warnings");
  for (const std::string& text : warnings)
    page.line("  {}", text);
  if (analysis.interrupted)
    page.line("\nStopped on request: these results are not complete.");
  return page.text_;
}

std::string summary(const coupling::Case& input, const meshes::Section& section)
{
  Page page;
  add_scene(page, input, section);
  for (const coupling::Soil& soil : input.soils)
  {
    const sph::Soil& m = soil.mechanical;
    std::string text = fmt::format(
        "{}: {:g} kN/m3, c = {:g} kPa, phi = {:g} deg, psi = {:g} deg, E = {:g} kPa, "
        "nu = {:g}",
        soil.name, m.density * gravity / 1e3, m.cohesion / 1e3, m.friction_angle * 180 / pi,
        m.dilation_angle * 180 / pi, m.young_modulus / 1e3, m.poisson_ratio);
    if (soil.conductivity && soil.conductivity->kx == soil.conductivity->ky)
      text += fmt::format(", k = {:g} m/s", soil.conductivity->kx);
    else if (soil.conductivity)
      text += fmt::format(", k = [{:g}, {:g}] m/s", soil.conductivity->kx, soil.conductivity->ky);
    page.row("soil", text);
  }
  std::string stages =
      input.water.pore_pressure == coupling::PorePressureKind::seepage ? "seepage" : "";
  if (input.stability)
    stages += stages.empty() ? "stability" : ", stability";
  if (input.run_out)
    stages += stages.empty() ? "run-out" : ", run-out";
  page.row("stages", stages);
  for (const std::string& text : section.warnings)
    page.row("warning", text);
  return page.text_;
}
} // namespace berm::app
