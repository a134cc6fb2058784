// SPDX-License-Identifier: GPL-3.0-or-later
/// Seepage, error against unknowns against seconds: the rectangular dam, the embankment, a
/// trapezoidal and a zoned dam, on meshes of one size and on meshes that the tolerance chooses;
/// then size alone; then one hard section with its history.
///   bench_seepage > table.csv              error and cost, rates on stderr
///   [mpirun -n N] bench_seepage UNKNOWNS   one embankment of about so many, over all ranks
///   bench_seepage hard NAME                one of docs/hard_cases.md, notes on stderr
#include "seepage/seepage.h"
#include "meshes/section.h"
#include "tests/support/hard_seepage.h"
#include "tests/verification/seepage_cases.h"

#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fmt/core.h>
#include <string>
#include <vector>

namespace
{
using namespace berm;

struct Row
{
  std::string name;
  meshes::SectionInput input;
  std::vector<seepage::Conductivity> conductivity;
  double discharge = 0; ///< known [m2/s]
  double size = 0;      ///< first edge length of the uniform series [m]
};

meshes::SectionInput slope(Polyline ground, double base, double level)
{
  meshes::SectionInput input;
  input.base = {{ground.front().x(), base}, {ground.back().x(), base}};
  input.ground = std::move(ground);
  input.left_pool_level = level;
  return input;
}

const Polyline embankment{{0, 7.3},       {33.5, 7.3},  {99.83, 28.6},
                          {107.13, 28.6}, {157.9, 7.3}, {191.4, 7.3}};

std::vector<Row> rows()
{
  meshes::SectionInput zoned = tests::rectangular_dam(10, 10, 2);
  zoned.zones = {tests::box(1, 4, 0, 6, 11)};
  return {{"S1 rectangular", tests::rectangular_dam(16, 24, 4), {{1, 1, 0}}, 17.5, 1},
          {"S4 embankment", slope(embankment, 0, 24.4), {{1, 1, 0}}, 3.317, 1.4},
          {"S5 trapezoidal",
           slope({{0, 0}, {24, 12}, {28, 12}, {52, 0}}, 0, 10),
           {{1, 1, 0}},
           1.5360,
           0.6},
          {"S2 core 0.1", zoned, {{1, 1, 0}, {0.1, 0.1, 0}}, 12 / 7., 0.5}};
}

/// Exponent of y = a x^b by least squares of the logarithms.
struct Rate
{
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  void add(double vx, double vy)
  {
    const double lx = std::log(vx), ly = std::log(vy);
    n += 1, x += lx, y += ly, xx += lx * lx, xy += lx * ly;
  }
  [[nodiscard]] double exponent() const { return (n * xy - x * y) / (n * xx - x * x); }
};

void speed_against_error()
{
  fmt::print("row,meshes,asked,unknowns,newton_steps,q,error_percent,estimated_percent,cpu_s\n");
  for (const Row& row : rows())
  {
    const meshes::Section section = meshes::build_section(row.input);
    const auto boundary = seepage::boundary_conditions(section, {});
    Rate uniform, adaptive;
    const auto run =
        [&](const char* kind, double asked, const seepage::Settings& settings, Rate& rate)
    {
      Observer silent;
      const seepage::Solution s =
          seepage::solve(section, row.conductivity, boundary, settings, silent);
      int steps = 0;
      for (const seepage::SolveHistory& h : s.history)
        steps += h.newton_steps;
      const double error = s.discharge / row.discharge - 1;
      fmt::print("{},{},{:.3g},{},{},{:.6g},{:+.4f},{:.4f},{:.2f}\n", row.name, kind, asked,
                 s.mesh.nodes.size(), steps, s.discharge, 100 * error,
                 100 * s.error.discharge.value_or(NAN) / s.discharge, s.seconds.cpu);
      std::fflush(stdout);
      rate.add(static_cast<double>(s.mesh.nodes.size()), std::max(std::abs(error), 1e-5));
    };
    for (double size = row.size; size > row.size / 9; size /= 2)
      run("uniform", size, {.element_size = size, .adaptive = false}, uniform);
    for (const double tolerance : {1e-2, 3e-3, 1e-3, 5e-4, 2e-4})
      run("adaptive", tolerance, {.tolerance = tolerance, .phreatic_tolerance = 1e3}, adaptive);
    fmt::print(stderr, "{}: error ~ unknowns^{:.2f} uniform, ^{:.2f} adaptive\n", row.name,
               uniform.exponent(), adaptive.exponent());
  }
}

struct Notes : Observer
{
  bool speaks = false;
  bool details = false; ///< each Newton step
  void note(std::string_view text) override
  {
    if (speaks)
      fmt::print(stderr, "{}\n", text);
  }
  void detail(std::string_view text) override
  {
    if (details)
      note(text);
  }
  void warn(std::string_view text) override { note(fmt::format("warning: {}", text)); }
};

/// One section of docs/hard_cases.md.
void hard(const std::string& name)
{
  for (const tests::HardSeepage& c : tests::hard_seepage())
    if (c.name == name)
    {
      const meshes::Section section = meshes::build_section(c.section);
      Notes notes;
      notes.speaks = notes.details = true;
      const seepage::Solution s = seepage::solve(
          section, c.conductivity, seepage::boundary_conditions(section, c.marked), {}, notes);
      fmt::print("{}: q = {:.6g}, known {:.6g}, {:.1f} CPU s\n", name, s.discharge,
                 c.discharge ? c.discharge->value : NAN, s.seconds.cpu);
      return;
    }
  fmt::print(stderr, "no section of that name\n");
}

void one_of(double unknowns, bool distributed, bool speaks)
{
  const meshes::Section section = meshes::build_section(slope(embankment, 0, 24.4));
  Notes notes;
  notes.speaks = speaks;
  seepage::Settings settings{.tolerance = 1e-9, .most_unknowns = static_cast<Index>(unknowns)};
  settings.distributed = distributed;
  const seepage::Solution s = seepage::solve(
      section, {{1, 1, 0}}, seepage::boundary_conditions(section, {}), settings, notes);
  if (speaks)
    fmt::print("{} unknowns: q/k = {:.5f}, CPU {:.1f} s of this rank, wall {:.1f} s\n",
               s.mesh.nodes.size(), s.discharge, s.seconds.cpu, s.seconds.wall);
}
} // namespace

int main(int argc, char** argv)
{
  if (argc < 2)
  {
    speed_against_error();
    return 0;
  }
  if (argc > 2 && std::string(argv[1]) == "hard")
  {
    hard(argv[2]);
    return 0;
  }
  int given = 0, size = 1, rank = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &given);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  one_of(std::atof(argv[1]), size > 1, rank == 0);
  MPI_Finalize();
}
