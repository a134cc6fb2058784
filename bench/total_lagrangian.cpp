// SPDX-License-Identifier: GPL-3.0-or-later
/// Particle-steps per CPU second of the total-Lagrangian solver, and what the memory could deliver:
/// the tables of docs/performance.md. One thread: OMP_NUM_THREADS=1.
/// Usage: bench_total_lagrangian [repeats] [largest number of particles] [packing...]
#include "bench/statistics.h"
#include "core/stopwatch.h"
#include "sph/fill.h"
#include "sph/soil_model.h"
#include "sph/trial.h"
#include "tests/support/sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace
{
using namespace berm;
using bench::median;
using bench::spread;

/// What one core reads, and moves in a = b + s c, of arrays of the given total size [GB/s].
void bandwidth(const char* where, std::size_t bytes, int repeats)
{
  std::vector<double> a(bytes / 24, 0.0), b(a.size(), 1.0), c(a.size(), 2.0);
  const int passes = std::max(1, static_cast<int>(2e9 / static_cast<double>(bytes)));
  std::vector<double> triad, read;
  double total = 0;
  const auto rate = [&](const Stopwatch& watch)
  { return 24e-9 * static_cast<double>(a.size()) * passes / watch.elapsed().cpu; };
  for (int k = 0; k < repeats; ++k)
  {
    const Stopwatch triad_watch;
    for (int pass = 0; pass < passes; ++pass)
    {
      const double s = 1e-9 * (pass + k);
      for (std::size_t i = 0; i < a.size(); ++i)
        a[i] = b[i] + s * c[i];
    }
    triad.push_back(rate(triad_watch));

    // Many sums at a time, so that memory and not the latency of an addition is measured.
    const Stopwatch read_watch;
    std::array<double, 64> sums{};
    for (int pass = 0; pass < passes; ++pass)
      for (const std::vector<double>* v : {&a, &b, &c})
        for (std::size_t i = 0; i + sums.size() <= v->size(); i += sums.size())
          for (std::size_t l = 0; l < sums.size(); ++l)
            sums[l] += v->data()[i + l];
    read.push_back(rate(read_watch));
    for (const double sum : sums)
      total += sum;
  }
  std::printf("| %s, %.3g MB | %s | %s |%s\n", where, 1e-6 * static_cast<double>(bytes),
              spread(read, 1).c_str(), spread(triad, 1).c_str(),
              std::isfinite(total) ? "" : " overflow");
}

/// The embankment, dry; at rest under its weight but for the slopes, whose stress is that of level
/// ground and which begin to move.
struct Slope
{
  std::vector<sph::Soil> soils{tests::embankment_soil()};
  meshes::Section section = meshes::build_section(tests::embankment());
  sph::Particles particles;
  sph::Discretisation d;

  Slope(double spacing, const std::string& packing)
      : particles(sph::fill(section, spacing, packing))
  {
    tests::set_density(particles, soils[0].density);
    d = sph::discretise(particles, soils, std::vector<double>(particles.size(), 0.0), section);
  }

  [[nodiscard]] sph::State level_ground() const
  {
    const double nu = soils[0].poisson_ratio;
    sph::State state = sph::unstressed(d.n);
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
      const double depth = meshes::ground_level(section, particles.x[i]) - particles.y[i];
      const double s = -soils[0].density * gravity * depth;
      state.stress[i] = {nu / (1 - nu) * s, s, nu / (1 - nu) * s, 0};
    }
    return state;
  }
};

/// Rates in windows of some tenths of a second; the first, in which memory is touched for the first
/// time, does not count.
void row(const Slope& slope, bool plastic, int repeats)
{
  const sph::SoilModel model(slope.d);
  const auto cones = plastic ? sph::reduced_cones(slope.soils, 2.4, "fitted")
                             : std::vector<sph::Cone>{}; // F is 2.38
  const auto soil = model.solver(cones, slope.level_ground());
  const auto n = static_cast<double>(slope.d.n);
  const long steps = std::max(8L, std::lround(4e6 / n));
  std::vector<double> rate, on_the_wall;
  soil->advance(steps);
  for (int k = 0; k < repeats; ++k)
  {
    const Stopwatch watch;
    soil->advance(steps);
    const Seconds seconds = watch.elapsed();
    rate.push_back(1e-6 * n * static_cast<double>(steps) / seconds.cpu);
    on_the_wall.push_back(1e-6 * n * static_cast<double>(steps) / seconds.wall);
  }
  soil->check_finite();
  const sph::State end = soil->state();
  const auto yielded = std::count_if(end.plastic_strain.begin(), end.plastic_strain.end(),
                                     [](double e) { return e > 0; });
  std::printf("| %s | %d | %s | %s | %.1f | %.1f | %.0f |\n", slope.particles.packing.c_str(),
              slope.d.n, plastic ? "2.4" : "elastic", spread(rate, 1).c_str(), median(on_the_wall),
              static_cast<double>(slope.d.neighbours.index.size()) / n,
              100 * static_cast<double>(yielded) / n);
  std::fflush(stdout);
}
} // namespace

int main(int argc, char** argv)
{
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  const double most = argc > 2 ? std::atof(argv[2]) : 2e6;
  std::vector<std::string> packings(argv + std::min(argc, 3), argv + argc);
  if (packings.empty())
    packings = {"columns", "hexagonal"};

  std::printf("One core. GB per CPU second: median of %d (least-most)\n"
              "| arrays | read | a = b + s c, 24 B an element |\n|--|--|--|\n",
              repeats);
  bandwidth("L1", 24 << 10, repeats);
  bandwidth("L2", 600 << 10, repeats);
  bandwidth("L3", 9 << 20, repeats);
  bandwidth("memory", 600 << 20, repeats);

  std::printf("\nMillion particle-steps per CPU second: median of %d (least-most)\n"
              "| packing | particles | factor | rate | a second on the wall | "
              "neighbours | yielded %% |\n"
              "|--|--|--|--|--|--|--|\n",
              repeats);
  for (const std::string& packing : packings)
    for (const double spacing : {1.0, 0.5, 0.168, 0.0531})
      if (2820 / (spacing * spacing) < most)
      {
        const Slope slope(spacing, packing);
        for (const bool plastic : {false, true})
          row(slope, plastic, repeats);
      }
  return 0;
}
