// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sandbox.h"

#include "core/error.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace berm
{
namespace
{
/// How work ended that has no answer.
std::string ending(const std::function<std::string()>& work)
{
  try
  {
    return "answers " + in_sandbox(work, 1);
  }
  catch (const SandboxFailure& e)
  {
    return e.what();
  }
}

TEST(Sandbox, HandsTheTextOut)
{
  const std::string text(3'000'000, 'x'); // more than a pipe holds
  EXPECT_EQ(in_sandbox([&] { return text; }, 9), text);
  EXPECT_EQ(in_sandbox([] { return std::string(); }, 9), "");
}

TEST(Sandbox, HandsMistakesOutAsTheyAre)
{
  try
  {
    static_cast<void>(in_sandbox(
        []() -> std::string {
          throw InputError({{"a", "1", "wrong", "2", ""}, {.key = "b", .hint = "three"}});
        },
        9));
    FAIL();
  }
  catch (const InputError& e)
  {
    ASSERT_EQ(e.mistakes().size(), 2U);
    EXPECT_EQ(e.mistakes()[0].allowed, "2");
    EXPECT_EQ(e.mistakes()[1].key, "b");
    EXPECT_EQ(e.mistakes()[1].hint, "three");
  }
  EXPECT_THROW(static_cast<void>(in_sandbox([]() -> std::string { throw IoError("gone"); }, 9)),
               IoError);
}

TEST(Sandbox, TellsEveryOtherEnd)
{
  EXPECT_EQ(ending(
                []
                {
                  while (std::getenv("") == nullptr)
                    continue;
                  return std::string();
                }),
            "takes longer than 1 s");
  EXPECT_EQ(ending(
                []
                {
                  std::raise(SIGSEGV);
                  return std::string();
                })
                .substr(0, 7),
            "crashes");
  EXPECT_EQ(ending(
                []
                {
                  std::exit(0);
                  return std::string();
                }),
            "ends without an answer");
  EXPECT_EQ(ending([]() -> std::string { throw 3; }), "fails");
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_EQ(ending([] { return std::string(2'000'000'000, 'x'); }), "needs more than 1 GB");
#endif
}

TEST(Sandbox, ReadsButChangesNothing)
{
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "berm_sandbox";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "kept") << "kept";
  const std::string answer = in_sandbox(
      [&]
      {
        std::string done;
        if (std::system(("touch " + (folder / "started").string()).c_str()) == 0)
          done += "started a program ";
        if (std::ofstream(folder / "written"))
          done += "wrote ";
        if (mkdir((folder / "made").c_str(), 0777) == 0)
          done += "made ";
#ifdef __X32_SYSCALL_BIT
        if (syscall(__X32_SYSCALL_BIT | SYS_mkdir, (folder / "made").c_str(), 0777) != -1 ||
            errno != EPERM) // ENOSYS would be the kernel's answer, not ours
          done += "made by another number ";
#endif
        std::error_code error;
        if (std::filesystem::remove(folder / "kept", error))
          done += "removed ";
        if (socket(AF_INET, SOCK_STREAM, 0) >= 0)
          done += "reached the network ";
        std::ifstream file(folder / "kept");
        return done + std::string(std::istreambuf_iterator<char>(file), {});
      },
      9);
  EXPECT_EQ(answer, "kept");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  std::filesystem::remove_all(folder);
}
} // namespace
} // namespace berm
