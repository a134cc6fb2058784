// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/result_json.h"
#include "app/study/child_processes.h"
#include "app/study/design.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace berm::app
{
/// What became of a member.
enum class MemberStatus
{
  not_run,
  complete,  ///< every answer that was asked for
  undecided, ///< ran to its end without one; would do so again
  stopped,   ///< on request, before its end
  failed     ///< no result: not converged, killed, files
};

[[nodiscard]] std::string_view to_string(MemberStatus status);

/// A member's row of the table: its result in a few numbers.
struct MemberResult
{
  MemberStatus status = MemberStatus::not_run;
  std::string reason;                      ///< why there is no answer; empty if there is one
  std::optional<double> factor, low, high; ///< only if the search is complete
  std::optional<double> stands, fails;
  std::optional<double> discharge, discharge_error; ///< [m2/s]
  std::optional<double> exit_y, phreatic_highest;   ///< [m]
  std::optional<double> mechanism_depth, run_out;   ///< [m]
  std::optional<double> seconds;                    ///< of processor time
  std::string mechanism;                            ///< "deep slide", "surface skin", or empty

  /// Nothing would change by running it again.
  [[nodiscard]] bool finished() const
  {
    return status == MemberStatus::complete || status == MemberStatus::undecided;
  }
};

/// A number of a MemberResult: name of its column, with the unit; unit; in words.
struct ResultColumn
{
  const char *name, *unit, *long_name;
  std::optional<double> MemberResult::*value;
};
/// @brief The columns of numbers, in the table's order.
[[nodiscard]] std::span<const ResultColumn> result_columns();

/// @brief A result.json in a few numbers.
[[nodiscard]] MemberResult summarise(const Json& result);

/// @brief What lies in a member's folder, if it is this member's: of the same case text, the same
/// --set and the same version of berm. Otherwise a row that says "not run".
[[nodiscard]] MemberResult stored_result(const std::filesystem::path& study, const Member& member,
                                         const std::string& case_text);

/// @brief After a child ended: what it stored, or why it stored nothing.
[[nodiscard]] MemberResult result_of(const ChildEnd& end, const std::filesystem::path& study,
                                     const Member& member, const std::string& case_text);
} // namespace berm::app
