// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/particles.h"
#include "sph/soil.h"

#include <span>

namespace berm::sph
{
/// By which verdicts measure time and displacement: docs/theory.md section 6.
struct Scales
{
  double T0 = 0;    ///< time of a shear wave over the height [s]
  double d_ref = 0; ///< gamma H^2 / E: scale of elastic settlement [m]
};

/// @brief Scales of a body, averaged over the soils by volume.
/// @param[in] height  Of the section [m].
[[nodiscard]] Scales body_scales(const Particles& particles, std::span<const Soil> soils,
                                 double height);
} // namespace berm::sph
