// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/neighbours.h"

#include <algorithm>
#include <cmath>

namespace berm::sph
{
NeighbourList find_neighbours(std::span<const double> x, std::span<const double> y, Index n,
                              double radius)
{
  NeighbourList list;
  list.begin.push_back(0);
  if (x.empty())
    return list;

  // Count, scan, place: points sorted by cell, in their own order inside a cell.
  const auto x_ends = std::minmax_element(x.begin(), x.end());
  const auto y_ends = std::minmax_element(y.begin(), y.end());
  const double x_lo = *x_ends.first, x_hi = *x_ends.second;
  const double y_lo = *y_ends.first, y_hi = *y_ends.second;
  const auto cells_along = [&](double extent)
  { return static_cast<std::size_t>(std::floor(extent / radius)) + 1; };
  const std::size_t nx = cells_along(x_hi - x_lo), ny = cells_along(y_hi - y_lo);
  const auto cell_of = [&](double value, double low)
  { return static_cast<std::size_t>((value - low) / radius); };
  const auto cell = [&](std::size_t i)
  { return std::min(cell_of(x[i], x_lo), nx - 1) * ny + std::min(cell_of(y[i], y_lo), ny - 1); };
  std::vector<std::size_t> start(nx * ny + 1, 0);
  for (std::size_t i = 0; i < x.size(); ++i)
    ++start[cell(i) + 1];
  for (std::size_t c = 0; c < nx * ny; ++c)
    start[c + 1] += start[c];
  std::vector<Index> sorted(x.size());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < x.size(); ++i)
    sorted[next[cell(i)]++] = static_cast<Index>(i);

  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
  {
    const std::size_t cx = cell(i) / ny, cy = cell(i) % ny;
    const std::size_t row = list.index.size();
    for (std::size_t ax = cx > 0 ? cx - 1 : 0; ax <= std::min(cx + 1, nx - 1); ++ax)
      for (std::size_t ay = cy > 0 ? cy - 1 : 0; ay <= std::min(cy + 1, ny - 1); ++ay)
        for (std::size_t s = start[ax * ny + ay]; s < start[ax * ny + ay + 1]; ++s)
        {
          const auto j = static_cast<std::size_t>(sorted[s]);
          const double dx = x[i] - x[j], dy = y[i] - y[j];
          if (j != i && dx * dx + dy * dy < radius * radius)
            list.index.push_back(sorted[s]);
        }
    std::sort(list.index.begin() + static_cast<std::ptrdiff_t>(row), list.index.end());
    list.begin.push_back(static_cast<std::int64_t>(list.index.size()));
  }
  return list;
}
} // namespace berm::sph
