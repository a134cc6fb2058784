// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/analysis.h"

#include <algorithm>

namespace berm::app::test
{
/// A unit square of two triangles and three particles: small enough to know every number of it.
inline coupling::Analysis small_analysis()
{
  coupling::Analysis analysis;
  meshes::SectionInput drawing;
  drawing.ground = {{0, 1}, {1, 1}};
  drawing.base = {{0, 0}, {1, 0}};
  analysis.section = meshes::build_section(drawing);

  seepage::Solution flow;
  flow.mesh.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  flow.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  flow.mesh.triangle_soil = {0, 0};
  flow.head = {1, 0.5, 0.5, 1};
  flow.pore_pressure = {9810, 4905, -4905, 0};
  flow.flux = {{5e-7, 0}, {5e-7, 0}};
  flow.stream_function = {0, 0, 5e-7, 5e-7};
  flow.reaction = {2.5e-7, -2.5e-7, -2.5e-7, 2.5e-7};
  flow.phreatic_lines = {{{0, 1}, {1, 0.5}}};
  flow.exit_point = Vec2{1, 0.5};
  flow.discharge = flow.inflow = flow.outflow = 5e-7;
  flow.history = {{.unknowns = 4, .strategy = "full section", .newton_steps = 3}};
  flow.seconds = {.wall = 0.25, .cpu = 0.5};
  analysis.seepage = flow;

  coupling::Readings& read = analysis.readings;
  seepage::LineReading& line = read.lines.emplace_back();
  line.length = 1;
  line.samples = {{0, {0, 0}, 1, 9810, {5e-7, 0}, 0.5}, {1, {1, 0}, 0.5, -4905, {5e-7, 0}, 0.5}};
  line.discharge = -5e-7;
  line.water = {
      .force = {0, 7500}, .moment = 3500, .pressure = 7500, .distance = 0.4375, .at = {0.4375, 0}};
  seepage::Outlet& outlet = read.outlets.emplace_back();
  const auto& stretches = analysis.section.stretches;
  outlet.stretch = static_cast<Index>(
      std::ranges::find(stretches, "ground", &meshes::Stretch::name) - stretches.begin());
  outlet.outflow = 5e-7;
  outlet.points = {{.distance = 0,
                    .at = {1, 1},
                    .head = 1,
                    .normal = 2,
                    .upward = 2,
                    .flux = 2e-6,
                    .faces_up = true,
                    .soil = 0,
                    .beside_singularity = Vec2{1, 1}},
                   {.distance = 0.5,
                    .at = {0.5, 1},
                    .head = 1,
                    .normal = 0.25,
                    .upward = 0.25,
                    .flux = 2.5e-7,
                    .faces_up = true,
                    .soil = 0,
                    .beside_singularity = {}}};
  outlet.steepest = 1;
  outlet.unbounded = {{1, 1}};
  outlet.kept_away = 0.125;
  read.critical_gradient = {1};
  read.heave.surface = {.factor = 4, .gradient = 0.25, .critical_gradient = 1, .at = {0.5, 1}};
  read.heave.column = {.factor = 3.5, .depth = 0.5, .excess_head = 0.125, .at = {0.5, 1}};

  coupling::Stability soil;
  soil.particles = {.x = {0.2, 0.5, 0.8},
                    .y = {0.5, 0.5, 0.5},
                    .volume = {0.3, 0.4, 0.3},
                    .density = {2000, 2000, 2000},
                    .soil = {0, 0, 0},
                    .spacing = 0.5,
                    .packing = "columns"};
  soil.pore_pressure = {4000, 2000, 0};
  soil.settled = {.ux = {0, 0, 0},
                  .uy = {0, 0, 0},
                  .vx = {0, 0, 0},
                  .vy = {0, 0, 0},
                  .stress = std::vector<SymTensor>(3, {-1e3, -2e3, -1e3, 0}),
                  .plastic_strain = {0, 0, 0}};
  sph::State failing = soil.settled;
  failing.ux = {0.25, 0.5, 0.75};
  failing.plastic_strain = {0.1, 0.2, 0.3};
  coupling::FoundFactor& found = soil.searches.emplace_back();
  sph::FactorOfSafety& factor = found.F;
  factor.stands = 1.5;
  factor.fails = 1.51;
  factor.complete = true;
  factor.trials.resize(2);
  factor.trials[0].factor = 1.5;
  factor.trials[0].outcome = sph::Outcome::stands;
  factor.trials[0].state = soil.settled;
  factor.trials[1].factor = 1.51;
  factor.trials[1].outcome = sph::Outcome::fails;
  factor.trials[1].history = {{0.25, 0.125, 0.0625}, {0.5, 0.25, 0.75}};
  factor.trials[1].state = failing;
  found.mechanism = sph::Mechanism{.slip_line = {{0, 1}, {1, 0.5}},
                                   .depth = 0.5,
                                   .kind = "deep slide",
                                   .side = "right",
                                   .circle = sph::FittedCircle{{1, 2}, 1.5, 0.25}};
  soil.particle_steps = 300;
  analysis.stability = soil;
  analysis.stages = {
      {"seepage", {0.25, 0.5}}, {"settling", {1, 2}}, {"strength reduction", {2, 4}}};
  return analysis;
}

/// The case that goes with it.
inline coupling::Case small_case()
{
  coupling::Case input;
  input.title = "a \"small\" case";
  input.text = "format = 1\n";
  input.water.pore_pressure = coupling::PorePressureKind::seepage;
  input.soils.push_back(
      {.name = "fill", .mechanical = {}, .conductivity = seepage::Conductivity{1e-6, 1e-6}});
  input.output.probes = {{0.5, 0.25}};
  input.output.lines = {{.name = "a/line", .line = {.points = {{0, 0}, {1, 0}}, .samples = 2}}};
  return input;
}
} // namespace berm::app::test
