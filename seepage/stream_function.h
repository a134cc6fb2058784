// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"
#include "seepage/flow_operator.h"

#include <cstdint>
#include <span>
#include <vector>

/// The stream function of a converged head. Internal to seepage/.
namespace berm::seepage
{
/// What is known of the flow on the boundary.
struct BoundaryFlow
{
  /// 1 where the head is known along the edge: heads and the wet seepage face; 0 where the flow is.
  std::vector<std::uint8_t> head_known; ///< shape (b)
  std::vector<double> edge_inflow;      ///< prescribed, of each edge [m2/s], shape (b)
  std::vector<double> reaction; ///< water that enters at each node besides [m2/s], shape (n)
};

/// @brief Stream function psi at the nodes, q = (d psi / dy, -d psi / dx).
/// Solves the problem dual to that of the head, docs/theory.md eq. (2.12) to (2.14), with linear
/// elements: where the head is known its change along the boundary is the load, where the flow is
/// known psi is given by the water that entered on the way round. Two points of a boundary without
/// flow between stretches with known head thus differ by exactly the reactions between them. On a
/// wall in the soil psi is one value, such that the head has no circulation about it, eq. (2.31).
/// Cost: one linear solve, and one more for each such wall.
/// @param[in] conductivity  Effective, k_r K, of each triangle [m/s], shape (m).
/// @param[in] head          At the nodes [m], shape (n).
/// @param[in] discharge     What psi is scaled with, > 0 [m2/s].
/// @param[in] distributed   Over the ranks: FlowOptions.
/// @return [m2/s], shape (n); 0 is its smallest value on the boundary of each piece, it grows to
/// the
///         left of the flow. Empty if water passes through a line in the soil.
[[nodiscard]] std::vector<double> stream_function(const meshes::TriangleMesh& mesh,
                                                  std::span<const ConductivityTensor> conductivity,
                                                  std::span<const double> head,
                                                  const BoundaryFlow& flow, double discharge,
                                                  bool distributed = false);
} // namespace berm::seepage
