// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/verlet_list.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

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
    inverse = 1 / size;
    x0 = size * std::floor(*x_lo * inverse); // the same cells with and without ghosts
    y0 = size * std::floor(*y_lo * inverse);
    nx = static_cast<Index>((*x_hi - x0) * inverse) + 1;
    ny = static_cast<Index>((*y_hi - y0) * inverse) + 1;
  }
  [[nodiscard]] Index cell(double x, double y) const
  {
    const Index cx = std::min(static_cast<Index>((x - x0) * inverse), nx - 1);
    const Index cy = std::min(static_cast<Index>((y - y0) * inverse), ny - 1);
    return cx * ny + cy;
  }
};

/// The points of a cell and of those around it, side by side, in whole blocks of four.
struct Candidates
{
  std::vector<double> x, y;
  std::vector<std::int64_t> index;
  std::vector<std::int64_t> inside; ///< of the circle asked for last: -1 or 0

  void clear()
  {
    x.clear();
    y.clear();
    index.clear();
  }
  void add(const double* from_x, const double* from_y, const Index* from, Index count)
  {
    x.insert(x.end(), from_x, from_x + count);
    y.insert(y.end(), from_y, from_y + count);
    index.insert(index.end(), from, from + count);
  }
  void fill_up()
  {
    const std::size_t whole = (x.size() + 3) / 4 * 4;
    x.resize(whole, std::numeric_limits<double>::infinity());
    y.resize(whole, std::numeric_limits<double>::infinity());
    index.resize(whole, -1);
    inside.resize(std::max(whole, inside.size()));
  }
  /// All but point i in the circle, to `out`, which has room for all; returns their number.
  std::size_t within(double x_i, double y_i, Index i, double radius2, Index* out)
  {
    using Mask = std::int64_t __attribute__((vector_size(32)));
    const std::int64_t self = i;
    const Mask skipped = {self, self, self, self};
    const Lanes x_0 = splat(x_i), y_0 = splat(y_i), r2 = splat(radius2);
    for (std::size_t k = 0; k < x.size(); k += 4)
    {
      const Lanes dx = x_0 - load<Lanes>(&x[k]), dy = y_0 - load<Lanes>(&y[k]);
      const Mask in = (dx * dx + dy * dy < r2) & (load<Mask>(&index[k]) != skipped);
      std::memcpy(&inside[k], &in, sizeof in);
    }
    std::int64_t found = 0;
    for (std::size_t k = 0; k < x.size(); ++k)
    {
      out[found] = static_cast<Index>(index[k]);
      found -= inside[k];
    }
    return static_cast<std::size_t>(found);
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
  nx_ = grid.nx;
  ny_ = grid.ny;
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
  Candidates candidates;
#pragma omp parallel for schedule(static) firstprivate(candidates)
  for (Index c = 0; c < chunks; ++c)
  {
    Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
    chunk.begin.assign(1, 0);
    std::size_t used = 0;
    Index cell = -1; // that the candidates lie around
    const Index end = std::min(n, (c + 1) * chunk_size);
    for (Index ii = c * chunk_size; ii < end; ++ii)
    {
      const auto i = static_cast<std::size_t>(ii);
      if (cell_[i] != cell)
      {
        cell = cell_[i];
        candidates.clear();
        const Index cx = cell / grid.ny, cy = cell % grid.ny;
        for (Index ax = std::max(cx - 1, 0); ax <= std::min(cx + 1, grid.nx - 1); ++ax)
        {
          // The cells of a column lie one after the other.
          const Index low = ax * grid.ny + std::max(cy - 1, 0);
          const Index high = ax * grid.ny + std::min(cy + 1, grid.ny - 1);
          const Index b = cell_begin_[static_cast<std::size_t>(low)];
          const Index e = cell_begin_[static_cast<std::size_t>(high) + 1];
          candidates.add(x_.data() + b, y_.data() + b, sorted_.data() + b, e - b);
        }
        candidates.fill_up();
      }
      if (chunk.index.size() < used + candidates.x.size() + 4)
        chunk.index.resize(2 * used + candidates.x.size() +
                           4 * 32 * static_cast<std::size_t>(chunk_size));
      used += candidates.within(x[i], y[i], ii, radius2, chunk.index.data() + used);
      while (used % 4 != 0)
        chunk.index[used++] = ii;
      chunk.begin.push_back(static_cast<Index>(used / 4));
    }
    chunk.pairs.resize(used / 4);
  }
}

double VerletList::closing(std::span<const double> x, std::span<const double> y)
{
  constexpr double inf = std::numeric_limits<double>::infinity();
  const Index cells = nx_ * ny_;
  box_.resize(static_cast<std::size_t>(cells));
  double most = 0, most2 = 0;
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (Index c = 0; c < cells; ++c)
    {
      Lanes box = splat(-inf);
      for (Index k = begin_of(c); k < begin_of(c + 1); ++k)
      {
        const auto at = static_cast<std::size_t>(k);
        const auto j = static_cast<std::size_t>(sorted_[at]);
        const double dx = x[j] - x_[at], dy = y[j] - y_[at];
        box = max(box, Lanes{-dx, -dy, dx, dy});
      }
      box_[static_cast<std::size_t>(c)] = box;
    }
    // Every two cells once. Points two cells apart in x were farther apart than the radius along x,
    // and come nearer only along x; points three cells apart stay too far.
#pragma omp for schedule(static) reduction(max : most, most2)
    for (Index c = 0; c < cells; ++c)
    {
      if (begin_of(c) == begin_of(c + 1))
        continue;
      const Index cx = c / ny_, cy = c % ny_;
      const Lanes a = box_[static_cast<std::size_t>(c)];
      for (Index bx = cx; bx <= std::min(cx + 2, nx_ - 1); ++bx)
        for (Index by = bx == cx ? cy : std::max(cy - 2, 0); by <= std::min(cy + 2, ny_ - 1); ++by)
        {
          const Lanes b = box_[static_cast<std::size_t>(bx * ny_ + by)];
          if (bx < cx + 2 && std::abs(by - cy) < 2)
          {
            const Lanes both = max(a, b);
            const double width = both[0] + both[2], height = both[1] + both[3];
            most2 = std::max(most2, width * width + height * height);
            continue;
          }
          const double along_x = bx == cx + 2 ? a[2] + b[0] : inf;
          const double along_y = by == cy + 2 ? a[3] + b[1] : by == cy - 2 ? b[3] + a[1] : inf;
          most = std::max(most, std::min(along_x, along_y));
        }
    }
  }
  return std::max(most, std::sqrt(most2));
}
} // namespace berm::sph
