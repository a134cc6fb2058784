// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/files.h"

#include "app/hdf5_file.h"
#include "app/run_writer.h"
#include "app/version.h"
#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

Json number_or_text(const std::string& value)
{
  if (const auto number = number_in(value))
    return *number;
  return value.empty() ? Json(nullptr) : Json(value);
}

Json or_null(const std::string& text)
{
  return text.empty() ? Json(nullptr) : Json(text);
}

Json member_json(const Study& study, std::size_t m)
{
  const Member& member = study.members[m];
  const MemberResult& result = study.results[m];
  Json json = {{"directory", member.folder}, {"values", Json::object()}, {"varied", Json::array()}};
  for (std::size_t v = 0; v < study.variations.size(); ++v)
  {
    json["values"][study.variations[v].name()] = number_or_text(member.values[v]);
    if (member.varied[v])
      json["varied"].push_back(study.variations[v].name());
  }
  json["overrides"] = member.overrides;
  for (const ResultColumn& column : result_columns())
  {
    const auto& value = result.*column.value;
    json[column.name] = value ? Json(*value) : Json(nullptr);
  }
  json["mechanism"] = or_null(result.mechanism);
  json["complete"] = result.status == MemberStatus::complete;
  json["status"] = to_string(result.status);
  json["reason"] = or_null(result.reason);
  return json;
}

std::string quoted(const std::string& text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

/// As Hdf5File has no missing value, NaN stands for it.
template <typename Value>
std::vector<double> column_of(const Study& study, const Value& value)
{
  std::vector<double> numbers;
  for (std::size_t m = 0; m < study.members.size(); ++m)
    numbers.push_back(value(m).value_or(NAN));
  return numbers;
}

void write_h5(const fs::path& path, const Study& study)
{
  Hdf5File file(path.string());
  file.attribute("/", "title", study.title);
  file.attribute("/", "design", std::string(to_string(study.design)));
  std::vector<std::string> directories, statuses, reasons, mechanisms;
  for (std::size_t m = 0; m < study.members.size(); ++m)
  {
    directories.push_back(study.members[m].folder);
    statuses.emplace_back(to_string(study.results[m].status));
    reasons.push_back(study.results[m].reason);
    mechanisms.push_back(study.results[m].mechanism);
  }
  file.write("/directory", directories, {"-", "folder of the member's run"});
  for (std::size_t v = 0; v < study.variations.size(); ++v)
  {
    const std::string name = study.variations[v].name(), at = "/varied/" + name;
    const auto value = [&](std::size_t m) { return number_in(study.members[m].values[v]); };
    std::vector<std::string> texts;
    for (const Member& member : study.members)
      texts.push_back(member.values[v]);
    const Hdf5File::Label label{"as in its name", name.c_str()};
    if (std::ranges::all_of(texts, [](const std::string& t) { return number_in(t) || t.empty(); }))
      file.write(at, column_of(study, value), 1, label);
    else
      file.write(at, texts, label);
  }
  for (const ResultColumn& column : result_columns())
    file.write(std::string("/") + column.name,
               column_of(study, [&](std::size_t m) { return study.results[m].*column.value; }), 1,
               {column.unit, column.long_name});
  file.write("/mechanism", mechanisms, {"-", "kind of mechanism"});
  file.write("/status", statuses, {"-", "complete, undecided, stopped, failed or not run"});
  file.write("/reason", reasons, {"-", "why there is no answer"});
  file.close();
}

std::string shortened(const std::string& text, std::size_t most)
{
  return text.size() <= most ? text : text.substr(0, most - 3) + "...";
}
} // namespace

Json study_json(const Study& study)
{
  Json vary = Json::array(), members = Json::array();
  for (const Variation& variation : study.variations)
    vary.push_back({{"keys", variation.keys}, {"values", variation.values}});
  for (std::size_t m = 0; m < study.members.size(); ++m)
    members.push_back(member_json(study, m));
  const bool all = std::ranges::all_of(study.results, [](const MemberResult& result)
                                       { return result.status == MemberStatus::complete; });
  return {{"berm", version()},
          {"commit", commit()},
          {"format", 1},
          {"title", study.title},
          {"case", {{"path", study.case_path}, {"overrides", study.overrides}}},
          {"stage", study.seepage_only ? "seepage" : "run"},
          {"design", to_string(study.design)},
          {"vary", vary},
          {"complete", all},
          {"members", members}};
}

std::string study_csv(const Study& study)
{
  std::string text = "directory";
  for (const Variation& variation : study.variations)
    text.append(",").append(quoted(variation.name()));
  for (const ResultColumn& column : result_columns())
    text += std::string(",") + column.name;
  text += ",mechanism,complete,status,reason\n";
  for (std::size_t m = 0; m < study.members.size(); ++m)
  {
    const MemberResult& result = study.results[m];
    text += study.members[m].folder;
    for (const std::string& value : study.members[m].values)
      text.append(",").append(quoted(value));
    for (const ResultColumn& column : result_columns())
    {
      const auto& value = result.*column.value;
      text += value ? fmt::format(",{:.9g}", *value) : ",";
    }
    fmt::format_to(std::back_inserter(text), ",{},{},{},{}\n", result.mechanism,
                   result.status == MemberStatus::complete ? 1 : 0, to_string(result.status),
                   quoted(result.reason));
  }
  return text;
}

std::string answer_text(const MemberResult& result)
{
  std::string text;
  if (result.factor)
    text = fmt::format("F = {:.3f} ({:.3f} to {:.3f})", *result.factor,
                       result.low.value_or(*result.factor), result.high.value_or(*result.factor));
  else if (result.stands || result.fails)
    text =
        fmt::format("{}{}{}", result.stands ? fmt::format("stands at {:.3f}", *result.stands) : "",
                    result.stands && result.fails ? ", " : "",
                    result.fails ? fmt::format("fails at {:.3f}", *result.fails) : "");
  if (result.discharge)
    text += fmt::format("{}q = {:.4g} m2/s", text.empty() ? "" : ", ", *result.discharge);
  if (result.run_out)
    text += fmt::format("{}run-out {:.2f} m", text.empty() ? "" : ", ", *result.run_out);
  if (result.status != MemberStatus::complete)
    text = fmt::format("{}{}{}{}{}", to_string(result.status), result.reason.empty() ? "" : ": ",
                       result.reason, text.empty() ? "" : "; ", text);
  return text;
}

std::string study_report(const Study& study)
{
  constexpr std::size_t widest = 34;
  std::vector<std::size_t> widths;
  std::string text = fmt::format("\n{}\n\n  {:>4}", study.title, "");
  for (std::size_t v = 0; v < study.variations.size(); ++v)
  {
    const std::string name = shortened(study.variations[v].name(), widest);
    std::size_t width = name.size();
    for (const Member& member : study.members)
      width = std::max(width, std::min(widest, member.values[v].size()));
    widths.push_back(width);
    fmt::format_to(std::back_inserter(text), "  {:>{}}", name, width);
  }
  text += "  answer\n";
  for (std::size_t m = 0; m < study.members.size(); ++m)
  {
    fmt::format_to(std::back_inserter(text), "  {:>4}", m + 1);
    for (std::size_t v = 0; v < study.variations.size(); ++v)
      fmt::format_to(std::back_inserter(text), "  {:>{}}",
                     shortened(study.members[m].values[v], widest), widths[v]);
    text += "  " + answer_text(study.results[m]) + "\n";
  }
  return text;
}

void write_study(const fs::path& directory, const Study& study)
{
  write_aside(directory / "case.toml", study.case_text);
  write_aside(directory / "study.csv", study_csv(study));
  const fs::path fields = directory / "study.h5";
  write_h5(fields.string() + ".part", study);
  fs::rename(fields.string() + ".part", fields);
  const Json json = study_json(study);
  require_finite(json);
  write_aside(directory / "study.json", json_text(json) + "\n");
}

std::vector<std::string> differences(const Study& study, const Json& stored,
                                     const std::string& stored_case_text)
{
  std::vector<std::string> list;
  if (stored.is_null())
    return list;
  const Json own = study_json(study);
  const auto compare = [&](const char* pointer, const char* name)
  {
    const Json::json_pointer at(pointer);
    if (!stored.contains(at) || stored.at(at) != own.at(at))
      list.emplace_back(name);
  };
  if (stored_case_text != study.case_text)
    list.emplace_back("the case file");
  compare("/case/overrides", "--set");
  compare("/vary", "--vary");
  compare("/design", "the design");
  compare("/stage", "--seepage");
  return list;
}
} // namespace berm::app
