#!/usr/bin/env bash
# Install what is missing, build, run a case, draw its figures.
#   ./run.sh                    the paper's embankment with real seepage
#   ./run.sh CASE [options]     another case; options as in `berm run --help`
set -euo pipefail
here=$(pwd)
cd "$(dirname "${BASH_SOURCE[0]}")"
root=$(pwd)
source cmake/setup.sh

install_dependencies
configure release
cmake --build --preset release --target berm >build/release.build.log 2>&1 \
  || { tail -n 40 build/release.build.log >&2; exit 1; }

cd "$here"
[ $# -gt 0 ] || set -- "$root/cases/two_sided_embankment/seepage.toml"
exec "$root/build/release/berm" run "$@"
