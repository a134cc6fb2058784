// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/analysis.h"

#include <string>
#include <vector>

namespace berm::app
{
/// @brief What is legal in a case and still hardly meant, a sentence each: particles too few to see
/// a slope, more dilation than the reduced friction, soil without strength, zones that the water
/// does not see, pools and boundaries without effect. The run goes on.
[[nodiscard]] std::vector<std::string> doubts(const coupling::Case& input);

/// @brief The same of a result: a slope that does not stand as it is. Empty if there is none.
[[nodiscard]] std::string doubt_of(const coupling::Analysis& analysis);
} // namespace berm::app
