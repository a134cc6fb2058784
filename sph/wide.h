// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

/// As many doubles as one instruction of the target works on, in the compiler's generic vectors.
namespace berm::sph
{
#if defined(__AVX512F__)
inline constexpr std::size_t wide_lanes = 8;
#elif defined(__AVX__)
inline constexpr std::size_t wide_lanes = 4;
#else
inline constexpr std::size_t wide_lanes = 2;
#endif
using Wide = double __attribute__((vector_size(wide_lanes * sizeof(double))));

[[nodiscard]] inline Wide wide(double value)
{
  return value - Wide{};
}
/// `wide_lanes` values from memory, aligned or not.
[[nodiscard]] inline Wide load_wide(const double* from)
{
  Wide v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store_wide(double* to, const Wide& v)
{
  std::memcpy(to, &v, sizeof v);
}
[[nodiscard]] inline Wide square_root(const Wide& v)
{
  Wide root;
  for (std::size_t l = 0; l < wide_lanes; ++l)
    root[l] = std::sqrt(v[l]);
  return root;
}
[[nodiscard]] inline Wide abs(const Wide& v)
{
  return v < 0 ? -v : v;
}
/// -1, 0 or 1 in each lane.
[[nodiscard]] inline Wide sign(const Wide& v)
{
  return v > 0 ? wide(1) : v < 0 ? wide(-1) : wide(0);
}
[[nodiscard]] inline double sum_of_lanes(const Wide& v)
{
  double total = 0;
  for (std::size_t l = 0; l < wide_lanes; ++l)
    total += v[l];
  return total;
}
} // namespace berm::sph
