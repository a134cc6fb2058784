// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "core/stopwatch.h"

#include <cstdio>
#include <string>
#include <vector>

namespace berm::app
{
/// @brief From here on SIGINT and SIGTERM ask the run to stop; a second one kills the process.
void catch_stop_signals();

/// Tells on a stream how a run goes: a bar with the time left on a terminal, plain lines in a log.
class Console final : public Observer
{
public:
  /// @param[in] stream    Usually stderr, so that stdout holds the report alone.
  /// @param[in] terminal  Whether a line may be drawn over.
  Console(std::FILE* stream, bool terminal, bool quiet);
  ~Console() override;

  void stage(std::string_view name) override;
  void note(std::string_view text) override;
  void warn(std::string_view text) override;
  void progress(double fraction, std::string_view text) override;
  [[nodiscard]] bool stop_requested() const override;

  /// Everything that was warned of, for the report.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

private:
  void clear_bar();
  void line(std::string_view text);

  std::FILE* stream_;
  bool terminal_, quiet_;
  bool bar_shown_ = false;
  std::string stage_;
  Stopwatch stage_watch_;
  double last_shown_ = -1e9; ///< of stage_watch_ [s]
  std::vector<std::string> warnings_;
};

/// @brief A duration for people: "8 s", "3 min 20 s", "2 h 05 min".
[[nodiscard]] std::string duration_text(double seconds);
} // namespace berm::app
