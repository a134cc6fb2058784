// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/team.h"

namespace berm::app
{
/// @brief The processes that mpirun started with this one; alone without mpirun, where MPI does not
/// even start. Ends with the process.
/// @throws InputError if there are several and this berm was built without MPI.
[[nodiscard]] Team& process_team();

/// @brief End all processes of a team of several, at once: the others may wait for this one
/// forever. Does nothing for a process alone.
void end_team(int code);
} // namespace berm::app
