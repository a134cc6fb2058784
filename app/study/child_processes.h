// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// This program, started by itself as further processes.
namespace berm::app
{
/// How a child ended.
struct ChildEnd
{
  std::size_t ticket = 0; ///< what start() was given
  int exit_code = 0;      ///< -1 if a signal ended it
  int signal = 0;         ///< 0 if it ended by itself
};

/// Children that run this program, each in a process group of its own so that Ctrl-C on the
/// terminal reaches this process alone. They end with it, however it ends.
class ChildProcesses
{
public:
  /// @brief Start this program with arguments of its own, on one thread.
  /// @param[in] ticket  Tells the child from others in what poll() says.
  /// @param[in] log     Where stdout and stderr go.
  /// @return Empty, or why it was not started.
  [[nodiscard]] std::string start(std::size_t ticket, std::vector<std::string> arguments,
                                  const std::filesystem::path& log);
  /// @brief Those that ended since the last call. Waits for a moment if there are none.
  [[nodiscard]] std::vector<ChildEnd> poll();
  /// @brief Ask all to stop (SIGTERM), once.
  void stop();
  [[nodiscard]] std::size_t running() const { return running_.size(); }

private:
  struct Child
  {
    pid_t id;
    std::size_t ticket;
  };
  std::vector<Child> running_;
  bool stopped_ = false;
};

/// @brief In a child that ChildProcesses started: end when the parent does. Called by main, first.
void end_with_parent();
} // namespace berm::app
