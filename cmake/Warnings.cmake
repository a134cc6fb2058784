# berm::warnings: what every target of ours compiles with.
add_library(berm_warnings INTERFACE)
add_library(berm::warnings ALIAS berm_warnings)
target_compile_options(berm_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  # g++ 12 takes its own AVX-512 header for uninitialised (GCC bug 105593).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
  # Vectors of four doubles never cross a library border: how they are passed does not matter.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>
  # No errno from sqrt and no trapping: loops vectorise, NaN checks stay alive (never -ffast-math).
  -fno-math-errno -fno-trapping-math
  $<$<BOOL:${BERM_WERROR}>:-Werror>
  $<$<BOOL:${BERM_NATIVE}>:-march=native>)
