// SPDX-License-Identifier: GPL-3.0-or-later
// Every key, random legal values: what --set says is what the case holds, to the last bit.
#include "app/case_check.h"
#include "app/case_schema.h"
#include "app/toml_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <regex>
#include <string>

namespace berm::app
{
namespace
{
constexpr int values_of_each = 40;

using Dice = std::mt19937_64;

/// Even in value, or in its logarithm where the range spans decades.
double number_in(const Range& range, Dice& dice)
{
  const double t = std::uniform_real_distribution(0.001, 0.999)(dice);
  if (range.lower > 0 && range.upper / range.lower > 1e3)
    return range.lower * std::pow(range.upper / range.lower, t);
  return range.lower + t * (range.upper - range.lower);
}

std::string points_in(const Key& key, Dice& dice, Polyline& points)
{
  const int count = key.least_points + static_cast<int>(dice() % 5);
  std::string text;
  for (int i = 0; i < count; ++i)
  {
    points.emplace_back(number_in(key.range, dice), number_in(key.range, dice));
    text += fmt::format("{}[{}, {}]", i == 0 ? "" : ", ", points.back().x(), points.back().y());
  }
  return "[" + text + "]";
}

/// Letters, blanks, marks of TOML and of shells, letters beyond ASCII.
std::string words(Dice& dice)
{
  static const std::vector<std::string> parts = {"a", "Z", "7", " ", "=", ",",  "[", "]", "#",
                                                 "$", "`", ";", "'", "ö", "堤", ".", "{", "true"};
  std::string text = "x";
  for (std::uint64_t i = dice() % 30; i > 0; --i)
    text += parts[dice() % parts.size()];
  return text;
}

/// A text for --set and what it has to become.
std::pair<std::string, CheckedValues::Value> value_of(const Key& key, Dice& dice)
{
  Polyline points;
  switch (key.type)
  {
  case ValueType::text:
  {
    const std::string text = words(dice);
    return {"\"" + text + "\"", text};
  }
  case ValueType::choice:
  {
    const std::string text(key.choices[dice() % key.choices.size()]);
    return {dice() % 2 == 0 ? text : "\"" + text + "\"", text}; // a bare word stands for itself
  }
  case ValueType::choice_list:
  {
    std::vector<std::string> some(key.choices.begin(), key.choices.end());
    std::shuffle(some.begin(), some.end(), dice);
    some.resize(1 + dice() % some.size());
    return {fmt::format("[\"{}\"]", fmt::join(some, "\", \"")), some};
  }
  case ValueType::integer:
  {
    const auto whole = static_cast<std::int64_t>(number_in(key.range, dice));
    return {fmt::format("{}", whole), whole};
  }
  case ValueType::boolean:
  {
    const bool on = dice() % 2 == 0;
    return {on ? "true" : "false", on};
  }
  case ValueType::points:
  {
    const std::string text = points_in(key, dice, points);
    return {text, points};
  }
  case ValueType::polygons:
  {
    const std::string text = points_in(key, dice, points);
    return {text, std::vector<Polyline>{points}};
  }
  case ValueType::interval:
  {
    const double a = number_in(key.range, dice), b = number_in(key.range, dice);
    return {fmt::format("[{}, {}]", std::min(a, b), std::max(a, b)),
            std::vector{std::min(a, b), std::max(a, b)}};
  }
  case ValueType::conductivity:
  {
    const double a = number_in(key.range, dice), b = number_in(key.range, dice);
    return {fmt::format("[{}, {}]", a, b), std::vector{a, b}};
  }
  case ValueType::number:
  case ValueType::level_or_polyline:
    break;
  }
  const double number = number_in(key.range, dice);
  return {fmt::format("{}", number), number};
}

TEST(SetRoundTrip, EveryLegalValueBecomesWhatItSays)
{
  Dice dice(20240611);
  int tried = 0;
  for (const Key& key : keys())
    for (int i = 0; i < values_of_each; ++i)
    {
      std::string path = std::regex_replace(std::string(key.path), std::regex("\\*"), "fill");
      path = std::regex_replace(path, std::regex("\\[\\]"), "[1]");
      const auto [text, expected] = value_of(key, dice);
      TomlValue document{.data = TomlValue::Table{}, .place = {}};
      KeyPlaces places;
      EXPECT_TRUE(apply_overrides(document, {path + "=" + text}, places).empty()) << path << text;
      std::vector<Mistake> mistakes;
      const CheckedValues values = check_values(document, places, mistakes);
      std::visit(
          [&]<typename T>(const T& value)
          {
            const auto got = values.get<T>(path);
            ASSERT_TRUE(got.has_value()) << path << " = " << text;
            EXPECT_EQ(*got, value) << path << " = " << text;
          },
          expected);
      ++tried;
    }
  EXPECT_GT(tried, 2000);
}
} // namespace
} // namespace berm::app
