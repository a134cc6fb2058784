// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/drucker_prager.h"
#include "sph/wide.h"

/// The soil's law for `wide_lanes` particles at a time: the formulas of drucker_prager.h, with a
/// choice between values where those branch.
namespace berm::sph
{
/// Effective stress of `wide_lanes` particles [Pa].
struct WideStress
{
  Wide xx = {}, yy = {}, zz = {}, xy = {};
};

/// Constants of `wide_lanes` particles, which may be of different soils.
struct WideSoil
{
  Wide lambda = {}, G = {}; ///< K - 2G/3, shear modulus [Pa]
  Wide alpha = {}, k = {};  ///< as in Cone
  Wide dgamma = {};         ///< of the yield function: 1 / (G + 9 K alpha alpha_psi)
  Wide three_K_psi = {};    ///< 3 K alpha_psi
  Wide most_tension = {};   ///< I1 at the cut-off [Pa]
  Wide q_cut = {};          ///< sqrt(J2) of the cone there [Pa]
  Wide p_apex = {};         ///< I1 / 3 at the apex [Pa]
  Wide strain_of_q = {};    ///< 1 / (sqrt(3) G)

  void set(std::size_t lane, const Elastic& e, const Cone& cone)
  {
    lambda[lane] = e.K - 2 * e.G / 3;
    G[lane] = e.G;
    alpha[lane] = cone.alpha;
    k[lane] = cone.k;
    dgamma[lane] = 1 / (e.G + 9 * e.K * cone.alpha * cone.alpha_psi);
    three_K_psi[lane] = 3 * e.K * cone.alpha_psi;
    most_tension[lane] = cone.most_tension;
    q_cut[lane] = cone.k - cone.alpha * cone.most_tension;
    p_apex[lane] = cone.k / (3 * cone.alpha);
    strain_of_q[lane] = 1 / (std::sqrt(3.0) * e.G);
  }
};

/// @brief return_to_cone() in every lane, equal to it but for rounding; `sig` is changed in place.
/// @return Increment of the plastic strain [-].
[[nodiscard]] inline Wide return_to_cone(WideStress& sig, const WideSoil& soil)
{
  const Wide i1 = sig.xx + sig.yy + sig.zz, p = i1 * (1.0 / 3);
  const Wide dx = sig.xx - p, dy = sig.yy - p, dz = sig.zz - p;
  const Wide q = square_root(0.5 * (dx * dx + dy * dy + dz * dz) + sig.xy * sig.xy);

  const Wide f = q + soil.alpha * i1 - soil.k;
  const Wide dgamma = f * soil.dgamma;
  const Wide q_smooth = q - soil.G * dgamma;
  const auto cut = i1 > soil.most_tension, yields = f > 0, apex = q_smooth < 0;
  const Wide q_cut = q < soil.q_cut ? q : soil.q_cut;
  const Wide q_new = cut ? q_cut : apex ? wide(0) : q_smooth;
  const Wide p_new = cut    ? soil.most_tension * (1.0 / 3)
                     : apex ? soil.p_apex
                            : p - soil.three_K_psi * dgamma;

  const auto returns = cut | yields;
  const Wide part = q > 0 ? q_new / q : wide(0);
  sig.xx = returns ? p_new + part * dx : sig.xx;
  sig.yy = returns ? p_new + part * dy : sig.yy;
  sig.zz = returns ? p_new + part * dz : sig.zz;
  sig.xy = returns ? part * sig.xy : sig.xy;
  return returns ? (q - q_new) * soil.strain_of_q : wide(0);
}
} // namespace berm::sph
