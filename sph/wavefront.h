// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>

namespace berm::sph
{
/// Takes a chain of blocks through passes in which a block reads what others within `reach` wrote
/// in the pass before, several passes at a time: a strip of blocks that is in the cache takes its
/// next passes before it leaves. Every block finds the values that it would find if all blocks took
/// each pass together, so results do not depend on the number of threads, to the last bit.
class Wavefront
{
public:
  /// @param[in] blocks  Length of the chain.
  /// @param[in] reach   A block reads and writes nothing of blocks farther away than this.
  /// @param[in] depth   Passes at a time, >= 1.
  Wavefront(Index blocks, Index reach, long depth);

  /// One pass of blocks begin .. end-1. It may write what the next pass reads, and what belongs to
  /// these blocks alone; it may read what the pass before wrote, within the reach.
  using Work = std::function<void(long pass, std::size_t begin, std::size_t end)>;

  /// @brief Take every block through passes 0 .. passes - 1, fewer than 2^31. Nothing is allocated.
  void run(long passes, const Work& work);

private:
  struct alignas(64) Done // a cache line each: threads do not disturb each other
  {
    std::atomic<int> passes = 0;
  };
  [[nodiscard]] std::size_t begin(long strip) const;
  void wait(long strip, long pass) const;

  long blocks_, strips_, depth_;
  std::unique_ptr<Done[]> done_;
};
} // namespace berm::sph
