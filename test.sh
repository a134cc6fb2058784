#!/usr/bin/env bash
# Install what is missing, build, run the tests: all that are not labelled slow.
#   ./test.sh          the release build, and the build without the seepage stage
#   ./test.sh slow     the slow published cases as well
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source cmake/setup.sh

install_dependencies
# Free of warnings is what the compiler of Debian 12 says; another one may be of another opinion.
strict=()
[ "$(c++ -dumpversion)" != 12 ] || strict=(-DBERM_WERROR=ON)
build_and_test() {
  configure "$1" "${strict[@]}"
  echo "berm: building $1" >&2
  cmake --build --preset "$1" >"build/$1.build.log" 2>&1 || { tail -n 60 "build/$1.build.log" >&2; exit 1; }
  ctest --preset "$1"
}
build_and_test release
build_and_test no-seepage
[ "${1:-}" != slow ] || ctest --preset slow
