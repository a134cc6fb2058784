// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/directory_lock.h"

#include "core/error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace berm::app
{
DirectoryLock::DirectoryLock(const std::filesystem::path& directory)
    : handle_(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
{
  // A file system that knows no locks locks nothing.
  if (handle_ >= 0 && flock(handle_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
  {
    close(handle_);
    throw IoError(directory.string() + ": another berm works in this directory");
  }
}

DirectoryLock::~DirectoryLock()
{
  if (handle_ >= 0)
    close(handle_);
}
} // namespace berm::app
