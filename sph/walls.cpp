// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/walls.h"

namespace berm::sph
{
std::vector<Ghost> mirror_ghosts(const Particles& particles, const meshes::Section& section,
                                 double reach)
{
  std::vector<Ghost> ghosts;
  const auto n = static_cast<Index>(particles.size());

  for (Index i = 0; i < n; ++i)
  {
    const double x = particles.x[static_cast<std::size_t>(i)];
    const double y = particles.y[static_cast<std::size_t>(i)];
    const double above = y - meshes::base_level(section, x);
    if (above < reach)
      ghosts.push_back({.source = i,
                        .x = x,
                        .y = y - 2 * above,
                        .sign_vx = -1,
                        .sign_vy = -1,
                        .sign_sxy = 1,
                        .sign_Bxy = -1,
                        .depth_below = 2 * above});
  }

  // The sides mirror the soil and the ghosts of the base, so that the corners are filled.
  const std::size_t behind_base = ghosts.size();
  const auto mirror_side = [&](double wall, double foot, double top, double inward)
  {
    if (top <= foot) // the ground meets the base: no side
      return;
    const auto mirror = [&](Ghost g)
    {
      if (inward * (g.x - wall) >= reach || g.y >= top)
        return;
      g.x = 2 * wall - g.x;
      g.sign_vx = -g.sign_vx;
      g.sign_sxy = -g.sign_sxy;
      g.sign_Bxy = -g.sign_Bxy;
      ghosts.push_back(g);
    };
    for (Index i = 0; i < n; ++i)
      mirror({.source = i,
              .x = particles.x[static_cast<std::size_t>(i)],
              .y = particles.y[static_cast<std::size_t>(i)]});
    for (std::size_t g = 0; g < behind_base; ++g)
      mirror(ghosts[g]);
  };
  mirror_side(section.x_min, section.base.front().y(), section.left_side_top, 1);
  mirror_side(section.x_max, section.base.back().y(), section.right_side_top, -1);
  return ghosts;
}
} // namespace berm::sph
