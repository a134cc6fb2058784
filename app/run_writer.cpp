// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/run_writer.h"

#include "app/case_mesh_file.h"
#include "app/field_files.h"
#include "app/frame_files.h"
#include "app/msh_file.h"
#include "app/reading_files.h"
#include "app/result_json.h"
#include "app/text_file.h"
#include "core/error.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <vector>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

constexpr std::array our_files = {
    "case.toml",          "results.h5",           "results_particles.xdmf",
    "results_mesh.xdmf",  "results_run_out.xdmf", "run_out.gif",
    "phreatic_lines.csv", "exit_gradients.csv",   "mesh.msh",
    "report.html",        "result.json"};

constexpr std::array our_figures = {"seepage", "lines",  "exit_gradient", "slip",
                                    "trials",  "curves", "run_out",       "run_out_energy"};

fs::path aside(const fs::path& path)
{
  return path.string() + ".part";
}

void write_text(const fs::path& path, const std::string& text)
{
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file)
    throw IoError(path.string() + ": cannot be written");
}

/// Every file that a run may replace or remove: the lines' of this run and of earlier ones, then
/// those of fixed names, result.json last.
std::vector<fs::path> files_of(const fs::path& directory, const coupling::Case& input)
{
  std::vector<fs::path> paths;
  for (const coupling::OutputLine& line : input.output.lines)
    paths.push_back(directory / line_path(line));
  std::error_code none; // there is no such folder
  for (const auto& entry : fs::directory_iterator(directory / lines_folder, none))
    if (entry.path().extension() == ".csv" && std::ranges::find(paths, entry.path()) == paths.end())
      paths.push_back(entry.path());
  for (const std::string name : our_figures)
    for (const char* ending : {".png", ".svg"})
      paths.push_back(directory / (name + ending));
  for (const char* name : our_files)
    paths.push_back(directory / name);
  return paths;
}

/// The file that the copy of the case takes its section from, so that it runs where it lies.
/// Nothing where it is not beside the case: --set named another.
std::vector<TextFile> mesh_file_of(const coupling::Case& input)
{
  const auto path = relative_mesh_file(input.text);
  const auto text = path ? text_of(fs::path(input.path).parent_path() / *path) : std::nullopt;
  return text ? std::vector<TextFile>{{path->string(), *text}} : std::vector<TextFile>{};
}

/// Removes what was written aside and not renamed, also when an exception passes.
struct Leftovers
{
  const fs::path& directory;
  const std::vector<fs::path>& paths;
  ~Leftovers()
  {
    std::error_code ignored;
    for (const fs::path& path : paths)
      fs::remove(aside(path), ignored);
    fs::remove(directory / lines_folder, ignored); // only if empty
  }
};
} // namespace

fs::path default_directory(const std::string& case_path)
{
  const fs::path path = fs::absolute(case_path).lexically_normal();
  const std::string folder = path.parent_path().filename().string();
  return fs::path("results") /
         (folder.empty() ? path.stem().string() : folder + "_" + path.stem().string());
}

void prepare_directory(const fs::path& directory)
{
  std::error_code error;
  fs::create_directories(directory, error);
  if (error || !fs::is_directory(directory, error))
    throw IoError(directory.string() + ": cannot be made a directory");
  const fs::path probe = aside(directory / "result.json");
  write_text(probe, "");
  fs::remove(probe, error);
}

void write_aside(const fs::path& path, const std::string& text)
{
  write_text(aside(path), text);
  std::error_code error;
  fs::rename(aside(path), path, error);
  if (error)
    throw IoError(path.string() + ": " + error.message());
}

void write_run(const fs::path& directory, const coupling::Case& input,
               const coupling::Analysis& analysis, std::span<const std::string> warnings,
               const fs::path& frames)
{
  prepare_directory(directory);
  std::vector<TextFile> texts = mesh_file_of(input);
  std::vector<fs::path> paths = files_of(directory, input);
  for (const TextFile& file : texts)
    if (std::ranges::find(paths, directory / file.path) == paths.end())
      paths.insert(paths.begin(), directory / file.path);
  const Leftovers leftovers{directory, paths}; // whatever throws, no earlier run is replaced
  write_fields(aside(directory / "results.h5").string(), input, analysis);
  write_text(aside(directory / "case.toml"), input.text);
  if (analysis.stability && !analysis.stability->settled.ux.empty())
    write_text(aside(directory / "results_particles.xdmf"),
               particles_xdmf(*analysis.stability, "results.h5"));
  if (analysis.seepage)
    write_text(aside(directory / "results_mesh.xdmf"), mesh_xdmf(*analysis.seepage, "results.h5"));
  if (analysis.seepage && input.output.msh)
    write_text(aside(directory / "mesh.msh"),
               msh_text(input, analysis.section, analysis.seepage->mesh));
  std::ranges::move(reading_files(input, analysis), std::back_inserter(texts));
  for (const TextFile& file : texts)
  {
    std::error_code error; // told by write_text
    fs::create_directories((directory / file.path).parent_path(), error);
    write_text(aside(directory / file.path), file.text);
  }
  if (analysis.run_out)
    write_text(aside(directory / "results_run_out.xdmf"),
               run_out_xdmf(*analysis.run_out, analysis.stability->particles.size()));
  write_text(aside(directory / "result.json"),
             json_text(result_json(input, analysis, warnings)) + "\n");
  // Whoever kills the run now finds no result.json rather than one beside files of another run.
  std::error_code error;
  fs::remove(directory / "result.json", error);
  if (analysis.run_out)
    publish_frames(frames, directory);
  else
    remove_frames(directory);
  for (const fs::path& path : paths)
  {
    if (fs::exists(aside(path)))
      fs::rename(aside(path), path, error);
    else
      fs::remove(path, error);
    if (error)
      throw IoError(path.string() + ": " + error.message());
  }
}
} // namespace berm::app
