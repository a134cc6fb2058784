// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_check.h"

#include "app/case_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <type_traits>

namespace berm::app
{
namespace
{
constexpr std::size_t most_points = 5000;
constexpr std::size_t most_points_in_all = 10000;
constexpr std::size_t most_tables = 1000; // of one kind
constexpr std::size_t most_text = 200;    // characters

/// A number is finite and within the range, or there is a problem to tell.
std::string number_problem(const TomlValue& value, const Range& range, double& number)
{
  if (const auto* whole = std::get_if<std::int64_t>(&value.data))
    number = static_cast<double>(*whole);
  else if (const auto* real = std::get_if<double>(&value.data))
    number = *real;
  else
    return "not a number";
  if (!std::isfinite(number))
    return "not a finite number";
  return range.contains(number) ? "" : "out of range";
}

std::string points_problem(const TomlValue& value, const Key& key, Polyline& points)
{
  const auto* array = value.array();
  if (array == nullptr)
    return "not a list of points";
  if (array->size() < static_cast<std::size_t>(key.least_points))
    return fmt::format("has {} {}", array->size(), array->size() == 1 ? "point" : "points");
  if (array->size() > most_points)
    return fmt::format("has {} points, more than {}", array->size(), most_points);
  for (const TomlValue& element : *array)
  {
    const auto* pair = element.array();
    const auto number = static_cast<std::size_t>(&element - array->data()) + 1;
    if (pair == nullptr || pair->size() != 2)
      return fmt::format("point {} is not [x, y]", number);
    Vec2 point;
    for (std::size_t i = 0; i < 2; ++i)
    {
      const std::string problem =
          number_problem((*pair)[i], key.range, point[static_cast<Index>(i)]);
      if (!problem.empty())
        return fmt::format("{} of point {} is {}", i == 0 ? "x" : "y", number, problem);
    }
    points.push_back(point);
  }
  return {};
}

/// One polygon, or a list of polygons.
std::string polygons_problem(const TomlValue& value, const Key& key,
                             std::vector<Polyline>& polygons)
{
  const auto first_of = [](const TomlValue::Array* array)
  { return array == nullptr || array->empty() ? nullptr : array->front().array(); };
  const auto* outer = value.array();
  const auto* second = first_of(outer);
  if (first_of(second) == nullptr)
    return points_problem(value, key, polygons.emplace_back());
  for (const TomlValue& polygon : *outer)
  {
    const std::string problem = points_problem(polygon, key, polygons.emplace_back());
    if (!problem.empty())
      return fmt::format("polygon {}: {}", polygons.size(), problem);
  }
  return outer->size() > most_tables ? fmt::format("has more than {} polygons", most_tables) : "";
}

std::string numbers_problem(const TomlValue& value, const Key& key, std::vector<double>& numbers)
{
  const auto* array = value.array();
  if (array == nullptr || array->size() != 2)
    return "not a list of two numbers";
  for (const TomlValue& element : *array)
  {
    double number = 0;
    const std::string problem = number_problem(element, key.range, number);
    if (!problem.empty())
      return fmt::format("{} is {}", numbers.empty() ? "the first" : "the second", problem);
    numbers.push_back(number);
  }
  return {};
}

std::string words_problem(const TomlValue& value, const Key& key, std::vector<std::string>& words)
{
  const auto* array = value.array();
  if (array == nullptr || array->empty())
    return "not a list of texts";
  for (const TomlValue& element : *array)
  {
    const auto* word = std::get_if<std::string>(&element.data);
    if (word == nullptr || std::ranges::find(key.choices, *word) == key.choices.end())
      return fmt::format("{} is not one of the choices", toml_text(element));
    if (std::ranges::find(words, *word) != words.end())
      return fmt::format("\"{}\" comes twice", *word);
    words.push_back(*word);
  }
  return {};
}

std::string text_problem(const TomlValue& value)
{
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr)
    return "not a text";
  if (std::any_of(text->begin(), text->end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    return "more than one line, or control characters";
  return text->size() > most_text ? fmt::format("longer than {} characters", most_text) : "";
}

/// What is wrong with a value; empty, and `out` set, if nothing is.
std::string value_problem(const TomlValue& value, const Key& key, CheckedValues::Value& out)
{
  const auto keep = [&out](std::string problem, auto checked)
  {
    if (problem.empty())
      out = std::move(checked);
    return problem;
  };
  double number = 0;
  Polyline points;
  std::vector<Polyline> polygons;
  std::vector<double> numbers;
  std::vector<std::string> words;
  std::string problem;
  switch (key.type)
  {
  case ValueType::text:
    problem = text_problem(value);
    return problem.empty() ? keep("", std::get<std::string>(value.data)) : problem;
  case ValueType::choice:
  {
    const auto* text = std::get_if<std::string>(&value.data);
    if (text == nullptr)
      return "not a text";
    const bool known =
        std::find(key.choices.begin(), key.choices.end(), *text) != key.choices.end();
    return keep(known ? "" : "not one of the choices", *text);
  }
  case ValueType::choice_list:
    problem = words_problem(value, key, words);
    return keep(problem, words);
  case ValueType::number:
    problem = number_problem(value, key.range, number);
    return keep(problem, number);
  case ValueType::integer:
    if (!std::holds_alternative<std::int64_t>(value.data))
      return "not a whole number";
    problem = number_problem(value, key.range, number);
    return keep(problem, std::get<std::int64_t>(value.data));
  case ValueType::boolean:
    if (!std::holds_alternative<bool>(value.data))
      return "not true or false";
    return keep("", std::get<bool>(value.data));
  case ValueType::points:
    problem = points_problem(value, key, points);
    return keep(problem, points);
  case ValueType::polygons:
    problem = polygons_problem(value, key, polygons);
    return keep(problem, polygons);
  case ValueType::level_or_polyline:
    if (value.array() != nullptr)
    {
      problem = points_problem(value, key, points);
      return keep(problem, points);
    }
    problem = number_problem(value, key.range, number);
    return keep(problem == "not a number" ? "neither a level nor a list of points" : problem,
                number);
  case ValueType::conductivity:
    if (value.array() != nullptr)
      problem = numbers_problem(value, key, numbers);
    else
    {
      problem = number_problem(value, key.range, number);
      numbers = {number, number};
    }
    return keep(problem, numbers);
  case ValueType::interval:
    problem = numbers_problem(value, key, numbers);
    if (problem.empty() && numbers[0] >= numbers[1])
      problem = "the first is not below the second";
    return keep(problem, numbers);
  }
  return "of a kind that nothing checks";
}

std::size_t points_in(const CheckedValues::Value& value)
{
  if (const auto* line = std::get_if<Polyline>(&value))
    return line->size();
  std::size_t sum = 0;
  if (const auto* polygons = std::get_if<std::vector<Polyline>>(&value))
    for (const Polyline& polygon : *polygons)
      sum += polygon.size();
  return sum;
}

bool is_name(std::string_view name)
{
  return !name.empty() && name.size() <= 64 &&
         name.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
             std::string_view::npos;
}

class Checker
{
public:
  Checker(KeyPlaces& places, std::vector<Mistake>& mistakes) : places_(places), mistakes_(mistakes)
  {
  }

  /// @param[in] pattern  "" or "soil.*." or "section.zone[]."
  /// @param[in] path     the same with names and numbers in it
  void check_table(const TomlValue::Table& table, const std::string& pattern,
                   const std::string& path)
  {
    for (const auto& [name, value] : table)
    {
      places_.set(path + name, value.place, value.order);
      check_entry(name, value, pattern, path);
    }
    for (const std::string_view child : children(pattern))
      if (child == "*" ? table.empty() : find(table, strip(child)) == nullptr)
        check_absent(std::string(child), pattern, path);
  }

  CheckedValues values;

private:
  /// Next parts of the key table's paths below a pattern, each once: "ground_m", "zone[]", "*".
  static std::vector<std::string_view> children(const std::string& pattern)
  {
    std::vector<std::string_view> names;
    for (const Key& key : keys())
    {
      if (!key.path.starts_with(pattern))
        continue;
      const std::string_view rest = key.path.substr(pattern.size());
      const std::string_view name = rest.substr(0, rest.find('.'));
      if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    }
    return names;
  }
  static std::string_view strip(std::string_view child)
  {
    return child.ends_with("[]") ? child.substr(0, child.size() - 2) : child;
  }
  static const TomlValue* find(const TomlValue::Table& table, std::string_view name)
  {
    for (const auto& entry : table)
      if (entry.first == name)
        return &entry.second;
    return nullptr;
  }
  static const Key* leaf(const std::string& path)
  {
    for (const Key& key : keys())
      if (key.path == path)
        return &key;
    return nullptr;
  }

  void check_entry(const std::string& name, const TomlValue& value, const std::string& pattern,
                   const std::string& path)
  {
    const auto known = children(pattern);
    const auto is_known = [&known](std::string_view n)
    { return std::find(known.begin(), known.end(), n) != known.end(); };
    if (is_known("*"))
      check_named_table(name, value, pattern + "*.", path);
    else if (is_known(name + "[]"))
      check_tables(value, pattern + name + "[].", path + name);
    else if (!is_known(name) || !is_name(name))
      add_unknown(name, pattern, path);
    else if (const Key* key = leaf(pattern + name))
      check_leaf(*key, value, path + name);
    else if (const auto* table = value.table())
      check_table(*table, pattern + name + ".", path + name + ".");
    else
      add({.key = path + name,
           .value = toml_text(value),
           .problem = "not a table",
           .hint = fmt::format("write [{}] on a line of its own, its keys below", path + name)});
  }

  void check_named_table(const std::string& name, const TomlValue& value,
                         const std::string& pattern, const std::string& path)
  {
    if (!is_name(name))
      add({.key = path + name,
           .problem = "not a name",
           .allowed = "letters, digits, _ and -, at most 64 of them"});
    else if (const auto* table = value.table())
    {
      values.soils.push_back(name);
      check_table(*table, pattern, path + name + ".");
    }
    else
      add({.key = path + name,
           .value = toml_text(value),
           .problem = "not a table",
           .hint = fmt::format("a soil has a table of its own: [{}name]", path)});
  }

  void check_tables(const TomlValue& value, const std::string& pattern, const std::string& path)
  {
    const auto* array = value.array();
    const bool fits = array != nullptr && array->size() <= most_tables &&
                      std::all_of(array->begin(), array->end(),
                                  [](const TomlValue& v) { return v.table() != nullptr; });
    if (!fits)
    {
      add({.key = path,
           .value = toml_text(value),
           .problem = fmt::format("not a list of at most {} tables", most_tables),
           .hint = fmt::format("write [[{}]] on a line of its own, its keys below", path)});
      return;
    }
    values.set_count(path, array->size());
    for (std::size_t i = 0; i < array->size(); ++i)
    {
      const std::string element = fmt::format("{}[{}]", path, i + 1);
      places_.set(element, (*array)[i].place, (*array)[i].order);
      check_table(*(*array)[i].table(), pattern, element + ".");
    }
  }

  void check_leaf(const Key& key, const TomlValue& value, const std::string& path)
  {
    CheckedValues::Value checked;
    std::string problem = value_problem(value, key, checked);
    if (const std::size_t points = points_in(checked); problem.empty() && points > 0)
    {
      points_ += points;
      if (points_ > most_points_in_all)
        problem = fmt::format("the case has more than {} points in all", most_points_in_all);
    }
    if (problem.empty())
    {
      values.set(path, std::move(checked));
      return;
    }
    std::string hint;
    if (const auto* text = std::get_if<std::string>(&value.data); text && !key.choices.empty())
      if (const std::string_view near = nearest(*text, key.choices); !near.empty())
        hint = fmt::format("did you mean \"{}\"?", near);
    add({.key = path,
         .value = toml_text(value),
         .problem = problem == "out of range" ? "" : problem, // `allowed` says it
         .allowed = allowed_text(key),
         .hint = hint});
  }

  /// What is not in the table: a default, a mistake, or nothing; the same for all in an absent
  /// table.
  void check_absent(const std::string& child, const std::string& pattern, const std::string& path)
  {
    if (child == "*")
    {
      add({.key = path.substr(0, path.size() - 1),
           .problem = "there is no soil",
           .hint = "a soil has a table of its own: [soil.fill]"});
      return;
    }
    if (child.ends_with("[]"))
      return;
    const Key* key = leaf(pattern + child);
    if (key == nullptr)
      check_table({}, pattern + child + ".", path + child + ".");
    else if (key->presence == Presence::required)
      add({.key = path + child,
           .problem = std::string(missing_key),
           .allowed = allowed_text(*key),
           .hint = std::string(key->sentence)});
    else if (key->presence == Presence::defaulted)
    {
      KeyPlaces unused;
      const TomlValue value =
          parse_toml("value = " + std::string(key->otherwise), "default", unused);
      check_leaf(*key, value.table()->front().second, path + child);
    }
  }

  void add_unknown(const std::string& name, const std::string& pattern, const std::string& path)
  {
    Mistake mistake{.key = path + name, .problem = std::string(unknown_key)};
    auto known = children(pattern);
    for (std::string_view& child : known)
      child = strip(child);
    if (const std::string_view near = nearest(name, known); !near.empty())
      mistake.hint = fmt::format("did you mean {}? ", near);
    else
      for (const Key& key : keys()) // right name, wrong table
        if (last_part(key.path) == name)
        {
          mistake.hint = fmt::format("did you mean {}? ", key.path);
          break;
        }
    if (mistake.hint.find("_m") != std::string::npos ||
        mistake.hint.find("_k") != std::string::npos)
      mistake.hint += "One unit per key; see `berm reference`.";
    else
      mistake.hint += "See `berm reference`.";
    add(std::move(mistake));
  }

  void add(Mistake mistake) { mistakes_.push_back(std::move(mistake)); }

  KeyPlaces& places_;
  std::vector<Mistake>& mistakes_;
  std::size_t points_ = 0; ///< of all lines so far
};
} // namespace

CheckedValues check_values(const TomlValue& document, KeyPlaces& places,
                           std::vector<Mistake>& mistakes)
{
  Checker checker(places, mistakes);
  const TomlValue::Table& top = *document.table();
  checker.check_table(top, "", "");
  checker.values.run_out = std::any_of(top.begin(), top.end(),
                                       [](const auto& entry) { return entry.first == "runout"; });
  return std::move(checker.values);
}

bool was_given(const CheckedValues& values, const std::vector<Mistake>& mistakes,
               const std::string& path)
{
  return values.has(path) ||
         std::ranges::any_of(mistakes, [&](const Mistake& m) { return m.key == path; });
}
} // namespace berm::app
