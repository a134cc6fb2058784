// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace berm
{
/// Work in a sandbox ended without an answer; the text says how, as a clause: "takes longer than 4
/// s".
class SandboxFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// @brief Let `work` run in a process of its own, and return its text.
/// For libraries that read files of unknown origin: a crash, a loop without end or the hunger for
/// memory there ends the child alone. The child may read files, but where the kernel has seccomp it
/// can neither write nor remove any, start no program and reach no network; it takes at most 1 GB
/// and is silent. Call it before threads are started: the child has the caller's alone.
/// @param[in] work     What to do. Nothing of this process changes by it.
/// @param[in] seconds  Longest time to wait, at least 1 [s].
/// @throws InputError, IoError as `work` does; SandboxFailure for every other way to end.
[[nodiscard]] std::string in_sandbox(const std::function<std::string()>& work, unsigned seconds);
} // namespace berm
