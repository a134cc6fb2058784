// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/result_json.h"
#include "app/study/design.h"
#include "app/study/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace berm::app
{
/// What makes a study the one that it is, and its results so far.
struct Study
{
  std::string title, case_path, case_text;
  std::vector<std::string> overrides; ///< of --set
  std::vector<Variation> variations;
  Design design = Design::grid;
  bool seepage_only = false;
  bool figures = true; ///< whether to draw it
  std::vector<std::string> figure_formats{"png"};
  bool report = true; ///< whether to write its page
  std::vector<Member> members;
  std::vector<MemberResult> results; ///< one for each member
};

/// @brief The contract for scripts: docs/output_format.md, study.json.
[[nodiscard]] Json study_json(const Study& study);

/// @brief The table as CSV (RFC 4180), a row a member; empty where there is no value.
[[nodiscard]] std::string study_csv(const Study& study);

/// @brief The table as aligned text for a terminal.
[[nodiscard]] std::string study_report(const Study& study);

/// @brief One member in a few words: "F = 1.612 (+- 0.005), q = 3.3e-07 m2/s", or why not.
[[nodiscard]] std::string answer_text(const MemberResult& result);

/// @brief Write case.toml, study.csv, study.h5 and, last, study.json; each aside, then renamed.
/// @throws IoError if one cannot be written.
void write_study(const std::filesystem::path& directory, const Study& study);

/// @brief In what the study in a directory differs from this one: "the case file", "--vary", ...;
/// empty if in nothing, or if the directory holds none. Neither paths nor berm's version count.
/// @param[in] stored  Its study.json; null if there is none.
[[nodiscard]] std::vector<std::string> differences(const Study& study, const Json& stored,
                                                   const std::string& stored_case_text);
} // namespace berm::app
