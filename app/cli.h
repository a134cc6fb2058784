// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/mistakes.h"

namespace berm::app
{
/// What the shell is told.
enum ExitCode : int
{
  exit_ok = 0,
  exit_bug = 1,       ///< ours
  exit_bad_input = 2, ///< command line or case file
  exit_no_answer = 3, ///< not converged, undecided, NaN, or stopped on request
  exit_files = 4      ///< a file cannot be read or written
};

/// @brief Parse the command line and do what it says.
/// @param[out] places  Where the case file says what, for messages about errors that are thrown.
/// @return The exit code. Prints a report to stdout, progress to stderr.
[[nodiscard]] int run_command_line(int argc, const char* const* argv, KeyPlaces& places);
} // namespace berm::app
