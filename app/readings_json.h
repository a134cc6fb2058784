// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/result_json.h"

namespace berm::app
{
/// @brief `lines`, `exit_gradients` and `heave` of the section `seepage` of result.json.
/// Pre: there was a seepage solve.
[[nodiscard]] Json readings_json(const coupling::Case& input, const coupling::Analysis& analysis);
} // namespace berm::app
