// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/indicator.h"

#include "meshes/sides.h"

#include <cstddef>

namespace berm::seepage
{
std::vector<double> error_indicator(const meshes::TriangleMesh& mesh, std::span<const Vec2> flux,
                                    std::span<const double> conductivity,
                                    std::span<const std::uint8_t> flow_is_given,
                                    std::span<const double> given_flux)
{
  const meshes::Sides sides(mesh);
  const auto along = [&](Index i, Index j) -> Vec2
  { return mesh.nodes[static_cast<std::size_t>(j)] - mesh.nodes[static_cast<std::size_t>(i)]; };
  // Times the side's length: what leaves to the right of it.
  const auto leaves = [](const Vec2& q, const Vec2& side)
  { return q.x() * side.y() - q.y() * side.x(); };

  std::vector<double> eta2(mesh.triangles.size(), 0);
  for (std::size_t s = 0; s < sides.ends.size(); ++s)
  {
    const auto [t, u] = sides.touches[s];
    if (t == u)
      continue;
    const double jump = leaves(flux[t] - flux[u], along(sides.ends[s][0], sides.ends[s][1]));
    const double share = 0.5 * jump * jump / (conductivity[t] + conductivity[u]);
    eta2[t] += share;
    eta2[u] += share;
  }
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    if (flow_is_given[e])
    {
      const auto [i, j] = mesh.boundary[e];
      const std::size_t t = sides.touches[sides.between(i, j)][0];
      const Vec2 side = along(i, j);
      const double jump = leaves(flux[t], side) + given_flux[e] * side.norm();
      eta2[t] += jump * jump / conductivity[t];
    }
  return eta2;
}
} // namespace berm::seepage
