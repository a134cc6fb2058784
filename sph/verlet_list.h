// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "sph/lanes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace berm::sph
{
/// What one pass over four pairs leaves for the next.
struct PairBlock
{
  Lanes gx, gy; ///< m_j grad_i W_ij [kg/m3]
  Lanes q;      ///< r / h [-]
};

/// Neighbours of each particle in rows of whole blocks of four, for positions that change a little
/// before the list is made again. A row is filled up with the particle itself, whose pair has no
/// gradient. Rows are kept in chunks of particles; chunks, not threads, own the memory, so that
/// list and sums do not depend on how many threads there are.
class VerletList
{
public:
  static constexpr Index chunk_size = 128;

  struct Row
  {
    const Index* index; ///< 4 * blocks of them
    PairBlock* pairs;
    Index blocks;
  };

  /// @brief All points within `radius` of each of the first n. Cell grid, O(points).
  /// @param[in] x, y  Positions [m], shape (points) each.
  void build(std::span<const double> x, std::span<const double> y, Index n, double radius);

  /// @brief How much nearer any two points farther apart than `radius` have come since build().
  /// A bound, from a box around the ways of each cell's points: soil that moves as one comes no
  /// nearer. Points more than two cells apart are left out. Cost O(points), a fifth of build().
  /// @param[in] x, y  Where the points of build() are now [m].
  [[nodiscard]] double closing(std::span<const double> x, std::span<const double> y);

  [[nodiscard]] Row row(Index i)
  {
    Chunk& c = chunks_[static_cast<std::size_t>(i / chunk_size)];
    const auto k = static_cast<std::size_t>(i % chunk_size);
    const Index b = c.begin[k];
    return {c.index.data() + 4 * b, c.pairs.data() + b, c.begin[k + 1] - b};
  }

private:
  struct Chunk
  {
    std::vector<Index> index;
    std::vector<PairBlock> pairs;
    std::vector<Index> begin; ///< first block of each row, shape (chunk_size + 1)
  };

  [[nodiscard]] Index begin_of(Index cell) const
  {
    return cell_begin_[static_cast<std::size_t>(cell)];
  }

  std::vector<Chunk> chunks_;
  Index nx_ = 0, ny_ = 0; ///< cells
  std::vector<Index> cell_begin_, sorted_, cell_;
  std::vector<Lanes> box_;    ///< of each cell's ways: -min x, -min y, max x, max y [m]
  std::vector<double> x_, y_; ///< in the order of the cells
};

/// @brief Order of the points by grid cell, in their own order inside a cell.
[[nodiscard]] std::vector<Index> order_by_cell(std::span<const double> x, std::span<const double> y,
                                               double cell_size);
} // namespace berm::sph
