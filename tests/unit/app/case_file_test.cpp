// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_file.h"

#include "app/version.h"
#include "case_text.h"

#include <gtest/gtest.h>

#include <random>

namespace berm::app::test
{
namespace
{
std::string replaced(std::string text, const std::string& what, const std::string& with)
{
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

ReadResult read_set(const std::vector<std::string>& overrides)
{
  return read_text(sound_case, {.overrides = overrides});
}
} // namespace

TEST(CaseFile, ConvertsToSiAndRadians)
{
  const ReadResult result = read_text(sound_case);
  ASSERT_TRUE(result.mistakes.empty()) << result.text();
  const sph::Soil& soil = result.input.soils.at(0).mechanical;
  EXPECT_DOUBLE_EQ(soil.density, 2000); // 19.62 kN/m3 / 9.81 m/s2
  EXPECT_DOUBLE_EQ(soil.saturated_density, 2000);
  EXPECT_DOUBLE_EQ(soil.cohesion, 10e3);
  EXPECT_DOUBLE_EQ(soil.friction_angle, pi / 6);
  EXPECT_DOUBLE_EQ(soil.dilation_angle, 0);
  EXPECT_DOUBLE_EQ(soil.young_modulus, 1e8);
  EXPECT_DOUBLE_EQ(soil.poisson_ratio, 0.3);
  EXPECT_EQ(result.input.section.ground.size(), 4u);
  EXPECT_EQ(result.input.section.base,
            (Polyline{{0, -5}, {40, -5}})); // a level, over the ground's x
}

TEST(CaseFile, FillsDefaultsIn)
{
  const coupling::Case input = read_text(sound_case).input;
  EXPECT_DOUBLE_EQ(input.search.lower, 0.5);
  EXPECT_DOUBLE_EQ(input.search.upper, 3.0);
  EXPECT_DOUBLE_EQ(input.search.tolerance, 0.005);
  EXPECT_EQ(input.sph.spacing, 0);
  EXPECT_EQ(input.sph.packing, "auto");
  EXPECT_EQ(input.sph.cone, "fitted");
  EXPECT_EQ(input.sph.formulation, "total_lagrangian");
  EXPECT_EQ(input.sph.threads, 0);
  EXPECT_TRUE(input.stability);
  EXPECT_TRUE(input.seepage.adaptive);
  EXPECT_TRUE(input.output.probes.empty());
  EXPECT_EQ(read_text(replaced(sound_case, "title = \"a slope\"", "")).input.title, "case");
}

TEST(CaseFile, KeepsTheTextAsItStands)
{
  const std::string text = replaced(sound_case, "format = 1", "# a comment\r\nformat = 1");
  const ReadResult result = read_text(text, {.overrides = {"sph.spacing_m=1"}});
  EXPECT_EQ(result.input.text, text);
  EXPECT_EQ(result.input.overrides, std::vector<std::string>{"sph.spacing_m=1"});
  EXPECT_DOUBLE_EQ(result.input.sph.spacing, 1);
}

TEST(CaseFile, TakesSoilsInTheFilesOrder)
{
  // By name the order would be clay, sand, zinc.
  std::string soil = sound_case.substr(sound_case.find("unit_weight"));
  soil = soil.substr(0, soil.find("[water]"));
  const std::string text =
      replaced(sound_case, "[soil.fill]",
               "[[section.zone]]\nsoil = \"clay\"\npolygon_m = [[0,0],[9,0],[9,5]]\n"
               "[soil.zinc]\n" +
                   soil + "[soil.clay]\n" + soil + "[soil.sand]");
  const ReadResult result = read_text(text);
  ASSERT_TRUE(result.mistakes.empty()) << result.text();
  ASSERT_EQ(result.input.soils.size(), 3u);
  EXPECT_EQ(result.input.soils[0].name, "zinc");
  EXPECT_EQ(result.input.soils[1].name, "clay");
  EXPECT_EQ(result.input.soils[2].name, "sand");
  EXPECT_EQ(result.input.section.zones.at(0).soil, 1);
}

TEST(CaseFile, TakesTheRetentionCurveOfASoil)
{
  const std::string conductive =
      replaced(sound_case, "poisson_ratio", "conductivity_m_s = 1e-6\npoisson_ratio");
  const auto retention = [&](std::vector<std::string> overrides)
  {
    for (std::string& o : overrides)
      o = "soil.fill.retention." + o;
    const ReadResult result = read_text(conductive, {.overrides = overrides});
    EXPECT_TRUE(result.mistakes.empty()) << result.text();
    return result.input.soils.at(0).conductivity.value().retention;
  };
  EXPECT_EQ(retention({}).model, seepage::RetentionModel::sharp);
  const seepage::Retention g = retention({"model=gardner", "alpha_1_m=2.5"});
  EXPECT_EQ(g.model, seepage::RetentionModel::gardner);
  EXPECT_EQ(g.alpha, 2.5);
  const seepage::Retention v =
      retention({"model=van_genuchten", "alpha_1_m=3", "van_genuchten_n=1.5"});
  EXPECT_EQ(v.model, seepage::RetentionModel::van_genuchten);
  EXPECT_EQ(v.n, 1.5);
  EXPECT_EQ(v.l, 0.5);
  EXPECT_EQ(v.air_entry, 0.02); // the slope of k_r at p = 0 has no bound without
  EXPECT_EQ(retention({"model=van_genuchten", "alpha_1_m=3", "van_genuchten_n=2"}).air_entry, 0);
  const seepage::Retention all = retention({"model=van_genuchten", "alpha_1_m=3",
                                            "van_genuchten_n=2", "mualem_l=-1", "air_entry_m=0.3"});
  EXPECT_EQ(all.l, -1);
  EXPECT_EQ(all.air_entry, 0.3);
}

TEST(CaseFile, ARetentionCurveHasTheKeysOfItsModel)
{
  const std::string at = "soil.fill.retention.";
  const auto mistakes = [&](const std::vector<std::string>& overrides)
  {
    std::vector<std::string> full;
    for (const std::string& o : overrides)
      full.push_back(at + o);
    return read_set(full);
  };
  EXPECT_NE(mistakes({"model=gardner"}).about(at + "alpha_1_m"), nullptr);
  EXPECT_NE(mistakes({"model=van_genuchten", "alpha_1_m=1"}).about(at + "van_genuchten_n"),
            nullptr);
  EXPECT_NE(mistakes({"alpha_1_m=1"}).about(at + "alpha_1_m"), nullptr); // sharp
  for (const char* key : {"van_genuchten_n", "mualem_l", "air_entry_m"})
    EXPECT_NE(mistakes({"model=gardner", "alpha_1_m=1", std::string(key) + "=1"}).about(at + key),
              nullptr)
        << key;
}

TEST(CaseFile, ReportsEveryMistakeAtOnce)
{
  std::string text = replaced(sound_case, "friction_angle_deg = 30", "friction_angle_deg = 95");
  text = replaced(text, "cohesion_kPa", "cohesion_Pa");
  text = replaced(text, "[40, 0]]", "[32, 0], [20, -9]]");
  const ReadResult result = read_text(text);
  EXPECT_NE(result.about("soil.fill.friction_angle_deg"), nullptr);
  EXPECT_NE(result.about("soil.fill.cohesion_Pa"), nullptr);
  EXPECT_NE(result.about("soil.fill.cohesion_kPa"), nullptr);
  EXPECT_NE(result.about("section.ground_m"), nullptr)
      << "geometry is checked together with the rest";
  EXPECT_TRUE(result.text().ends_with("mistakes; nothing was run.\n"));
}

TEST(CaseFile, GivesMistakesOfTheDrawingTheirLine)
{
  // The ground crosses itself; the pool lies below the ground at its end; the marked line is not on
  // the outline.
  const ReadResult crossing =
      read_text(replaced(sound_case, "[12, 10], [32, 0]", "[32, 0], [12, 10]"));
  ASSERT_NE(crossing.about("section.ground_m"), nullptr);
  EXPECT_TRUE(crossing.places.find("section.ground_m").text.ends_with(":4"));

  const ReadResult dry_pool =
      read_text(replaced(sound_case, "\"none\"", "\"hydrostatic\"\nleft_level_m = 9"));
  ASSERT_NE(dry_pool.about("water.left_level_m"), nullptr) << dry_pool.text();
  EXPECT_TRUE(dry_pool.places.find("water.left_level_m").text.ends_with(":15"));

  const ReadResult zone = read_text(
      sound_case + "[[section.zone]]\nsoil = \"fill\"\npolygon_m = [[0,0],[9,5],[9,0],[0,5]]\n");
  ASSERT_NE(zone.about("section.zone[1].polygon_m"), nullptr) << zone.text();
  EXPECT_TRUE(zone.places.find("section.zone[1].polygon_m").text.ends_with(":17"));
}

/// The sound case with seepage, and these keys.
std::vector<std::string> with_seepage(std::vector<std::string> overrides)
{
  overrides.insert(overrides.begin(),
                   {"water.pore_pressure=seepage", "soil.fill.conductivity_m_s=1e-7"});
  return overrides;
}

TEST(CaseFile, AsksForWaterThatIsNamedBeItDryInEffect)
{
  if (!seepage_built_in())
    GTEST_SKIP() << "built without the seepage stage";
  EXPECT_NE(read_set(with_seepage({})).about("water.pore_pressure"), nullptr);
  EXPECT_NE(read_set(with_seepage({"seepage.boundary[1]={line_m=[[40,-5],[40,0]], "
                                   "kind=\"inflow\", value=-1e-8}"}))
                .about("water.pore_pressure"),
            nullptr);
  for (const char* water :
       {"water.right_level_m=0", // the ground's level: no pool
        "water.right_level_m=2", "seepage.rain_m_s=1e-8",
        "seepage.boundary[1]={line_m=[[0,10],[12,10]], kind=\"rain\", value=1e-8}",
        "seepage.boundary[1]={line_m=[[0,0],[5,0]], kind=\"inflow\", value=1e-8}"})
    EXPECT_TRUE(read_set(with_seepage({water})).mistakes.empty())
        << water << read_set(with_seepage({water})).text();
}

TEST(CaseFile, RefusesRainOnALineInTheSoil)
{
  if (!seepage_built_in())
    GTEST_SKIP() << "built without the seepage stage";
  const ReadResult result = read_set(
      with_seepage({"seepage.boundary[1]={line_m=[[5,0],[10,0]], kind=\"rain\", value=1e-8}"}));
  ASSERT_NE(result.about("seepage.boundary[1].kind"), nullptr) << result.text();
  EXPECT_NE(result.text().find("it does not rain inside the soil"), std::string::npos);
}

TEST(CaseFile, ChecksRulesThatConcernSeveralKeys)
{
  const auto expect = [](const std::vector<std::string>& overrides, const std::string& key)
  {
    const ReadResult result = read_set(overrides);
    EXPECT_NE(result.about(key), nullptr) << overrides.back() << "\n" << result.text();
    EXPECT_NE(result.text().find("--set "), std::string::npos) << result.text();
  };
  expect({"soil.fill.dilation_angle_deg=31"}, "soil.fill.dilation_angle_deg");
  expect({"soil.fill.saturated_unit_weight_kN_m3=18"}, "soil.fill.saturated_unit_weight_kN_m3");
  expect({"section.outline_m=[[0,0],[1,0],[1,1]]"}, "section.outline_m");
  expect({"section.zone[1]={soil=\"fil\", polygon_m=[[0,0],[9,0],[9,5]]}"}, "section.zone[1].soil");
  expect({"water.pore_pressure=hydrostatic"}, "water.pore_pressure");
  expect({"water.pore_pressure=hydrostatic", "water.free_surface_m=[[0,1],[0,2]]"},
         "water.free_surface_m");
  expect({"stability.enabled=false"}, "stability.enabled");
  expect({"sph.spacing_m=0.001"}, "sph.spacing_m");
  expect({"sph.spacing_m=4"}, "sph.spacing_m");
  expect({"output.probes_m=[[30,9]]"}, "output.probes_m");
  expect({"seepage.boundary[1]={line_m=[[40,-5],[40,0]], kind=\"head\"}"},
         "seepage.boundary[1].value");
  expect({"seepage.boundary[1]={line_m=[[40,-5],[40,0]], kind=\"impervious\", value=1}"},
         "seepage.boundary[1].value");
  expect({"seepage.boundary[1]={line_m=[[40,-5],[40,0]], kind=\"inflow\", value=2}"},
         "seepage.boundary[1].value");
  expect({"seepage.boundary[1]={line_m=[[0,10],[12,10]], kind=\"rain\"}"},
         "seepage.boundary[1].value");
  expect({"seepage.boundary[1]={line_m=[[0,10],[12,10]], kind=\"rain\", value=-1e-8}"},
         "seepage.boundary[1].value");
}

TEST(CaseFile, AsksForConductivityExactlyWhereSeepageIsAskedFor)
{
  const std::vector<std::string> seepage = {"water.pore_pressure=seepage",
                                            "water.left_level_m=10.5"};
  EXPECT_NE(read_set(seepage).about("soil.fill.conductivity_m_s"), nullptr);
  EXPECT_NE(read_text(sound_case, {.overrides = {}, .seepage_only = true})
                .about("soil.fill.conductivity_m_s"),
            nullptr);
  EXPECT_EQ(read_set({"sph.spacing_m=1"}).about("soil.fill.conductivity_m_s"), nullptr);
}

TEST(CaseFile, ReadsSeepageOrSaysThatItIsNotBuiltIn)
{
  const ReadResult result =
      read_set({"water.pore_pressure=seepage", "water.left_level_m=10.5",
                "soil.fill.conductivity_m_s=[1e-6,1e-7]", "soil.fill.conductivity_angle_deg=90"});
  if (!seepage_built_in())
  {
    ASSERT_NE(result.about("water.pore_pressure"), nullptr);
    EXPECT_NE(result.text().find("no seepage stage"), std::string::npos);
    return;
  }
  ASSERT_TRUE(result.mistakes.empty()) << result.text();
  const seepage::Conductivity& k = result.input.soils[0].conductivity.value();
  EXPECT_DOUBLE_EQ(k.kx, 1e-6);
  EXPECT_DOUBLE_EQ(k.ky, 1e-7);
  EXPECT_DOUBLE_EQ(k.angle, pi / 2);
  EXPECT_DOUBLE_EQ(result.input.section.left_pool_level.value(), 10.5);
}

TEST(CaseFile, LeavesPoolsOutWhereTheSoilIsDry)
{
  const ReadResult result = read_set({"water.left_level_m=10.5"});
  ASSERT_TRUE(result.mistakes.empty()) << result.text();
  EXPECT_FALSE(result.input.section.left_pool_level);
}

TEST(CaseFile, TellsFilesThatCannotBeReadFromMistakes)
{
  KeyPlaces places;
  EXPECT_THROW((void)read_case("/nonexistent/case.toml", {}, places), IoError);
  EXPECT_THROW((void)read_case("/", {}, places), IoError);
  EXPECT_THROW((void)read_case("/dev/zero", {}, places), IoError) << "never ends";
}

TEST(CaseFile, NeverFallsOverWhateverTheFileHolds)
{
  const std::vector<std::string> texts = {"",
                                          "\n",
                                          std::string(1, '\0'),
                                          "\xEF\xBB\xBF",
                                          "soil = 3",
                                          "section = []",
                                          "section.zone = [1]",
                                          "[[soil]]",
                                          "[[soil.fill]]",
                                          "[soil.\"a.b\"]",
                                          "[section.\"zone[]\"]",
                                          "[\"*\"]",
                                          "seepage.boundary = {}",
                                          "format = {}"};
  for (const std::string& text : texts)
    EXPECT_FALSE(read_text(text).mistakes.empty());

  std::mt19937 random(20240501); // any seed: the same files each time
  for (int round = 0; round < 1000; ++round)
  {
    std::string text = sound_case;
    for (int change = 0; change < 1 + round % 8; ++change)
    {
      const std::size_t at = random() % text.size();
      switch (random() % 3)
      {
      case 0:
        text[at] = static_cast<char>(random() % 256);
        break;
      case 1:
        text.erase(at, random() % 20);
        break;
      default:
        text.insert(at, text.substr(random() % text.size(), random() % 30));
        break;
      }
      text.append(text.empty(), 'x');
    }
    (void)read_text(text); // mistakes or a case: never another exception
  }
}

TEST(CaseFile, ReadsWhereTheStrengthIsReduced)
{
  const std::string scope = R"([stability]
side = "right"
search_region_m = [[0, -5], [40, -5], [40, 12], [0, 12]]
exclude_region_m = [[[0, -5], [4, -5], [4, 12]], [[36, -5], [40, -5], [40, 0], [36, -5]]]
min_depth_m = 2
)";
  const ReadResult result = read_text(sound_case + scope);
  ASSERT_TRUE(result.mistakes.empty()) << result.text();
  const coupling::SearchScope& read = result.input.scope;
  EXPECT_EQ(read.side, coupling::Side::right);
  ASSERT_EQ(read.inside.size(), 1u);
  EXPECT_EQ(read.inside[0].size(), 4u);
  ASSERT_EQ(read.outside.size(), 2u);
  EXPECT_EQ(read.outside[1].size(), 3u); // without the last point, which repeats the first
  EXPECT_EQ(read.min_depth, 2);
}

TEST(CaseFile, ReportsAllMistakesAboutWhereTheStrengthIsReduced)
{
  const ReadResult wrong = read_text(sound_case + R"([stability]
search_region_m = [[[0, 0], [10, 0], [10, 5]], [[0, 0], [10, 10], [10, 0], [0, 10]]]
exclude_region_m = [[100, 0], [110, 0], [110, 9]]
min_depth_m = 0.1
)");
  EXPECT_EQ(wrong.mistakes.size(), 3u) << wrong.text();
  const Mistake* crossed = wrong.about("stability.search_region_m");
  ASSERT_NE(crossed, nullptr);
  EXPECT_TRUE(crossed->problem.starts_with("polygon 2: edge 1 crosses edge 3")) << crossed->problem;
  const Mistake* outside = wrong.about("stability.exclude_region_m");
  ASSERT_NE(outside, nullptr);
  EXPECT_EQ(outside->problem, "holds no part of the section");
  EXPECT_NE(wrong.about("stability.min_depth_m"), nullptr); // less than two spacings

  const ReadResult left = read_text(sound_case + "[stability]\nside = \"left\"\n");
  ASSERT_NE(left.about("stability.side"), nullptr) << "the ground falls to the right only";
  const ReadResult nothing = read_text(sound_case + R"([stability]
search_region_m = [[1, 0], [9, 0], [9, 5]]
exclude_region_m = [[0, -1], [10, -1], [10, 6], [0, 6]]
)");
  ASSERT_NE(nothing.about("stability.search_region_m"), nullptr) << nothing.text();
  EXPECT_TRUE(
      nothing.about("stability.search_region_m")->problem.starts_with("leaves no soil to weaken"));
  const ReadResult deep = read_text(sound_case + "[stability]\nmin_depth_m = 20\n");
  ASSERT_NE(deep.about("stability.min_depth_m"), nullptr) << deep.text();
}
} // namespace berm::app::test
