// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace berm::coupling
{
/// Keeps what is dear to compute (settled soil, trials), so that a run that was stopped or killed
/// need not compute it twice. This one keeps nothing; what writes files supplies another.
/// All that is kept is a function of the case, in the bits of this machine: whoever keeps it sees
/// that the case is the same.
class WorkStore
{
public:
  WorkStore() = default;
  WorkStore(const WorkStore&) = delete;
  WorkStore& operator=(const WorkStore&) = delete;
  virtual ~WorkStore() = default;

  /// @param[in] name  Of letters, digits, '_', '.', '+', '-': the same for the same piece of work.
  [[nodiscard]] virtual std::optional<std::string> kept(const std::string& /*name*/)
  {
    return std::nullopt;
  }
  /// Called as soon as a piece is done.
  virtual void keep(const std::string& /*name*/, const std::string& /*bytes*/) {}
};
} // namespace berm::coupling
