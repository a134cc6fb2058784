// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace berm::seepage
{
/// How the conductivity of a soil falls with suction.
enum class RetentionModel
{
  sharp,        ///< at once: a free surface without a capillary fringe
  gardner,      ///< exponentially
  van_genuchten ///< Mualem's conductivity for van Genuchten's retention curve
};

/// Retention curve, as far as steady flow needs it. docs/theory.md eq. (2.40) to (2.43).
struct Retention
{
  RetentionModel model = RetentionModel::sharp;
  double alpha = 0;     ///< inverse length of the curve, > 0 unless sharp [1/m]
  double n = 0;         ///< van Genuchten: exponent, > 1 [-]
  double l = 0.5;       ///< van Genuchten: Mualem's l, >= -1 [-]
  double air_entry = 0; ///< van Genuchten: suction below which k_r = 1, >= 0 [m]
};
} // namespace berm::seepage
