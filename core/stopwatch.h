// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <ctime>

namespace berm
{
/// Seconds that a stage took: on the wall, and on the processor (all threads of this process).
struct Seconds
{
  double wall = 0;
  double cpu = 0;
};

/// Measures from its construction.
class Stopwatch
{
public:
  [[nodiscard]] Seconds elapsed() const
  {
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(),
            process_cpu() - cpu_};
  }

private:
  static double process_cpu()
  {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  double cpu_ = process_cpu();
};
} // namespace berm
