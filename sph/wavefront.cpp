// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/wavefront.h"

#include <algorithm>
#include <omp.h>
#include <thread>

namespace berm::sph
{
namespace
{
constexpr long smallest_strip = 8; // blocks: fewer are not worth the bookkeeping
// A strip takes some microseconds, as long as a thread looks whether it is done. A thread that
// waits longer offers its processor to others, and sleeps at last: the other thread may have lost
// its own.
constexpr int patience = 1000, last_look = 1300;
} // namespace

Wavefront::Wavefront(Index blocks, Index reach, long depth)
    : blocks_(blocks), strips_(std::max(1L, blocks / std::max(long{reach}, smallest_strip))),
      depth_(depth), done_(std::make_unique<Done[]>(static_cast<std::size_t>(strips_)))
{
}

std::size_t Wavefront::begin(long strip) const
{
  return static_cast<std::size_t>(strip * blocks_ / strips_); // none is shorter than the reach
}

/// Until a strip, if there is one, has taken all passes before this one.
void Wavefront::wait(long strip, long pass) const
{
  if (strip < 0 || strip >= strips_)
    return;
  const std::atomic<int>& done = done_[static_cast<std::size_t>(strip)].passes;
  int looks = 0;
  for (int now = done.load(std::memory_order_acquire); now < pass;
       now = done.load(std::memory_order_acquire))
    if (++looks > last_look)
      done.wait(now, std::memory_order_acquire);
    else if (looks > patience)
      std::this_thread::yield();
}

void Wavefront::run(long passes, const Work& work)
{
  for (long strip = 0; strip < strips_; ++strip)
    done_[static_cast<std::size_t>(strip)].passes.store(0, std::memory_order_relaxed);
#pragma omp parallel
  {
    // Strip s takes pass p when s-1, s and s+1 have taken pass p-1; s+1 cannot be farther than one
    // pass ahead, since it waits for s in turn. All threads go through the same order of work, each
    // with strips of its own that stay in its cache: the earliest piece left can always go on.
    const long threads = omp_get_num_threads(), me = omp_get_thread_num();
    const long gap = threads > 1 ? 2 : 1; // 2: a wave waits only for earlier ones
    for (long first = 0; first < passes; first += depth_)
    {
      const long levels = std::min(depth_, passes - first);
      for (long wave = 0; wave < strips_ + gap * (levels - 1); ++wave)
        for (long level = 0; level < levels; ++level)
        {
          const long strip = wave - gap * level, pass = first + level;
          if (strip < 0 || strip >= strips_ || strip % threads != me)
            continue;
          for (const long other : {strip - 1, strip, strip + 1})
            wait(other, pass);
          work(pass, begin(strip), begin(strip + 1));
          std::atomic<int>& done = done_[static_cast<std::size_t>(strip)].passes;
          done.store(static_cast<int>(pass) + 1, std::memory_order_release);
          if (threads > 1)
            done.notify_all();
        }
    }
  }
}
} // namespace berm::sph
