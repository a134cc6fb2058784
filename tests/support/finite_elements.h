// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/case.h"
#include "sph/strength_reduction.h"

#include <array>
#include <vector>

namespace berm::tests
{
/// Strength reduction by finite elements, written to have something to hold the particles against:
/// it shares with them the section, the soil's parameters and the search, nothing else.
/// Quadrilaterals in columns up to the ground, each of two pairs of triangles whose volume strain
/// is that of the pair (mixed discretisation: Marti and Cundall, Int. J. Numer. Anal. Methods
/// Geomech. 6, 1982, 129-139); Mohr-Coulomb in the plane, psi = 0; explicit steps to equilibrium
/// with local damping, masses scaled so that every element has the same critical step. Fixed base,
/// rollers at the sides; pore pressure as a nodal field, a pool's weight on the ground.
class ElementSlope
{
public:
  /// @param[in] input  One soil on a level base, ground without overhangs, dry or hydrostatic.
  /// @param[in] size   Width of the columns, and height of an element under the highest ground [m].
  ElementSlope(const coupling::Case& input, double size);

  /// From the elastic state under the full load.
  [[nodiscard]] sph::Outcome trial(double factor) const;

  /// The whole search; a bracket of twice the tolerance.
  [[nodiscard]] sph::FactorOfSafety factor(double tolerance) const;

private:
  struct Triangle
  {
    std::array<std::size_t, 3> node;
    std::array<double, 3> bx, by; ///< gradients of the shape functions [1/m]
    double area;
  };
  struct Stress
  {
    double xx = 0, yy = 0, xy = 0;
  };
  struct Motion;

  [[nodiscard]] Triangle triangle(std::size_t a, std::size_t b, std::size_t c) const;
  void add_loads(const coupling::Case& input, double gamma);
  void add_masses();
  void step(Motion& motion, double c, double phi, bool elastic) const;
  [[nodiscard]] double measure(const Motion& motion) const;

  std::size_t rows_ = 0, columns_ = 0;
  std::vector<double> x_, y_;
  std::vector<Triangle> triangles_;    ///< four to an element: first pair, second pair
  std::vector<double> fx_, fy_, mass_; ///< loads [N/m] and scaled masses of the nodes
  double K_, G_, c_, phi_, d_ref_;
  std::vector<Stress> elastic_; ///< effective, under the full load
};
} // namespace berm::tests
