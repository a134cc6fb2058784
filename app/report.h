// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/analysis.h"

#include <string>
#include <vector>

namespace berm::app
{
/// @brief What a run found, as aligned text for a terminal or a log.
[[nodiscard]] std::string report(const coupling::Case& input, const coupling::Analysis& analysis,
                                 const std::vector<std::string>& warnings);

/// @brief What a case asks for, for `berm check`.
[[nodiscard]] std::string summary(const coupling::Case& input, const meshes::Section& section);

/// @brief Five to eight round numbers within [lower, upper], equally spaced.
[[nodiscard]] std::vector<double> round_positions(double lower, double upper);

/// @brief The factor of safety with its bracket, or what is known in its place; one line.
[[nodiscard]] std::string factor_text(const sph::FactorOfSafety& factor);
} // namespace berm::app
