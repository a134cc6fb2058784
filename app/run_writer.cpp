// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/run_writer.h"

#include "app/field_files.h"
#include "app/frame_files.h"
#include "app/result_json.h"
#include "core/error.h"

#include <array>
#include <fstream>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

constexpr std::array our_files = {
    "case.toml",         "results.h5",           "results_particles.xdmf",
    "results_mesh.xdmf", "results_run_out.xdmf", "seepage.png",
    "slip.png",          "trials.png",           "curves.png",
    "run_out.png",       "run_out_energy.png",   "run_out.gif",
    "result.json"};

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

/// Removes what was written aside and not renamed, also when an exception passes.
struct Leftovers
{
  const fs::path& directory;
  ~Leftovers()
  {
    for (const char* name : our_files)
    {
      std::error_code ignored;
      fs::remove(aside(directory / name), ignored);
    }
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

void write_run(const fs::path& directory, const coupling::Case& input,
               const coupling::Analysis& analysis)
{
  prepare_directory(directory);
  const Leftovers leftovers{
      directory}; // whatever throws below, nothing of an earlier run is replaced
  write_fields(aside(directory / "results.h5").string(), input, analysis);
  write_text(aside(directory / "case.toml"), input.text);
  if (analysis.stability && !analysis.stability->settled.ux.empty())
    write_text(aside(directory / "results_particles.xdmf"),
               particles_xdmf(*analysis.stability, "results.h5"));
  if (analysis.seepage)
    write_text(aside(directory / "results_mesh.xdmf"), mesh_xdmf(*analysis.seepage, "results.h5"));
  if (analysis.run_out)
    write_text(aside(directory / "results_run_out.xdmf"),
               run_out_xdmf(*analysis.run_out, analysis.stability->particles.size()));
  else
    remove_frames(directory);
  write_text(aside(directory / "result.json"), json_text(result_json(input, analysis)) + "\n");
  for (const char* name : our_files)
  {
    std::error_code error;
    if (fs::exists(aside(directory / name)))
      fs::rename(aside(directory / name), directory / name, error);
    else
      fs::remove(directory / name, error);
    if (error)
      throw IoError((directory / name).string() + ": " + error.message());
  }
}
} // namespace berm::app
