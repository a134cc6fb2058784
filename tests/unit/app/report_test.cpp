// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report.h"

#include "app/console.h"
#include "core/error.h"
#include "small_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace berm::app
{
TEST(Report, RoundPositionsAreFiveToEightRoundNumbersInside)
{
  EXPECT_EQ(round_positions(86.75, 150.2), (std::vector<double>{90, 100, 110, 120, 130, 140, 150}));
  for (const double lower : {-1234.5, -0.3, 0.0, 17.0})
    for (const double extent : {0.013, 0.1, 1.0, 3.3, 4.99, 5.0, 7.7, 99.0, 100.0, 12345.0})
    {
      const auto x = round_positions(lower, lower + extent);
      EXPECT_GE(x.size(), 5u) << lower << " " << extent;
      EXPECT_LE(x.size(), 8u) << lower << " " << extent;
      EXPECT_GE(x.front(), lower - 1e-9);
      EXPECT_LE(x.back(), lower + extent + 1e-9);
    }
  EXPECT_EQ(round_positions(2, 2), std::vector<double>{2});
}

TEST(Report, NamesAMeshThatAnotherStrategyThanTheFirstSolved)
{
  coupling::Analysis analysis = test::small_analysis();
  EXPECT_EQ(report(test::small_case(), analysis, {}).find("from the"), std::string::npos);
  analysis.seepage->history.push_back({.strategy = "coarser mesh"});
  EXPECT_EQ(report(test::small_case(), analysis, {}).find("from the"), std::string::npos);
  analysis.seepage->history.push_back({.strategy = "full section", .newton_steps = 40});
  EXPECT_NE(report(test::small_case(), analysis, {})
                .find("43 Newton steps on 3 meshes; mesh 3 from the full section"),
            std::string::npos)
      << report(test::small_case(), analysis, {});
}

TEST(Report, TellsTheFactorWithItsBracket)
{
  sph::FactorOfSafety factor;
  factor.stands = 1.628;
  factor.fails = 1.642;
  factor.complete = true;
  EXPECT_EQ(factor_text(factor), "F = 1.635 (stands at 1.628, fails at 1.642)");
}

TEST(Report, NeverRoundsAnUndecidedSearchToAnAnswer)
{
  sph::FactorOfSafety factor;
  factor.reason = "the trial at 1.6 is undecided";
  EXPECT_EQ(factor_text(factor), "UNDECIDED: the trial at 1.6 is undecided; no trial was decided");
  factor.stands = 1.5;
  EXPECT_EQ(factor_text(factor), "UNDECIDED: the trial at 1.6 is undecided; stands at 1.500");
  factor.fails = 1.7;
  EXPECT_EQ(factor_text(factor),
            "UNDECIDED: the trial at 1.6 is undecided; stands at 1.500, fails at 1.700");
}

TEST(Console, TellsDurationsForPeople)
{
  EXPECT_EQ(duration_text(0.2), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(7500), "2 h 05 min");
  EXPECT_EQ(duration_text(-1), "0 s");
}

TEST(Console, WritesPlainLinesToALog)
{
  std::FILE* log = std::tmpfile();
  {
    Console console(log, false, Volume::normal);
    console.stage("settling");
    console.progress(0.5, "half");
    console.note("done");
    console.warn("doubtful");
    EXPECT_EQ(console.warnings(), std::vector<std::string>{"doubtful"});
  }
  std::rewind(log);
  char text[200] = {};
  const std::size_t length = std::fread(text, 1, sizeof text - 1, log);
  std::fclose(log);
  EXPECT_EQ(std::string(text, length), "settling\n  done\n  warning: doubtful\n");
}

TEST(Console, TellsDetailsToALogFileAndWhereAskedFor)
{
  const std::filesystem::path path = testing::TempDir() + "berm_console.log";
  const auto told = [&](Volume volume)
  {
    std::FILE* stream = std::tmpfile();
    {
      Console console(stream, false, volume, path);
      console.note("a trial");
      console.detail("a step");
    }
    const long length = std::ftell(stream);
    std::fclose(stream);
    return length;
  };
  const std::string note = "  a trial\n", detail = "  a step\n";
  EXPECT_EQ(told(Volume::quiet), 0);
  EXPECT_EQ(told(Volume::normal), static_cast<long>(note.size()));
  EXPECT_EQ(told(Volume::verbose), static_cast<long>((note + detail).size()));
  std::ifstream file(path);
  std::string first, second;
  ASSERT_TRUE(std::getline(file, first) && std::getline(file, second));
  EXPECT_TRUE(first.ends_with(" s    a trial")) << first;
  EXPECT_TRUE(second.ends_with(" s    a step")) << second;
  EXPECT_THROW(Console(stderr, false, Volume::normal, testing::TempDir()), IoError);
}

TEST(Console, DrawsABarOnATerminalAndTakesItAway)
{
  std::FILE* screen = std::tmpfile();
  {
    Console console(screen, true, Volume::normal);
    console.stage("settling");
    console.progress(0.5, "half");
    console.progress(NAN, "too early to be drawn again");
    console.note("done");
  }
  std::rewind(screen);
  char text[400] = {};
  const std::size_t length = std::fread(text, 1, sizeof text - 1, screen);
  std::fclose(screen);
  EXPECT_EQ(std::string(text, length),
            "settling\n\r\x1b[Ksettling [############............]  50 %  half\r\x1b[K  done\n");
}
} // namespace berm::app
