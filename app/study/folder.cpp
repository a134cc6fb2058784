// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/folder.h"

#include "app/case_mesh_file.h"
#include "app/run_writer.h"
#include "app/text_file.h"
#include "app/version.h"
#include "core/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>

namespace berm::app
{
namespace fs = std::filesystem;

StudyFolder::StudyFolder(const fs::path& directory, bool leads) : directory_(directory)
{
  if (!leads)
    return;
  prepare_directory(directory_);
  lock_.emplace(directory_);
}

void StudyFolder::clear() const
{
  std::error_code none;
  std::vector<fs::path> old{directory_ / "study.json", directory_ / "study.csv",
                            directory_ / "study.h5", directory_ / "case.toml"};
  for (const auto& entry : fs::directory_iterator(directory_ / "members", none))
    if (std::isdigit(static_cast<unsigned char>(entry.path().filename().string().front())) != 0)
      old.push_back(entry.path());
  for (const fs::path& path : old)
    if (fs::remove_all(path, none); none)
      throw IoError(path.string() + ": " + none.message());
}

bool StudyFolder::holds_of_another_build(const Study& study) const
{
  const std::string text = text_of(directory_ / "study.json").value_or("");
  const Json stored = text.empty() ? Json(nullptr) : Json::parse(text, nullptr, false);
  const auto list = differences(study, stored, text_of(directory_ / "case.toml").value_or(""));
  if (!list.empty())
    throw InputError(
        {{.key = "--out",
          .value = directory_.string(),
          .problem = fmt::format("holds another study, which differs in {}", fmt::join(list, ", ")),
          .allowed = "the same study, to go on with it",
          .hint = "choose another directory, or --fresh to remove that study"}});
  return stored.is_object() && stored.value("commit", "") != commit();
}

void StudyFolder::take_reference(const std::string& path) const
{
  const fs::path copy = directory_ / "reference.csv";
  std::error_code none;
  if (path.empty())
    fs::remove(copy, none);
  else if (!fs::equivalent(path, copy, none))
    write_aside(copy, text_of(path).value_or(""));
}

void StudyFolder::take_mesh_file(const Study& study) const
{
  const auto path = relative_mesh_file(study.case_text);
  const auto text = path ? text_of(fs::path(study.case_path).parent_path() / *path) : std::nullopt;
  if (!text) // none, or --set names another
    return;
  std::error_code none; // told by write_aside
  fs::create_directories((directory_ / *path).parent_path(), none);
  write_aside(directory_ / *path, *text);
}
} // namespace berm::app
