// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/packing_check.h"

#include "core/error.h"
#include "meshes/planar.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <string>
#include <utility>

namespace berm::sph
{
namespace
{
constexpr double largest_residual = 0.016; // F within 2 % up to 0.0145; 5 % too low at 0.019
constexpr double smallest_distance = 0.3;
constexpr double largest_settlement = 3; // in gamma H^2 / E; sound packings have 0.36
constexpr Index enough_inside = 50;

[[noreturn]] void refuse(const Particles& particles, std::string problem)
{
  throw InputError({{.key = "sph.packing",
                     .value = particles.packing,
                     .problem = std::move(problem),
                     .allowed = {},
                     .hint = "the soil would yield falsely and F would be too low; take another "
                             "packing, \"auto\" if nothing speaks against it, or a smaller "
                             "sph.spacing_m"}});
}
} // namespace

PackingQuality measure_packing(const Particles& particles, const Discretisation& d,
                               const meshes::Section& section)
{
  const std::size_t n = particles.size();
  std::vector<double> x = particles.x, y = particles.y;
  std::vector<SymTensor> B = d.B;
  for (const Ghost& g : d.ghosts)
  {
    x.push_back(g.x);
    y.push_back(g.y);
    B.push_back(d.B[static_cast<std::size_t>(g.source)]);
    B.back().xy *= g.sign_Bxy;
  }

  PackingQuality quality;
  double nearest2 = std::numeric_limits<double>::infinity(), residual2 = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec2 p{x[i], y[i]};
    Vec2 force = Vec2::Zero();
    for (auto k = static_cast<std::size_t>(d.neighbours.begin[i]);
         k < static_cast<std::size_t>(d.neighbours.begin[i + 1]); ++k)
    {
      const auto j = static_cast<std::size_t>(d.neighbours.index[k]);
      if (j < n)
        nearest2 = std::min(nearest2, (Vec2{x[j], y[j]} - p).squaredNorm());
      const auto [gx, gy] = d.G[k];
      const double xx = B[i].xx + B[j].xx, xy = B[i].xy + B[j].xy, yy = B[i].yy + B[j].yy;
      force += Vec2{xx * gx + xy * gy, xy * gx + yy * gy};
    }
    if (meshes::nearest_edge(section.outline, p).distance < 4 * d.h)
      continue;
    ++quality.inside;
    residual2 += force.squaredNorm();
  }
  quality.min_distance = std::sqrt(nearest2) / particles.spacing;
  if (quality.inside > 0)
    quality.residual =
        0.5 * particles.spacing * std::sqrt(residual2 / static_cast<double>(quality.inside));
  return quality;
}

void require_sound_packing(const PackingQuality& quality, const Particles& particles)
{
  if (quality.min_distance < smallest_distance)
    refuse(particles, fmt::format("two particles are only {:.2g} spacings apart, wanted {:.2g}",
                                  quality.min_distance, smallest_distance));
  if (quality.inside >= enough_inside && quality.residual > largest_residual)
    refuse(particles, fmt::format("too disordered: a constant stress leaves a residual force of "
                                  "{:.2g}, at most {:.2g} is sound",
                                  quality.residual, largest_residual));
}

void require_sound_settlement(double settlement, const Discretisation& d,
                              const Particles& particles)
{
  if (settlement > largest_settlement * d.d_ref)
    refuse(particles, fmt::format("the particles gave way by {:.3g} m under their own weight; "
                                  "elastic soil settles by about {:.3g} m",
                                  settlement, 0.4 * d.d_ref));
}
} // namespace berm::sph
