// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/column_weights.h"

#include <algorithm>
#include <cmath>

namespace berm::coupling
{
namespace
{
constexpr std::size_t pieces = 256; ///< of the section's width and height
}

ColumnWeights::ColumnWeights(const meshes::Section& section, std::span<const sph::Soil> soils,
                             const PorePressure& pore_pressure)
    : x_min_(section.x_min), dx_((section.x_max - section.x_min) / pieces), y_min_(section.y_min),
      dy_((section.y_max - section.y_min) / pieces)
{
  below_.reserve((pieces + 1) * (pieces + 1));
  std::vector<double> x(pieces), y(pieces);
  const double inside = 1e-9 * dx_; // on the section's ends a point may belong to no zone
  for (std::size_t i = 0; i <= pieces; ++i)
  {
    std::ranges::fill(x, std::clamp(x_min_ + static_cast<double>(i) * dx_, section.x_min + inside,
                                    section.x_max - inside));
    const double base = meshes::base_level(section, x.front()),
                 ground = meshes::ground_level(section, x.front());
    for (std::size_t j = 0; j < pieces; ++j) // above the ground and below the base as there
      y[j] = std::clamp(y_min_ + (static_cast<double>(j) + 0.5) * dy_, base, ground);
    const std::vector<double> p_w = pore_pressure(x, y);
    below_.push_back(0);
    for (std::size_t j = 0; j < pieces; ++j)
    {
      const sph::Soil& soil =
          soils[static_cast<std::size_t>(meshes::soil_at(section, {x[j], y[j]}))];
      below_.push_back(below_.back() +
                       (p_w[j] > 0 ? soil.saturated_density : soil.density) * gravity * dy_);
    }
  }
}

double ColumnWeights::between(double x, double low, double high) const
{
  return below(x, high) - below(x, low);
}

double ColumnWeights::below(double x, double y) const
{
  const double at = std::clamp((x - x_min_) / dx_, 0.0, static_cast<double>(pieces));
  const auto left = std::min(static_cast<std::size_t>(at), pieces - 1);
  const double t = at - static_cast<double>(left);
  return (1 - t) * in_column(left, y) + t * in_column(left + 1, y);
}

double ColumnWeights::in_column(std::size_t column, double y) const
{
  const double at = std::clamp((y - y_min_) / dy_, 0.0, static_cast<double>(pieces));
  const auto level = std::min(static_cast<std::size_t>(at), pieces - 1);
  const double* w = &below_[column * (pieces + 1) + level];
  return w[0] + (at - static_cast<double>(level)) * (w[1] - w[0]);
}
} // namespace berm::coupling
