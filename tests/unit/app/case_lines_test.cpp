// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_lines.h"

#include "case_text.h"

#include <gtest/gtest.h>

namespace berm::app::test
{
TEST(CaseLines, HaveNamesAndSamplesByDefault)
{
  const ReadResult result = read_text(sound_case + R"([[output.line]]
points_m = [[0, 0], [10, 0]]
[[output.line]]
name = "across"
points_m = [[5, -5], [5, 10]]
samples = 7
)");
  ASSERT_TRUE(result.mistakes.empty()) << result.text();
  const auto& lines = result.input.output.lines;
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].name, "line_1");
  EXPECT_EQ(lines[0].line.samples, 101);
  EXPECT_EQ(lines[1].name, "across");
  EXPECT_EQ(lines[1].line.samples, 7);
  EXPECT_EQ(lines[1].line.points, (Polyline{{5, -5}, {5, 10}}));
}

TEST(CaseLines, MayRunAlongTheOutlineAndTouchItsCorners)
{
  const ReadResult result = read_text(sound_case + R"([[output.line]]
points_m = [[0, 10], [12, 10], [32, 0], [40, 0], [40, -5], [0, -5], [0, 10]]
[[output.line]]
points_m = [[3, 10], [9, 10]]
[[output.line]]
points_m = [[22, 5], [27, 2.5]]
[[output.line]]
points_m = [[0, -5], [40, 0]]
)");
  EXPECT_TRUE(result.mistakes.empty()) << result.text();
}

TEST(CaseLines, AllMistakesAreToldAtOnceWithTheirLines)
{
  const ReadResult result = read_text(sound_case + R"([[output.line]]
name = "a b"
points_m = [[0, 0], [50, 0], [5, 20]]
[[output.line]]
name = "a/b"
points_m = [[5, 5], [5, 5], [6, 5]]
[[output.line]]
points_m = [[0, 10], [40, 0]]
samples = 1
[[output.line]]
name = 3
)");
  const std::string text = result.text();
  for (const char* part : {
           "output.line[1].points_m = (50, 0): point 2 lies outside the section",
           "output.line[1].points_m = (5, 20): point 3 lies outside the section",
           "output.line[2].name = \"a/b\": the same file, lines/a_b.csv, as that of line 1",
           "output.line[2].points_m = (5, 5): points 1 and 2 are the same",
           "the line from point 1 to point 2 leaves the section here",
           "output.line[3].samples = 1",
           "output.line[4].name = 3",
           "missing key output.line[4].points_m",
       })
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
}

TEST(CaseLines, NoNameLeadsOutOfItsFolder)
{
  EXPECT_EQ(file_name("crest-2_b"), "crest-2_b");
  EXPECT_EQ(file_name("../../etc/passwd"), "______etc_passwd");
  EXPECT_EQ(file_name("."), "_");
  EXPECT_EQ(file_name(""), "_");
  EXPECT_EQ(file_name("a\\b:c"), "a_b_c");
  EXPECT_EQ(file_name(std::string(300, 'x')), std::string(64, 'x'));
}
} // namespace berm::app::test
