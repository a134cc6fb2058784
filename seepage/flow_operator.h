// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"
#include "seepage/relative_conductivity.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// The discrete flow problem, behind plain arrays in the numbering of the mesh that was given.
/// Internal to seepage/; solver.cpp implements it with dolfinx and PETSc.
namespace berm::seepage
{
/// Symmetric conductivity tensor [m/s].
struct ConductivityTensor
{
  double xx = 0, xy = 0, yy = 0;
};

/// How the flow operator works.
struct FlowOptions
{
  bool curves = false;      ///< a triangle may have van Genuchten's curve: costs more
  bool distributed = false; ///< mesh, assembly and solve over all ranks, which call alike; else
                            ///< each rank does all of it
};

/// Linear elements on one mesh. MPI and PETSc start with the first of these, and end with the
/// process.
class FlowOperator
{
public:
  /// @param[in] conductivity  Of each triangle, shape (m).
  /// @param[in] weight        w of docs/theory.md eq. (2.5) at the nodes, shape (n).
  FlowOperator(const meshes::TriangleMesh& mesh, std::span<const ConductivityTensor> conductivity,
               std::span<const double> weight, FlowOptions options = {});
  ~FlowOperator();
  FlowOperator(const FlowOperator&) = delete;
  FlowOperator& operator=(const FlowOperator&) = delete;

  /// @brief Set k_r of each triangle, docs/theory.md eq. (2.40), shape (m). Until then k_r = 1
  /// everywhere. Pre: none has van Genuchten's curve unless the operator was made for it.
  void set_relative_conductivity(std::span<const RelativeConductivity> laws);

  /// @brief Water that has to enter at each node for this pressure head [m2/s] (docs/theory.md eq.
  /// (2.6)).
  /// @param[in]  p         Pressure head [m], shape (n).
  /// @param[out] residual  Shape (n).
  void residual(std::span<const double> p, std::vector<double>& residual);

  /// @brief Solve J(p) correction = right_side for the free nodes; the others keep zero.
  /// Sparse LU, in large systems as a preconditioner as long as it serves; on several ranks, and
  /// for very many unknowns, GMRES with an algebraic multigrid first.
  /// @param[in] fixed  Nonzero where the node has a given pressure, shape (n).
  /// @throws NotConverged if neither solves.
  void correction(std::span<const double> p, std::span<const std::uint8_t> fixed,
                  std::span<const double> right_side, std::vector<double>& correction);

  /// @brief Mean Darcy flux k_r K (-grad head) in each triangle [m/s], shape (m).
  [[nodiscard]] std::vector<Vec2> flux(std::span<const double> p);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
} // namespace berm::seepage
