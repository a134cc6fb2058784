// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/analysis.h"

#include <string>
#include <vector>

namespace berm::app
{
/// A row of the report.
struct ReportRow
{
  std::string label, text;
};

/// @brief A point for people, to the centimetre [m]: "(1.50, 2.00)".
[[nodiscard]] std::string point_text(const Vec2& p);

/// @brief Lines, exit gradients and heave, for the report's part on seepage.
/// Pre: there was a seepage solve.
[[nodiscard]] std::vector<ReportRow> reading_rows(const coupling::Case& input,
                                                  const coupling::Analysis& analysis);
} // namespace berm::app
