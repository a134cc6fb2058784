// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace berm
{
/// Processes that run the same analysis side by side and share the trials of a search.
/// This one is a process on its own; what starts several of them supplies the team.
class Team
{
public:
  Team() = default;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  virtual ~Team() = default;

  [[nodiscard]] virtual int size() const { return 1; }
  [[nodiscard]] virtual int rank() const { return 0; }
  /// The bytes of every rank, in the ranks' order. All must call it; it waits for the slowest.
  [[nodiscard]] virtual std::vector<std::string> gather(std::string mine)
  {
    return {std::move(mine)};
  }

  /// Whether it is so on any rank. All must call it, as above.
  [[nodiscard]] bool any(bool mine)
  {
    const std::vector<std::string> all = gather(mine ? "1" : "0");
    return std::find(all.begin(), all.end(), "1") != all.end();
  }
};
} // namespace berm
