#!/usr/bin/env bash
# Fuzz each target for so many minutes in turn; print executions and findings.
#   tests/fuzz/run.sh MINUTES [TARGET...]     targets: case set vary result mesh files
# Inputs that break something are kept in build/fuzz/findings, the grown corpus in build/fuzz/corpus.
# `files` breaks geometries, meshes and results under the release build's program; the others are
# clang's libFuzzer with address and undefined-behaviour sanitizers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
minutes=${1:?usage: tests/fuzz/run.sh MINUTES [TARGET...]}
shift
targets=("$@")
[ $# -gt 0 ] || targets=(case set vary result mesh files)

if [ ! -x build/fuzz/tests/fuzz/fuzz_mesh ]; then
  mkdir -p build
  cmake --preset fuzz >build/fuzz.log 2>&1 && cmake --build --preset fuzz >>build/fuzz.log 2>&1
fi
findings=build/fuzz/findings
mkdir -p "$findings"
python3 tests/fuzz/seeds.py build/fuzz/corpus
TMPDIR=$(mktemp -d /dev/shm/berm_fuzz_XXXXXX) # in memory
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
export BERM_FUZZ_RESULTS="$PWD/build/fuzz/corpus/sound_results"
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 OMP_NUM_THREADS=1

for target in "${targets[@]}"; do
  if [ "$target" = files ]; then
    python3 tests/fuzz/fuzz_files.py "$minutes" "$findings"
    continue
  fi
  log=build/fuzz/$target.log
  build/fuzz/tests/fuzz/fuzz_$target -max_total_time=$((60 * minutes)) -timeout=10 -rss_limit_mb=3000 \
    -max_len=20000 -print_final_stats=1 -artifact_prefix="$findings/$target-" -dict=tests/fuzz/words.dict \
    "build/fuzz/corpus/$target" >"$log" 2>&1 && end="nothing found" || end="FOUND: see $log"
  echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") executions in $minutes min, $end"
done
