// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <vector>

/// THE SIGN CONVENTION, for every module: stress is positive in tension, pore pressure is positive
/// in compression, sigma = sigma' - p_w I; x points right, y up; SI units and radians inside.
namespace berm
{
using Vec2 = Eigen::Vector2d;
using Polyline =
    std::vector<Vec2>;      ///< points in order [m]; a polygon when said so (not closed twice)
using Index = std::int32_t; ///< index of a particle, node, triangle

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double gravity = 9.81;             ///< [m/s2]
inline constexpr double water_unit_weight = 9810.0; ///< gamma_w [N/m3]

/// Symmetric stress or strain in plane strain: xz and yz vanish, zz is carried.
struct SymTensor
{
  double xx = 0, yy = 0, zz = 0, xy = 0;
};

[[nodiscard]] inline SymTensor operator+(const SymTensor& a, const SymTensor& b)
{
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy};
}
[[nodiscard]] inline SymTensor operator*(double s, const SymTensor& a)
{
  return {s * a.xx, s * a.yy, s * a.zz, s * a.xy};
}

/// First invariant [unit of a]: the trace.
[[nodiscard]] inline double I1(const SymTensor& a)
{
  return a.xx + a.yy + a.zz;
}

/// Second invariant of the deviator [unit of a, squared]: s:s / 2.
[[nodiscard]] inline double J2(const SymTensor& a)
{
  const double p = I1(a) / 3;
  const double sx = a.xx - p, sy = a.yy - p, sz = a.zz - p;
  return 0.5 * (sx * sx + sy * sy + sz * sz) + a.xy * a.xy;
}
} // namespace berm
