// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/verlet_list.h"

#include <algorithm>
#include <cmath>

namespace berm::sph
{
namespace
{
/// Square cells over the bounding box; larger than asked for where soil is spread thinly.
struct Grid
{
  double x0 = 0, y0 = 0, inverse = 1;
  Index nx = 1, ny = 1;

  Grid(std::span<const double> x, std::span<const double> y, double size)
  {
    const auto [x_lo, x_hi] = std::minmax_element(x.begin(), x.end());
    const auto [y_lo, y_hi] = std::minmax_element(y.begin(), y.end());
    const double width = *x_hi - *x_lo, height = *y_hi - *y_lo;
    const double most = 4 * static_cast<double>(x.size()) + 64; // cells
    while ((width / size + 1) * (height / size + 1) > most)
      size *= 1.5;
    x0 = *x_lo;
    y0 = *y_lo;
    inverse = 1 / size;
    nx = static_cast<Index>(width * inverse) + 1;
    ny = static_cast<Index>(height * inverse) + 1;
  }
  [[nodiscard]] Index cell(double x, double y) const
  {
    const Index cx = std::min(static_cast<Index>((x - x0) * inverse), nx - 1);
    const Index cy = std::min(static_cast<Index>((y - y0) * inverse), ny - 1);
    return cx * ny + cy;
  }
};

/// Counting sort: count, scan, place.
void sort_by_cell(std::span<const double> x, std::span<const double> y, const Grid& grid,
                  std::vector<Index>& cell, std::vector<Index>& begin, std::vector<Index>& sorted)
{
  const std::size_t n = x.size();
  begin.assign(static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny) + 2, 0);
  cell.resize(n);
  sorted.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    cell[i] = grid.cell(x[i], y[i]);
    ++begin[static_cast<std::size_t>(cell[i]) + 2];
  }
  for (std::size_t c = 2; c < begin.size(); ++c)
    begin[c] += begin[c - 1];
  for (std::size_t i = 0; i < n; ++i)
    sorted[static_cast<std::size_t>(begin[static_cast<std::size_t>(cell[i]) + 1]++)] =
        static_cast<Index>(i);
}
} // namespace

std::vector<Index> order_by_cell(std::span<const double> x, std::span<const double> y,
                                 double cell_size)
{
  std::vector<Index> cell, begin, sorted;
  if (!x.empty())
    sort_by_cell(x, y, Grid(x, y, cell_size), cell, begin, sorted);
  return sorted;
}

void VerletList::build(std::span<const double> x, std::span<const double> y, Index n, double radius)
{
  const Grid grid(x, y, radius);
  sort_by_cell(x, y, grid, cell_, cell_begin_, sorted_);
  x_.resize(x.size());
  y_.resize(x.size());
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    x_[k] = x[static_cast<std::size_t>(sorted_[k])];
    y_[k] = y[static_cast<std::size_t>(sorted_[k])];
  }

  const Index chunks = (n + chunk_size - 1) / chunk_size;
  chunks_.resize(static_cast<std::size_t>(chunks));
  const double radius2 = radius * radius;
#pragma omp parallel for schedule(static)
  for (Index c = 0; c < chunks; ++c)
  {
    Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
    chunk.begin.assign(1, 0);
    std::size_t used = 0;
    const Index end = std::min(n, (c + 1) * chunk_size);
    for (Index ii = c * chunk_size; ii < end; ++ii)
    {
      const auto i = static_cast<std::size_t>(ii);
      const double x_i = x[i], y_i = y[i];
      const Index cx = cell_[i] / grid.ny, cy = cell_[i] % grid.ny;
      for (Index ax = std::max(cx - 1, 0); ax <= std::min(cx + 1, grid.nx - 1); ++ax)
      {
        // The cells of a column lie one after the other.
        const Index low = ax * grid.ny + std::max(cy - 1, 0);
        const Index high = ax * grid.ny + std::min(cy + 1, grid.ny - 1);
        const auto b = static_cast<std::size_t>(cell_begin_[static_cast<std::size_t>(low)]);
        const auto e = static_cast<std::size_t>(cell_begin_[static_cast<std::size_t>(high) + 1]);
        if (chunk.index.size() < used + (e - b) + 4)
          chunk.index.resize(2 * used + (e - b) + 4 * 32 * static_cast<std::size_t>(chunk_size));
        Index* out = chunk.index.data();
        for (std::size_t k = b; k < e; ++k)
        {
          const double dx = x_i - x_[k], dy = y_i - y_[k];
          out[used] = sorted_[k];
          used += static_cast<std::size_t>((dx * dx + dy * dy < radius2) & (sorted_[k] != ii));
        }
      }
      while (used % 4 != 0)
        chunk.index[used++] = ii;
      chunk.begin.push_back(static_cast<Index>(used / 4));
    }
    chunk.pairs.resize(used / 4);
  }
}
} // namespace berm::sph
