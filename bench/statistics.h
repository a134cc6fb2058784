// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <fmt/core.h>
#include <string>
#include <vector>

/// How benches print repeated measurements.
namespace berm::bench
{
inline double median(std::vector<double> v)
{
  std::sort(v.begin(), v.end());
  return 0.5 * (v[v.size() / 2] + v[(v.size() - 1) / 2]);
}

/// "median (least-most)"
inline std::string spread(const std::vector<double>& v, int digits)
{
  const auto [least, most] = std::minmax_element(v.begin(), v.end());
  return fmt::format("{:.{}f} ({:.{}f}-{:.{}f})", median(v), digits, *least, digits, *most, digits);
}
} // namespace berm::bench
