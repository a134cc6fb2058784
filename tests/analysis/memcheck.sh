#!/usr/bin/env bash
# A seepage analysis and a small run with all its stages under valgrind: errors and leaks in our code.
#   tests/analysis/memcheck.sh [DIR]    results and valgrind's log go to DIR (build/valgrind/out)
# What comes from the libraries alone: memcheck.supp. Exit code 1 if anything is found.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=build/valgrind
out=${1:-$build/out}

cmake --preset dev -B "$build" -DBERM_WERROR=OFF -DBERM_NATIVE=OFF -DBERM_TESTS=OFF -DCMAKE_UNITY_BUILD=ON >/dev/null
cmake --build "$build" --target berm >/dev/null
mkdir -p "$out"

found=0
check() {
  local name=$1
  shift
  OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive valgrind --quiet --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
    --num-callers=40 --gen-suppressions=all --suppressions=/usr/share/openmpi/openmpi-valgrind.supp \
    --suppressions=tests/analysis/memcheck.supp --log-file="$out/$name.log" --error-exitcode=1 \
    "$build/berm" "$@" --quiet --out "$out/$name" >/dev/null || { cat "$out/$name.log"; found=1; }
}
case=cases/two_sided_embankment/seepage.toml
# Coarse, for valgrind takes tens of times as long: what runs is looked at, no number.
small=(--set seepage.tolerance=0.05 --set output.figures=false --set output.report=false)
check seepage seepage "$case" "${small[@]}"
check run run "$case" "${small[@]}" --set sph.spacing_m=3 --set stability.tolerance=0.2
exit $found
