// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "meshes/section.h"
#include "sph/circle_fit.h"
#include "sph/particles.h"

#include <optional>
#include <string>

namespace berm::sph
{
/// How the slope fails, read from the velocity in the failing trial.
struct Mechanism
{
  Polyline slip_line;   ///< border between moving and resting soil, from entry (uphill) to exit [m]
  Vec2 entry{0, 0};     ///< where it meets the ground uphill [m]
  Vec2 exit{0, 0};      ///< where it meets the ground downhill [m]
  double depth = 0;     ///< largest vertical distance below the ground [m]
  double thickness = 0; ///< largest distance from the ground, the shortest way [m]
  double length = 0;    ///< from entry to exit, straight [m]
  double volume = 0;    ///< sliding mass [m2 = m3 per m run]
  std::string kind;     ///< "deep slide" or "surface skin": docs/theory.md section 7
  std::string side;     ///< "left" or "right": where the mass moves to
  std::optional<FittedCircle> circle; ///< of the slip line, where it is near to one
};

/// @brief Find the sliding mass and the line on which it slides.
/// At the end of a failing trial the mass moves nearly as a block while the rest is still: the slip
/// line is where the speed passes half of the block's, which lies in the middle of the shear band.
/// Plastic strain would show the same band, but also those that were active before the mechanism
/// formed. Of several separate masses, the one with the largest momentum is taken.
/// A skin is thinner than a tenth of its length (slides along a plane are, rotational ones are not:
/// Skempton & Hutchinson 1969), or than two spacings, below which particles show nothing else.
/// @return Nothing if no soil moves, or if the moving part never reaches the ground.
[[nodiscard]] std::optional<Mechanism>
find_mechanism(const Particles& particles, const State& failing, const meshes::Section& section);
} // namespace berm::sph
