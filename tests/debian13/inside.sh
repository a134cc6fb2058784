#!/usr/bin/env bash
# What run.sh runs inside its root: install, build, test.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
apt-get update -qq
grep -vxE '#.*|npm|chromium' cmake/debian-packages.txt \
  | xargs apt-get install -y -qq --no-install-recommends >/dev/null
cmake --preset release -DBERM_WITH_REPORT=OFF
cmake --build --preset release -j "${JOBS:-$(nproc)}"
ctest --preset release "$@"
