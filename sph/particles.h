// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

#include <string>
#include <vector>

namespace berm::sph
{
/// The soil as particles in their reference positions, ordered column by column from left to right,
/// in a column from the base up. Where they do not stand above each other, a column is a strip of
/// width dx, counted from the left end of the section. Structure of arrays, shape (n) each.
struct Particles
{
  std::vector<double> x, y; ///< reference position [m]
  std::vector<double>
      volume; ///< area of the section that the particle stands for [m2 = m3 per m run]
  std::vector<double> density; ///< of the soil with the water in it [kg/m3]
  std::vector<Index> soil;     ///< index into the list of soils
  double spacing = 0;          ///< nominal dx [m]
  std::string packing;         ///< "columns", "lattice", "hexagonal", "mesh"

  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// What moves: shape (n) each, in the particles' order.
struct State
{
  std::vector<double> ux, uy;         ///< displacement since the settled state [m]
  std::vector<double> vx, vy;         ///< velocity [m/s]
  std::vector<SymTensor> stress;      ///< effective stress, tension positive [Pa]
  std::vector<double> plastic_strain; ///< accumulated equivalent deviatoric plastic strain [-]
  std::vector<double> x = {}, y = {}; ///< position [m]; empty if the reference position serves
  std::vector<double> density = {};   ///< [kg/m3]; empty if the reference density serves
};
} // namespace berm::sph
