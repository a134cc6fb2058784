// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "core/stopwatch.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace berm::app
{
/// @brief From here on SIGINT and SIGTERM ask the run to stop; a second one kills the process.
void catch_stop_signals();

/// How much a run tells.
enum class Volume
{
  quiet,   ///< nothing
  normal,  ///< stages, notes, warnings, progress
  verbose, ///< details as well, such as each Newton step
};

/// Tells on a stream how a run goes: a bar with the time left on a terminal, plain lines elsewhere.
/// A log file gets everything but the progress, each line with the seconds since the start.
class Console final : public Observer
{
public:
  /// @param[in] stream    Usually stderr, so that stdout holds the report alone.
  /// @param[in] terminal  Whether a line may be drawn over.
  /// @param[in] log       File to write to as the run goes on; empty: none.
  /// @throws IoError if the log cannot be opened.
  Console(std::FILE* stream, bool terminal, Volume volume, const std::filesystem::path& log = {});
  ~Console() override;

  void stage(std::string_view name) override;
  void note(std::string_view text) override;
  void detail(std::string_view text) override;
  void warn(std::string_view text) override;
  void progress(double fraction, std::string_view text) override;
  [[nodiscard]] bool stop_requested() const override;

  /// Everything that was warned of, for the report.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

private:
  void clear_bar();
  void line(std::string_view text, Volume from = Volume::normal);

  std::FILE* stream_;
  bool terminal_;
  Volume volume_;
  std::ofstream log_;
  Stopwatch watch_;
  bool bar_shown_ = false;
  std::string stage_;
  Stopwatch stage_watch_;
  double last_shown_ = -1e9; ///< of stage_watch_ [s]
  std::vector<std::string> warnings_;
};

/// @brief A duration for people: "8 s", "3 min 20 s", "2 h 05 min".
[[nodiscard]] std::string duration_text(double seconds);
} // namespace berm::app
