// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/result.h"

#include "app/cli.h"
#include "app/text_file.h"
#include "app/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

/// The number at a path of keys; nothing if it is not there, or null.
std::optional<double> number_at(const Json& json, const char* pointer)
{
  const Json::json_pointer at(pointer);
  if (!json.contains(at) || !json.at(at).is_number())
    return std::nullopt;
  return json.at(at).get<double>();
}

std::string text_at(const Json& json, const char* pointer)
{
  const Json::json_pointer at(pointer);
  return json.contains(at) && json.at(at).is_string() ? json.at(at).get<std::string>() : "";
}

bool true_at(const Json& json, const char* pointer)
{
  const Json::json_pointer at(pointer);
  return json.contains(at) && json.at(at) == true;
}

std::optional<double> highest_point(const Json& result)
{
  std::optional<double> highest;
  for (const Json& line : result.value("/seepage/phreatic_lines_m"_json_pointer, Json::array()))
    for (const Json& point : line)
      highest = std::max(highest.value_or(point.at(1).get<double>()), point.at(1).get<double>());
  return highest;
}

std::optional<double> processor_seconds(const Json& result)
{
  double sum = 0;
  for (const Json& stage : result.value("/performance/stages"_json_pointer, Json::array()))
    sum += stage.at("cpu_s").get<double>();
  return sum;
}

std::string why_incomplete(const Json& result)
{
  if (std::string reason = text_at(result, "/stability/reason"); !reason.empty())
    return reason;
  if (result.contains("runout") && !true_at(result, "/runout/at_rest"))
    return "the soil still moves";
  return "not every search found a factor of safety";
}

/// The log's last line: what berm says before it gives up.
std::string last_line(const fs::path& log)
{
  std::string text = text_of(log).value_or("");
  text.erase(text.find_last_not_of(" \n") + 1);
  text.erase(0, text.rfind('\n') + 1);
  return text.starts_with("berm: ") ? text.substr(6) : text;
}
} // namespace

std::string_view to_string(MemberStatus status)
{
  constexpr std::array<std::string_view, 5> names = {"not run", "complete", "undecided", "stopped",
                                                     "failed"};
  return names[static_cast<std::size_t>(status)];
}

std::span<const ResultColumn> result_columns()
{
  static constexpr std::array columns = {
      ResultColumn{"factor", "-", "factor of safety", &MemberResult::factor},
      ResultColumn{"low", "-", "least factor within the uncertainty", &MemberResult::low},
      ResultColumn{"high", "-", "largest factor within the uncertainty", &MemberResult::high},
      ResultColumn{"stands", "-", "largest factor at which the slope stood", &MemberResult::stands},
      ResultColumn{"fails", "-", "smallest factor at which it failed", &MemberResult::fails},
      ResultColumn{"discharge_m2_s", "m2/s", "discharge per metre run", &MemberResult::discharge},
      ResultColumn{"discharge_error_m2_s", "m2/s", "estimated error of the discharge",
                   &MemberResult::discharge_error},
      ResultColumn{"exit_y_m", "m", "height of the exit point", &MemberResult::exit_y},
      ResultColumn{"phreatic_highest_m", "m", "highest point of the phreatic lines",
                   &MemberResult::phreatic_highest},
      ResultColumn{"mechanism_depth_m", "m", "depth of the slip line below the ground",
                   &MemberResult::mechanism_depth},
      ResultColumn{"run_out_m", "m", "run-out beyond the toe", &MemberResult::run_out},
      ResultColumn{"seconds", "s", "processor time", &MemberResult::seconds}};
  return columns;
}

MemberResult summarise(const Json& result)
{
  MemberResult row;
  row.stands = number_at(result, "/stability/stands");
  row.fails = number_at(result, "/stability/fails");
  if (true_at(result, "/stability/complete"))
  {
    row.factor = number_at(result, "/stability/factor");
    row.low = number_at(result, "/stability/uncertainty/low");
    row.high = number_at(result, "/stability/uncertainty/high");
    row.mechanism_depth = number_at(result, "/stability/mechanism/depth_m");
    row.mechanism = text_at(result, "/stability/mechanism/kind");
  }
  row.discharge = number_at(result, "/seepage/discharge_m2_s");
  row.discharge_error = number_at(result, "/seepage/estimated_error/discharge_m2_s");
  row.exit_y = number_at(result, "/seepage/exit_point_m/1");
  row.phreatic_highest = highest_point(result);
  if (true_at(result, "/runout/at_rest"))
    row.run_out = number_at(result, "/runout/run_out_m");
  row.seconds = processor_seconds(result);
  if (true_at(result, "/interrupted"))
  {
    row.status = MemberStatus::stopped;
    row.reason = "stopped on request";
  }
  else if (true_at(result, "/complete"))
    row.status = MemberStatus::complete;
  else
  {
    row.status = MemberStatus::undecided;
    row.reason = why_incomplete(result);
  }
  return row;
}

MemberResult stored_result(const fs::path& study, const Member& member,
                           const std::string& case_text)
{
  const fs::path folder = study / member.folder;
  const auto text = text_of(folder / "result.json");
  if (!text || text_of(folder / "case.toml") != case_text)
    return {};
  const Json result = Json::parse(*text, nullptr, false);
  const bool ours =
      result.is_object() && text_at(result, "/berm") == version() &&
      result.value("/case/overrides"_json_pointer, Json(nullptr)) == Json(member.overrides);
  return ours ? summarise(result) : MemberResult{};
}

MemberResult result_of(const ChildEnd& end, const fs::path& study, const Member& member,
                       const std::string& case_text)
{
  MemberResult row = stored_result(study, member, case_text);
  if (row.status != MemberStatus::not_run)
    return row;
  row.status = MemberStatus::failed;
  const std::string said = last_line(study / member.folder / "log.txt");
  row.reason = end.signal != 0
                   ? fmt::format("killed by signal {} ({})", end.signal, strsignal(end.signal))
                   : fmt::format("exit code {}{}{}", end.exit_code, said.empty() ? "" : ": ", said);
  return row;
}
} // namespace berm::app
