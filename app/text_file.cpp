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
} // namespace berm::app
