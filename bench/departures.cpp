// SPDX-License-Identifier: GPL-3.0-or-later
/// What each departure from Bui et al. 2009 is worth: F of their embankment, dry and under the
/// straight line, with one thing changed at a time. The table of docs/theory.md section 8.
/// Usage: bench_departures [spacing in m]
///        bench_departures SPACING (dry | line) FACTOR...   where paper mode's soil comes to rest
#include "coupling/pore_pressure.h"
#include "sph/discretisation.h"
#include "sph/fill.h"
#include "sph/soil_model.h"
#include "sph/trial.h"
#include "sph/updated_lagrangian.h"
#include "tests/support/sections.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fmt/core.h>
#include <string>
#include <vector>

namespace
{
using namespace berm;

/// One row of the table: what is changed in paper mode.
struct Row
{
  std::string change;
  sph::UpdatedLagrangianSettings terms = sph::paper_settings();
  bool total_lagrangian = false, settled_elastically = false;
  std::string cone = "paper", packing = "columns";
};

std::vector<Row> rows()
{
  std::vector<Row> all;
  all.reserve(32); // the references below stay good
  all.push_back({.change = "paper mode"});
  const auto add = [&](const char* change) -> Row&
  { return all.emplace_back(Row{.change = change}); };
  add("pore term corrected (9.5)").terms.pressure_correction = true;
  add("strain and stress corrected (9.2)").terms.gradient_correction = true;
  Row& both = add("both corrected");
  both.terms.pressure_correction = both.terms.gradient_correction = true;
  add("geostatic gradient behind the base (5.1)").terms.geostatic_base = true;
  Row& three = add("all three");
  three.terms = both.terms;
  three.terms.geostatic_base = true;
  add("no artificial stress").terms.artificial_stress = false;
  add("viscosity both ways").terms.viscosity_both_ways = true;
  add("local damping 0.5 instead of 0.8").terms.local_damping = 0.5;
  add("settled elastically").settled_elastically = true;
  add("packing: lattice").packing = "lattice";
  add("cone fitted (4.5)").cone = "fitted";
  add("total Lagrangian (3.2)-(3.6)").total_lagrangian = true;
  Row& ours = add("the same, cone fitted: the default");
  ours.total_lagrangian = true;
  ours.cone = "fitted";
  return all;
}

/// The embankment, settled, in the terms of one row.
class Slope
{
public:
  Slope(const Row& row, double spacing, bool water)
      : section_(section(water)), particles_(sph::fill(section_, spacing, row.packing)),
        p_w_(pore_pressure(water)), still_(sph::discretise(particles_, soils_, p_w_, section_)),
        moving_(sph::moving_body(particles_, soils_, p_w_, section_, row.terms)),
        model_(row.total_lagrangian ? sph::SoilModel(still_) : sph::SoilModel(moving_)),
        cone_(row.cone), water_(water)
  {
    const bool elastic = row.total_lagrangian || row.settled_elastically;
    settled_ = sph::settle(model_, silent_, elastic ? std::vector<sph::Cone>{} : cones(1)).state;
  }

  /// Largest factor at which it stands, smallest at which it fails.
  std::string bracket()
  {
    const auto trial = [&](double factor, Observer& observer)
    { return sph::run_trial(model_, settled_, cones(factor), factor, observer); };
    const sph::SearchSettings search{
        .lower = water_ ? 1.6 : 2.2, .upper = water_ ? 2.0 : 2.6, .tolerance = 0.00625};
    const sph::FactorOfSafety F = sph::reduce_strength(trial, search, silent_);
    if (!F.complete)
      return F.reason;
    return fmt::format("{:.3f} - {:.3f}", F.stands.value_or(0), F.fails.value_or(0));
  }

  /// Run on, whatever the verdict, until the soil rests or 160 T0 are over.
  std::string course(double factor)
  {
    const auto soil = model_.solver(cones(factor), settled_);
    double s = 1;
    while (soil->time() < 160 * model_.T0 && (s > 1e-3 || soil->time() < 4 * model_.T0))
    {
      soil->advance(std::lround(model_.T0 / soil->time_step()));
      s = soil->v_rms() * model_.T0 / model_.d_ref;
    }
    return fmt::format("{:.3f} | {:.0f} T0 | {:.2f} m | {}", factor, soil->time() / model_.T0,
                       soil->max_displacement(), s > 1e-3 ? "still moves" : "at rest");
  }

private:
  static meshes::Section section(bool water)
  {
    meshes::SectionInput input = tests::embankment();
    if (water)
      input.left_pool_level = 24.4;
    return meshes::build_section(input);
  }
  std::vector<double> pore_pressure(bool water)
  {
    tests::set_density(particles_, soils_[0].density);
    const auto p_w =
        water ? coupling::hydrostatic_pore_pressure(coupling::straight_free_surface(section_))
              : coupling::no_pore_pressure();
    return p_w(particles_.x, particles_.y);
  }
  std::vector<sph::Cone> cones(double factor) { return sph::reduced_cones(soils_, factor, cone_); }

  std::vector<sph::Soil> soils_{tests::embankment_soil()};
  meshes::Section section_;
  sph::Particles particles_;
  std::vector<double> p_w_;
  sph::Discretisation still_;
  sph::MovingBody moving_;
  sph::SoilModel model_;
  std::string cone_;
  bool water_;
  Observer silent_;
  sph::State settled_;
};
} // namespace

int main(int argc, char** argv)
{
  const double spacing = argc > 1 ? std::atof(argv[1]) : 1.0;
  if (argc > 2)
  {
    const bool water = argv[2] == std::string("line");
    Slope slope({.change = "paper mode"}, spacing, water);
    std::printf("| factor | run for | moved by | end |\n|--|--|--|--|\n");
    for (int k = 3; k < argc; ++k)
      std::printf("| %s |\n", slope.course(std::atof(argv[k])).c_str());
    return 0;
  }
  std::printf("| changed, dx = %g m | dry | straight line |\n|--|--|--|\n", spacing);
  for (const Row& row : rows())
  {
    std::printf("| %s | %s | %s |\n", row.change.c_str(),
                Slope(row, spacing, false).bracket().c_str(),
                Slope(row, spacing, true).bracket().c_str());
    std::fflush(stdout);
  }
  return 0;
}
