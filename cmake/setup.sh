# shellcheck shell=bash
# Sourced by run.sh and test.sh: install what is missing, configure the release preset once.

# Name every package of the list that is not installed. An npm from elsewhere will do: Debian's would
# not install beside it.
missing_packages() {
  local package
  grep -v '^#' cmake/debian-packages.txt | while read -r package; do
    [ "$package" = npm ] && command -v npm >/dev/null && continue
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

install_dependencies() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "berm: this is not Debian: no apt-get. berm is built on Debian 12 and 13 and needs the" >&2
    echo "equivalents of these packages there (DOLFINX 0.5, PETSc 3.18, gmsh 4.8, or 0.9, 3.22, 4.13):" >&2
    grep -v '^#' cmake/debian-packages.txt | sed 's/^/  /' >&2
    echo "With them in place: cmake --preset release && cmake --build --preset release" >&2
    exit 1
  fi
  local codename missing
  codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-unknown}")
  missing=$(missing_packages)
  [ -z "$missing" ] && return
  if [ "$codename" != bookworm ] && [ "$codename" != trixie ]; then
    echo "berm: this is '$codename', neither Debian 12 (bookworm) nor 13 (trixie), which berm is built on." >&2
    echo "These packages are missing: $(echo "$missing" | tr '\n' ' ')" >&2
    echo "Install them, or what provides DOLFINX 0.5 or 0.9, PETSc and gmsh here, and call this again." >&2
    exit 1
  fi
  local sudo=""
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "berm: run as root, or install: $missing" >&2; exit 1; }
    sudo=sudo
  fi
  echo "berm: installing $(echo "$missing" | tr '\n' ' ')" >&2
  $sudo apt-get update -qq
  # shellcheck disable=SC2086 # one word a package
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# configure PRESET [OPTION ...]: once; a changed CMake file is picked up by the build itself.
configure() {
  local log="build/$1.configure.log"
  [ -f "build/$1/build.ninja" ] && return
  mkdir -p build
  echo "berm: configuring $1" >&2
  cmake --preset "$@" >"$log" 2>&1 || { grep -A4 -E 'CMake Error|lacks' "$log" >&2; echo "berm: the whole of it is in $log" >&2; exit 1; }
}
