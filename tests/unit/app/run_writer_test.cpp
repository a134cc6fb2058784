// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/run_writer.h"

#include "app/result_json.h"
#include "case_text.h"
#include "small_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace berm::app::test
{
namespace
{
namespace fs = std::filesystem;

std::string contents(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Every file of a directory and of those in it, by its path from there.
std::vector<std::string> names(const fs::path& directory)
{
  std::vector<std::string> list;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file())
      list.push_back(entry.path().lexically_relative(directory).generic_string());
  std::sort(list.begin(), list.end());
  return list;
}
} // namespace

TEST(RunWriter, WritesTheFilesThatTheDocumentationLists)
{
  const TemporaryDirectory directory;
  write_run(directory.path() / "a" / "b", small_case(), small_analysis());
  EXPECT_EQ(names(directory.path() / "a" / "b"),
            (std::vector<std::string>{"case.toml", "exit_gradients.csv", "lines/a_line.csv",
                                      "phreatic_lines.csv", "result.json", "results.h5",
                                      "results_mesh.xdmf", "results_particles.xdmf"}));
  EXPECT_EQ(contents(directory.path() / "a" / "b" / "case.toml"), "format = 1\n");
}

TEST(RunWriter, TheResultIsTheContractForScripts)
{
  const TemporaryDirectory directory;
  write_run(directory.path(), small_case(), small_analysis());
  const Json json = Json::parse(contents(directory.path() / "result.json"));
  EXPECT_EQ(json.at("title"), "a \"small\" case");
  EXPECT_EQ(json.at("complete"), true);
  const Json& flow = json.at("seepage");
  EXPECT_EQ(flow.at("discharge_m2_s"), 5e-7);
  EXPECT_DOUBLE_EQ(flow.at("discharge_over_k_m").get<double>(), 0.5);
  EXPECT_EQ(flow.at("exit_point_m"), Json::array({1.0, 0.5}));
  EXPECT_EQ(flow.at("phreatic_line_m").size(), 2u);
  // Head falls linearly from 1 m to 0.5 m; y = 0.25 m.
  EXPECT_NEAR(flow.at("probes").at(0).at("head_m").get<double>(), 0.75, 1e-14);
  const Json& stability = json.at("stability");
  EXPECT_DOUBLE_EQ(stability.at("factor").get<double>(), 1.505);
  EXPECT_EQ(stability.at("stands"), 1.5);
  EXPECT_EQ(stability.at("fails"), 1.51);
  EXPECT_EQ(stability.at("pore_pressure"), "seepage");
  EXPECT_EQ(stability.at("side"), "right");
  EXPECT_EQ(stability.at("mechanism").at("depth_m"), 0.5);
  const Json circle = {{"centre_m", {1.0, 2.0}}, {"radius_m", 1.5}, {"misfit_m", 0.25}};
  EXPECT_EQ(stability.at("mechanism").at("circle"), circle);
  EXPECT_EQ(stability.at("trials").size(), 2u);
  EXPECT_EQ(stability.at("trials").at(1).at("outcome"), "fails");
  const Json history = {{"time_s", {0.25, 0.5}},
                        {"velocity_measure", {0.125, 0.25}},
                        {"max_displacement_m", {0.0625, 0.75}}};
  EXPECT_EQ(stability.at("trials").at(1).at("history"), history);
  EXPECT_EQ(json.at("performance").at("particle_steps_per_cpu_second"), 50.0); // 300 in 2 + 4 s
}

TEST(RunWriter, TheReadingsAreInTheResult)
{
  const Json flow = result_json(small_case(), small_analysis()).at("seepage");
  const Json line = {{"name", "a/line"},
                     {"file", "lines/a_line.csv"},
                     {"length_m", 1.0},
                     {"points_m", {{0.0, 0.0}, {1.0, 0.0}}},
                     {"discharge_m2_s", -5e-7},
                     {"discharge_from", "stream function"},
                     {"water_force",
                      {{"force_kN_m", {0.0, 7.5}},
                       {"pressure_kN_m", 7.5},
                       {"moment_kNm_m", 3.5},
                       {"distance_m", 0.4375},
                       {"at_m", {0.4375, 0.0}}}}};
  EXPECT_EQ(flow.at("lines"), Json::array({line}));
  const Json outlet = {
      {"stretch", "ground"},     {"from_m", {1.0, 1.0}},     {"to_m", {0.5, 1.0}},
      {"outflow_m2_s", 5e-7},    {"gradient", 0.25},         {"at_m", {0.5, 1.0}},
      {"upward_gradient", 0.25}, {"critical_gradient", 1.0}, {"unbounded_at_m", {{1.0, 1.0}}},
      {"kept_away_m", 0.125}};
  EXPECT_EQ(flow.at("exit_gradients"), Json::array({outlet}));
  const Json heave = {
      {"factor", 3.5},
      {"surface",
       {{"factor", 4.0}, {"at_m", {0.5, 1.0}}, {"gradient", 0.25}, {"critical_gradient", 1.0}}},
      {"column",
       {{"factor", 3.5}, {"at_m", {0.5, 1.0}}, {"depth_m", 0.5}, {"excess_head_m", 0.125}}}};
  EXPECT_EQ(flow.at("heave"), heave);
  coupling::Analysis still = small_analysis();
  still.readings.heave = {};
  EXPECT_TRUE(result_json(small_case(), still).at("seepage").at("heave").at("factor").is_null());
}

TEST(RunWriter, TheReadingsAreTablesWithTheirUnits)
{
  const TemporaryDirectory directory;
  write_run(directory.path(), small_case(), small_analysis());
  EXPECT_EQ(contents(directory.path() / "lines" / "a_line.csv"),
            "distance_m,x_m,y_m,head_m,pore_pressure_kPa,flux_x_m_s,flux_y_m_s,gradient\n"
            "0,0,0,1,9.81,5e-07,0,0.5\n"
            "1,1,0,0.5,-4.905,5e-07,0,0.5\n");
  EXPECT_EQ(contents(directory.path() / "phreatic_lines.csv"), "line,x_m,y_m\n1,0,1\n1,1,0.5\n");
  EXPECT_EQ(contents(directory.path() / "exit_gradients.csv"),
            "outlet,stretch,counts,distance_m,x_m,y_m,head_m,normal_gradient,upward_gradient,"
            "critical_gradient,flux_m_s\n"
            "1,ground,0,0,1,1,1,2,2,1,2e-06\n"
            "1,ground,1,0.5,0.5,1,1,0.25,0.25,1,2.5e-07\n");
}

TEST(RunWriter, LinesOfAnEarlierRunAreRemoved)
{
  const TemporaryDirectory directory;
  write_run(directory.path(), small_case(), small_analysis());
  coupling::Case input = small_case();
  input.output.lines[0].name = "../b";
  write_run(directory.path(), input, small_analysis());
  EXPECT_EQ(names(directory.path() / "lines"), std::vector<std::string>{"___b.csv"});
  EXPECT_FALSE(fs::exists(directory.path() / "b.csv"));
  coupling::Analysis dry = small_analysis();
  dry.seepage.reset();
  write_run(directory.path(), input, dry);
  EXPECT_FALSE(fs::exists(directory.path() / "lines"));
  EXPECT_FALSE(fs::exists(directory.path() / "exit_gradients.csv"));
}

TEST(RunWriter, TheSmallestFactorStandsAboveAllSearches)
{
  coupling::Analysis analysis = small_analysis();
  auto& searches = analysis.stability->searches;
  searches.insert(searches.begin(), searches[0]);
  searches[0].region.name = "left side";
  searches[0].F.stands = 1.75;
  searches[0].F.fails = 1.77;
  searches[1].region.name = "right side";
  searches[1].region.min_depth = 2;
  const Json json = result_json(small_case(), analysis);
  const Json& stability = json.at("stability");
  EXPECT_EQ(stability.at("fails"), 1.51);
  EXPECT_EQ(stability.at("region"), "right side");
  EXPECT_EQ(stability.at("min_depth_m"), 2);
  EXPECT_EQ(stability.at("searches").size(), 2u);
  EXPECT_EQ(stability.at("searches").at(0).at("region"), "left side");
  EXPECT_DOUBLE_EQ(stability.at("searches").at(0).at("factor").get<double>(), 1.76);
  for (const auto& [key, value] : stability.at("searches").at(1).items())
    EXPECT_EQ(value, stability.at(key)) << key;
  EXPECT_TRUE(json.at("complete"));
  searches[0].F.complete = false; // one answer is missing
  EXPECT_FALSE(result_json(small_case(), analysis).at("complete"));
  EXPECT_FALSE(result_json(small_case(), small_analysis()).at("stability").contains("searches"));
}

TEST(RunWriter, AStageThatDidNotRunIsAbsent)
{
  const TemporaryDirectory directory;
  coupling::Analysis analysis = small_analysis();
  write_run(directory.path(), small_case(), analysis); // an earlier run that had both
  analysis.seepage.reset();
  write_run(directory.path(), small_case(), analysis);
  const Json json = Json::parse(contents(directory.path() / "result.json"));
  EXPECT_FALSE(json.contains("seepage"));
  EXPECT_TRUE(json.contains("stability"));
  EXPECT_FALSE(fs::exists(directory.path() / "results_mesh.xdmf"))
      << "left over from the earlier run";
}

TEST(RunWriter, AnUndecidedSearchIsWrittenAsSuch)
{
  coupling::Analysis analysis = small_analysis();
  auto& factor = analysis.stability->searches[0].F;
  factor.fails.reset();
  factor.complete = false;
  factor.reason = "why";
  analysis.stability->searches[0].mechanism.reset();
  analysis.interrupted = true;
  const Json json = result_json(small_case(), analysis);
  EXPECT_EQ(json.at("complete"), false);
  EXPECT_EQ(json.at("interrupted"), true);
  EXPECT_TRUE(json.at("stability").at("factor").is_null());
  EXPECT_TRUE(json.at("stability").at("fails").is_null());
  EXPECT_EQ(json.at("stability").at("reason"), "why");
}

TEST(RunWriter, EqualRunsGiveEqualFiles)
{
  const TemporaryDirectory directory;
  for (const char* name : {"a", "b"})
    write_run(directory.path() / name, small_case(), small_analysis());
  for (const std::string& name : names(directory.path() / "a"))
    EXPECT_EQ(contents(directory.path() / "a" / name), contents(directory.path() / "b" / name))
        << name;
}

TEST(RunWriter, RefusesNaNNamingFieldAndPlaceAndKeepsTheEarlierRun)
{
  const TemporaryDirectory directory;
  write_run(directory.path(), small_case(), small_analysis());
  const std::string earlier = contents(directory.path() / "result.json");

  const auto refused = [&](const char* text, auto&& spoil)
  {
    coupling::Analysis analysis = small_analysis();
    spoil(analysis);
    try
    {
      write_run(directory.path(), small_case(), analysis);
      ADD_FAILURE() << text << " was written";
    }
    catch (const NumericalError& e)
    {
      EXPECT_NE(std::string(e.what()).find(text), std::string::npos) << e.what();
    }
    EXPECT_EQ(contents(directory.path() / "result.json"), earlier);
    EXPECT_EQ(names(directory.path()).size(), 8u) << "something written aside was left behind";
  };
  refused("/seepage/discharge_m2_s", [](auto& a) { a.seepage->discharge = NAN; });
  refused("/stability/trials/1/velocity_measure",
          [](auto& a) { a.stability->searches[0].F.trials[1].velocity_measure = INFINITY; });
  refused("/mesh/head[2] = nan at (1, 1) m", [](auto& a) { a.seepage->head[2] = NAN; });
  refused("/particles/failing/displacement[1] = inf at (0.5, 0.5) m",
          [](auto& a) { a.stability->searches[0].F.trials[1].state.ux[1] = INFINITY; });
  refused("lines/a_line.csv: head_m = nan in row 2",
          [](auto& a) { a.readings.lines[0].samples[1].head = NAN; });
  refused("exit_gradients.csv: normal_gradient = inf in row 1",
          [](auto& a) { a.readings.outlets[0].points[0].normal = INFINITY; });
  refused("phreatic_lines.csv: y_m = nan in row 2",
          [](auto& a) { a.seepage->phreatic_lines[0][1].y() = NAN; });
  refused("/seepage/heave/factor", [](auto& a) { a.readings.heave.surface->factor = NAN; });
  refused("/particles/settled/stress_xy[2]",
          [](auto& a) { a.stability->settled.stress[2].xy = NAN; });
}

TEST(RunWriter, TellsWhereNothingCanBeWritten)
{
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "file") << "x";
  EXPECT_THROW(prepare_directory(directory.path() / "file"), IoError);
  EXPECT_THROW(prepare_directory(directory.path() / "file" / "below"), IoError);
  EXPECT_THROW(prepare_directory("/proc/berm"), IoError);
}

TEST(RunWriter, LeavesFilesOfOthersAlone)
{
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "notes.txt") << "mine";
  write_run(directory.path(), small_case(), small_analysis());
  EXPECT_EQ(contents(directory.path() / "notes.txt"), "mine");
}

TEST(RunWriter, NamesTheDirectoryAfterTheCase)
{
  EXPECT_EQ(default_directory("cases/dam/dry.toml"), fs::path("results/dam_dry"));
  EXPECT_EQ(default_directory("/a/b/../c/dry.toml"), fs::path("results/c_dry"));
  EXPECT_EQ(default_directory("/dry.toml"), fs::path("results/dry"));
}

TEST(ResultJson, BearsAPathThatIsNotUtf8)
{
  coupling::Case input = small_case();
  input.path = "d\xff/case.toml";
  EXPECT_TRUE(Json::accept(json_text(result_json(input, small_analysis()))));
}

TEST(ResultJson, KeepsPointsOnOneLine)
{
  const Json json = {
      {"a", 1}, {"b", {{1.5, 2.0}, {3.0, 4.0}}}, {"c", {{"d", nullptr}}}, {"e", Json::array()}};
  const std::string text = json_text(json);
  EXPECT_EQ(text, "{\n  \"a\": 1,\n  \"b\": [[1.5,2.0],[3.0,4.0]],\n  \"c\": {\n    \"d\": null\n  "
                  "},\n  \"e\": []\n}");
  EXPECT_EQ(Json::parse(text), json);
}
} // namespace berm::app::test
