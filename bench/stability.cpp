// SPDX-License-Identifier: GPL-3.0-or-later
/// Speed against error: the published slopes over spacings and formulations, each run as a user's
/// run is, in a process of its own whose CPU seconds and memory the system counts.
///   bench_stability [finest, as parts of the slope's height: 40] > table.csv
#include "coupling/analysis.h"
#include "tests/support/published_slopes.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fmt/core.h>
#include <map>

namespace
{
using namespace berm;

struct Formulation
{
  const char* name;
  bool associated;
  const char* formulation;
  int finest; ///< parts of the slope's height
};

/// What a run found, sent through a pipe.
struct Answer
{
  double F = NAN, low = NAN, high = NAN;
  double particles = 0;
};

Answer run(const coupling::Case& input)
{
  Observer silent;
  const auto analysis = coupling::analyse(input, silent);
  const auto& stability = analysis.stability.value();
  Answer answer;
  answer.particles = static_cast<double>(stability.particles.size());
  const auto& found = stability.governing();
  if (const auto range = found.range())
    answer = {*found.F.factor(), range->low, range->high, answer.particles};
  return answer;
}

struct Measured
{
  Answer answer;
  double cpu = 0, megabytes = 0;
};

Measured run_alone(const coupling::Case& input)
{
  int ends[2];
  if (pipe(ends) != 0)
    std::abort();
  const pid_t child = fork();
  if (child == 0)
  {
    const Answer answer = run(input);
    _exit(write(ends[1], &answer, sizeof answer) == sizeof answer ? 0 : 1);
  }
  close(ends[1]);
  Measured measured;
  if (read(ends[0], &measured.answer, sizeof(Answer)) != sizeof(Answer))
    measured.answer = {};
  close(ends[0]);
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  const auto seconds = [](const timeval& t)
  { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  measured.cpu = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  measured.megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  return measured;
}

/// Exponent and factor of cpu = a n^b by least squares of the logarithms.
struct CostLaw
{
  double count = 0, x = 0, y = 0, xx = 0, xy = 0;
  void add(double n, double cpu)
  {
    const double lx = std::log(n), ly = std::log(cpu);
    count += 1;
    x += lx;
    y += ly;
    xx += lx * lx;
    xy += lx * ly;
  }
  [[nodiscard]] double exponent() const { return (count * xy - x * y) / (count * xx - x * x); }
  [[nodiscard]] double at(double n) const
  {
    const double b = exponent();
    return std::exp((y - b * x) / count) * std::pow(n, b);
  }
};
} // namespace

int main(int argc, char** argv)
{
  const int finest = argc > 1 ? std::atoi(argv[1]) : 40;
  const Formulation formulations[] = {{"psi = 0", false, "total_lagrangian", finest},
                                      {"psi = phi", true, "total_lagrangian", finest},
                                      {"paper", false, "paper", 10}};
  std::map<std::string, CostLaw> laws;
  fmt::print("row,formulation,dx_m,parts,particles,F,low,high,reference,error_percent,cpu_s,MB\n");
  for (const tests::PublishedSlope& row : tests::published_slopes())
    for (const Formulation& f : formulations)
      for (int parts = 10; parts <= f.finest; parts *= 2)
      {
        coupling::Case input = row.at_one_metre;
        input.sph.spacing = row.height / parts;
        input.sph.formulation = f.formulation;
        input.search.tolerance = 0.005;
        sph::Soil& soil = input.soils.front().mechanical;
        soil.dilation_angle = f.associated ? soil.friction_angle : 0;
        if (f.associated && soil.friction_angle == 0)
          continue;
        const Measured m = run_alone(input);
        const Answer& a = m.answer;
        fmt::print("{},{},{:.4g},{},{:.0f},{:.4f},{:.4f},{:.4f},{:.4f},{:+.2f},{:.2f},{:.0f}\n",
                   row.name, f.name, input.sph.spacing, parts, a.particles, a.F, a.low, a.high,
                   row.reference, 100 * (a.F / row.reference - 1), m.cpu, m.megabytes);
        std::fflush(stdout);
        if (a.particles > 500) // below, starting the program takes longer
          laws[f.formulation].add(a.particles, m.cpu);
      }
  for (const auto& [name, law] : laws)
    if (law.count > 2)
      fmt::print(stderr, "{}: CPU seconds ~ particles^{:.2f}; {:.2f} s at 10000\n", name,
                 law.exponent(), law.at(1e4));
}
