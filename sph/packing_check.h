// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"
#include "sph/discretisation.h"
#include "sph/particles.h"

namespace berm::sph
{
/// How fit a packing is for strength reduction.
struct PackingQuality
{
  double min_distance = 0; ///< of two particles, over dx [-]
  double residual = 0;     ///< rms of dx/2 |sum_j (B_i + B_j) G_ij| inside the section [-]: the
                           ///< force of a unit stress on a cell's face that should not be there
  Index inside = 0;        ///< particles that went into the residual
};

/// @brief Measure a packing before any step. Inside means farther than 4 h from the outline, where
/// neither a particle nor its neighbours feel it.
[[nodiscard]] PackingQuality measure_packing(const Particles& particles, const Discretisation& d,
                                             const meshes::Section& section);

/// @brief Refuse a packing on which the soil would yield falsely.
/// The limits are measured, docs/theory.md section 3: a residual above 0.016, a distance below
/// 0.3 dx. A section too thin to have 50 particles inside is judged by the distance alone.
/// @throws InputError with the key sph.packing, the reason and a hint.
void require_sound_packing(const PackingQuality& quality, const Particles& particles);

/// @brief Refuse a packing that gave way while the soil settled elastically.
/// @param[in] settlement  Largest displacement while settling [m].
/// @throws InputError if it is above 3 gamma H^2 / E: some 8 times gamma H^2 / (2 M).
void require_sound_settlement(double settlement, const Discretisation& d,
                              const Particles& particles);
} // namespace berm::sph
