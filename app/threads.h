// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace berm::app
{
/// @brief Make idle threads sleep at barriers instead of spinning, unless the user chose otherwise.
/// OpenMP reads OMP_WAIT_POLICY when it is loaded, before main: the program starts itself once more
/// with the variable set. On a machine with other work, spinning is three to five times slower.
void wait_passively(char** argv);
} // namespace berm::app
