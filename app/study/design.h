// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/study/variation.h"

#include <string>
#include <string_view>
#include <vector>

namespace berm::app
{
/// How the members of a study come from what is varied.
enum class Design
{
  grid,         ///< every combination; the last variation changes fastest
  pairs,        ///< the first values of all variations, the second ones, ...
  one_at_a_time ///< the case as it is, then one variation at a time, the others as in the case
};

/// @brief "grid", "pairs", "one-at-a-time".
[[nodiscard]] std::string_view to_string(Design design);

/// One run of a study.
struct Member
{
  std::string folder;                 ///< "members/003_cohesion_kPa_10"
  std::vector<std::string> overrides; ///< of --set, those of the whole study first
  std::vector<std::string> values;    ///< one for each variation
  std::vector<bool> varied;           ///< false: the case's own value (one at a time)
};

/// @brief The members of a study, in the order in which they are listed and started.
/// @param[in] fixed  The texts of --set, for all members.
/// @param[in] base   The case's own value of each variation, for the design that has a base.
/// @throws InputError if `pairs` lacks partners, or if there are more members than 9999.
[[nodiscard]] std::vector<Member> members(const std::vector<Variation>& variations, Design design,
                                          const std::vector<std::string>& fixed,
                                          const std::vector<std::string>& base);
} // namespace berm::app
