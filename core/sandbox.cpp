// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sandbox.h"

#include "core/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

namespace berm
{
namespace
{
constexpr rlim_t most_memory = 1'000'000'000; // bytes

/// What a child's answer begins with.
enum Answer : char
{
  result = 'r',
  mistakes = 'm',
  io_error = 'i',
  failure = 'f'
};

//------------------------------------------------------------------------------------------------
// The child
//------------------------------------------------------------------------------------------------

#if defined(__x86_64__)
constexpr std::uint32_t our_architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t our_architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t our_architecture = 0;
#endif

constexpr sock_filter load(std::size_t offset)
{
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}

constexpr sock_filter refuse()
{
  return BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);
}

constexpr sock_filter allow()
{
  return BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
}

/// System calls that start programs, change files or talk to others; opening is told apart.
constexpr auto refused_calls = std::to_array<int>({
    SYS_execve,    SYS_execveat, SYS_socket,    SYS_connect,        SYS_ptrace, SYS_kill,
    SYS_unlinkat,  SYS_renameat, SYS_renameat2, SYS_mkdirat,        SYS_linkat, SYS_symlinkat,
    SYS_mknodat,   SYS_fchmodat, SYS_fchownat,  SYS_truncate,       SYS_fchmod, SYS_fchown,
    SYS_utimensat, SYS_openat2,  SYS_mount,     SYS_io_uring_setup,
#ifdef SYS_open // older calls, which newer architectures do without
    SYS_creat,     SYS_unlink,   SYS_rename,    SYS_mkdir,          SYS_rmdir,  SYS_link,
    SYS_symlink,   SYS_mknod,    SYS_chmod,     SYS_chown,          SYS_lchown,
#endif
});

std::vector<sock_filter> read_only_filter()
{
  constexpr std::uint32_t writes = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
  std::vector<sock_filter> filter{load(offsetof(seccomp_data, arch)),
                                  BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, our_architecture, 1, 0),
                                  refuse(), load(offsetof(seccomp_data, nr))};
#ifdef __X32_SYSCALL_BIT // the same calls by other numbers
  filter.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, __X32_SYSCALL_BIT, 0, 1));
  filter.push_back(refuse());
#endif
  for (const int call : refused_calls)
  {
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
    filter.push_back(refuse());
  }
  const auto only_to_read = [&](long call, std::size_t argument)
  {
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 4));
    filter.push_back(load(offsetof(seccomp_data, args) + 8 * argument));
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, writes, 0, 1));
    filter.push_back(refuse());
    filter.push_back(allow());
  };
  only_to_read(SYS_openat, 2);
#ifdef SYS_open
  only_to_read(SYS_open, 1);
#endif
  filter.push_back(allow());
  return filter;
}

/// From here on this process may read, and little else.
void confine(unsigned seconds)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL); // Ctrl-C and the like end both
  if (const int nothing = open("/dev/null", O_RDWR); nothing >= 0)
    for (const int out : {STDOUT_FILENO, STDERR_FILENO})
      dup2(nothing, out);
  for (const int number :
       {SIGALRM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) // not the parent's way
    std::signal(number, SIG_DFL);
  alarm(seconds);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__) // whose shadow is larger
  const rlimit memory{most_memory, most_memory};
  setrlimit(RLIMIT_DATA, &memory);
#endif
  if (our_architecture == 0 || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
    return;
  std::vector<sock_filter> filter = read_only_filter();
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

std::string packed(const std::vector<Mistake>& list)
{
  std::string text(1, mistakes);
  for (const Mistake& m : list)
    for (const std::string& part : {m.key, m.value, m.problem, m.allowed, m.hint})
      text += part + '\0';
  return text;
}

std::string answer_of(const std::function<std::string()>& work)
{
  try
  {
    return static_cast<char>(result) + work();
  }
  catch (const InputError& e)
  {
    return packed(e.mistakes());
  }
  catch (const IoError& e)
  {
    return static_cast<char>(io_error) + std::string(e.what());
  }
  catch (const std::bad_alloc&)
  {
    return static_cast<char>(failure) + fmt::format("needs more than {} GB", most_memory / 1e9);
  }
  catch (const std::exception& e)
  {
    return static_cast<char>(failure) + fmt::format("fails: {}", e.what());
  }
  catch (...) // plain values in some libraries
  {
    return static_cast<char>(failure) + std::string("fails");
  }
}

[[noreturn]] void be_the_child(const std::function<std::string()>& work, unsigned seconds, int out)
{
  confine(seconds);
  const std::string answer = answer_of(work);
  std::string_view rest = answer;
  while (!rest.empty())
  {
    const ssize_t written = write(out, rest.data(), rest.size());
    if (written < 0 && errno != EINTR)
      _exit(1);
    rest.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
  }
  _exit(0);
}

//------------------------------------------------------------------------------------------------
// The parent
//------------------------------------------------------------------------------------------------

/// All that comes through a pipe.
std::string all_of(int in)
{
  std::string text;
  std::array<char, 65536> block;
  while (true)
  {
    const ssize_t count = read(in, block.data(), block.size());
    if (count > 0)
      text.append(block.data(), static_cast<std::size_t>(count));
    else if (count == 0 || errno != EINTR)
      return text;
  }
}

std::vector<Mistake> unpacked(std::string_view text)
{
  const auto part = [&text]
  {
    std::string one(text.substr(0, text.find('\0')));
    text.remove_prefix(std::min(one.size() + 1, text.size()));
    return one;
  };
  std::vector<Mistake> list;
  while (!text.empty())
  {
    Mistake& m = list.emplace_back();
    for (std::string* field : {&m.key, &m.value, &m.problem, &m.allowed, &m.hint})
      *field = part();
  }
  return list;
}

std::string ending(int status, unsigned seconds)
{
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    return fmt::format("takes longer than {} s", seconds);
  if (WIFSIGNALED(status))
    return fmt::format("crashes: {}", strsignal(WTERMSIG(status)));
  return "ends without an answer";
}
} // namespace

std::string in_sandbox(const std::function<std::string()>& work, unsigned seconds)
{
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw IoError("no pipe to a process of its own");
  const pid_t child = fork();
  if (child == 0)
    be_the_child(work, seconds, ends[1]);
  close(ends[1]);
  const std::string answer = child > 0 ? all_of(ends[0]) : "";
  close(ends[0]);
  if (child < 0)
    throw IoError("no process of its own can be started");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR)
    continue;
  if (answer.empty() || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw SandboxFailure(ending(status, seconds));
  std::string rest = answer.substr(1);
  switch (answer.front())
  {
  case result:
    return rest;
  case mistakes:
    throw InputError(unpacked(rest));
  case io_error:
    throw IoError(rest);
  default:
    throw SandboxFailure(rest);
  }
}
} // namespace berm
