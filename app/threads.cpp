// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/threads.h"

#include <cstdlib>
#include <unistd.h>

namespace berm::app
{
void wait_passively(char** argv)
{
  constexpr const char* variable = "OMP_WAIT_POLICY";
  if (std::getenv(variable) != nullptr)
    return;
  setenv(variable, "passive", 0);
  execv("/proc/self/exe", argv); // returns only if it fails: then run as we are
}
} // namespace berm::app
