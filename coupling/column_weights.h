// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/pore_pressure.h"
#include "meshes/section.h"
#include "sph/soil.h"

#include <cstddef>
#include <span>
#include <vector>

namespace berm::coupling
{
/// Weights of columns of soil and of the water in it, by a table over the section: for a search
/// that asks for hundreds of thousands. Between its columns and levels, 1/256 of the section apart,
/// linear. Pre: ground and base are functions of x.
class ColumnWeights
{
public:
  ColumnWeights(const meshes::Section& section, std::span<const sph::Soil> soils,
                const PorePressure& pore_pressure);

  /// @brief Weight of a column of unit width at x between two levels [N/m2].
  [[nodiscard]] double between(double x, double low, double high) const;

private:
  [[nodiscard]] double below(double x, double y) const;
  [[nodiscard]] double in_column(std::size_t column, double y) const;

  double x_min_, dx_, y_min_, dy_; ///< [m]
  std::vector<double> below_; ///< weight below each level of each column, level by level [N/m2]
};
} // namespace berm::coupling
