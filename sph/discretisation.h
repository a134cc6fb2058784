// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"
#include "sph/drucker_prager.h"
#include "sph/neighbours.h"
#include "sph/panels.h"
#include "sph/particles.h"
#include "sph/soil.h"
#include "sph/walls.h"

#include <cstdint>
#include <span>
#include <vector>

namespace berm::sph
{
/// Total-Lagrangian SPH sums over the reference positions: all that stays the same while the soil
/// moves. Points 0 .. n-1 are the particles, n .. n+ghosts-1 their images behind the walls.
/// docs/theory.md section 3.
struct Discretisation
{
  Index n = 0;
  double h = 0;             ///< smoothing length, 1.2 dx [m]
  double dt = 0;            ///< time step, 0.8 h / c_p of the stiffest soil, or less [s]
  NeighbourList neighbours; ///< of particles, among particles and ghosts
  std::vector<std::array<double, 2>> G; ///< G_ij = V_j grad_i W_ij for each pair [1/m]
  std::vector<double> viscosity;        ///< s_ij of eq. (3.9) for each pair [m2/s]
  Panels panels; ///< the same pairs for particles in columns; without blocks for other packings
  std::vector<SymTensor> B;  ///< gradient correction of each particle (xx, yy, xy) [-]
  std::vector<Ghost> ghosts; ///< ordered by source
  std::vector<Index>
      ghost_begin; ///< ghosts of particle i: ghost_begin[i] .. ghost_begin[i+1], shape (n + 1)
  std::vector<double> bx, by;   ///< gravity plus the pore pressure's push [m/s2], shape (n)
  std::vector<double> density;  ///< [kg/m3], shape (n)
  std::vector<Index> soil;      ///< shape (n)
  std::vector<Elastic> elastic; ///< of each soil
  double height = 0;            ///< of the body [m]
  double T0 = 0;                ///< time of a shear wave over the height [s]
  double d_ref = 0;             ///< gamma H^2 / E: scale of elastic settlement [m]
};

/// @brief Build the sums for particles at rest.
/// @param[in] p_w    Pore pressure at the particles [Pa], compression positive, shape (n).
/// @param[in] soils  One entry for each soil index.
[[nodiscard]] Discretisation discretise(const Particles& particles, std::span<const Soil> soils,
                                        std::span<const double> p_w,
                                        const meshes::Section& section);

/// @brief Acceleration by pore pressure, -(grad p_w) / rho [m/s2], over the particles alone.
/// a_i = -(1/rho_i) sum_j V_j (p_j - p_i) B_i grad W: eq. (9) of Bui et al. 2009 with its sign
/// corrected and its gradient corrected by B_i of the particles without ghosts: exact for a linear
/// field, at the surface too, and zero for a uniform one, so that a pool needs no boundary force.
/// @return Components interleaved by particle, shape (n).
[[nodiscard]] std::vector<Vec2> pore_pressure_acceleration(const Particles& particles,
                                                           std::span<const double> p_w, double h);

/// @brief B = (sum_j V_j (x_j - x_i) (x) grad W_ij)^-1 for the first n points [-].
/// Corrected gradients are exact on linear fields. Where too few neighbours span the plane, the
/// direction they miss keeps a correction of one.
[[nodiscard]] std::vector<SymTensor> gradient_correction(std::span<const double> x,
                                                         std::span<const double> y,
                                                         std::span<const double> volume,
                                                         const NeighbourList& neighbours, double h);
} // namespace berm::sph
