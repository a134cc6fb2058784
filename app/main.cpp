// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli.h"
#include "app/process_team.h"
#include "app/study/child_processes.h"
#include "app/threads.h"
#include "core/error.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

namespace
{
int fail(int code, const char* what, const char* text)
{
  std::fprintf(stderr, "berm: %s%s\n", what, text);
  berm::app::end_team(code);
  return code;
}
} // namespace

int main(int argc, char** argv)
{
  berm::app::wait_passively(argv);
  berm::app::end_with_parent();
  berm::app::KeyPlaces places;
  try
  {
    return berm::app::run_command_line(argc, argv, places);
  }
  catch (const berm::InputError& e)
  {
    if (berm::app::process_team().rank() == 0) // every rank reads the same case
      std::fputs(berm::app::describe(e.mistakes(), places).c_str(), stderr);
    return berm::app::exit_bad_input;
  }
  catch (const berm::NotConverged& e)
  {
    return fail(berm::app::exit_no_answer, "not converged: ", e.what());
  }
  catch (const berm::NumericalError& e)
  {
    return fail(berm::app::exit_no_answer, "not a number: ", e.what());
  }
  catch (const berm::IoError& e)
  {
    return fail(berm::app::exit_files, "", e.what());
  }
  catch (const std::filesystem::filesystem_error& e)
  {
    return fail(berm::app::exit_files, "", e.what());
  }
  catch (const std::bad_alloc&)
  {
    return fail(berm::app::exit_no_answer,
                "out of memory: ", "try a larger spacing or element size");
  }
  catch (const std::exception& e)
  {
    return fail(berm::app::exit_bug, "a bug in berm, please report it: ", e.what());
  }
}
