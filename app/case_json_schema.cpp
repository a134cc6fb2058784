// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_schema.h"
#include "app/result_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace berm::app
{
namespace
{
Json number_schema(const Range& range, const char* type = "number")
{
  Json json = {{"type", type}};
  if (std::isfinite(range.lower))
    json[range.lower_open ? "exclusiveMinimum" : "minimum"] = range.lower;
  if (std::isfinite(range.upper))
    json[range.upper_open ? "exclusiveMaximum" : "maximum"] = range.upper;
  return json;
}

Json list_schema(const Json& items, int least, int most = 0)
{
  Json json = {{"type", "array"}, {"items", items}, {"minItems", least}};
  if (most > 0)
    json["maxItems"] = most;
  return json;
}

Json value_schema(const Key& key)
{
  using enum ValueType;
  Json one = number_schema(key.range);
  Json line = list_schema(list_schema(one, 2, 2), key.least_points);
  switch (key.type)
  {
  case text:
    return {{"type", "string"}, {"maxLength", 200}};
  case choice:
    return {{"enum", key.choices}};
  case choice_list:
  {
    Json json = list_schema({{"enum", key.choices}}, 1);
    json["uniqueItems"] = true;
    return json;
  }
  case number:
    return one;
  case integer:
    return number_schema(key.range, "integer");
  case boolean:
    return {{"type", "boolean"}};
  case points:
    return line;
  case polygons:
    return {{"anyOf", {line, list_schema(line, 1)}}};
  case level_or_polyline:
    return {{"anyOf", {one, line}}};
  case conductivity:
    return {{"anyOf", {one, list_schema(one, 2, 2)}}};
  case interval:
    return list_schema(one, 2, 2);
  }
  return {};
}

Json key_schema(const Key& key)
{
  Json json = {{"description", key.unit.empty() || key.unit == "-"
                                   ? std::string(key.sentence)
                                   : fmt::format("{} Unit: {}.", key.sentence, key.unit)}};
  json.update(value_schema(key));
  if (key.presence == Presence::defaulted)
    if (const Json otherwise = Json::parse(key.otherwise, nullptr, false);
        !otherwise.is_discarded())
      json["default"] = otherwise; // TOML's simple values are JSON's
  return json;
}

Json& table_schema(Json& json)
{
  if (json.is_null())
    json = {{"type", "object"}, {"additionalProperties", false}};
  return json;
}

void require(Json& table, const std::string& name)
{
  Json& list = table["required"];
  if (std::find(list.begin(), list.end(), name) == list.end())
    list.push_back(name);
}

/// Put a key where its path says. Returns whether it has to be there whenever `table` is.
bool insert(Json& table, std::string_view path, const Key& key)
{
  const auto dot = path.find('.');
  std::string name(path.substr(0, dot));
  if (dot == std::string_view::npos)
  {
    table["properties"][name] = key_schema(key);
    if (key.presence == Presence::required)
      require(table, name);
    return key.presence == Presence::required;
  }
  const std::string_view rest = path.substr(dot + 1);
  if (name == "*") // any name, at least one of them
  {
    table["minProperties"] = 1;
    if (!table["additionalProperties"].is_object())
      table["additionalProperties"] = nullptr;
    return insert(table_schema(table["additionalProperties"]), rest, key);
  }
  if (name.ends_with("[]"))
  {
    Json& list = table["properties"][name.substr(0, name.size() - 2)];
    if (list.is_null())
      list = {{"type", "array"}, {"items", nullptr}};
    (void)insert(table_schema(list["items"]), rest, key);
    return false;
  }
  const bool needed = insert(table_schema(table["properties"][name]), rest, key);
  if (needed)
    require(table, name);
  return needed;
}
} // namespace

std::string case_json_schema()
{
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "berm case file, format 1"},
                 {"description", "Written by `berm reference --format json-schema`."}};
  Json root;
  for (const Key& key : keys())
    (void)insert(table_schema(root), key.path, key);
  schema.update(root);
  return schema.dump(2) + "\n";
}
} // namespace berm::app
