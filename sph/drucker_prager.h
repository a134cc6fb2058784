// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

#include <algorithm>
#include <cmath>
#include <limits>

/// Linear elasticity with a Drucker-Prager cone: pure functions of values.
namespace berm::sph
{
/// sqrt(J2) + alpha I1 <= k, plastic potential sqrt(J2) + alpha_psi I1 (tension positive).
struct Cone
{
  double alpha = 0;     ///< friction constant [-]
  double alpha_psi = 0; ///< dilation constant [-]
  double k = 0;         ///< cohesion constant [Pa]
  /// Tension cut-off: I1 is at most this [Pa], at most k / alpha. Infinite: the apex is the
  /// cut-off.
  double most_tension = std::numeric_limits<double>::infinity();
};

/// Elastic moduli of an isotropic solid.
struct Elastic
{
  double K = 0; ///< bulk modulus [Pa]
  double G = 0; ///< shear modulus [Pa]

  /// P-wave modulus [Pa]
  [[nodiscard]] double M() const { return K + 4 * G / 3; }
};

[[nodiscard]] inline Elastic elastic_moduli(double young_modulus, double poisson_ratio)
{
  return {.K = young_modulus / (3 * (1 - 2 * poisson_ratio)),
          .G = young_modulus / (2 * (1 + poisson_ratio))};
}

/// Bui et al. 2009 eq. (14): tan(angle) / sqrt(9 + 12 tan^2(angle)).
[[nodiscard]] inline double associated_constant(double angle)
{
  const double t = std::tan(angle);
  return t / std::sqrt(9 + 12 * t * t);
}

/// @brief Fit the cone to Mohr-Coulomb collapse in plane strain, for this flow rule.
/// No plastic strain along z at collapse, with a = alpha_psi, gives  D = sqrt(1 - 3 a^2) + a
/// sin(phi),
///   alpha = sin(phi) / (3 D),   k = c cos(phi) / D.   docs/theory.md eq. (4.5), derived there.
/// psi = phi gives eq. (14) of Bui et al. 2009; psi = 0 gives alpha = sin(phi) / 3, k = c cos(phi).
/// @param[in] c    Effective cohesion [Pa], >= 0.
/// @param[in] phi  Friction angle [rad], psi <= phi < pi/2.
/// @param[in] psi  Dilation angle [rad], >= 0.
[[nodiscard]] inline Cone fit_plane_strain(double c, double phi, double psi)
{
  const double a = associated_constant(psi);
  const double D = std::sqrt(1 - 3 * a * a) + a * std::sin(phi);
  return {.alpha = std::sin(phi) / (3 * D), .alpha_psi = a, .k = c * std::cos(phi) / D};
}

/// @brief The constants of Bui et al. 2009 eq. (14) whatever psi is.
/// With psi = 0 the cone is weaker than Mohr-Coulomb by sqrt(1 + tan^2(phi) / 3) in plane strain.
[[nodiscard]] inline Cone paper_cone(double c, double phi, double psi)
{
  const double t = std::tan(phi);
  return {.alpha = associated_constant(phi),
          .alpha_psi = associated_constant(psi),
          .k = 3 * c / std::sqrt(9 + 12 * t * t)};
}

/// Stress on or inside the cone, and the plastic strain that took it there.
struct Returned
{
  SymTensor sig;
  double plastic_strain = 0; ///< increment of sqrt(2/3 e_p : e_p), deviatoric [-]
  double gap = 0; ///< volume strain beyond apex or cut-off: empty space, not looser soil [-]
};

/// @brief Return a trial effective stress to the cone.
/// Smooth part: sqrt(J2) falls by G dgamma, I1 by 9 K alpha_psi dgamma; past the axis the stress
/// goes to the apex I1 = k / alpha. Beyond the tension cut-off, I1 falls to it and sqrt(J2) to the
/// cone there. docs/theory.md eq. (4.6)-(4.9).
[[nodiscard]] inline Returned return_to_cone(const SymTensor& trial, const Cone& cone,
                                             const Elastic& e)
{
  const double sqrt3 = 1.7320508075688772;
  const double i1 = I1(trial), q = std::sqrt(J2(trial));
  if (i1 > cone.most_tension)
  {
    const double q_cut = std::min(q, cone.k - cone.alpha * cone.most_tension);
    const double part = q > 0 ? q_cut / q : 0, p = i1 / 3, p_cut = cone.most_tension / 3;
    return {.sig = {p_cut + part * (trial.xx - p), p_cut + part * (trial.yy - p),
                    p_cut + part * (trial.zz - p), part * trial.xy},
            .plastic_strain = (q - q_cut) / (e.G * sqrt3),
            .gap = (p - p_cut) / e.K};
  }
  const double f = q + cone.alpha * i1 - cone.k;
  if (f <= 0)
    return {.sig = trial};

  const double dgamma = f / (e.G + 9 * e.K * cone.alpha * cone.alpha_psi);
  const double q_new = q - e.G * dgamma;
  if (q_new < 0) // only with alpha > 0: alpha = 0 gives q_new = k >= 0
  {
    const double p = cone.k / (3 * cone.alpha);
    return {.sig = {p, p, p, 0}, .plastic_strain = q / (e.G * sqrt3), .gap = (i1 / 3 - p) / e.K};
  }
  const double ratio = q > 0 ? q_new / q : 0;
  const double p = i1 / 3, p_new = p - 3 * e.K * cone.alpha_psi * dgamma;
  return {.sig = {p_new + ratio * (trial.xx - p), p_new + ratio * (trial.yy - p),
                  p_new + ratio * (trial.zz - p), ratio * trial.xy},
          .plastic_strain = dgamma / sqrt3};
}
} // namespace berm::sph
