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

/// Members that run, and what is told of them.
class Runs
{
public:
  Runs(Study& study, const fs::path& directory, Console& console)
      : study_(study), directory_(directory), console_(console)
  {
    for (std::size_t m = 0; m < study.members.size(); ++m)
      if (!study.results[m].finished())
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
    write_study(directory_, study_);
    ++done_;
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

void refuse_a_team()
{
  if (process_team().size() > 1)
    throw InputError({{.key = "mpirun",
                       .problem = "a study starts its own processes",
                       .allowed = "one process",
                       .hint = "--jobs N runs N members at a time"}});
}
} // namespace

int run_study(const StudyOptions& options, KeyPlaces& places)
{
  refuse_a_team();
  Study study = plan(options, places);
  const CheckedMembers checked = check_members(study, options.reference);
  if (!checked.mistakes.empty())
  {
    std::cerr << checked.mistakes;
    return exit_bad_input;
  }
  study.title = checked.title;
  study.figure_formats = checked.figure_formats;
  if (options.check)
  {
    std::cout << study_report(study) << "\nNo mistakes; nothing was run.\n";
    return exit_ok;
  }
  const fs::path directory = options.out.empty() ? default_directory(options.case_path) += "_study"
                                                 : fs::path(options.out);
  const StudyFolder folder(directory);
  if (options.fresh || folder.holds_of_another_build(study))
    folder.clear();
  folder.take_reference(options.reference);
  folder.take_mesh_file(study);
  places.run_began = true;
  catch_stop_signals();
  for (std::size_t m = 0; m < study.members.size(); ++m)
    study.results[m] = stored_result(directory, study.members[m], study.case_text);
  write_study(directory, study);

  Console console(stderr, isatty(STDERR_FILENO) == 1,
                  options.quiet ? Volume::quiet : Volume::normal);
  const auto there = std::ranges::count_if(study.results, &MemberResult::finished);
  const int jobs = options.jobs > 0 ? options.jobs : omp_get_num_procs();
  console.stage(fmt::format("study: {} members, {} of them there already, {} at a time",
                            study.members.size(), there, jobs));
  Runs(study, directory, console).run(jobs);
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
  return all_complete(study) ? exit_ok : exit_no_answer;
}
} // namespace berm::app
