// SPDX-License-Identifier: GPL-3.0-or-later
// Bad-input tests that are generated from the key table: a new key is tested the day it is added.
#include "app/case_schema.h"
#include "case_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace berm::app::test
{
namespace
{
/// Values that are sound together; choices and booleans that are not here take their first.
const std::map<std::string, std::string, std::less<>> sound_values = {
    {"format", "1"},
    {"title", "\"a slope\""},
    {"section.ground_m", "[[0, 8], [6, 10], [12, 10], [32, 0], [40, 0]]"},
    {"section.base_m", "-5"},
    {"section.outline_m", "[[0, 0], [40, 0], [12, 10], [0, 8]]"},
    {"section.mesh_file", "\"dam.geo\""},
    {"section.zone[].soil", "\"fill\""},
    {"section.zone[].polygon_m", "[[0, 0], [10, 0], [10, 8]]"},
    {"soil.*.unit_weight_kN_m3", "19"},
    {"soil.*.saturated_unit_weight_kN_m3", "20"},
    {"soil.*.cohesion_kPa", "10"},
    {"soil.*.friction_angle_deg", "30"},
    {"soil.*.dilation_angle_deg", "0"},
    {"soil.*.young_modulus_kPa", "1e5"},
    {"soil.*.poisson_ratio", "0.3"},
    {"soil.*.tensile_strength_kPa", "5"},
    {"soil.*.conductivity_m_s", "[1e-6, 1e-7]"},
    {"soil.*.conductivity_angle_deg", "10"},
    {"soil.*.retention.model", "\"van_genuchten\""},
    {"soil.*.retention.alpha_1_m", "2"},
    {"soil.*.retention.van_genuchten_n", "1.5"},
    {"soil.*.retention.mualem_l", "0.5"},
    {"soil.*.retention.air_entry_m", "0.05"},
    {"water.pore_pressure", "\"hydrostatic\""},
    {"water.left_level_m", "9"},
    {"water.right_level_m", "3"},
    {"water.free_surface_m", "[[0, 8], [40, -1]]"},
    {"seepage.boundary[].line_m", "[[40, -5], [40, 0]]"},
    {"seepage.boundary[].curve", "\"drain\""},
    {"seepage.boundary[].kind", "\"head\""},
    {"seepage.boundary[].value", "1"},
    {"seepage.rain_m_s", "1e-8"},
    {"seepage.element_size_m", "1"},
    {"seepage.tolerance", "1e-3"},
    {"seepage.phreatic_tolerance_m", "0.05"},
    {"seepage.max_unknowns", "50000"},
    {"sph.spacing_m", "0.5"},
    {"sph.threads", "1"},
    {"stability.factor_range", "[1, 2]"},
    {"stability.tolerance", "0.02"},
    {"stability.flow_rule_spread", "true"},
    {"stability.search_region_m",
     "[[[0, -5], [20, -5], [20, 12], [0, 12]], [[20, -5], [40, -5], [40, 9]]]"},
    {"stability.exclude_region_m", "[[1, 1], [2, 1], [2, 2]]"},
    {"stability.min_depth_m", "1.5"},
    {"runout.factor", "1"},
    {"runout.duration_s", "20"},
    {"runout.frame_interval_s", "0.5"},
    {"runout.shake_g", "0"},
    {"runout.shake_duration_s", "0"},
    {"output.probes_m", "[[5, 5]]"},
    {"output.line[].name", "\"a line\""},
    {"output.line[].points_m", "[[5, 5], [6, 5]]"},
    {"output.line[].samples", "11"},
};

std::string sound_value(const Key& key)
{
  if (const auto it = sound_values.find(key.path); it != sound_values.end())
    return it->second;
  if (key.type == ValueType::choice)
    return fmt::format("\"{}\"", key.choices.front());
  if (key.type == ValueType::choice_list)
    return fmt::format("[\"{}\"]", fmt::join(key.choices, "\", \""));
  return key.type == ValueType::boolean ? "true" : "";
}

/// The path as it is in a case with the one soil "fill": "soil.fill.cohesion_kPa",
/// "section.zone[1].soil".
std::string instance(std::string_view path)
{
  std::string text(path);
  if (const auto star = text.find('*'); star != std::string::npos)
    text.replace(star, 1, "fill");
  if (const auto brackets = text.find("[]"); brackets != std::string::npos)
    text.replace(brackets, 2, "[1]");
  return text;
}

/// "[soil.fill]\n" of "soil.*.cohesion_kPa".
std::string header(std::string_view path)
{
  const auto cut = path.rfind('.');
  if (cut == std::string_view::npos)
    return "";
  const std::string table = instance(path.substr(0, cut));
  if (table.ends_with("[1]"))
    return fmt::format("[[{}]]\n", table.substr(0, table.size() - 3));
  return fmt::format("[{}]\n", table);
}

struct Written
{
  std::string text;
  int line = 0; ///< of the key in question
};

/// Whether a case gives one key in place of another.
bool replaces(std::string_view key, std::string_view other)
{
  const bool ground = other == "section.ground_m" || other == "section.base_m";
  return (key == "section.outline_m" && ground) ||
         (key == "section.mesh_file" && (ground || other.starts_with("section.zone"))) ||
         (key == "seepage.boundary[].curve" && other == "seepage.boundary[].line_m");
}

/// The case of `sound_values` with one key given another value, or left out if that is empty.
Written write_case(std::string_view key, const std::string& value)
{
  Written out;
  std::string table;
  int line = 0;
  for (const Key& k : keys())
  {
    // One way to draw the section, one to draw a boundary: where another is in question, it takes
    // the place of the usual one.
    const bool unusual = k.path == "section.outline_m" || k.path == "section.mesh_file" ||
                         k.path == "seepage.boundary[].curve";
    if ((unusual && key != k.path) || replaces(key, k.path))
      continue;
    if (header(k.path) != table)
    {
      table = header(k.path);
      out.text += table;
      ++line;
    }
    if (k.path == key && value.empty())
      continue;
    ++line;
    if (k.path == key)
      out.line = line;
    out.text += fmt::format("{} = {}\n", last_part(k.path), k.path == key ? value : sound_value(k));
  }
  return out;
}

/// Expect a mistake about the key, at its line.
void expect_mistake(const Key& key, const std::string& value)
{
  const Written written = write_case(key.path, value);
  const ReadResult result = read_text(written.text);
  const Mistake* mistake = result.about(instance(key.path));
  ASSERT_NE(mistake, nullptr) << key.path << " = " << value << " passes\n" << result.text();
  const std::string place = result.places.find(mistake->key).text;
  EXPECT_TRUE(place.ends_with(fmt::format("case.toml:{}", written.line)))
      << key.path << " = " << value << " is said to be at " << place << "\n"
      << written.text;
  EXPECT_FALSE(mistake->problem.empty() && mistake->allowed.empty());
}

bool holds_numbers(const Key& key)
{
  return key.type != ValueType::text && key.type != ValueType::choice &&
         key.type != ValueType::choice_list && key.type != ValueType::boolean;
}

/// A value of the key's form with `number` in it.
std::string with_number(const Key& key, const std::string& number)
{
  switch (key.type)
  {
  case ValueType::points:
    return fmt::format("[[{}, 0], [1, 1], [2, 0]]", number);
  case ValueType::polygons:
    return fmt::format("[[[0, 0], [1, 0], [0, 1]], [[{}, 0], [1, 1], [2, 0]]]", number);
  case ValueType::interval:
    return fmt::format("[{}, {}]", number, number);
  default:
    return number;
  }
}
/// The number nearest to a bound that is not allowed any more.
std::string just_beyond(const Key& key, double bound, bool open, int direction)
{
  if (open)
    return fmt::format("{:.17e}", bound);
  if (key.type == ValueType::integer)
    return fmt::format("{:.0f}", bound + direction);
  const double next = bound == 0 ? direction * 1e-300 : std::nextafter(bound, direction * HUGE_VAL);
  return fmt::format("{:.17e}", next);
}
} // namespace

TEST(CaseSchema, EveryKeyHasASoundValueHere)
{
  std::set<std::string_view> paths;
  for (const Key& key : keys())
  {
    EXPECT_FALSE(sound_value(key).empty()) << key.path;
    EXPECT_TRUE(paths.insert(key.path).second) << key.path << " is declared twice";
    EXPECT_TRUE(key.sentence.ends_with(".")) << key.path;
    EXPECT_EQ(key.presence == Presence::required, key.otherwise.empty()) << key.path;
    const bool chosen = key.type == ValueType::choice || key.type == ValueType::choice_list;
    EXPECT_EQ(chosen, !key.choices.empty()) << key.path;
  }
  for (const auto& [path, value] : sound_values)
    EXPECT_TRUE(paths.contains(path)) << path << " is not a key any more";
}

TEST(CaseSchema, TheSoundValuesHaveNoMistake)
{
  const std::string outline = sound_values.at("section.outline_m");
  for (const Written& written : {write_case("", ""), write_case("section.outline_m", outline)})
  {
    const ReadResult result = read_text(written.text);
    EXPECT_TRUE(result.mistakes.empty()) << result.text();
  }
}

TEST(CaseSchema, AWrongTypeIsReportedAtItsLine)
{
  for (const Key& key : keys())
    for (const char* value :
         {"\"abc\"", "3", "1.5", "true", "1979-05-27", "[]", "[[1], [2]]", "{ a = 1 }"})
    {
      const std::string_view v = value;
      const bool number = v == "3" || v == "1.5";
      const bool right =
          (key.type == ValueType::text && v == "\"abc\"") ||
          (key.type == ValueType::boolean && v == "true") ||
          (key.type == ValueType::integer && v == "3" && key.range.contains(3)) ||
          (number && (key.type == ValueType::number || key.type == ValueType::level_or_polyline ||
                      key.type == ValueType::conductivity));
      if (!right)
        expect_mistake(key, value);
    }
}

TEST(CaseSchema, ANumberBeyondABoundIsReportedAtItsLine)
{
  for (const Key& key : keys())
  {
    if (!holds_numbers(key))
      continue;
    const Range& r = key.range;
    ASSERT_TRUE(std::isfinite(r.lower) && std::isfinite(r.upper)) << key.path << " has no range";
    expect_mistake(key, with_number(key, just_beyond(key, r.lower, r.lower_open, -1)));
    expect_mistake(key, with_number(key, just_beyond(key, r.upper, r.upper_open, 1)));
  }
}

TEST(CaseSchema, NaNAndInfinityAreReportedAtTheirLine)
{
  for (const Key& key : keys())
    if (holds_numbers(key))
      for (const char* number : {"nan", "inf", "-inf"})
        expect_mistake(key, with_number(key, number));
}

TEST(CaseSchema, AWrongChoiceIsReportedWithTheNearestOne)
{
  for (const Key& key : keys())
    for (const std::string_view choice : key.choices)
    {
      const Written written = write_case(key.path, fmt::format("\"{}x\"", choice));
      const ReadResult result = read_text(written.text);
      const Mistake* mistake = result.about(instance(key.path));
      ASSERT_NE(mistake, nullptr) << key.path;
      EXPECT_EQ(mistake->hint, fmt::format("did you mean \"{}\"?", choice));
    }
}

TEST(CaseSchema, AListOfChoicesHoldsKnownOnesOnce)
{
  for (const Key& key : keys())
    if (key.type == ValueType::choice_list)
      for (const char* list : {"[\"{0}\", \"{0}\"]", "[\"{0}\", \"{0}x\"]", "[\"{0}\", 1]"})
        expect_mistake(key, fmt::format(fmt::runtime(list), key.choices.front()));
}

TEST(CaseSchema, ARequiredKeyThatIsMissingIsReported)
{
  for (const Key& key : keys())
  {
    const ReadResult result = read_text(write_case(key.path, "").text);
    const Mistake* mistake = result.about(instance(key.path));
    if (key.presence == Presence::required)
    {
      ASSERT_NE(mistake, nullptr) << key.path;
      EXPECT_EQ(mistake->problem, missing_key);
    }
    else if (key.presence == Presence::defaulted)
    {
      EXPECT_EQ(mistake, nullptr) << key.path << "\n" << result.text();
    }
  }
}

TEST(CaseSchema, AMistypedKeyIsReportedWithTheRightOne)
{
  for (const Key& key : keys())
  {
    const std::string name(last_part(key.path));
    const std::string wrong = name.substr(0, name.size() - 1); // the last letter is missing
    Written written = write_case(key.path, sound_value(key));
    const auto at = ("\n" + written.text).find("\n" + name + " = ");
    ASSERT_NE(at, std::string::npos);
    // The name may occur in another table first: the one of this key is at its own line.
    std::size_t start = 0;
    for (int line = 1; line < written.line; ++line)
      start = written.text.find('\n', start) + 1;
    written.text.replace(start, name.size(), wrong);
    const ReadResult result = read_text(written.text);
    const std::string path = instance(key.path);
    const Mistake* mistake = result.about(path.substr(0, path.size() - 1));
    ASSERT_NE(mistake, nullptr) << path << "\n" << result.text();
    EXPECT_EQ(mistake->problem, unknown_key);
    EXPECT_TRUE(mistake->hint.starts_with("did you mean " + name)) << path << ": " << mistake->hint;
  }
}

TEST(CaseSchema, TheReferenceNamesEveryKey)
{
  const std::string reference = case_reference();
  for (const Key& key : keys())
    EXPECT_NE(reference.find(fmt::format("| `{}` |", last_part(key.path))), std::string::npos)
        << key.path;
}
} // namespace berm::app::test
