// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/text_file.h"

#include <fstream>
#include <iterator>
#include <utility>

namespace berm::app
{
std::optional<std::string> text_of(const std::filesystem::path& path)
{
  if (std::error_code error; std::filesystem::is_directory(path, error))
    return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  return file ? std::optional(std::move(text)) : std::nullopt;
}

std::filesystem::path name_inside(const std::string& path)
{
  const std::filesystem::path name = std::filesystem::path(path).filename();
  return name == ".." ? std::filesystem::path(".") : name;
}
} // namespace berm::app
