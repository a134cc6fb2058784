// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/directory_lock.h"
#include "app/study/files.h"

#include <filesystem>
#include <optional>
#include <string>

namespace berm::app
{
/// The directory of a study, which no other study works in meanwhile.
class StudyFolder
{
public:
  /// @brief Make the directory if it is not there, and lock it.
  /// @param[in] leads  False for the other ranks of a team: theirs is the directory of the first.
  /// @throws IoError if that fails, or if another berm works there.
  StudyFolder(const std::filesystem::path& directory, bool leads);

  /// @brief Remove the members and tables of the study that is there. Other files stay.
  void clear() const;
  /// @brief Whether this study, as another build of berm ran it, is there.
  /// @throws InputError that names what differs, if another study is there.
  [[nodiscard]] bool holds_of_another_build(const Study& study) const;
  /// @brief Keep a copy of the reference points, or none if `path` is empty.
  void take_reference(const std::string& path) const;
  /// @brief Keep a copy of the mesh file that the case names, where the copy of the case looks for
  /// it.
  void take_mesh_file(const Study& study) const;

private:
  std::filesystem::path directory_;
  std::optional<DirectoryLock> lock_;
};
} // namespace berm::app
