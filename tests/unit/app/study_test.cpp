// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/files.h"
#include "app/version.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace berm::app
{
namespace
{
using Texts = std::vector<std::string>;

std::vector<Variation> parsed(const Texts& texts)
{
  std::vector<Mistake> mistakes;
  auto variations = parse_variations(texts, mistakes);
  EXPECT_TRUE(mistakes.empty());
  return variations;
}

Texts problems(const Texts& texts)
{
  std::vector<Mistake> mistakes;
  (void)parse_variations(texts, mistakes);
  Texts list;
  for (const Mistake& mistake : mistakes)
    list.push_back(mistake.problem);
  return list;
}

Texts values_of(const std::vector<Member>& list, std::size_t variation)
{
  Texts values;
  for (const Member& member : list)
    values.push_back(member.values[variation]);
  return values;
}

/// A directory that goes with the test.
struct Scratch
{
  Scratch() { std::filesystem::create_directories(path); }
  ~Scratch() { std::filesystem::remove_all(path); }
  void write(const std::string& name, const std::string& text) const
  {
    std::filesystem::create_directories((path / name).parent_path());
    std::ofstream(path / name) << text;
  }
  std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "berm_study_test";
};
} // namespace

TEST(StudyVariation, SplitsAtCommasOutsideOfBracketsAndQuotes)
{
  EXPECT_EQ(split_values("1, 2 ,3"), (Texts{"1", "2", "3"}));
  EXPECT_EQ(split_values("[[0,1],[2,3]],[[4,5],[6,7]]"), (Texts{"[[0,1],[2,3]]", "[[4,5],[6,7]]"}));
  EXPECT_EQ(split_values(R"("a,b",'c,d',{x=1,y=2})"), (Texts{R"("a,b")", "'c,d'", "{x=1,y=2}"}));
  EXPECT_EQ(split_values(R"("a\",b",c)"), (Texts{R"("a\",b")", "c"}));
  EXPECT_EQ(split_values(""), (Texts{""}));
}

TEST(StudyVariation, RangesEndWhereTheySayInEqualStepsOrRatios)
{
  EXPECT_EQ(parsed({"k=18:24:4"})[0].values, (Texts{"18", "20", "22", "24"}));
  EXPECT_EQ(parsed({"k=0.3:0.1:3"})[0].values, (Texts{"0.3", "0.2", "0.1"}));
  const Texts ratios = parsed({"k=1e-9:1e-6:4:log"})[0].values;
  ASSERT_EQ(ratios.size(), 4U);
  for (int i = 0; i < 4; ++i)
    EXPECT_DOUBLE_EQ(std::stod(ratios[static_cast<std::size_t>(i)]), std::pow(10.0, i - 9));
  EXPECT_EQ(parsed({"k=1,5:7:3"})[0].values, (Texts{"1", "5", "6", "7"}));
}

TEST(StudyVariation, KeysJoinedByPlusMoveTogether)
{
  const auto variations = parsed({"water.left_level_m+water.right_level_m=1,2"});
  EXPECT_EQ(variations[0].keys, (Texts{"water.left_level_m", "water.right_level_m"}));
  const auto list = members(variations, Design::grid, {"title=t"}, {""});
  EXPECT_EQ(list[1].overrides, (Texts{"title=t", "water.left_level_m=2", "water.right_level_m=2"}));
}

TEST(StudyVariation, TellsEveryMistakeAtOnce)
{
  EXPECT_EQ(problems({"a", "b=1,,2", "c=1,1.0", "d=1:2", "d=1:2:1", "d=-1:2:3:log", "c=3"}).size(),
            9U); // each of the last four is a repeated key or a range that is none, some both
  EXPECT_NE(problems({"b=1,1.0"})[0].find("twice"), std::string::npos);
  EXPECT_NE(problems({"b=1,"})[0].find("empty"), std::string::npos);
}

TEST(StudyDesign, AGridHasEveryCombinationTheLastFastest)
{
  const auto list = members(parsed({"a=1,2", "b=3,4,5"}), Design::grid, {}, {"", ""});
  EXPECT_EQ(values_of(list, 0), (Texts{"1", "1", "1", "2", "2", "2"}));
  EXPECT_EQ(values_of(list, 1), (Texts{"3", "4", "5", "3", "4", "5"}));
  EXPECT_EQ(list[5].folder, "members/006_a_2_b_5");
}

TEST(StudyDesign, PairsTakeTheSameNumberOfEach)
{
  const auto list = members(parsed({"a=1,2", "b=3,4"}), Design::pairs, {}, {"", ""});
  EXPECT_EQ(values_of(list, 0), (Texts{"1", "2"}));
  EXPECT_EQ(values_of(list, 1), (Texts{"3", "4"}));
  EXPECT_THROW((void)members(parsed({"a=1,2", "b=3"}), Design::pairs, {}, {"", ""}), InputError);
}

TEST(StudyDesign, OneAtATimeLeavesTheOthersAsInTheCaseAndSkipsItsOwnValue)
{
  const auto list = members(parsed({"a=1,2.0", "b=3"}), Design::one_at_a_time, {}, {"2", "7"});
  EXPECT_EQ(values_of(list, 0), (Texts{"2", "1", "2"}));
  EXPECT_EQ(values_of(list, 1), (Texts{"7", "7", "3"}));
  EXPECT_TRUE(list[0].overrides.empty());
  EXPECT_EQ(list[1].overrides, (Texts{"a=1"}));
  EXPECT_EQ(list[2].overrides, (Texts{"b=3"}));
  EXPECT_EQ(list[0].folder, "members/001_base");
}

TEST(StudyDesign, NoFolderLeadsOutOfItsDirectory)
{
  for (const Member& member :
       members(parsed({R"(title="../../x","/etc","a b;c","..")"}), Design::grid, {}, {""}))
  {
    const std::filesystem::path path(member.folder);
    EXPECT_EQ(path.parent_path(), "members");
    EXPECT_EQ(path.lexically_normal(), path);
    EXPECT_EQ(path.string().find_first_of(" ;\"'"), std::string::npos);
  }
}

TEST(StudyDesign, RefusesMoreMembersThanAnyoneReads)
{
  EXPECT_THROW((void)members(parsed({"a=1:2:1000", "b=1:2:1000"}), Design::grid, {}, {"", ""}),
               InputError);
}

TEST(StudyResumption, AMemberCountsIfItsResultIsOfTheSameTextOverridesAndVersion)
{
  const Scratch scratch;
  const Member member{"members/001_a_1", {"a=1"}, {"1"}, {true}};
  const auto status = [&](const Json& result, const std::string& case_text)
  {
    scratch.write("members/001_a_1/result.json", result.dump());
    scratch.write("members/001_a_1/case.toml", case_text);
    return stored_result(scratch.path, member, "text").status;
  };
  Json result = {{"berm", version()},
                 {"case", {{"path", "p"}, {"overrides", {"a=1"}}}},
                 {"complete", true},
                 {"interrupted", false}};
  EXPECT_EQ(status(result, "text"), MemberStatus::complete);
  EXPECT_EQ(status(result, "other text"), MemberStatus::not_run);
  result["complete"] = false;
  EXPECT_EQ(status(result, "text"), MemberStatus::undecided);
  result["interrupted"] = true;
  EXPECT_EQ(status(result, "text"), MemberStatus::stopped);
  result["case"]["overrides"] = {"a=2"};
  EXPECT_EQ(status(result, "text"), MemberStatus::not_run);
  result["case"]["overrides"] = {"a=1"};
  result["berm"] = "0.0.0";
  EXPECT_EQ(status(result, "text"), MemberStatus::not_run);
  scratch.write("members/001_a_1/result.json", "{ half a");
  EXPECT_EQ(stored_result(scratch.path, member, "text").status, MemberStatus::not_run);
}

TEST(StudyResumption, WhatRanToItsEndIsNotRunAgain)
{
  const auto finished = [](MemberStatus status)
  {
    MemberResult result;
    result.status = status;
    return result.finished();
  };
  EXPECT_TRUE(finished(MemberStatus::complete));
  EXPECT_TRUE(finished(MemberStatus::undecided)); // it would be so again
  EXPECT_FALSE(finished(MemberStatus::stopped));
  EXPECT_FALSE(finished(MemberStatus::failed));
  EXPECT_FALSE(finished(MemberStatus::not_run));
}

TEST(StudyResumption, AnotherStudyIsToldApartByAllThatDefinesIt)
{
  Study study;
  study.case_text = "text";
  study.variations = parsed({"a=1,2"});
  const Json stored = study_json(study);
  EXPECT_TRUE(differences(study, stored, "text").empty());
  EXPECT_TRUE(differences(study, nullptr, "").empty());
  study.case_path = "elsewhere";
  EXPECT_TRUE(differences(study, stored, "text").empty());
  study.overrides = {"b=1"};
  study.variations = parsed({"a=1,3"});
  study.design = Design::pairs;
  study.seepage_only = true;
  EXPECT_EQ(differences(study, stored, "other"),
            (Texts{"the case file", "--set", "--vary", "the design", "--seepage"}));
}

TEST(StudyTable, HasNoFactorWhereTheSearchFoundNone)
{
  const Json result = {{"complete", false},
                       {"interrupted", false},
                       {"stability",
                        {{"factor", 1.5},
                         {"stands", 1.4},
                         {"fails", 1.6},
                         {"complete", false},
                         {"reason", "a trial stayed undecided"}}}};
  const MemberResult row = summarise(result);
  EXPECT_FALSE(row.factor);
  EXPECT_EQ(row.stands, 1.4);
  EXPECT_EQ(row.fails, 1.6);
  EXPECT_EQ(row.reason, "a trial stayed undecided");
  EXPECT_NE(answer_text(row).find("undecided: a trial stayed undecided"), std::string::npos);
}

TEST(StudyTable, QuotesValuesWithCommas)
{
  Study study;
  study.variations = parsed({"k=[1,2],3"});
  study.members = members(study.variations, Design::grid, {}, {""});
  study.results.resize(2);
  const std::string text = study_csv(study);
  EXPECT_NE(text.find("\nmembers/001_k_1_2_,\"[1,2]\",,"), std::string::npos) << text;
  EXPECT_NE(text.find(",0,not run,\n"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
}
} // namespace berm::app
