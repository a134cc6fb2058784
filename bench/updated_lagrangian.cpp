// SPDX-License-Identifier: GPL-3.0-or-later
/// Particle-steps per CPU second of the updated-Lagrangian solver: a collapsing column of rods, so
/// that the list is made again as in a run-out. Usage: bench_updated_lagrangian [steps]
#include "sph/updated_lagrangian.h"
#include "core/stopwatch.h"
#include "sph/fill.h"
#include "sph/soil_model.h"
#include "sph/trial.h"
#include "tests/support/sections.h"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv)
{
  using namespace berm;
  const long steps = argc > 1 ? std::atol(argv[1]) : 1000;
  sph::Soil rods;
  rods.density = rods.saturated_density = 2650;
  rods.cohesion = 100;
  rods.friction_angle = 19.8 * pi / 180;
  rods.dilation_angle = 0;
  rods.young_modulus = 0.84e6;
  rods.poisson_ratio = 0.3;
  const meshes::Section section = tests::block(0.2, 0.1);
  std::printf("%9s %18s %28s %10s\n", "particles", "artificial stress", "Msteps per CPU second",
              "list");
  for (const double spacing : {0.0025, 0.0014, 0.0005})
    for (const bool artificial_stress : {false, true})
    {
      sph::Particles particles = sph::fill(section, spacing, "columns");
      tests::set_density(particles, rods.density);
      sph::MovingBody body = sph::moving_body(particles, std::vector{rods}, {}, section,
                                              {.artificial_stress = artificial_stress});
      body.walls.right.reset();
      sph::UpdatedLagrangian soil(body, sph::reduced_cones(std::vector{rods}, 1, "fitted"),
                                  sph::unstressed(static_cast<Index>(particles.size())));
      const Stopwatch watch;
      soil.advance(steps);
      const Seconds t = watch.elapsed();
      std::printf("%9zu %18s %28.2f %9.1f%%\n", particles.size(), artificial_stress ? "on" : "off",
                  1e-6 * static_cast<double>(steps) * static_cast<double>(particles.size()) / t.cpu,
                  100 * soil.rebuild_seconds() / t.wall);
    }
  return 0;
}
