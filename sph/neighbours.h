// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

#include <cstdint>
#include <span>
#include <vector>

namespace berm::sph
{
/// Neighbours of each point in compressed rows, sorted by index, the point itself left out.
struct NeighbourList
{
  std::vector<std::int64_t>
      begin; ///< row i is index[begin[i]] .. index[begin[i + 1]], shape (n + 1)
  std::vector<Index> index;

  [[nodiscard]] std::span<const Index> of(Index i) const
  {
    const auto b = static_cast<std::size_t>(begin[static_cast<std::size_t>(i)]);
    const auto e = static_cast<std::size_t>(begin[static_cast<std::size_t>(i) + 1]);
    return {index.data() + b, e - b};
  }
};

/// @brief All points closer than `radius`, for the first `n` of the points. Cell grid, O(points).
/// @param[in] x, y    Positions [m], shape (m) each, m >= n.
/// @param[in] radius  [m], > 0; a pair at exactly this distance is left out.
[[nodiscard]] NeighbourList find_neighbours(std::span<const double> x, std::span<const double> y,
                                            Index n, double radius);
} // namespace berm::sph
