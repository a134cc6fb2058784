// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/case_check.h"
#include "core/error.h"
#include "coupling/case.h"

#include <string>
#include <vector>

/// [soil.*] of the case file.
namespace berm::app
{
/// @brief The soils, in the order of the file.
/// @param[in]     needs_conductivity  Whether there is a seepage solve.
/// @param[in,out] mistakes            Gains what concerns more than one key of a soil.
[[nodiscard]] std::vector<coupling::Soil> assemble_soils(const CheckedValues& values,
                                                         bool needs_conductivity,
                                                         std::vector<Mistake>& mistakes);
} // namespace berm::app
