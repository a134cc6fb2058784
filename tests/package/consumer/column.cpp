// SPDX-License-Identifier: GPL-3.0-or-later
// A column of soil, 2 m by 10 m, settles under its weight. Exit code 0: sigma_yy is gamma times
// depth, but for the half spacing of soil that the sum at the surface misses.
#include "sph/discretisation.h"
#include "sph/fill.h"
#include "sph/trial.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

int main()
{
  constexpr double spacing = 0.25, gamma = 2000 * berm::gravity; // m, N/m3
  const berm::meshes::Section section =
      berm::meshes::build_section({.ground = {{0, 10}, {2, 10}}, .base = {{0, 0}, {2, 0}}});
  berm::sph::Particles column = berm::sph::fill(section, spacing, "columns");
  column.density.assign(column.size(), gamma / berm::gravity);
  const std::vector soils{berm::sph::Soil{.young_modulus = 1e8, .poisson_ratio = 0.3}}; // elastic
  const std::vector<double> dry(column.size(), 0.0);
  const auto sums = berm::sph::discretise(column, soils, dry, section);
  berm::Observer silent;
  const auto settled = berm::sph::settle(sums, silent);

  double worst = 0; // Pa
  for (std::size_t i = 0; i < column.size(); ++i)
    worst = std::max(worst, std::abs(settled.state.stress[i].yy + gamma * (10 - column.y[i])));
  std::printf("%zu particles, sigma_yy within %.0f Pa\n", column.size(), worst);
  return worst < 0.6 * gamma * spacing ? 0 : 1;
}
