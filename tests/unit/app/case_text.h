// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/case_file.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace berm::app::test
{
/// A directory of this process, removed at the end of a test.
class TemporaryDirectory
{
public:
  TemporaryDirectory()
      : path_(std::filesystem::temp_directory_path() / ("berm_test_" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(path_);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() { std::filesystem::remove_all(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// What reading a text gave: a case, or mistakes with their places.
struct ReadResult
{
  coupling::Case input;
  std::vector<Mistake> mistakes;
  KeyPlaces places;

  /// The mistakes as the user sees them.
  [[nodiscard]] std::string text() const { return describe(mistakes, places); }
  /// Whether a mistake about this key is there.
  [[nodiscard]] const Mistake* about(const std::string& key) const
  {
    for (const Mistake& m : mistakes)
      if (m.key == key)
        return &m;
    return nullptr;
  }
};

/// @brief Write the text to a file "case.toml" and read it as `berm` does.
inline ReadResult read_text(const std::string& text, const ReadOptions& options = {})
{
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "case.toml").string();
  std::ofstream(path, std::ios::binary) << text;
  ReadResult result;
  try
  {
    result.input = read_case(path, options, result.places);
  }
  catch (const InputError& e)
  {
    result.mistakes = e.mistakes();
  }
  return result;
}

/// A sound case without seepage.
inline const std::string sound_case = R"(format = 1
title = "a slope"
[section]
ground_m = [[0, 10], [12, 10], [32, 0], [40, 0]]
base_m = -5
[soil.fill]
unit_weight_kN_m3 = 19.62
cohesion_kPa = 10
friction_angle_deg = 30
dilation_angle_deg = 0
young_modulus_kPa = 1e5
poisson_ratio = 0.3
[water]
pore_pressure = "none"
)";
} // namespace berm::app::test
