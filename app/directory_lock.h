// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace berm::app
{
/// A directory in which no other berm works as long as this lives. Nothing is written: the lock
/// ends with the process, however that ends.
class DirectoryLock
{
public:
  /// @throws IoError if another process works there.
  explicit DirectoryLock(const std::filesystem::path& directory);
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;
  ~DirectoryLock();

private:
  int handle_ = -1;
};
} // namespace berm::app
