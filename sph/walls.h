// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "meshes/section.h"
#include "sph/particles.h"

#include <vector>

namespace berm::sph
{
/// The mirror image of a particle behind a wall. Fixed base: velocity reversed, stress copied plus
/// the geostatic gradient; in strength reduction the shear stress grows with the strength, too.
/// Roller at the sides: normal velocity and shear stress reversed. docs/theory.md section 5.
struct Ghost
{
  Index source = 0;
  double x = 0, y = 0;
  double sign_vx = 1, sign_vy = 1;
  double sign_sxy = 1; ///< of the shear stress
  double sign_Bxy = 1; ///< of the off-diagonal of the gradient correction
  double depth_below =
      0; ///< y of the source minus y of the ghost: 0 at a side, > 0 behind the base [m]
};

/// @brief Ghosts of every particle within `reach` of the base or of a side of the section.
/// Behind a sloping base the image is taken along the vertical, which holds for small slopes.
[[nodiscard]] std::vector<Ghost> mirror_ghosts(const Particles& particles,
                                               const meshes::Section& section, double reach);
} // namespace berm::sph
