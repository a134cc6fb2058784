// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seepage/retention.h"

/// How the conductivity falls with suction: on a mesh, with a floor. Internal to seepage/.
namespace berm::seepage
{
/// Mualem's conductivity for van Genuchten's retention curve as a function of alpha times suction,
/// docs/theory.md eq. (2.43).
struct VanGenuchtenCurve
{
  double n = 2;     ///< [-], > 1
  double l = 0;     ///< [-]
  double entry = 1; ///< alpha times the suction below which k_r = 1 [-], > 0
  double scale = 0; ///< makes k_r = 1 there; 0: no such curve, the exponential holds
};

/// The law of a triangle, docs/theory.md eq. (2.40):
/// k_r = k_min + (1 - k_min) f((p - shift w) / eps), f exponential or van Genuchten's. The default
/// is k_r = 1.
struct RelativeConductivity
{
  double eps = 1;    ///< length over which it falls [m]
  double k_min = 1;  ///< floor [-]
  double fringe = 0; ///< T: what the capillary fringe conducts, over k [m]; 0 for a sharp surface
  double tau = 1;    ///< integral of f over u < 0 [-]
  VanGenuchtenCurve curve;

  /// @brief The pressure head where k_r begins to fall, such that the fringe conducts T whatever
  /// eps is [m]; docs/theory.md eq. (2.41).
  [[nodiscard]] double shift() const;
};

/// @brief The law of a soil, without a floor; eps = 0 if sharp. docs/theory.md eq. (2.41) to
/// (2.43).
[[nodiscard]] RelativeConductivity law_of(const Retention& retention);

/// @brief The law of a soil on a triangle that shows nothing shorter than `resolved`. Where that is
/// longer than the soil's curve, an exponential takes its place that conducts the same in the
/// fringe; docs/theory.md eq. (2.42), (2.44).
/// @param[in] resolved  [m], > 0.
[[nodiscard]] RelativeConductivity on_mesh(RelativeConductivity law, double resolved, double k_min);

/// @brief k_r. The forms of forms/flow.py use the same.
/// @param[in] p  Pressure head [m].
/// @param[in] w  Weight of the shift, docs/theory.md eq. (2.5) [-].
[[nodiscard]] double relative_conductivity(const RelativeConductivity& law, double p, double w);

/// @brief Move the pressure head at a node by a Newton correction, docs/theory.md eq. (2.9).
/// Where a dry node gets wetter, the correction is one of the integral of k_r, which is nearly
/// linear in the flow, and not of p, which is its logarithm and would overshoot by orders of
/// magnitude.
[[nodiscard]] double moved_pressure(const RelativeConductivity& law, double p, double correction);
} // namespace berm::seepage
