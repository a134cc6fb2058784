// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli.h"

#include "app/case_doubts.h"
#include "app/case_file.h"
#include "app/case_schema.h"
#include "app/case_templates.h"
#include "app/checkpoint.h"
#include "app/cli_pages.h"
#include "app/comparison_files.h"
#include "app/console.h"
#include "app/directory_lock.h"
#include "app/figures.h"
#include "app/frame_files.h"
#include "app/html_report.h"
#include "app/process_team.h"
#include "app/report.h"
#include "app/result_json.h"
#include "app/run_writer.h"
#include "app/study/study.h"
#include "app/version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <span>

namespace berm::app
{
namespace
{
/// What `berm run` and `berm seepage` are told.
struct RunOptions
{
  std::string case_path;
  ReadOptions read;
  std::string out; ///< empty: default_directory
  std::string log; ///< file for the log; empty: none
  bool quiet = false;
  bool verbose = false;
  bool resume = false; ///< go on with a run that was stopped
  int threads = 0;     ///< 0: what the case says
};

/// Where the results go; no other process writes there meanwhile.
struct Place
{
  std::filesystem::path directory;
  std::unique_ptr<DirectoryLock> lock; ///< of rank 0
};

/// Before anything is computed: threads as the user says, or as the case does, or shared among the
/// processes; signals caught; a place for the results.
Place begin_run(const RunOptions& options, const coupling::Case& input, const std::string& suffix,
                KeyPlaces& places)
{
  Team& team = process_team();
  Place place{.directory = options.out.empty() ? default_directory(options.case_path) += suffix
                                               : std::filesystem::path(options.out),
              .lock = nullptr};
  if (team.rank() == 0)
  {
    prepare_directory(place.directory);
    place.lock = std::make_unique<DirectoryLock>(place.directory);
  }
  if (const int threads = options.threads > 0 ? options.threads : input.sph.threads; threads > 0)
    omp_set_num_threads(threads);
  else if (team.size() > 1)
    omp_set_num_threads(std::max(1, omp_get_max_threads() / team.size()));
  places.run_began = true;
  catch_stop_signals();
  return place;
}

/// `berm run --resume DIR`: case, --set and --out as when the run began.
RunOptions as_begun(RunOptions options)
{
  if (!options.resume || !std::filesystem::is_directory(options.case_path))
    return options;
  if (!options.out.empty())
    throw InputError({{.key = "--out",
                       .value = options.out,
                       .problem = "the results go where they went before",
                       .allowed = "nothing, beside --resume DIR",
                       .hint = "leave it out"}});
  StoppedRun run = stopped_run(options.case_path);
  options.out = options.case_path;
  options.case_path = std::move(run.case_path);
  // What is given now, too, makes it another case, which is refused.
  options.read.overrides.insert(options.read.overrides.begin(), run.overrides.begin(),
                                run.overrides.end());
  return options;
}

/// On stderr, of one of the ranks.
Console console_of(const RunOptions& options, bool speaks)
{
  const Volume volume = options.quiet || !speaks ? Volume::quiet
                        : options.verbose        ? Volume::verbose
                                                 : Volume::normal;
  return Console(stderr, isatty(STDERR_FILENO) == 1, volume, speaks ? options.log : "");
}

/// The page beside the results, if it is wanted and this build has it.
void add_report(const std::filesystem::path& directory, const coupling::Case& input,
                Console& console)
{
  if (!input.output.report)
    return;
  console.stage("report");
  if (report_built_in())
    write_report(directory);
  else
    console.warn("no report: berm was built without its page");
}

int run_case(const RunOptions& given, KeyPlaces& places)
{
  const RunOptions options = as_begun(given);
  coupling::Case input = read_case(options.case_path, options.read, places);
  Team& team = process_team();
  // The seepage stage alone: the ranks share it. Before trials, which they share, each does all of
  // it, so that no result depends on their number.
  input.seepage.distributed = options.read.seepage_only && team.size() > 1;
  const bool speaks = team.rank() == 0; // the others work in silence, and write nothing
  const Place place = begin_run(options, input, "", places);
  const std::filesystem::path& directory = place.directory;
  Console console = console_of(options, speaks);
  Checkpoint checkpoint(directory, input);
  if (options.resume)
    checkpoint.require_same();
  if (speaks)
    checkpoint.begin(options.resume);
  (void)team.any(false); // the others write there, too
  FrameFiles frames(checkpoint.frames());
  for (const std::string& doubt : doubts(input))
    console.warn(doubt);
  const coupling::Analysis analysis = coupling::analyse(input, console, frames, checkpoint, team);
  if (const std::string doubt = doubt_of(analysis); !doubt.empty())
    console.warn(doubt);
  if (!speaks)
    return complete(input, analysis) ? exit_ok : exit_no_answer;

  write_run(directory, input, analysis, console.warnings(), checkpoint.frames());
  if (!analysis.interrupted)
    checkpoint.remove();
  if (input.output.figures && !analysis.interrupted)
  {
    console.stage("figures");
    if (const std::string problem = draw_figures(directory, input.output.figure_formats);
        !problem.empty())
      console.warn("no figures: " + problem);
  }
  add_report(directory, input, console);
  if (!options.quiet)
    std::cout << report(input, analysis, console.warnings()) << "\nResults in "
              << directory.string() << "\n";
  return complete(input, analysis) ? exit_ok : exit_no_answer;
}

/// Each water's run in a folder of its own, and the comparison beside them.
int compare_case(RunOptions options, KeyPlaces& places)
{
  options.read.overrides.emplace_back("water.pore_pressure=\"seepage\"");
  const coupling::Case input = read_case(options.case_path, options.read, places);
  Team& team = process_team();
  const bool speaks = team.rank() == 0;
  const Place place = begin_run(options, input, "_compared", places);
  const std::filesystem::path& directory = place.directory;
  Console console = console_of(options, speaks);
  const auto draw = [&](const std::string& problem)
  {
    if (!problem.empty())
      console.warn("no figures: " + problem);
  };
  std::size_t told = 0; // warnings of the waters before
  const auto done = [&](const coupling::ComparedWater& water)
  {
    if (!speaks)
      return;
    write_run(directory / water.name, water.input, water.analysis,
              std::span(console.warnings()).subspan(told));
    told = console.warnings().size();
    if (input.output.figures && !water.analysis.interrupted)
      draw(draw_figures(directory / water.name, input.output.figure_formats));
  };
  const coupling::Comparison comparison = coupling::compare(input, console, team, done);
  const bool all = std::ranges::all_of(comparison.waters, [](const coupling::ComparedWater& water)
                                       { return complete(water.input, water.analysis); });
  const int code = all && !console.stop_requested() ? exit_ok : exit_no_answer;
  if (!speaks)
    return code;
  write_comparison(directory, comparison);
  if (input.output.figures)
    draw(draw_comparison(directory, input.output.figure_formats));
  add_report(directory, input, console);
  if (!options.quiet)
    std::cout << comparison_report(comparison) << "\nResults in " << directory.string() << "\n";
  return code;
}

int report_directory(const std::string& directory)
{
  constexpr bool foreign = true;
  write_report(directory, foreign);
  std::cout << "Report in " << (std::filesystem::path(directory) / "report.html").string() << "\n";
  return exit_ok;
}

int check_case(const RunOptions& options, KeyPlaces& places)
{
  const coupling::Case input = read_case(options.case_path, options.read, places);
  std::cout << summary(input, meshes::build_section(input.section));
  for (const std::string& doubt : doubts(input))
    std::cout << "  warning           " << doubt << "\n";
  std::cout << "\n" << options.case_path << ": no mistakes\n";
  return exit_ok;
}

void add_case_options(CLI::App& command, std::string& path, std::vector<std::string>& overrides)
{
  command.add_option("CASE", path, "Case file (TOML); `berm reference` lists its keys")->required();
  command.add_option("--set", overrides, "Replace or add a key of the case file; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

/// A range that is refused in the same words with every version of CLI11.
CLI::Validator thread_count()
{
  const CLI::Range range(1, 1024);
  return {[range](const std::string& value)
          { return range(value).empty() ? "" : "Value " + value + " not in range 1 to 1024"; },
          range.get_description()};
}

void add_run_options(CLI::App& command, RunOptions& options)
{
  add_case_options(command, options.case_path, options.read.overrides);
  command
      .add_option("--out", options.out,
                  "Directory for the results [results/<case's folder>_<case's name>]")
      ->type_name("DIR");
  CLI::Option* quiet = command.add_flag("--quiet", options.quiet, "Print mistakes and errors only");
  command.add_flag("--verbose", options.verbose, "Print details, such as each Newton step")
      ->excludes(quiet);
  command
      .add_option("--log", options.log, "Write all of it to a file, details as well, as it goes on")
      ->type_name("FILE");
  command
      .add_option("--threads", options.threads, "Threads of the particle loops [all processors]")
      ->type_name("N")
      ->check(thread_count());
}

void add_init_options(CLI::App& command, std::string& name, std::string& kind)
{
  command.add_option("NAME", name, "The case: NAME.toml, which must not be there")->required();
  std::vector<std::string> kinds;
  for (const CaseTemplate& one : case_templates())
    kinds.emplace_back(one.name);
  command.add_option("--template", kind, "What to begin with [embankment]")
      ->check(CLI::IsMember(kinds));
}

void add_study_options(CLI::App& command, StudyOptions& options)
{
  add_case_options(command, options.case_path, options.overrides);
  command
      .add_option(
          "--vary", options.vary,
          "Values of a key: a,b,c or from:to:count or from:to:count:log; may be repeated. A "
          "value may be any TOML; KEY+KEY=... gives several keys the same value")
      ->type_name("KEY=VALUES")
      ->allow_extra_args(false)
      ->required();
  CLI::Option* pairs = command.add_flag_callback(
      "--pairs", [&] { options.design = Design::pairs; },
      "The first values of all keys, the second ones, ... in place of every combination");
  command
      .add_flag_callback(
          "--one-at-a-time", [&] { options.design = Design::one_at_a_time; },
          "The case as it is, then each value of one key alone")
      ->excludes(pairs);
  command.add_flag("--seepage", options.seepage_only, "The seepage stage alone");
  command
      .add_option(
          "--out", options.out,
          "Directory for the results [results/<case's folder>_<case's name>_study]; a study "
          "that is there goes on")
      ->type_name("DIR");
  command.add_flag("--fresh", options.fresh, "Remove the study that is there, and begin anew");
  command
      .add_option("--jobs", options.jobs,
                  "Members at a time, a thread each [all processors; one on each rank of mpirun]")
      ->type_name("N")
      ->check(thread_count());
  command
      .add_option(
          "--reference", options.reference,
          "CSV with columns x, F or discharge_m2_s, source: points to draw over the results")
      ->type_name("FILE");
  command.add_flag("--check", options.check, "Check and list the members; run nothing");
  command.add_flag("--quiet", options.quiet, "Print mistakes and errors only");
}
} // namespace

int run_command_line(int argc, const char* const* argv, KeyPlaces& places)
{
  CLI::App app("berm: how safe is this embankment, with the water where it really is?", "berm");
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", version());
  app.footer("Start with:  berm run cases/two_sided_embankment/hydrostatic.toml\n"
             "Exit codes:  0 ok, 1 bug in berm, 2 bad input, 3 no answer (not converged, "
             "undecided, stopped), "
             "4 files");
  RunOptions options;
  CLI::App* run = app.add_subcommand("run", "Run all stages that a case asks for");
  add_run_options(*run, options);
  run->add_flag("--resume", options.resume,
                "Go on with a run that was stopped or killed: of the same CASE and --out, or with "
                "the directory of its results in place of CASE");
  CLI::App* seepage = app.add_subcommand("seepage", "Run the seepage stage of a case alone");
  add_run_options(*seepage, options);
  CLI::App* compare = app.add_subcommand(
      "compare", "The same soil without water, with hydrostatic pressure, and with seepage");
  add_run_options(*compare, options);
  compare->get_option("--out")->description(
      "Directory for the results [results/<case's folder>_<case's name>_compared]");
  StudyOptions study_options;
  CLI::App* study = app.add_subcommand("study", "Run a case for many values of its keys");
  add_study_options(*study, study_options);
  CLI::App* report =
      app.add_subcommand("report", "Write report.html into a directory of results, again");
  std::string report_of;
  report->add_option("DIR", report_of, "What --out named")->required();
  CLI::App* check = app.add_subcommand("check", "Report every mistake in a case file; run nothing");
  add_case_options(*check, options.case_path, options.read.overrides);
  std::string new_case, kind = "embankment", format = "md";
  CLI::App* init = app.add_subcommand("init", "Write a commented case file to begin with");
  add_init_options(*init, new_case, kind);
  CLI::App* reference = app.add_subcommand("reference", "Print the table of case file keys");
  reference
      ->add_option(
          "--format", format,
          "md: a Markdown page; json-schema: for editors that complete and check TOML [md]")
      ->check(CLI::IsMember({"md", "json-schema"}));
  CLI::App* completion =
      app.add_subcommand("completion", "Print a script that completes this command line");
  std::string shell;
  completion->add_option("SHELL", shell, "The shell")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  CLI::App* man =
      app.add_subcommand("man", "Print the manual page; read it by  berm man | man -l -");
  CLI::App* print_version =
      app.add_subcommand("version", "Print version, commit, compiler and libraries");

  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& e)
  {
    return app.exit(e) == 0 ? exit_ok : exit_bad_input;
  }

  int code = exit_ok;
  options.read.seepage_only = seepage->parsed();
  if (run->parsed() || seepage->parsed())
    code = run_case(options, places);
  else if (compare->parsed())
    code = compare_case(options, places);
  else if (init->parsed())
  {
    const std::string path = write_template(new_case, kind).string();
    std::cout << path << " is written. Next:  berm check " << path << "\n";
  }
  else if (study->parsed())
    code = run_study(study_options, places);
  else if (report->parsed())
    code = report_directory(report_of);
  else if (check->parsed())
    code = check_case(options, places);
  else if (reference->parsed())
    std::cout << (format == "md" ? case_reference() : case_json_schema());
  else if (completion->parsed())
    std::cout << (shell == "zsh" ? zsh_completion(app) : bash_completion(app));
  else if (man->parsed())
    std::cout << man_page(app);
  else if (print_version->parsed())
    std::cout << version_text();
  else
    std::cout << app.help();
  if (!std::cout.flush())
    throw IoError("standard output cannot be written");
  return code;
}
} // namespace berm::app
