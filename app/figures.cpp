// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/figures.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>
#include <vector>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

/// Of an installed program, beside it in share; of one that was built, where its source is.
fs::path scripts()
{
  std::error_code none; // no /proc: not installed
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  const fs::path installed =
      program.parent_path().parent_path() / "share" / "berm" / "plots"; // CMakeLists.txt
  return fs::is_directory(installed, none) ? installed : fs::path(BERM_FIGURES);
}

/// Runs the script with the directory. Empty, or why there are no figures.
std::string draw(const char* name, const fs::path& directory, std::span<const std::string> formats)
{
  std::string python = BERM_PYTHON, script = (scripts() / name).string();
  if (python.empty())
    return "berm was built without a Python that has matplotlib and h5py";
  if (!fs::exists(script))
    return script + " is not there";

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  std::vector<std::string> texts{python, script, directory.string(), "--formats"};
  texts.insert(texts.end(), formats.begin(), formats.end());
  std::vector<char*> arguments;
  for (std::string& text : texts)
    arguments.push_back(text.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, python.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    return python + " cannot be started";

  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      return python + " was lost";
  const bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return good ? "" : python + " " + script + " " + directory.string() + " failed";
}
} // namespace

std::string draw_figures(const fs::path& directory, std::span<const std::string> formats)
{
  return draw("figures.py", directory, formats);
}

std::string draw_comparison(const fs::path& directory, std::span<const std::string> formats)
{
  return draw("comparison.py", directory, formats);
}

std::string draw_study(const fs::path& directory, std::span<const std::string> formats)
{
  return draw("study.py", directory, formats);
}
} // namespace berm::app
