// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "meshes/section.h"
#include "meshes/triangle_mesh.h"
#include "seepage/seepage.h"

#include <vector>

/// The mesh that an adaptive solve begins with. Internal to seepage/.
namespace berm::seepage
{
/// @brief x -> M x, det M = 1, with M such that the section's most widespread soil is isotropic,
/// docs/theory.md eq. (2.17). Meshes are made and refined between stretched points: in an
/// anisotropic soil triangles are to be as long as the flow is.
class Stretching
{
public:
  Stretching() = default; ///< none
  Stretching(const meshes::Section& section, const std::vector<Conductivity>& conductivity);

  [[nodiscard]] bool none() const { return none_; }
  [[nodiscard]] meshes::Section stretched(meshes::Section section) const;
  [[nodiscard]] meshes::TriangleMesh stretched(meshes::TriangleMesh mesh) const;
  [[nodiscard]] meshes::TriangleMesh unstretched(meshes::TriangleMesh mesh) const;

private:
  bool none_ = true;
  Eigen::Matrix2d m_ = Eigen::Matrix2d::Identity(), inverse_ = m_;
};

/// @brief The section with a vertex wherever its outline or an inner line crosses the head level of
/// its own stretch.
[[nodiscard]] meshes::Section with_head_levels(const meshes::Section& section,
                                               const std::vector<Boundary>& boundary);

/// @brief Edge length such that the stretched section's smaller extent and the drop of the water
/// have enough elements [m].
[[nodiscard]] double default_element_size(const meshes::Section& section,
                                          const std::vector<Boundary>& boundary,
                                          const meshes::Section& stretched);
} // namespace berm::seepage
