# SPDX-License-Identifier: AGPL-3.0-or-later
# shellcheck shell=bash
# What ./run, ./test and contrib/install_dependencies share; sourced, not run.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

build_packages="cmake ninja-build g++ ccache mold libdeal.ii-dev libtet1.5-dev libcgal-dev
  libsuitesparse-dev libpugixml-dev zlib1g-dev libmuparser-dev mpi-default-bin"
test_packages="numdiff perl gnuplot-nox python3"

say() { printf '%s\n' "$*" >&2; }
fail() {
  say "$*"
  exit 1
}

# Open MPI refuses to start ranks for root unless told twice.
if [ "$(id -u)" = 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi

# Prints which of the given packages are not installed.
missing_packages() {
  # dpkg-query fails for names that it has never heard of.
  { dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' "$@" 2>/dev/null || true; } |
    awk -v wanted="$*" '
      $1 == "ii" { here[$2] = 1 }
      END { n = split(wanted, name)
            for (i = 1; i <= n; ++i) if (!(name[i] in here)) printf "%s ", name[i] }'
}

# Runs a command as root, through sudo if need be.
as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    fail "Root is needed, and there is no sudo here. As root: $*"
  fi
}

# Installs those of the given packages that are missing; silent when none is.
install_packages() {
  local missing
  if [ -n "${TETRADAPT_NO_INSTALL:-}" ] || ! command -v dpkg-query >/dev/null; then
    return 0 # not Debian, or told not to: cmake says what it does not find
  fi
  missing=$(missing_packages "$@")
  [ -n "$missing" ] || return 0
  say "Installing from Debian's packages: $missing"
  as_root sh -c "apt-get update -q &&
    DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing" >&2 ||
    fail "These Debian packages could not be installed: $missing"
}

# Jobs that fit in the processors and, at 2 GB each, in the memory.
build_jobs() {
  awk -v cores="$(nproc)" '
    $1 == "MemAvailable:" { jobs = int($2 / 2000000) }
    END { if (jobs > cores || jobs == "") jobs = cores
          print jobs < 1 ? 1 : jobs }' /proc/meminfo
}

is_configured() { [ -e "$1/CMakeCache.txt" ] && { [ -e "$1/build.ninja" ] || [ -e "$1/Makefile" ]; }; }

# configure <folder> <build type> [options]: a new build folder uses Ninja.
configure() {
  local folder=$1 type=$2 generator=()
  shift 2
  if [ ! -e "$folder/CMakeCache.txt" ] && command -v ninja >/dev/null; then
    generator=(-G Ninja)
  fi
  cmake -S "$root" -B "$folder" "${generator[@]}" -DCMAKE_BUILD_TYPE="$type" "$@" >&2 ||
    fail "$folder could not be configured; the message is above."
}

# build <folder> [options]: prints what the build prints, to stderr.
build() {
  local folder=$1
  shift
  cmake --build "$folder" -j "$(build_jobs)" "$@" 2>&1 |
    sed -e '/no work to do/d' -e '/Re-checking globbed directories/d' >&2
  return "${PIPESTATUS[0]}"
}
