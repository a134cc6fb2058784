// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/child_processes.h"

#include "app/cli.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

namespace berm::app
{
namespace
{
constexpr const char* parent_variable = "BERM_PARENT"; // the parent's process id

/// This process's environment for a child: one thread, its parent's id, and nothing of a launcher
/// (mpirun, srun) whose process the child is not.
std::vector<std::string> child_environment()
{
  const bool launched = std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr; // else OMPI_ is the user's
  std::vector<std::string> list;
  for (char** entry = environ; *entry != nullptr; ++entry)
  {
    const std::string_view text(*entry);
    const auto is = [&](std::string_view start) { return text.starts_with(start); };
    if (!is("OMP_NUM_THREADS=") && !is("BERM_PARENT=") && !is("PMI_") && !is("PMIX_") &&
        !(launched && is("OMPI_")))
      list.emplace_back(text);
  }
  list.emplace_back("OMP_NUM_THREADS=1");
  list.emplace_back(std::string(parent_variable) + "=" + std::to_string(getpid()));
  return list;
}

std::vector<char*> pointers(std::vector<std::string>& texts)
{
  std::vector<char*> list;
  for (std::string& text : texts)
    list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}
} // namespace

std::string ChildProcesses::start(std::size_t ticket, std::vector<std::string> arguments,
                                  const std::filesystem::path& log)
{
  std::vector<std::string> environment = child_environment();
  arguments.insert(arguments.begin(), "berm");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0666);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t id = 0;
  const int error = posix_spawn(&id, "/proc/self/exe", &actions, &attributes,
                                pointers(arguments).data(), pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    return "cannot be started with " + log.string() + ": " + std::generic_category().message(error);
  running_.push_back({id, ticket});
  return {};
}

std::vector<ChildEnd> ChildProcesses::poll()
{
  std::vector<ChildEnd> ended;
  std::erase_if(running_,
                [&](const Child& child)
                {
                  int status = 0;
                  const pid_t found = waitpid(child.id, &status, WNOHANG);
                  if (found == child.id)
                    ended.push_back({child.ticket, WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                                     WIFSIGNALED(status) ? WTERMSIG(status) : 0});
                  return found == child.id;
                });
  if (ended.empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return ended;
}

void ChildProcesses::stop()
{
  if (std::exchange(stopped_, true)) // a second signal would kill them
    return;
  for (const Child& child : running_)
    kill(child.id, SIGTERM);
}

void end_with_parent()
{
  const char* parent = std::getenv(parent_variable);
  if (parent == nullptr)
    return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != std::atol(parent)) // it ended before
    std::_Exit(exit_no_answer);
}
} // namespace berm::app
