// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "coupling/analysis.h"
#include "sph/moving_walls.h"
#include "sph/neighbours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

/// Whether what a solver computed can be soil at all.
namespace berm::tests
{
/// @brief How far the stress alternates from particle to particle [-].
/// rms of I1 less the linear fit through its neighbours within 1.6 dx, over the rms of I1, for
/// particles two layers and more away from every border. Zero where stress is linear, on any
/// packing; a / m for a checkerboard of +-a around m, 1.5 a / m for stripes.
inline double checkerboard(std::span<const double> x, std::span<const double> y,
                           std::span<const SymTensor> stress, double dx)
{
  const auto n = static_cast<Index>(x.size());
  const sph::NeighbourList near = sph::find_neighbours(x, y, n, 1.6 * dx);
  const auto full = [&](Index i) { return near.of(i).size() >= 7; };
  double alternating = 0, all = 0;
  for (Index ii = 0; ii < n; ++ii)
  {
    const auto i = static_cast<std::size_t>(ii);
    const auto row = near.of(ii);
    if (!full(ii) || !std::all_of(row.begin(), row.end(), full))
      continue;
    // Least squares: the value at i of the plane through the neighbours.
    double m = 0, sx = 0, sy = 0, sf = 0, xx = 0, xy = 0, yy = 0, xf = 0, yf = 0;
    for (const Index jj : row)
    {
      const auto j = static_cast<std::size_t>(jj);
      const double rx = x[j] - x[i], ry = y[j] - y[i], f = I1(stress[j]);
      m += 1;
      sx += rx, sy += ry, sf += f;
      xx += rx * rx, xy += rx * ry, yy += ry * ry;
      xf += rx * f, yf += ry * f;
    }
    xx -= sx * sx / m, xy -= sx * sy / m, yy -= sy * sy / m;
    xf -= sx * sf / m, yf -= sy * sf / m;
    const double det = xx * yy - xy * xy;
    const double gx = (yy * xf - xy * yf) / det, gy = (xx * yf - xy * xf) / det;
    const double fit = (sf - gx * sx - gy * sy) / m, here = I1(stress[i]);
    alternating += (here - fit) * (here - fit);
    all += here * here;
  }
  return std::sqrt(alternating / all);
}

/// Looks at every frame of a run-out as it comes. Values that are not finite throw by themselves.
class SoundRunOut : public coupling::RunOutStore
{
public:
  explicit SoundRunOut(const meshes::Section& section) : walls_(sph::moving_walls(section)) {}

  void keep(const sph::Frame& frame) override
  {
    const sph::State& s = frame.state;
    for (std::size_t i = 0; i < s.x.size(); ++i)
    {
      least_height = std::min(least_height, s.y[i] - sph::base_line(walls_, s.x[i]).at(s.x[i]));
      if (walls_.left)
        least_height = std::min(least_height, s.x[i] - *walls_.left);
      if (walls_.right)
        least_height = std::min(least_height, *walls_.right - s.x[i]);
    }
    const sph::Energies& e = frame.energies;
    if (frame.number == 0)
      start_ = e.total();
    drift = std::max(drift, std::abs(e.total() - start_));
    most_kinetic = std::max(most_kinetic, e.kinetic);
    plastic = e.plastic;
  }

  double least_height = std::numeric_limits<double>::max(); ///< over base and sides [m]
  double drift = 0;                                         ///< of the energy balance [J/m]
  double most_kinetic = 0;                                  ///< [J/m]
  double plastic = 0;                                       ///< dissipated at the end [J/m]

private:
  sph::MovingWalls walls_;
  double start_ = 0;
};
} // namespace berm::tests
