// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_templates.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>

namespace berm::app
{
namespace
{
constexpr std::array templates = {
#include "case_templates_text.h"
};
} // namespace

std::span<const CaseTemplate> case_templates()
{
  return templates;
}

std::filesystem::path write_template(const std::string& name, std::string_view kind)
{
  const std::string path = name.ends_with(".toml") ? name : name + ".toml";
  const auto it = std::ranges::find(templates, kind, &CaseTemplate::name);
  std::FILE* file = std::fopen(path.c_str(), "wx"); // never over a file that is there
  if (file == nullptr)
    throw IoError(path + (errno == EEXIST ? ": is there already, and stays as it is"
                                          : ": cannot be written"));
  const bool written = std::fwrite(it->text.data(), 1, it->text.size(), file) == it->text.size();
  if (std::fclose(file) != 0 || !written)
    throw IoError(path + ": cannot be written");
  return path;
}
} // namespace berm::app
