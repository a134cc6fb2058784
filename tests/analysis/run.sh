#!/usr/bin/env bash
# What static analysis finds in our sources; exit code 1 if it finds anything.
#   tests/analysis/run.sh [MODULE ...]    meshes seepage sph coupling app, and the headers they include
# What is not asked for, and why: .clang-tidy, cppcheck.supp.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
[ $# -gt 0 ] || set -- meshes seepage sph coupling app
build=build/analysis found=0

cppcheck --enable=warning,performance,portability --std=c++20 --language=c++ --quiet --error-exitcode=1 \
  --suppressions-list=tests/analysis/cppcheck.supp -I . "$@" || found=1

# Of clang 16: 14 does not take all of C++20. clang-tidy takes most of its time for the headers of
# libraries: it reads eight sources at once, where the names of one file may shadow those of another.
cmake --preset audit -B "$build" -DCMAKE_UNITY_BUILD=ON -DBERM_WERROR=OFF -DBERM_TESTS=OFF >/dev/null
cmake --build "$build" -j2 --target berm_git_describe berm_report_page berm_form_flow >/dev/null
modules=$(IFS='|'; echo "$*")
run-clang-tidy-16 -quiet -j2 -p "$build" -header-filter="$PWD/(core|$modules)/.*" \
  -extra-arg=-Wno-unknown-warning-option -extra-arg=-Wno-shadow -checks=-bugprone-suspicious-include \
  "$PWD/$build/($modules)/.*_cxx\.cxx" 2>/dev/null | grep -E -A4 '(warning|error): ' && found=1
exit $found
