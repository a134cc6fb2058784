// SPDX-License-Identifier: GPL-3.0-or-later
/// Particle-steps per CPU second of the updated-Lagrangian solver: the tables of
/// docs/performance.md. Run it on one thread: OMP_NUM_THREADS=1.
/// Usage: bench_updated_lagrangian collapse [repeats] [spacing in m]
///        bench_updated_lagrangian size [repeats]
#include "sph/updated_lagrangian.h"

#include "bench/statistics.h"
#include "core/stopwatch.h"
#include "coupling/pore_pressure.h"
#include "seepage/seepage.h"
#include "sph/fill.h"
#include "sph/soil_model.h"
#include "sph/trial.h"
#include "tests/support/sections.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace
{
using namespace berm;
using bench::median;
using bench::spread;

constexpr double width = 0.2, height = 0.1, water_level = 0.06; // of the column [m]

/// Aluminium rods of Bui et al. 2008.
sph::Soil rods()
{
  sph::Soil soil;
  soil.density = soil.saturated_density = 2650;
  soil.cohesion = 0;
  soil.dilation_angle = 0;
  soil.friction_angle = 19.8 * pi / 180;
  soil.young_modulus = 0.84e6;
  soil.poisson_ratio = 0.3;
  return soil;
}

/// A seepage field as the seepage stage would leave it: hydrostatic, on triangles in the column.
coupling::PorePressure field_on_triangles(const meshes::Section& section, double size)
{
  seepage::Solution solution;
  meshes::TriangleMesh& mesh = solution.mesh;
  const auto nx = static_cast<Index>(width / size), ny = static_cast<Index>(height / size);
  for (Index a = 0; a <= nx; ++a)
    for (Index b = 0; b <= ny; ++b)
    {
      mesh.nodes.emplace_back(width * a / nx, height * b / ny);
      solution.pore_pressure.push_back(water_unit_weight * (water_level - height * b / ny));
      if (a < nx && b < ny)
      {
        const Index k = a * (ny + 1) + b, right = k + ny + 1;
        mesh.triangles.push_back({k, right, right + 1});
        mesh.triangles.push_back({k, right + 1, k + 1});
      }
    }
  mesh.triangle_soil.assign(mesh.triangles.size(), 0);
  return coupling::pore_pressure_in_space(coupling::seepage_pore_pressure(solution, size), section);
}

/// A column at the left wall of an endless floor.
sph::MovingBody column(double spacing, const sph::UpdatedLagrangianSettings& terms, bool wet)
{
  const meshes::Section section = tests::block(width, height);
  sph::Particles particles = sph::fill(section, spacing, "columns");
  tests::set_density(particles, rods().density);
  coupling::PorePressure p_w = wet ? field_on_triangles(section, 2 * spacing) : nullptr;
  sph::MovingBody body =
      sph::moving_body(particles, std::vector{rods()},
                       wet ? p_w(particles.x, particles.y) : std::vector<double>{}, section, terms);
  body.reread_pressure = p_w;
  body.walls.right.reset();
  return body;
}

sph::UpdatedLagrangian solver(const sph::MovingBody& body)
{
  return {body, sph::reduced_cones(std::vector{rods()}, 1, "fitted"),
          sph::unstressed(static_cast<Index>(body.particles.size()))};
}

/// Memory that the process holds now [GB].
double resident_memory()
{
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return static_cast<double>(resident) * 4096e-9;
}

/// One set of terms, and what was measured with it.
struct Row
{
  bool corrected = false, repulsion = false, wet = false;
  std::vector<double> rate = {}, slowest = {}, search = {}, push = {};
  std::size_t particles = 0;
  long steps = 0, rebuilds = 0;
  double memory = 0; ///< [GB]

  [[nodiscard]] sph::UpdatedLagrangianSettings terms() const
  {
    return {.gradient_correction = corrected, .artificial_stress = repulsion};
  }
};

/// The column from its release to four times its time of fall, in ten pieces.
void collapse(Row& row, double spacing)
{
  const sph::MovingBody body = column(spacing, row.terms(), row.wet);
  sph::UpdatedLagrangian soil = solver(body);
  const double first_search = soil.search_seconds(), first_push = soil.push_seconds();
  row.particles = body.particles.size();
  double cpu = 0, slowest = 1e9;
  for (int piece = 0; piece < 10; ++piece)
  {
    const long before = soil.steps();
    const Stopwatch watch;
    soil.advance_for(0.04);
    const double seconds = watch.elapsed().cpu;
    slowest = std::min(slowest, 1e-6 * static_cast<double>(soil.steps() - before) *
                                    static_cast<double>(row.particles) / seconds);
    cpu += seconds;
  }
  row.rate.push_back(1e-6 * static_cast<double>(soil.steps()) * static_cast<double>(row.particles) /
                     cpu);
  row.slowest.push_back(slowest);
  row.search.push_back(100 * (soil.search_seconds() - first_search) / cpu);
  row.push.push_back(100 * (soil.push_seconds() - first_push) / cpu);
  row.steps = soil.steps();
  row.rebuilds = soil.rebuilds();
}

/// A short run of soil that flows as fast as in the middle of a collapse, so that the list is made
/// again every few steps.
void flow(Row& row, double spacing)
{
  const sph::MovingBody body = column(spacing, row.terms(), row.wet);
  sph::State start = sph::unstressed(static_cast<Index>(body.particles.size()));
  for (std::size_t i = 0; i < start.vx.size(); ++i)
  {
    start.vx[i] = body.particles.x[i] / width;
    start.vy[i] = -body.particles.y[i] / width;
  }
  sph::UpdatedLagrangian soil(body, sph::reduced_cones(std::vector{rods()}, 1, "fitted"), start);
  const double first_search = soil.search_seconds();
  row.particles = body.particles.size();
  row.steps = std::max(40L, 2000000L / static_cast<long>(row.particles));
  const Stopwatch watch;
  soil.advance(row.steps);
  const double cpu = watch.elapsed().cpu;
  row.rate.push_back(1e-6 * static_cast<double>(row.steps) * static_cast<double>(row.particles) /
                     cpu);
  row.search.push_back(100 * (soil.search_seconds() - first_search) / cpu);
  row.rebuilds = soil.rebuilds();
  row.memory = resident_memory();
}

const char* on(bool term)
{
  return term ? "on" : "off";
}

void collapse_table(int repeats, double spacing)
{
  std::vector<Row> rows{{},
                        {.corrected = true},
                        {.repulsion = true},
                        {.corrected = true, .repulsion = true},
                        {.wet = true}};
  for (int k = 0; k < repeats; ++k)
    for (Row& row : rows)
      collapse(row, spacing);
  std::printf("A column collapses. Million particle-steps per CPU second: median of %d "
              "(least-most)\n"
              "| particles | B_i | artificial stress | water | whole collapse | slowest tenth | "
              "search %% | push %% | steps | lists |\n|--|--|--|--|--|--|--|--|--|--|\n",
              repeats);
  for (const Row& r : rows)
    std::printf("| %zu | %s | %s | %s | %s | %s | %.1f | %.1f | %ld | %ld |\n", r.particles,
                on(r.corrected), on(r.repulsion), on(r.wet), spread(r.rate, 2).c_str(),
                spread(r.slowest, 2).c_str(), median(r.search), median(r.push), r.steps,
                r.rebuilds);
}

void size_table(int repeats)
{
  std::printf("Flowing soil. Million particle-steps per CPU second: median of %d (least-most)\n"
              "| particles | B_i | artificial stress | rate | search %% | steps | lists | "
              "GB |\n|--|--|--|--|--|--|--|--|\n",
              repeats);
  for (const double spacing : {0.0014, 0.00045, 0.00014})
    for (Row row : {Row{}, Row{.corrected = true, .repulsion = true}})
    {
      for (int k = 0; k < repeats; ++k)
        flow(row, spacing);
      std::printf("| %zu | %s | %s | %s | %.1f | %ld | %ld | %.2f |\n", row.particles,
                  on(row.corrected), on(row.repulsion), spread(row.rate, 2).c_str(),
                  median(row.search), row.steps, row.rebuilds, row.memory);
      std::fflush(stdout);
    }
}
} // namespace

int main(int argc, char** argv)
{
  const std::string table = argc > 1 ? argv[1] : "";
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 3;
  if (table == "collapse")
    collapse_table(repeats, argc > 3 ? std::atof(argv[3]) : 0.0014);
  else if (table == "size")
    size_table(repeats);
  else
    std::printf("usage: bench_updated_lagrangian collapse [repeats] [spacing in m]\n"
                "       bench_updated_lagrangian size [repeats]\n");
  return 0;
}
