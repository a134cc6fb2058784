// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/study.h"

#include "app/case_file.h"
#include "app/case_mesh_file.h"
#include "app/cli.h"
#include "app/console.h"
#include "app/figures.h"
#include "app/html_report.h"
#include "app/process_team.h"
#include "app/result_json.h"
#include "app/run_writer.h"
#include "app/study/checks.h"
#include "app/study/child_processes.h"
#include "app/study/files.h"
#include "app/study/folder.h"
#include "app/toml_document.h"
#include "core/error.h"
#include "core/stopwatch.h"

#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

/// What the case says itself, as TOML on one line; empty if it says nothing.
std::string own_value(const TomlValue& document, const std::string& key)
{
  const TomlValue* value = find_value(document, key);
  if (value == nullptr)
    return {};
  const auto* number = std::get_if<double>(&value->data);
  return number != nullptr ? fmt::format("{:.10g}", *number) : toml_text(*value);
}

/// Members read a copy of the case elsewhere: a mesh file relative to the case becomes absolute.
std::optional<std::string> absolute_mesh_file(const TomlValue& document, const fs::path& case_path)
{
  const auto file = relative_mesh_file(document);
  if (!file)
    return std::nullopt;
  const fs::path full = fs::absolute(case_path).parent_path() / *file;
  // A string of JSON is one of TOML.
  return "section.mesh_file=" + Json(full.lexically_normal().string()).dump();
}

/// The study as asked for, nothing of it computed.
Study plan(const StudyOptions& options, KeyPlaces& places)
{
  std::vector<Mistake> mistakes;
  Study study;
  study.variations = parse_variations(options.vary, mistakes);
  if (!mistakes.empty())
    throw InputError(std::move(mistakes));
  const std::string text = read_case_text(options.case_path);
  TomlValue document = parse_toml(text, options.case_path, places);
  mistakes = apply_overrides(document, options.overrides, places);
  if (!mistakes.empty())
    throw InputError(std::move(mistakes));
  places = {}; // what is wrong with the study is in no line of the file
  study.figures = own_value(document, "output.figures") != "false";
  study.report = own_value(document, "output.report") != "false";
  study.case_path = options.case_path;
  study.case_text = text;
  study.overrides = options.overrides;
  study.design = options.design;
  study.seepage_only = options.seepage_only;
  std::vector<std::string> fixed{"output.figures=false",
                                 "output.report=false"}; // unless --set says otherwise
  fixed.insert(fixed.end(), options.overrides.begin(), options.overrides.end());
  if (auto file = absolute_mesh_file(document, options.case_path))
    fixed.push_back(std::move(*file));
  std::vector<std::string> base;
  for (const Variation& variation : study.variations)
    base.push_back(own_value(document, variation.keys.front()));
  study.members = members(study.variations, study.design, fixed, base);
  study.results.resize(study.members.size());
  return study;
}

/// Members that this rank runs, and what is told of them. Rank 0 alone speaks and writes.
class Runs
{
public:
  Runs(Study& study, const fs::path& directory, Console& console, const Team& team)
      : study_(study), directory_(directory), console_(console), leads_(team.rank() == 0)
  {
    int turn = 0; // every rank counts the same members: they are dealt out like cards
    for (std::size_t m = 0; m < study.members.size(); ++m)
      if (!study.results[m].finished() && turn++ % team.size() == team.rank())
        waiting_.push_back(m);
    std::ranges::reverse(waiting_); // the next is the last
    to_run_ = waiting_.size();
  }

  void run(int jobs)
  {
    while (!waiting_.empty() || children_.running() > 0)
    {
      if (console_.stop_requested())
      {
        waiting_.clear();
        children_.stop();
      }
      while (!waiting_.empty() && children_.running() < static_cast<std::size_t>(jobs))
      {
        start(waiting_.back());
        waiting_.pop_back();
      }
      for (const ChildEnd& end : children_.poll())
        finish(end.ticket,
               result_of(end, directory_, study_.members[end.ticket], study_.case_text));
    }
  }

private:
  void start(std::size_t m)
  {
    const Member& member = study_.members[m];
    const fs::path folder = directory_ / member.folder;
    std::error_code none; // what fails here fails again below, and is told
    fs::create_directories(folder, none);
    fs::remove(folder / "result.json", none); // of another version; were it left, it would be told
    std::vector<std::string> arguments{study_.seepage_only ? "seepage" : "run",
                                       (directory_ / "case.toml").string()};
    for (const std::string& text : member.overrides)
      arguments.insert(arguments.end(), {"--set", text});
    arguments.insert(arguments.end(), {"--out", folder.string(), "--threads", "1", "--quiet"});
    const std::string problem = children_.start(m, std::move(arguments), folder / "log.txt");
    if (problem.empty())
      return;
    MemberResult result;
    result.status = MemberStatus::failed;
    result.reason = problem;
    finish(m, std::move(result));
  }

  void finish(std::size_t m, MemberResult result)
  {
    study_.results[m] = std::move(result);
    ++done_;
    if (!leads_)
      return;
    write_study(directory_, study_);
    const double left =
        watch_.elapsed().wall / static_cast<double>(done_) * static_cast<double>(to_run_ - done_);
    console_.note(fmt::format("{} of {}{}: {}: {}", done_, to_run_,
                              done_ < to_run_ ? fmt::format(", {} left", duration_text(left)) : "",
                              fs::path(study_.members[m].folder).filename().string(),
                              answer_text(study_.results[m])));
  }

  Study& study_;
  const fs::path& directory_;
  Console& console_;
  bool leads_;
  ChildProcesses children_;
  std::vector<std::size_t> waiting_;
  std::size_t to_run_ = 0, done_ = 0;
  Stopwatch watch_;
};

bool all_complete(const Study& study)
{
  return std::ranges::all_of(study.results, [](const MemberResult& result)
                             { return result.status == MemberStatus::complete; });
}

/// What the other ranks ran, known to all: results from the members' folders, which the ranks
/// share, and of members without one the reason, from the rank that saw it.
void share_results(Team& team, const fs::path& directory, Study& study)
{
  if (team.size() == 1)
    return;
  Json failed = Json::object();
  for (std::size_t m = 0; m < study.members.size(); ++m)
    if (study.results[m].status == MemberStatus::failed)
      failed[std::to_string(m)] = study.results[m].reason;
  const std::vector<std::string> told = team.gather(failed.dump());
  for (std::size_t m = 0; m < study.members.size(); ++m)
    study.results[m] = stored_result(directory, study.members[m], study.case_text);
  for (const std::string& text : told)
  {
    const Json reasons = Json::parse(text);
    for (const auto& [m, reason] : reasons.items())
    {
      MemberResult& result = study.results[std::stoul(m)];
      result.status = MemberStatus::failed;
      result.reason = reason;
    }
  }
}

void wait_for_all(Team& team)
{
  (void)team.gather({});
}

/// The directory, ready for the members that are missing; `study` gains the results that are there.
void prepare(const StudyFolder& folder, const StudyOptions& options, const fs::path& directory,
             Study& study, Team& team)
{
  wait_for_all(team);                                                      // rank 0 made it
  const bool anew = options.fresh || folder.holds_of_another_build(study); // all throw, or none
  wait_for_all(team);                                                      // all looked at it
  if (team.rank() == 0)
  {
    if (anew)
      folder.clear();
    folder.take_reference(options.reference);
    folder.take_mesh_file(study);
  }
  wait_for_all(team);
  for (std::size_t m = 0; m < study.members.size(); ++m)
    study.results[m] = stored_result(directory, study.members[m], study.case_text);
  if (team.rank() == 0)
    write_study(directory, study);
  wait_for_all(team); // no member runs before all know which are missing
}

/// What rank 0 makes of the results.
void report_study(const StudyOptions& options, const fs::path& directory, const Study& study,
                  Console& console)
{
  write_study(directory, study);
  if (study.figures && !console.stop_requested())
  {
    console.stage("figures");
    if (const std::string problem = draw_study(directory, study.figure_formats); !problem.empty())
      console.warn("no figures: " + problem);
  }
  if (study.report && report_built_in())
    write_report(directory);
  if (!options.quiet)
    std::cout << study_report(study) << "\nResults in " << directory.string() << "\n";
}
} // namespace

int run_study(const StudyOptions& options, KeyPlaces& places)
{
  Team& team = process_team();
  const bool leads = team.rank() == 0;
  Study study = plan(options, places);
  const CheckedMembers checked = check_members(study, options.reference);
  if (!checked.mistakes.empty())
  {
    if (leads)
      std::cerr << checked.mistakes;
    return exit_bad_input;
  }
  study.title = checked.title;
  study.figure_formats = checked.figure_formats;
  if (options.check)
  {
    if (leads)
      std::cout << study_report(study) << "\nNo mistakes; nothing was run.\n";
    return exit_ok;
  }
  const fs::path directory = options.out.empty() ? default_directory(options.case_path) += "_study"
                                                 : fs::path(options.out);
  const StudyFolder folder(directory, leads);
  prepare(folder, options, directory, study, team);
  places.run_began = true;
  catch_stop_signals();

  Console console(stderr, isatty(STDERR_FILENO) == 1,
                  options.quiet || !leads ? Volume::quiet : Volume::normal);
  const auto there = std::ranges::count_if(study.results, &MemberResult::finished);
  const int jobs = options.jobs > 0 ? options.jobs : team.size() > 1 ? 1 : omp_get_num_procs();
  console.stage(fmt::format(
      "study: {} members, {} of them there already, {} at a time{}", study.members.size(), there,
      jobs, team.size() > 1 ? fmt::format(" on each of {} ranks", team.size()) : ""));
  Runs(study, directory, console, team).run(jobs);
  share_results(team, directory, study);
  if (leads)
    report_study(options, directory, study, console);
  return all_complete(study) ? exit_ok : exit_no_answer;
}
} // namespace berm::app
