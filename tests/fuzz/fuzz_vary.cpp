// SPDX-License-Identifier: GPL-3.0-or-later
// Any lines as texts of --vary: values, or mistakes.
#include "app/study/variation.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::vector<std::string> texts;
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string line; std::getline(lines, line);)
    texts.push_back(line);
  std::vector<berm::Mistake> mistakes;
  for (const auto& variation : berm::app::parse_variations(texts, mistakes))
    for (const std::string& value : variation.values)
      if (value.empty() && mistakes.empty())
        std::abort(); // an empty value is a mistake
  return 0;
}
