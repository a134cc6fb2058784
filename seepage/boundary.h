// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"
#include "seepage/seepage.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
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

/// Whether a boundary of this kind may hold the pressure of its nodes.
[[nodiscard]] bool may_hold_pressure(BoundaryKind kind);

/// What holds at the nodes.
struct NodeConditions
{
  std::vector<NodeKind> kind;        ///< shape (n)
  std::vector<double> pressure_head; ///< at nodes of kind head, else 0 [m], shape (n)
  std::vector<double> load; ///< prescribed inflow and rain, lumped to the nodes [m2/s], shape (n)
  std::vector<double> rain; ///< the rain in it, that may run off [m2/s], shape (n)
  std::vector<Index> face_edges; ///< rows of mesh.boundary that may become a seepage face
  /// Largest head given to a wet node; without one, the highest point of the potential seepage face
  /// [m].
  double highest_head = 0;
  double heaviest_rain = 0;          ///< without limit under a film of running water [m/s]
  std::vector<std::string> warnings; ///< which pieces of the section no water reaches
};

/// @brief Conditions at the nodes of a mesh.
/// An edge of kind head that lies nowhere below its head level is dry: it becomes part of the
/// potential seepage face. An edge that crosses the level does so node by node. Where stretches
/// meet, a head prevails over a seepage face and the higher of two heads over the lower. Ground
/// under rain is a potential seepage face with a load, docs/theory.md eq. (2.32). A piece of the
/// mesh that no water reaches is dry: all its nodes are given the head of its lowest point.
/// @param[in] boundary  One entry for each stretch.
/// @throws InputError if a piece has no node under a head or on a potential seepage face, or one
///         that no water reaches has an outflow prescribed.
[[nodiscard]] NodeConditions node_conditions(const meshes::TriangleMesh& mesh,
                                             std::span<const Boundary> boundary);

/// @brief The weight w of docs/theory.md eq. (2.5): distance to the potential seepage face over
/// four times the length of its edge there, at most 1. Edge by edge, the smallest counts.
/// @return shape (n). Cost O(n).
[[nodiscard]] std::vector<double> face_weight(const meshes::TriangleMesh& mesh,
                                              std::span<const Index> face_edges);

/// @brief Lower the weight where rain percolates: docs/theory.md eq. (2.33).
/// @param[in]     vertical_conductivity  Of each triangle [m/s], shape (m).
/// @param[in]     rain                   [m/s], >= 0.
/// @param[in,out] weight                 As from face_weight, shape (n).
void limit_weight(const meshes::TriangleMesh& mesh, std::span<const double> vertical_conductivity,
                  double rain, std::vector<double>& weight);

/// Water at the stretches, one entry each [m2/s].
struct StretchWater
{
  std::vector<double> inflow; ///< what enters the soil less what leaves it
  std::vector<double> runoff; ///< rain that does not enter, >= 0
};

/// @brief Water that enters through each stretch [m2/s], docs/theory.md eq. (2.7): the reactions of
/// its nodes, its prescribed inflow, and rain as far as it enters, (2.32). The reaction of a node
/// where stretches meet is shared among the edges there that impose its condition (of kind head at
/// a node of kind head; potential seepage face at one of kind face), in proportion to their
/// lengths.
/// @param[in] reaction  At each node, > 0 into the soil, with rain that enters but without
/// prescribed
///                      inflow [m2/s], shape (n).
[[nodiscard]] StretchWater stretch_water(const meshes::TriangleMesh& mesh,
                                         std::span<const Boundary> boundary,
                                         const NodeConditions& conditions,
                                         std::span<const double> reaction);
} // namespace berm::seepage
