// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report_data.h"

#include "app/hdf5_file.h"
#include "app/packed_array.h"
#include "app/study_lines.h"
#include "app/text_file.h"
#include "core/error.h"
#include "core/sandbox.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

/// Bytes that the frames of a run-out may take before they are compressed: what is left out then is
/// every other frame, and so on.
constexpr std::size_t frame_budget = 4'000'000;

[[noreturn]] void refuse(const fs::path& path, const std::string& problem, const std::string& hint)
{
  throw InputError({{.value = path.string(), .problem = problem, .hint = hint}});
}

std::string required_text(const fs::path& path)
{
  std::optional<std::string> text = text_of(path);
  if (!text)
    throw IoError(path.string() + ": cannot be read");
  return std::move(*text);
}

/// A file of berm's own, format 1.
Json read_json(const fs::path& path, const char* must_have)
{
  Json json = Json::parse(required_text(path), nullptr, false);
  if (!json.is_object() || !json.contains("format") || json["format"] != 1 ||
      !json.contains(must_have))
    refuse(path, "is not a result of this version of berm", "run the case again");
  return json;
}

fs::path name_in(const Json& json, const char* key)
{
  return name_inside(json.at(key).get<std::string>());
}

std::vector<std::uint32_t> whole(const std::vector<double>& values)
{
  std::vector<std::uint32_t> numbers(values.size());
  std::ranges::transform(values, numbers.begin(),
                         [](double v)
                         { return v >= 0 && v < 4e9 ? static_cast<std::uint32_t>(v) : 0; });
  return numbers;
}

/// Decadic logarithm of the flux's size, as far down as a millionth of the largest: near a corner
/// it has no bound, and even steps would leave nothing for the rest.
std::vector<double> log_flux(const std::vector<double>& flux)
{
  std::vector<double> size(flux.size() / 3);
  for (std::size_t i = 0; i < size.size(); ++i)
    size[i] = std::hypot(flux[3 * i], flux[3 * i + 1]);
  const double largest = size.empty() ? 0 : std::ranges::max(size);
  const double floor = largest > 0 ? 1e-6 * largest : 1e-30;
  for (double& q : size)
    q = std::log10(std::max(q, floor));
  return size;
}

Json mesh_fields(const Hdf5Reader& file)
{
  const std::vector<double> nodes = file.values("/mesh/nodes");
  Json json = {{"x", packed_column(nodes, 0, 2)},
               {"y", packed_column(nodes, 1, 2)},
               {"triangles", packed_whole(whole(file.values("/mesh/triangles")))},
               {"head", packed(file.values("/mesh/head"))},
               {"pore_pressure", packed(file.values("/mesh/pore_pressure"))},
               {"log_flux", packed(log_flux(file.values("/mesh/flux")))}};
  if (file.has("/mesh/stream_function"))
    json["stream_function"] = packed(file.values("/mesh/stream_function"));
  return json;
}

Json state_fields(const Hdf5Reader& file, const std::string& group)
{
  const std::vector<double> displacement = file.values(group + "displacement");
  Json json = {{"factor", file.attribute("factor", group)},
               {"time_s", file.attribute("time_s", group)},
               {"ux", packed_column(displacement, 0, 3)},
               {"uy", packed_column(displacement, 1, 3)}};
  for (const char* name : {"plastic_strain", "stress_xx", "stress_yy", "stress_xy"})
    json[name] = packed(file.values(group + name));
  return json;
}

Json particle_fields(const Hdf5Reader& file)
{
  const std::vector<double> position = file.values("/particles/position");
  Json json = {{"x", packed_column(position, 0, 2)},
               {"y", packed_column(position, 1, 2)},
               {"soil", packed_whole(whole(file.values("/particles/soil")))},
               {"pore_pressure", packed(file.values("/particles/pore_pressure"))},
               {"states", Json::object()}};
  for (const char* state : {"settled", "standing", "failing"})
    if (const std::string group = fmt::format("/particles/{}/", state); file.has(group))
      json["states"][state] = state_fields(file, group);
  return json;
}

std::vector<fs::path> frame_paths(const fs::path& directory)
{
  std::vector<fs::path> paths;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(directory / "run_out", none))
    if (entry.path().extension() == ".h5")
      paths.push_back(entry.path());
  std::ranges::sort(paths);
  return paths;
}

/// The first frame, the last one, and evenly as many between as the budget has room for.
Json frame_fields(const std::vector<fs::path>& paths, std::size_t particles)
{
  const std::size_t room =
      std::max<std::size_t>(2, frame_budget / std::max<std::size_t>(1, 6 * particles));
  const std::size_t kept = std::min(room, paths.size());
  Json frames = Json::array();
  for (std::size_t k = 0; k < kept; ++k)
  {
    const std::size_t index =
        kept == 1 ? 0 : (k * (paths.size() - 1) + (kept - 1) / 2) / (kept - 1);
    const Hdf5Reader file(paths[index].string());
    const std::vector<double> position = file.values("/position");
    frames.push_back({{"frame", index},
                      {"time_s", file.attribute("time_s")},
                      {"x", packed_column(position, 0, 2)},
                      {"y", packed_column(position, 1, 2)},
                      {"plastic_strain", packed(file.values("/plastic_strain"))}});
  }
  return frames;
}

/// The tables that were written beside the result, as they are.
Json tables(const fs::path& directory, const Json& result)
{
  Json json = Json::object();
  if (fs::exists(directory / "exit_gradients.csv"))
    json["exit_gradients"] = required_text(directory / "exit_gradients.csv");
  json["lines"] = Json::array();
  if (result.contains("seepage"))
    for (const Json& line : result.at("seepage").value("lines", Json::array()))
      json["lines"].push_back(required_text(directory / "lines" / name_in(line, "file")));
  return json;
}

Json case_data(const fs::path& directory)
{
  const std::string text = required_text(directory / "case.toml");
  return {{"text", text}, {"sha256", hexadecimal(sha256(text))}};
}

Json run_data(const fs::path& directory)
{
  const Json result = read_json(directory / "result.json", "inputs");
  Json data = {{"kind", "run"}, {"result", result}};
  data["case"] = case_data(directory);
  data["tables"] = tables(directory, result);
  const Hdf5Reader file((directory / "results.h5").string());
  if (result.contains("seepage"))
    data["mesh"] = mesh_fields(file);
  if (file.has("/particles/position"))
    data["particles"] = particle_fields(file);
  if (result.contains("runout"))
    data["frames"] = frame_fields(frame_paths(directory), file.values("/particles/soil").size());
  return data;
}

Json comparison_data(const fs::path& directory)
{
  const Json comparison = read_json(directory / "comparison.json", "waters");
  Json data = {{"kind", "comparison"}, {"comparison", comparison}, {"waters", Json::array()}};
  for (const Json& water : comparison.at("waters"))
  {
    const fs::path folder = directory / name_in(water, "directory");
    const Hdf5Reader file((folder / "results.h5").string());
    Json one = {{"result", read_json(folder / "result.json", "inputs")}};
    if (file.has("/particles/position"))
      one["particles"] = particle_fields(file);
    data["waters"].push_back(one);
  }
  data["case"] = case_data(directory / name_in(comparison.at("waters").at(0), "directory"));
  return data;
}

Json study_data(const fs::path& directory)
{
  const Json study = read_json(directory / "study.json", "members");
  Json data = {{"kind", "study"}, {"study", study}, {"case", case_data(directory)}};
  if (const std::optional<std::string> points = text_of(directory / "reference.csv"))
    data["reference"] = *points;
  if (Json lines = study_lines(directory, study); !lines.is_null())
    data["phreatic"] = std::move(lines);
  return data;
}

Json data_of(const fs::path& directory)
{
  std::error_code none;
  if (!fs::is_directory(directory, none))
    refuse(directory, "is not a directory", "give the directory that `berm run --out` named");
  // A further kind of directory is a further line here and a page of its own in report_page/src.
  if (fs::exists(directory / "comparison.json", none))
    return comparison_data(directory);
  if (fs::exists(directory / "study.json", none))
    return study_data(directory);
  if (fs::exists(directory / "result.json", none))
    return run_data(directory);
  refuse(directory, "holds neither result.json nor comparison.json nor study.json",
         "give the directory that `berm run --out` named");
}
} // namespace

Json report_data(const fs::path& directory)
{
  try
  {
    return data_of(directory);
  }
  catch (const Json::exception& e)
  {
    refuse(directory, fmt::format("a file is not as berm writes it: {}", e.what()),
           "run the case again");
  }
}

Json foreign_report_data(const fs::path& directory)
{
  constexpr unsigned longest = 60; // s; a large run-out takes a few
  try
  {
    const std::string cbor = in_sandbox(
        [&directory]
        {
          const std::vector<std::uint8_t> bytes = Json::to_cbor(report_data(directory));
          return std::string(bytes.begin(), bytes.end());
        },
        longest);
    return Json::from_cbor(cbor);
  }
  catch (const SandboxFailure& e)
  {
    refuse(directory, fmt::format("cannot be read: reading it {}", e.what()), "run the case again");
  }
}
} // namespace berm::app
