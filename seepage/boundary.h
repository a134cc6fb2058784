// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"
#include "seepage/seepage.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

/// Boundary conditions brought from the section's stretches to the nodes of a mesh. Internal to
/// seepage/.
namespace berm::seepage
{
enum class NodeKind : std::uint8_t
{
  interior, ///< no condition: inside, impervious, or inflow
  head,     ///< the head is given
  face      ///< potential seepage face: the active set decides
};

/// What holds at the nodes.
struct NodeConditions
{
  std::vector<NodeKind> kind;        ///< shape (n)
  std::vector<double> pressure_head; ///< at nodes of kind head, else 0 [m], shape (n)
  std::vector<double> load;          ///< prescribed inflow, lumped to the nodes [m2/s], shape (n)
  std::vector<Index> face_edges;     ///< rows of mesh.boundary that may become a seepage face
  double highest_head = 0;           ///< largest head given to a wet node [m]
};

/// @brief Conditions at the nodes of a mesh.
/// An edge of kind head that lies nowhere below its head level is dry: it becomes part of the
/// potential seepage face. An edge that crosses the level does so node by node. Where stretches
/// meet, a head prevails over a seepage face and the higher of two heads over the lower.
/// @param[in] boundary  One entry for each stretch.
/// @throws InputError if no node is under a head.
[[nodiscard]] NodeConditions node_conditions(const meshes::TriangleMesh& mesh,
                                             std::span<const Boundary> boundary);

/// @brief The weight w of docs/theory.md eq. (2.5): distance to the potential seepage face over
/// four times the length of its edge there, at most 1. Edge by edge, the smallest counts.
/// @return shape (n). Cost O(n).
[[nodiscard]] std::vector<double> face_weight(const meshes::TriangleMesh& mesh,
                                              std::span<const Index> face_edges);

/// @brief Water that enters through each stretch [m2/s], docs/theory.md eq. (2.7): the reactions of
/// its nodes and its prescribed inflow. The reaction of a node where stretches meet is shared among
/// the edges there that impose its condition (of kind head at a node of kind head; potential
/// seepage face at one of kind face), in proportion to their lengths.
/// @param[in] reaction  At each node, > 0 into the soil, without the load [m2/s], shape (n).
[[nodiscard]] std::vector<double> stretch_inflow(const meshes::TriangleMesh& mesh,
                                                 std::span<const Boundary> boundary,
                                                 const NodeConditions& conditions,
                                                 std::span<const double> reaction);
} // namespace berm::seepage
