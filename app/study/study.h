// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/mistakes.h"
#include "app/study/design.h"

#include <string>
#include <vector>

namespace berm::app
{
/// What `berm study` is told.
struct StudyOptions
{
  std::string case_path;
  std::vector<std::string> vary, overrides;
  Design design = Design::grid;
  bool seepage_only = false;
  std::string out;       ///< empty: default_directory with "_study"
  std::string reference; ///< CSV of points to draw the results over; may be empty
  int jobs = 0;       ///< members at a time, of each rank; 0: number of processors, or one a rank
  bool fresh = false; ///< forget what the directory holds
  bool check = false; ///< list the members; run nothing
  bool quiet = false;
};

/// @brief Run a case again and again with other values: each member a process of its own, what is
/// there already not again, a table and figures at the end. The ranks of mpirun share the members.
/// @return exit_ok if every member is complete, exit_no_answer if not, exit_bad_input after every
///         mistake of every member was told (nothing is run then).
/// @throws InputError for mistakes of the study itself; IoError.
[[nodiscard]] int run_study(const StudyOptions& options, KeyPlaces& places);
} // namespace berm::app
