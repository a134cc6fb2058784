// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/tensor.h"
#include "meshes/section.h"
#include "sph/particles.h"

#include <optional>
#include <string>

namespace berm::sph
{
/// How the slope fails, read from the plastic strain of the failing trial.
struct Mechanism
{
  Polyline slip_line;         ///< ridge of the plastic strain from entry (uphill) to exit [m]
  Vec2 entry{0, 0};           ///< where it meets the ground uphill [m]
  Vec2 exit{0, 0};            ///< where it meets the ground (or ends) downhill [m]
  double depth = 0;           ///< largest vertical distance below the ground [m]
  double volume = 0;          ///< sliding mass [m2 = m3 per m run]
  std::string kind;           ///< "deep slide" or "surface skin"
  std::string side;           ///< "left" or "right": where the mass moves to
};

/// @brief Find the slip line; nothing if the plastic strain shows no connected band.
[[nodiscard]] std::optional<Mechanism> find_mechanism(const Particles& particles, const State& failing,
                                                      const meshes::Section& section);
} // namespace berm::sph
