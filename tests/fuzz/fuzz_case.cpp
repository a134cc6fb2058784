// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a case file: a case, or mistakes that can be told.
#include "app/case_file.h"
#include "core/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  berm::app::KeyPlaces places;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try
  {
    static_cast<void>(berm::app::parse_case(text, "/fuzz/case.toml", {}, places));
  }
  catch (const berm::InputError& e)
  {
    if (berm::app::describe(e.mistakes(), places).find("mistake") == std::string::npos)
      std::abort();
  }
  catch (const berm::IoError&) // a mesh_file that cannot be opened
  {
  }
  return 0;
}
