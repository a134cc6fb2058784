// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/version.h"

#include "git_describe.h"

namespace berm::app
{
std::string version()
{
  return BERM_VERSION;
}

bool seepage_built_in()
{
#ifdef BERM_WITH_SEEPAGE
  return true;
#else
  return false;
#endif
}

std::string commit()
{
  return BERM_GIT_DESCRIBE;
}

std::string version_text()
{
  std::string text = "berm " + version() + "\n";
  text += "commit    : " + (commit().empty() ? "unknown" : commit()) + "\n";
#ifdef __clang__
  text += "compiler  : Clang " __clang_version__ "\n";
#else
  text += "compiler  : GCC " __VERSION__ "\n";
#endif
  text += std::string("seepage   : ") + (seepage_built_in() ? "built in" : "not built in") + "\n";
  text += "libraries : " BERM_LIBRARIES "\n";
  return text;
}
} // namespace berm::app
