// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/case.h"
#include "coupling/work_store.h"

#include <filesystem>
#include <string>
#include <vector>

namespace berm::app
{
/// Finished pieces of a run as files, checkpoint/NAME in the directory of its results: each is
/// written aside, then renamed, and carries its own SHA-256 and that of the case. They go once the
/// run is over.
class Checkpoint final : public coupling::WorkStore
{
public:
  /// @param[in] directory  Of the results; made already.
  Checkpoint(const std::filesystem::path& directory, const coupling::Case& input);

  /// Where the frames of a run-out are kept.
  [[nodiscard]] std::filesystem::path frames() const { return folder_ / "run_out"; }
  /// @throws InputError if there is work to go on from, but on another case or of another berm.
  void require_same() const;
  /// @brief Before anything is computed, on one rank: drop what is there, unless the run goes on
  /// from it, and note the case.
  /// @throws IoError.
  void begin(bool resume);
  /// @brief The run is over: nothing is left to go on from.
  void remove();

  /// Nothing if it is not there, or damaged.
  [[nodiscard]] std::optional<std::string> kept(const std::string& name) override;
  void keep(const std::string& name, const std::string& bytes) override;

private:
  std::filesystem::path folder_;
  std::string case_path_;
  std::vector<std::string> overrides_;
  std::string identity_; ///< SHA-256 of what the work is a function of, 64 digits
};

/// Whose work a directory holds.
struct StoppedRun
{
  std::string case_path;
  std::vector<std::string> overrides;
};

/// @brief The run that was stopped or killed in a directory.
/// @throws InputError if there is none.
[[nodiscard]] StoppedRun stopped_run(const std::filesystem::path& directory);
} // namespace berm::app
