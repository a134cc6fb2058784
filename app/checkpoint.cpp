// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/checkpoint.h"

#include "app/frame_files.h"
#include "app/packed_array.h"
#include "app/result_json.h"
#include "app/run_writer.h"
#include "app/text_file.h"
#include "app/version.h"
#include "core/error.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* checkpoint_folder = "checkpoint";
constexpr const char* run_file = "run.json";
constexpr std::size_t digest_length = 64; ///< of SHA-256 in hexadecimal digits

std::string digest(std::string_view bytes)
{
  return hexadecimal(sha256(bytes));
}

/// The case as it was read, a section from a mesh file included, and the program: all that finished
/// work depends on.
std::string identity_of(const coupling::Case& input)
{
  std::string all = version_text() + '\n' + input.text + '\n';
  for (const std::string& one : input.overrides)
    all += one + '\n';
  const auto add = [&all](const Polyline& line)
  {
    for (const Vec2& point : line)
      all += fmt::format("{:a} {:a}\n", point.x(), point.y());
  };
  add(input.section.outline);
  for (const meshes::Zone& zone : input.section.zones)
    add(zone.polygon);
  for (const Polyline& line : input.section.marked_lines)
    add(line);
  return digest(all);
}

/// Remove what is ours; what else somebody keeps there stays, and the folder with it.
void clear(const fs::path& folder)
{
  std::error_code ignored;
  remove_frames(folder);
  for (const auto& entry : fs::directory_iterator(folder, ignored))
  {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(run_file) || name.starts_with("settled_") || name.starts_with("trial_"))
      fs::remove(entry.path(), ignored);
  }
  fs::remove(folder, ignored);
}

/// What `begin` noted; null if there is nothing, or it cannot be read.
Json noted(const fs::path& folder)
{
  const std::optional<std::string> text = text_of(folder / run_file);
  Json json = text ? Json::parse(*text, nullptr, false) : Json();
  return json.is_object() ? json : Json();
}
} // namespace

Checkpoint::Checkpoint(const fs::path& directory, const coupling::Case& input)
    : folder_(directory / checkpoint_folder), case_path_(fs::absolute(input.path).string()),
      overrides_(input.overrides), identity_(identity_of(input))
{
}

void Checkpoint::require_same() const
{
  const Json before = noted(folder_);
  if (!before.is_null() && before.value("identity", "") != identity_)
    throw InputError({{.key = "--resume",
                       .value = folder_.string(),
                       .problem = "the work there is on another case, or by another build of berm",
                       .allowed = "the same case file, --set and program",
                       .hint = "leave out --resume to begin anew"}});
}

void Checkpoint::begin(bool resume)
{
  std::error_code error;
  if (!resume)
    clear(folder_);
  fs::create_directories(folder_, error);
  if (error)
    throw IoError(folder_.string() + ": " + error.message());
  write_aside(
      folder_ / run_file,
      json_text({{"case", case_path_}, {"overrides", overrides_}, {"identity", identity_}}) + "\n");
}

void Checkpoint::remove()
{
  clear(folder_);
}

std::optional<std::string> Checkpoint::kept(const std::string& name)
{
  std::optional<std::string> text = text_of(folder_ / name);
  if (!text || text->size() < 2 * digest_length)
    return std::nullopt;
  const std::string_view all = *text, bytes = all.substr(2 * digest_length);
  const bool sound = all.substr(0, digest_length) == identity_ &&
                     all.substr(digest_length, digest_length) == digest(bytes);
  return sound ? std::optional(std::string(bytes)) : std::nullopt;
}

void Checkpoint::keep(const std::string& name, const std::string& bytes)
{
  write_aside(folder_ / name, identity_ + digest(bytes) + bytes);
}

StoppedRun stopped_run(const fs::path& directory)
{
  const Json run = noted(directory / checkpoint_folder);
  if (run.is_null())
    throw InputError(
        {{.key = "--resume",
          .value = directory.string(),
          .problem = "there is no run to go on with: none was stopped there",
          .allowed = "a directory of results with a folder " + std::string(checkpoint_folder),
          .hint = "berm run CASE begins one"}});
  return {.case_path = run.value("case", ""),
          .overrides = run.value("overrides", std::vector<std::string>{})};
}
} // namespace berm::app
