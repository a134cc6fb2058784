#!/usr/bin/env bash
# Build berm and run its tests on Debian 13, in a root of its own. Needs debootstrap, and to be root.
#   tests/debian13/run.sh ROOT [options of ctest]     ROOT is made if it is not there, and kept
# Without npm and chromium, so without report.html and its tests. JOBS=N compiles N files at a time.
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
root=$1
shift
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

[ -e "$root/etc/debian_version" ] \
  || debootstrap --variant=minbase trixie "$root" "${MIRROR:-http://deb.debian.org/debian}"
mkdir -p "$root/berm"
git ls-files -z | tar -c --null -T - | tar -x -m -C "$root/berm" # all new: build/ there stays, and may be later

# shellcheck disable=SC2016 # expanded inside; what is mounted there ends with the command
exec unshare --mount sh -c '
  mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && mount --rbind /sys "$0/sys" || exit 1
  exec chroot "$0" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 JOBS="$JOBS" \
    DEBIAN_FRONTEND=noninteractive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    bash /berm/tests/debian13/inside.sh "$@"' "$root" "$@"
