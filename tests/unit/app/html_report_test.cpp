// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/html_report.h"

#include "app/packed_array.h"
#include "app/report_data.h"
#include "app/run_writer.h"
#include "case_text.h"
#include "core/error.h"
#include "small_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

namespace berm::app::test
{
namespace
{
constexpr const char* hostile = "</script><script>alert(1)</script><img src=x onerror=alert(1)>";

std::size_t count(std::string_view text, std::string_view part)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

/// What a browser would find in the element of the data.
std::string data_element(const std::string& page)
{
  const std::string opening = "<script id=\"data\" type=\"application/json\">";
  const std::size_t begin = page.find(opening) + opening.size();
  return page.substr(begin, page.find("</script", begin) - begin);
}
} // namespace

TEST(ReportData, GathersARunsFields)
{
  const TemporaryDirectory directory;
  write_run(directory.path(), small_case(), small_analysis());
  const Json data = report_data(directory.path());
  EXPECT_EQ(data.at("kind"), "run");
  EXPECT_EQ(data.at("result").at("stability").at("stands"), 1.5);
  EXPECT_EQ(data.at("case").at("text"), "format = 1\n");
  EXPECT_EQ(data.at("case").at("sha256"), hexadecimal(sha256("format = 1\n")));
  EXPECT_EQ(data.at("mesh").at("head"), packed(std::vector<double>{1, 0.5, 0.5, 1}));
  EXPECT_EQ(data.at("mesh").at("triangles"),
            packed_whole(std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(data.at("mesh").at("log_flux").at("least"), std::log10(5e-7));
  EXPECT_EQ(data.at("particles").at("x"), packed(std::vector<double>{0.2, 0.5, 0.8}));
  const Json& failing = data.at("particles").at("states").at("failing");
  EXPECT_EQ(failing.at("factor"), 1.51);
  EXPECT_EQ(failing.at("ux"), packed(std::vector<double>{0.25, 0.5, 0.75}));
  EXPECT_TRUE(data.at("particles").at("states").contains("settled"));
  EXPECT_FALSE(data.contains("frames"));
  EXPECT_EQ(data.at("tables").at("lines").size(), 1U);
}

TEST(ReportData, RefusesWhatIsNoResult)
{
  const TemporaryDirectory directory;
  EXPECT_THROW((void)report_data(directory.path() / "none"), InputError);
  EXPECT_THROW((void)report_data(directory.path()), InputError);
  for (const char* text :
       {"", "[]", "{\"format\": 1}", "{\"format\": 2, \"section\": {}}", "{\"format\": \"1\"}"})
  {
    std::ofstream(directory.path() / "result.json") << text;
    EXPECT_THROW((void)report_data(directory.path()), InputError) << text;
  }
}

TEST(ReportData, ReadsNothingOutsideItsDirectory)
{
  const TemporaryDirectory directory;
  const auto results = directory.path() / "results";
  write_run(results, small_case(), small_analysis());
  std::ofstream(directory.path() / "secret.csv") << "secret\n";
  Json result = Json::parse(std::ifstream(results / "result.json"));
  result["seepage"]["lines"][0]["file"] = "../secret.csv";
  std::ofstream(results / "result.json") << result;
  EXPECT_THROW((void)report_data(results), IoError); // there is no lines/secret.csv
}

TEST(ReportData, AComparisonIsOfFoldersInItsOwn)
{
  const TemporaryDirectory directory;
  const auto inside = directory.path() / "compared";
  write_run(directory.path(), small_case(), small_analysis()); // outside, and ready to be read
  std::filesystem::create_directory(inside);
  std::ofstream(inside / "comparison.json")
      << R"({"format": 1, "waters": [{"name": "seepage", "directory": ".."}]})";
  EXPECT_THROW((void)report_data(inside), IoError);
}

namespace
{
/// A study of five members, of which the first, third and fourth ran: study.json and their folders.
Json small_study(const std::filesystem::path& directory)
{
  Json study = {{"format", 1}, {"title", "five"}, {"members", Json::array()}};
  for (int m = 0; m < 5; ++m)
  {
    const std::string folder = "members/00" + std::to_string(m);
    const bool ran = m == 0 || m == 2 || m == 3;
    study["members"].push_back(
        {{"directory", folder}, {"discharge_m2_s", ran ? Json(5e-7) : Json(nullptr)}});
    coupling::Analysis analysis = small_analysis();
    const double outlet = m == 2 ? 0 : m / 10.0; // the third has the line of the first
    analysis.seepage->phreatic_lines = {{{0, 1}, {0.5, 0.8}, {1, outlet}}};
    analysis.section.right_pool_level = 0.1 * m;
    analysis.section.left_pool_level = 1;
    if (ran)
      write_run(directory / folder, small_case(), analysis);
  }
  std::ofstream(directory / "case.toml") << "format = 1\n";
  std::ofstream(directory / "study.json") << study;
  return study;
}

/// Another text in place of a member's result.json.
void spoil(const std::filesystem::path& result, const std::string& text)
{
  std::filesystem::create_directories(result.parent_path());
  std::ofstream(result) << text;
}
} // namespace

TEST(ReportData, GathersAStudysReferenceAndPhreaticLines)
{
  const TemporaryDirectory directory;
  const Json study = small_study(directory.path());
  EXPECT_FALSE(report_data(directory.path()).contains("reference"));
  const std::string points = "x,F,source\n1,1.5,\"A, B\"\n";
  std::ofstream(directory.path() / "reference.csv") << points;
  const Json data = report_data(directory.path());
  EXPECT_EQ(data.at("kind"), "study");
  EXPECT_EQ(data.at("study"), study);
  EXPECT_EQ(data.at("reference"), points);
  const Json& drawn = data.at("phreatic").at("members");
  ASSERT_EQ(drawn.size(), 2U); // what ran, but the third, whose line is the first one's
  EXPECT_EQ(drawn.at(0).at("index"), 0);
  EXPECT_EQ(drawn.at(1).at("index"), 3);
  EXPECT_EQ(drawn.at(1).at("lines").at(0).at("x"), packed(std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(drawn.at(1).at("lines").at(0).at("y"), packed(std::vector<double>{1, 0.8, 0.3}));
  const Json& section = data.at("phreatic").at("section");
  EXPECT_EQ(section.at("left_level_m"), 1.0);
  EXPECT_TRUE(section.at("right_level_m").is_null()) << "a pool that differs is no one's";
  EXPECT_EQ(section.at("ground_m"), Json::parse("[[0.0, 1.0], [1.0, 1.0]]"));
}

TEST(ReportData, AStudysMemberThatIsOddHasNoLine)
{
  const TemporaryDirectory directory;
  (void)small_study(directory.path());
  const auto result = directory.path() / "members/000/result.json";
  const Json sound = Json::parse(std::ifstream(result));
  std::vector<std::string> texts = {"", "{", "[]", "7", "null", "{\"section\": 1}"};
  const auto changed = [&](const char* place, const char* value)
  {
    Json json = sound;
    json[Json::json_pointer(place)] = Json::parse(value);
    texts.push_back(json.dump());
  };
  for (const char* value : {"null", "7", "\"a\"", "[[0, 1]]", "[[[0, 1], [1]]]", "{\"a\": [1, 2]}"})
    changed("/seepage/phreatic_lines_m", value);
  changed("/section/outline_m", "{\"a\": [0, 1], \"b\": [1, 1]}");
  changed("/section/x_min_m", "\"0\"");
  changed("/section/left_level_m", "[1]");
  changed("/section/inner_lines", "[{\"kind\": 1, \"line_m\": [[0, 1], [1, 1]]}]");
  for (const std::string& text : texts)
  {
    spoil(result, text);
    const Json drawn = report_data(directory.path()).at("phreatic").at("members");
    ASSERT_EQ(drawn.size(), 2U) << text;
    EXPECT_EQ(drawn.at(0).at("index"), 2) << text;
  }
  std::filesystem::remove_all(directory.path() / "members");
  EXPECT_FALSE(report_data(directory.path()).contains("phreatic"));
}

TEST(ReportData, ReadsNoMemberOutsideOfAStudy)
{
  const TemporaryDirectory directory;
  const auto inside = directory.path() / "study";
  std::filesystem::create_directories(inside);
  Json study = small_study(inside);
  std::filesystem::rename(inside / "members/000", directory.path() / "secret");
  const std::string absolute = (directory.path() / "secret").string();
  for (const std::string& path : {std::string("../secret"), std::string("members/../../secret"),
                                  absolute, std::string(".."), std::string()})
  {
    study["members"] = Json::array({{{"directory", path}, {"discharge_m2_s", 1.0}}});
    std::ofstream(inside / "study.json") << study;
    EXPECT_FALSE(report_data(inside).contains("phreatic")) << path;
  }
}

TEST(ResultJson, SaysTheInputsAsUnderstoodAndWhatWasWarnedOf)
{
  coupling::Case input = small_case();
  input.soils.front().mechanical = {.density = 2000,
                                    .saturated_density = 2100,
                                    .cohesion = 5e3,
                                    .friction_angle = std::numbers::pi / 6,
                                    .dilation_angle = 0,
                                    .young_modulus = 1e7,
                                    .poisson_ratio = 0.3};
  const std::vector<std::string> warnings = {"the slope is steep"};
  const Json json = result_json(input, small_analysis(), warnings);
  EXPECT_EQ(json.at("warnings"), Json(warnings));
  const Json& soil = json.at("inputs").at("soils").at(0);
  EXPECT_EQ(soil.at("name"), "fill");
  EXPECT_NEAR(soil.at("unit_weight_kN_m3").get<double>(), 19.62, 1e-9); // 2000 kg/m3 times 9.81
  EXPECT_NEAR(soil.at("friction_angle_deg").get<double>(), 30, 1e-9);
  EXPECT_EQ(soil.at("cohesion_kPa"), 5.0);
  EXPECT_TRUE(soil.at("tensile_strength_kPa").is_null()); // infinite: no cut-off
  EXPECT_EQ(soil.at("conductivity_m_s"), Json::array({1e-6, 1e-6}));
}

TEST(HtmlReport, NoTextOfTheUserIsMarkup)
{
  if (!report_built_in())
    GTEST_SKIP() << "built without the page";
  coupling::Case input = small_case();
  input.title = input.soils.front().name = hostile;
  input.text = std::string("# ") + hostile + "\xff\n<!--";
  const TemporaryDirectory directory;
  write_run(directory.path(), input, small_analysis());
  const Json data = report_data(directory.path());
  const std::string page = report_page(data), plain = report_page({{"kind", "run"}});
  // The same elements as on a page without any text of the user's.
  for (const char* mark : {"<script", "</script", "<img", "<!--"})
    EXPECT_EQ(count(page, mark), count(plain, mark)) << mark;
  const std::string element = data_element(page);
  EXPECT_EQ(element.find('<'), std::string::npos);
  EXPECT_EQ(Json::parse(element).at("result").at("title"), hostile);
}

TEST(HtmlReport, LetsNothingBeLoadedAndOnlyItsOwnScriptRun)
{
  if (!report_built_in())
    GTEST_SKIP() << "built without the page";
  const std::string page = report_page({{"kind", "run"}});
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  const std::size_t begin = page.rfind("<script>") + 8;
  const std::string script = page.substr(begin, page.rfind("</script>") - begin);
  EXPECT_GT(script.size(), 10000U);
  EXPECT_NE(page.find("script-src 'sha256-" + base64(sha256(script)) + "'"), std::string::npos);
  for (const char* mark : {"src=\"http", "href=\"http", "@import", "@DATA@", "@SCRIPT@"})
    EXPECT_EQ(page.find(mark), std::string::npos) << mark;
}

TEST(HtmlReport, IsWrittenForAComparisonAndEachOfItsRuns)
{
  if (!report_built_in())
    GTEST_SKIP() << "built without the page";
  const TemporaryDirectory directory;
  for (const char* name : {"seepage", "dry"})
    write_run(directory.path() / name, small_case(), small_analysis());
  Json comparison = {{"format", 1}, {"title", "two"}, {"waters", Json::array()}};
  for (const char* name : {"seepage", "dry"})
    comparison["waters"].push_back({{"name", name}, {"directory", name}});
  std::ofstream(directory.path() / "comparison.json") << comparison;
  write_report(directory.path());
  for (const char* name : {".", "seepage", "dry"})
    EXPECT_TRUE(std::filesystem::exists(directory.path() / name / "report.html")) << name;
  const Json data = report_data(directory.path());
  EXPECT_EQ(data.at("kind"), "comparison");
  EXPECT_EQ(data.at("waters").size(), 2U);
  EXPECT_EQ(data.at("waters").at(1).at("particles").at("pore_pressure"),
            packed(std::vector<double>{4000, 2000, 0}));
}
} // namespace berm::app::test
