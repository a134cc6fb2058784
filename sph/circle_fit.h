// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

#include <optional>

namespace berm::sph
{
/// The circle nearest to a line.
struct FittedCircle
{
  Vec2 centre{0, 0}; ///< [m]
  double radius = 0; ///< [m]
  double misfit = 0; ///< root mean square of the line's distance from it, over its length [m]
};

/// @brief Taubin's algebraic least-squares circle: the least
/// sum w (A z + B x + C y + D)^2 / sum w |grad|^2, z = x^2 + y^2, w the length of line about each
/// vertex. Taubin 1991; as an eigenvalue problem after Chernov 2010. Of the algebraic fits it is
/// the one that noise on a short arc shrinks little; exact on exact arcs.
/// @return Nothing for less than three vertices, or where the line is straight.
[[nodiscard]] std::optional<FittedCircle> fit_circle(const Polyline& line);
} // namespace berm::sph
