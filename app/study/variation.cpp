// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/variation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace berm::app
{
namespace
{
constexpr int most_values = 1000; // of one range

std::string_view trimmed(std::string_view text)
{
  const auto begin = std::min(text.find_first_not_of(" \t"), text.size());
  text.remove_prefix(begin);
  return text.substr(0, text.find_last_not_of(" \t") + 1); // npos + 1 is 0
}

std::vector<std::string> split_at(std::string_view text, char separator)
{
  std::vector<std::string> parts;
  while (true)
  {
    const auto at = text.find(separator);
    parts.emplace_back(trimmed(text.substr(0, at)));
    if (at == std::string_view::npos)
      return parts;
    text.remove_prefix(at + 1);
  }
}

/// The values of a range. Nothing if the text is not meant as one; a problem if it is a wrong one.
struct Ranged
{
  std::vector<std::string> values;
  std::string problem;
};

std::optional<Ranged> range_in(const std::string& text)
{
  const std::vector<std::string> parts = split_at(text, ':');
  const auto from = number_in(parts.front());
  if (parts.size() < 2 || !from)
    return std::nullopt;
  const auto to = number_in(parts[1]);
  const auto count = parts.size() > 2 ? number_in(parts[2]) : std::nullopt;
  const bool log = parts.size() == 4 && parts[3] == "log";
  if (!to || !count || *count != std::floor(*count) || *count < 2 || *count > most_values ||
      parts.size() > 4 || (parts.size() == 4 && !log))
    return Ranged{{}, "\"" + text + "\" is not a range"};
  if (log && (*from <= 0 || *to <= 0))
    return Ranged{{}, "\"" + text + "\": a range by ratios has ends above 0"};
  Ranged range;
  const int last = static_cast<int>(*count) - 1;
  for (int i = 0; i <= last; ++i)
  {
    const double t = static_cast<double>(i) / last;
    const double value = log ? *from * std::pow(*to / *from, t) : *from + (*to - *from) * t;
    range.values.push_back(fmt::format("{:.10g}", i == last ? *to : value));
  }
  return range;
}

/// One text of --vary; `mistakes` gains what is wrong with it.
Variation parse_variation(const std::string& text, std::vector<Mistake>& mistakes)
{
  const auto add = [&](std::string problem, std::string hint = {})
  {
    mistakes.push_back({.key = "--vary " + text,
                        .problem = std::move(problem),
                        .allowed = {},
                        .hint = std::move(hint)});
  };
  Variation variation;
  const auto equals = text.find('=');
  if (equals == std::string::npos)
  {
    add("not of the form key=values", "for example --vary soil.core.cohesion_kPa=5,10,20");
    return variation;
  }
  variation.keys = split_at(std::string_view(text).substr(0, equals), '+');
  for (const std::string& value : split_values(std::string_view(text).substr(equals + 1)))
  {
    const auto range = range_in(value);
    const std::vector<std::string> values = range ? range->values : std::vector{value};
    if (range && !range->problem.empty())
      add(range->problem,
          fmt::format("from:to:count or from:to:count:log, count from 2 to {}, as in "
                      "water.left_level_m=18:24:4",
                      most_values));
    for (const std::string& one : values)
      if (one.empty())
        add("a value is empty");
      else if (std::ranges::any_of(variation.values, [&](const std::string& other)
                                   { return same_value(one, other); }))
        add("the value " + one + " is there twice");
      else
        variation.values.push_back(one);
  }
  return variation;
}
} // namespace

std::string Variation::name() const
{
  return fmt::format("{}", fmt::join(keys, "+"));
}

std::vector<Variation> parse_variations(const std::vector<std::string>& texts,
                                        std::vector<Mistake>& mistakes)
{
  std::vector<Variation> variations;
  std::set<std::string> seen;
  for (const std::string& text : texts)
  {
    Variation variation = parse_variation(text, mistakes);
    for (const std::string& key : variation.keys)
      if (!seen.insert(key).second)
        mistakes.push_back({.key = "--vary " + text, .problem = key + " is varied already"});
    if (!variation.keys.empty() && !variation.values.empty())
      variations.push_back(std::move(variation));
  }
  return variations;
}

std::vector<std::string> split_values(std::string_view text)
{
  std::vector<std::string> parts;
  int depth = 0;
  char quote = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const char c = text[i];
    if (quote != 0)
    {
      if (c == '\\' && quote == '"')
        ++i;
      else if (c == quote)
        quote = 0;
    }
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '[' || c == '{')
      ++depth;
    else if (c == ']' || c == '}')
      --depth;
    else if (c == ',' && depth <= 0)
    {
      parts.emplace_back(trimmed(text.substr(begin, i - begin)));
      begin = i + 1;
    }
  }
  parts.emplace_back(trimmed(text.substr(begin)));
  return parts;
}

std::optional<double> number_in(std::string_view text)
{
  if (text.starts_with('+'))
    text.remove_prefix(1);
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool all =
      error == std::errc{} && rest == text.data() + text.size() && std::isfinite(value);
  return all ? std::optional(value) : std::nullopt;
}

bool same_value(const std::string& a, const std::string& b)
{
  const auto x = number_in(a), y = number_in(b);
  return a == b || (x && y && *x == *y);
}
} // namespace berm::app
