// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/refinement.h"

#include "meshes/refine.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace berm::seepage
{
namespace
{
constexpr double marked_share = 0.6; ///< of the sum, in the triangles that are cut at a time

double sum(const std::vector<double>& v)
{
  return std::accumulate(v.begin(), v.end(), 0.0);
}

/// The fewest triangles that hold marked_share of the sum.
std::vector<std::uint8_t> largest_of(const std::vector<double>& eta2)
{
  std::vector<std::size_t> order(eta2.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t t) { return eta2[t]; });
  std::vector<std::uint8_t> marked(eta2.size(), 0);
  double rest = marked_share * sum(eta2);
  for (std::size_t k = 0; k < order.size() && rest > 0; ++k)
  {
    marked[order[k]] = 1;
    rest -= eta2[order[k]];
  }
  return marked;
}
} // namespace

NextMesh next_mesh(meshes::TriangleMesh mesh, std::vector<double> indicator, CoarserField solution,
                   std::size_t most)
{
  const double goal = indicator_share_left * sum(indicator);
  while (sum(indicator) > goal && mesh.nodes.size() < most)
  {
    meshes::RefinedMesh finer = meshes::refined(mesh, largest_of(indicator));
    meshes::prolong(finer, solution.p);
    meshes::prolong(finer, solution.eps);
    // eq. (2.16): the fourth power of the size, so that each of k parts has 1 / k^2.
    std::vector<double> parts(mesh.triangles.size(), 0);
    for (const Index t : finer.origin)
      parts[static_cast<std::size_t>(t)] += 1;
    std::vector<double> expected;
    expected.reserve(finer.origin.size());
    for (const Index t : finer.origin)
    {
      const auto k = static_cast<std::size_t>(t);
      expected.push_back(indicator[k] / (parts[k] * parts[k]));
    }
    indicator = std::move(expected);
    mesh = std::move(finer.mesh);
  }
  return {std::move(mesh), std::move(solution)};
}
} // namespace berm::seepage
