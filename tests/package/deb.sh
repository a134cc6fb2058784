#!/usr/bin/env bash
# Install the Debian package by apt on a clean Debian 12, and run it there as a plain user.
#   tests/package/deb.sh ROOT [FILE.deb]     as root; needs debootstrap; ROOT is made, and kept
# Without FILE.deb the package is built, which needs dpkg-dev.
set -euo pipefail
if [ $# -lt 1 ] || [ -e "$1" ]; then
  sed -n '2,4s/^# //p' "$0" >&2
  exit 2
fi
root=$1
deb=$(realpath "${2:-.}")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

if [ $# -lt 2 ]; then
  cmake --preset package
  cmake --build --preset package -j "${JOBS:-$(nproc)}"
  rm -f build/package/*.deb
  cpack --preset package
  deb=$(echo build/package/berm_*.deb)
fi

debootstrap --variant=minbase bookworm "$root" "${MIRROR:-http://deb.debian.org/debian}"
cp "$deb" "$root/berm.deb"
# shellcheck disable=SC2016 # expanded inside; what is mounted there ends with the command
unshare --mount sh -ec '
  mount -t proc proc "$0/proc"
  mount --rbind /dev "$0/dev"
  mount --rbind /sys "$0/sys"
  exec chroot "$0" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 bash -euxc "$1"' \
  "$root" '
  apt-get update -qq
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq ./berm.deb >/dev/null
  useradd --create-home user
  su user -c "
    set -eux
    cd
    case=/usr/share/berm/cases/two_sided_embankment/seepage.toml
    berm version
    berm check \$case
    timeout 300 berm run \$case --set sph.spacing_m=1.0 --out coarse
    ls coarse"'
