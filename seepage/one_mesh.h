// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "meshes/triangle_mesh.h"
#include "seepage/boundary.h"
#include "seepage/flow_operator.h"
#include "seepage/newton.h"
#include "seepage/seepage.h"
#include "seepage/solution.h"
#include "seepage/strategies.h"

#include <optional>
#include <vector>

/// The solve on one mesh, and what is read off it. Internal to seepage/.
namespace berm::seepage
{
/// What flows, whatever the mesh.
struct Problem
{
  const std::vector<Conductivity>& conductivity; ///< of each soil
  const std::vector<Boundary>& boundary;         ///< of each stretch
  bool distributed = false;                      ///< over the ranks: FlowOptions
};

/// A converged solution with what the next mesh is made from.
struct MeshSolution
{
  meshes::TriangleMesh mesh;
  NodeConditions conditions;
  Field field;
  std::vector<Vec2> flux;                    ///< Darcy, of each triangle [m/s], shape (m)
  std::vector<ConductivityTensor> effective; ///< k_r K of each triangle [m/s], shape (m)
  std::vector<double> indicator;             ///< docs/theory.md eq. (2.15) [m3/s], shape (m)
  double smoothing_share = 0;                ///< eps over the element size [-]
  std::vector<double> eps; ///< smoothing of k_r, largest around each node [m], shape (n)
  double surface_eps = 0;  ///< the largest of a triangle that the free surface crosses [m]
  std::vector<Polyline> phreatic_lines; ///< as in Solution
  std::optional<Vec2> exit_point;       ///< as in Solution
};

/// @brief Solve on this mesh.
/// @param[in] coarser  The coarser mesh's solution on this one, to start from; or nothing.
/// @throws As seepage::solve.
[[nodiscard]] MeshSolution solve_one_mesh(meshes::TriangleMesh mesh, const Problem& problem,
                                          const std::optional<CoarserField>& coarser,
                                          Observer& observer);

/// @brief The whole answer, stream function and inflows of the stretches included.
[[nodiscard]] Solution finished(MeshSolution last, const Problem& problem);
} // namespace berm::seepage
