// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "meshes/triangle_mesh.h"

#include <span>
#include <vector>

/// Where the error of a solution comes from. Internal to seepage/.
namespace berm::seepage
{
/// @brief Error indicator of each triangle, docs/theory.md eq. (2.15): a share of the square of the
/// error in the energy norm, which for a given drop of the head is also that of the discharge.
/// @param[in] flux          Mean Darcy flux [m/s], shape (m).
/// @param[in] conductivity  Saturated, a mean over the directions [m/s], shape (m).
/// @param[in] flow_is_given 1 for rows of mesh.boundary with a given flux, shape (b).
/// @param[in] given_flux    Into the soil at those rows [m/s], shape (b).
/// @return [m3/s], shape (m).
[[nodiscard]] std::vector<double> error_indicator(const meshes::TriangleMesh& mesh,
                                                  std::span<const Vec2> flux,
                                                  std::span<const double> conductivity,
                                                  std::span<const std::uint8_t> flow_is_given,
                                                  std::span<const double> given_flux);
} // namespace berm::seepage
