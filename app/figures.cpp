// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/figures.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>

namespace berm::app
{
namespace
{
/// Runs the script with the directory. Empty, or why there are no figures.
std::string draw(std::string script, const std::filesystem::path& directory)
{
  std::string python = BERM_PYTHON, argument = directory.string();
  if (python.empty())
    return "berm was built without a Python that has matplotlib and h5py";
  if (!std::filesystem::exists(script))
    return script + " is not there";

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  const std::array<char*, 4> arguments = {python.data(), script.data(), argument.data(), nullptr};
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
  return good ? "" : python + " " + script + " " + argument + " failed";
}
} // namespace

std::string draw_figures(const std::filesystem::path& directory)
{
  return draw(BERM_FIGURES, directory);
}

std::string draw_comparison(const std::filesystem::path& directory)
{
  return draw(std::filesystem::path(BERM_FIGURES).replace_filename("comparison.py"), directory);
}

std::string draw_study(const std::filesystem::path& directory)
{
  return draw(std::filesystem::path(BERM_FIGURES).replace_filename("study.py"), directory);
}
} // namespace berm::app
