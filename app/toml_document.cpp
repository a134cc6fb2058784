// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/toml_document.h"

#include "app/toml_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace
{
/// toml++ asserts where some malformed documents lead it: to be told as a syntax error.
struct TomlAssertion : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

constexpr void toml_assert(bool holds)
{
  if (!holds)
    throw TomlAssertion("this is not TOML");
}
} // namespace

// Without NDEBUG toml++ checks its assumptions; with it, it may build on ones that do not hold.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_MAX_NESTED_VALUES 16 // brackets; our deepest value has three
#define TOML_ASSERT(expression) toml_assert(static_cast<bool>(expression))
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace berm::app
{
namespace
{
constexpr int after_all_lines = 1'000'000'000; // order of --set

TomlValue convert(const toml::node& node, const std::string& name, int fixed_order)
{
  TomlValue value;
  const auto line = static_cast<int>(node.source().begin.line);
  value.place = fixed_order > 0 ? name : fmt::format("{}:{}", name, line);
  value.order = fixed_order > 0 ? fixed_order : line;
  if (const auto* table = node.as_table())
  {
    // toml++ sorts keys by name; the places of their names give the file's order back.
    struct Row
    {
      toml::source_position at;
      std::string key;
      const toml::node* node;
    };
    std::vector<Row> rows;
    for (const auto& [key, child] : *table)
      rows.push_back({key.source().begin, std::string(key.str()), &child});
    std::stable_sort(rows.begin(), rows.end(),
                     [](const Row& a, const Row& b) { return a.at < b.at; });
    TomlValue::Table out;
    for (const Row& row : rows)
    {
      out.push_back({row.key, convert(*row.node, name, fixed_order)});
      // Where the key stands, not where its value begins or, for a table, is first opened.
      if (fixed_order == 0 && row.at.line > 0)
      {
        out.back().second.order = static_cast<int>(row.at.line);
        out.back().second.place = fmt::format("{}:{}", name, row.at.line);
      }
    }
    value.data = std::move(out);
  }
  else if (const auto* array = node.as_array())
  {
    TomlValue::Array out;
    for (const toml::node& child : *array)
      out.push_back(convert(child, name, fixed_order));
    value.data = std::move(out);
  }
  else if (const auto* text = node.as_string())
    value.data = text->get();
  else if (const auto* whole = node.as_integer())
    value.data = whole->get();
  else if (const auto* number = node.as_floating_point())
    value.data = number->get();
  else if (const auto* boolean = node.as_boolean())
    value.data = boolean->get();
  else
    value.data = TomlValue::DateOrTime{};
  return value;
}

/// A step of a --set path: a key, or an element counted from 1.
struct Step
{
  std::string key;
  std::size_t element = 0; ///< 0: a key
};

std::optional<std::vector<Step>> parse_path(std::string_view path)
{
  std::vector<Step> steps;
  while (true)
  {
    const std::size_t end = std::min(path.find_first_of(".["), path.size());
    if (end == 0 || steps.size() > 16)
      return std::nullopt;
    steps.push_back({std::string(path.substr(0, end))});
    path.remove_prefix(end);
    if (path.starts_with('['))
    {
      std::size_t element = 0;
      const std::size_t close = path.find(']');
      if (close == std::string_view::npos)
        return std::nullopt;
      const auto [rest, error] = std::from_chars(path.data() + 1, path.data() + close, element);
      if (error != std::errc{} || rest != path.data() + close || element == 0)
        return std::nullopt;
      steps.push_back({{}, element});
      path.remove_prefix(close + 1);
    }
    if (path.empty())
      return steps;
    if (!path.starts_with('.'))
      return std::nullopt;
    path.remove_prefix(1);
  }
}

TomlValue parse_override_value(const std::string& text, const std::string& place, int order)
{
  const std::string line = "value = " + text;
  try
  {
    const bool parseable = find_obstacle(line).problem.empty();
    const toml::table table = toml::parse(parseable ? line : "");
    if (table.size() == 1)
      return convert(*table.get("value"), place, order);
  }
  catch (const std::runtime_error&) // toml::parse_error, TomlAssertion
  {
    // A bare word stands for itself: --set water.pore_pressure=none.
  }
  return {.data = text, .place = place, .order = order};
}

/// Put the value where the path says; what is in the way is replaced. Empty text if it went well.
std::string put(TomlValue& root, const std::vector<Step>& steps, TomlValue value)
{
  TomlValue* at = &root;
  for (const Step& step : steps)
  {
    TomlValue fresh{.data = TomlValue::Table{}, .place = value.place, .order = value.order};
    if (step.element > 0)
    {
      if (at->array() == nullptr)
      {
        at->data = TomlValue::Array{};
        at->place = value.place;
        at->order = value.order;
      }
      auto& array = std::get<TomlValue::Array>(at->data);
      if (step.element > array.size() + 1)
        return fmt::format("there is no element {}; the last is {}", step.element, array.size());
      if (step.element == array.size() + 1)
        array.push_back(std::move(fresh));
      at = &array[step.element - 1];
      continue;
    }
    if (at->table() == nullptr)
      at->data = TomlValue::Table{};
    auto& table = std::get<TomlValue::Table>(at->data);
    auto it = std::find_if(table.begin(), table.end(),
                           [&](const auto& e) { return e.first == step.key; });
    if (it == table.end())
      it = table.insert(table.end(), {step.key, std::move(fresh)});
    at = &it->second;
  }
  *at = std::move(value);
  return {};
}

void append_text(const TomlValue& value, std::string& text)
{
  constexpr std::size_t enough = 60;
  if (text.size() > enough)
    return;
  if (const auto* boolean = std::get_if<bool>(&value.data))
    text += *boolean ? "true" : "false";
  else if (const auto* whole = std::get_if<std::int64_t>(&value.data))
    text += std::to_string(*whole);
  else if (const auto* number = std::get_if<double>(&value.data))
    text += fmt::format("{}{}", *number, *number == std::round(*number) ? ".0" : ""); // 2.0, not 2
  else if (const auto* string = std::get_if<std::string>(&value.data))
  {
    text += '"';
    for (const char c : *string)
      text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    text += '"';
  }
  else if (std::holds_alternative<TomlValue::DateOrTime>(value.data))
    text += "(a date or time)";
  else if (const auto* array = value.array())
  {
    text += '[';
    for (const TomlValue& element : *array)
    {
      text += &element == array->data() ? "" : ", ";
      append_text(element, text);
    }
    text += ']';
  }
  else
  {
    text += '{';
    for (const auto& entry : *value.table())
    {
      text += &entry == value.table()->data() ? "" : ", ";
      text += entry.first + " = ";
      append_text(entry.second, text);
    }
    text += '}';
  }
}
} // namespace

TomlValue parse_toml(std::string_view text, const std::string& name, KeyPlaces& places)
{
  places.set("", name, 0);
  if (const TomlObstacle obstacle = find_obstacle(text); !obstacle.problem.empty())
  {
    places.set("", fmt::format("{}:{}:{}", name, obstacle.line, obstacle.column), obstacle.line);
    throw InputError({{.problem = "not valid TOML: " + obstacle.problem}});
  }
  try
  {
    return convert(toml::parse(text, name), name, 0);
  }
  catch (const toml::parse_error& e)
  {
    const toml::source_position at = e.source().begin;
    places.set("", fmt::format("{}:{}:{}", name, at.line, at.column), static_cast<int>(at.line));
    throw InputError({{.problem = "not valid TOML: " + std::string(e.description())}});
  }
  catch (const TomlAssertion& e)
  {
    throw InputError({{.problem = std::string("not valid TOML: ") + e.what()}});
  }
}

std::vector<Mistake> apply_overrides(TomlValue& document, const std::vector<std::string>& overrides,
                                     KeyPlaces& places)
{
  std::vector<Mistake> mistakes;
  int order = after_all_lines;
  for (const std::string& text : overrides)
  {
    const std::string place = "--set " + text;
    ++order;
    const auto equals = text.find('=');
    const std::string path = text.substr(0, std::min(equals, text.size()));
    std::string problem;
    const auto steps = parse_path(path);
    if (equals == std::string::npos || !steps)
      problem = "not of the form key=value";
    else
      problem = put(document, *steps, parse_override_value(text.substr(equals + 1), place, order));
    if (problem.empty())
      continue;
    places.set(place, "", order);
    mistakes.push_back(
        {.key = place,
         .problem = problem,
         .hint = "for example --set sph.spacing_m=0.5 or --set section.zone[1].soil=core"});
  }
  return mistakes;
}

const TomlValue* find_value(const TomlValue& document, std::string_view path)
{
  const TomlValue* at = &document;
  for (const Step& step : parse_path(path).value_or(std::vector<Step>{}))
  {
    if (step.element > 0)
    {
      const auto* array = at->array();
      if (array == nullptr || step.element > array->size())
        return nullptr;
      at = &(*array)[step.element - 1];
      continue;
    }
    const auto* table = at->table();
    if (table == nullptr)
      return nullptr;
    const auto it = std::ranges::find(*table, step.key, &TomlValue::Table::value_type::first);
    if (it == table->end())
      return nullptr;
    at = &it->second;
  }
  return at == &document ? nullptr : at;
}

std::string toml_text(const TomlValue& value)
{
  constexpr std::size_t most = 60;
  std::string text;
  append_text(value, text);
  if (text.size() > most)
  {
    std::size_t cut = most; // never inside a UTF-8 character
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80)
      --cut;
    text.resize(cut);
    text += "...";
  }
  return text;
}
} // namespace berm::app
