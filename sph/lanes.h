// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstring>

/// Four doubles side by side, in the compiler's generic vectors.
namespace berm::sph
{
using Lanes = double __attribute__((vector_size(32)));

[[nodiscard]] inline Lanes splat(double v)
{
  return Lanes{v, v, v, v};
}
/// Four values from memory, aligned or not.
template <class Four>
[[nodiscard]] inline Four load(const void* from)
{
  Four v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
[[nodiscard]] inline double sum(const Lanes& v)
{
  return (v[0] + v[1]) + (v[2] + v[3]);
}
[[nodiscard]] inline double largest(const Lanes& v)
{
  const double a = v[0] > v[1] ? v[0] : v[1], b = v[2] > v[3] ? v[2] : v[3];
  return a > b ? a : b;
}
[[nodiscard]] inline Lanes max(const Lanes& a, const Lanes& b)
{
  return a > b ? a : b;
}
[[nodiscard]] inline Lanes sqrt(const Lanes& v)
{
  return Lanes{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
}

/// Component c of four records becomes lane by lane the vector component[c].
struct Transposed
{
  Lanes component[4];
};
[[nodiscard]] inline Transposed transpose(const Lanes& a, const Lanes& b, const Lanes& c,
                                          const Lanes& d)
{
  const Lanes ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Lanes ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Lanes cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return {{__builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5),
           __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5),
           __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7),
           __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7)}};
}
} // namespace berm::sph
