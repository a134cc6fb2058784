// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/discretisation.h"
#include "sph/drucker_prager.h"
#include "sph/soil_solver.h"
#include "sph/updated_lagrangian.h"

#include <functional>
#include <memory>
#include <vector>

namespace berm::sph
{
/// A body of soil whichever way its motion is solved: what settling and trials need. A view: the
/// discretisation or body behind it must outlive it.
struct SoilModel
{
  SoilModel(const Discretisation& d); ///< total Lagrangian with local damping 0.8
  SoilModel(const MovingBody& body);  ///< updated Lagrangian with the body's settings

  Index n = 0;
  double T0 = 0;    ///< time of a shear wave over the height [s]
  double d_ref = 0; ///< scale of elastic settlement [m]
  /// A solver from a state; without cones it is linear elastic.
  std::function<std::unique_ptr<SoilSolver>(std::vector<Cone> cones, const State& start)> solver;
};

/// @brief No stress, no velocity, no displacement, at the reference positions.
[[nodiscard]] State unstressed(Index n);
} // namespace berm::sph
