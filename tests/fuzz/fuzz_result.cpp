// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a file in a directory of results, for `berm report`: data for the page, or an error
// that can be told. The first byte says which file. BERM_FUZZ_RESULTS names a sound directory, which
// is copied.
#include "app/report_data.h"
#include "core/error.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace
{
namespace fs = std::filesystem;

/// A copy of the sound directory.
const fs::path& scratch()
{
  static const fs::path path = []
  {
    const fs::path made = fs::temp_directory_path() / ("berm_fuzz_" + std::to_string(getpid()));
    fs::remove_all(made);
    if (const char* sound = std::getenv("BERM_FUZZ_RESULTS"))
      fs::copy(sound, made, fs::copy_options::recursive);
    else
      fs::create_directory(made);
    return made;
  }();
  return path;
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  constexpr std::array names = {"result.json", "results.h5", "comparison.json", "study.json"};
  if (size == 0)
    return 0;
  const fs::path file = scratch() / names[data[0] % names.size()];
  const fs::path kept = scratch() / "kept";
  const bool was_there = fs::exists(file);
  if (was_there)
    fs::rename(file, kept);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  try
  {
    static_cast<void>(berm::app::report_data(scratch()));
  }
  catch (const berm::InputError&)
  {
  }
  catch (const berm::IoError&)
  {
  }
  fs::remove(file);
  if (was_there)
    fs::rename(kept, file);
  return 0;
}
