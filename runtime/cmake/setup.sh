# shellcheck shell=bash
# shellcheck disable=SC2154 # top: set by who sources this
# Sourced by ./fly, ./check and .ci/run: what a machine needs before it can build, and how to build.
# Expects `top`, the folder of the checkout, and `set -euo pipefail`.

# The one list of packages: name, and the version of Debian 12 that everything is tested with.
build_packages() {
  cat << 'LIST'
g++                     12.2.0
cmake                   3.25.1
ninja-build             1.11.1
ccache                  4.8
libeigen3-dev           3.4.0
liboctomap-dev          1.9.7
libompl-dev             1.5.2
libsimbody-dev          3.7
libembree-dev           3.13.5
libassimp-dev           5.2.5
libpng-dev              1.6.39
libopencv-dev           4.6.0
libopencv-contrib-dev   4.6.0
opencv-data             4.6.0
morse-simulator-data    1.4
libmrpt-topography-dev  2.5.8
libmrpt-poses-dev       2.5.8
libmrpt-graphslam-dev   2.5.8
libsqlite3-dev          3.40.1
libzstd-dev             1.5.4
libnlopt-dev            2.7.1
libtomlplusplus-dev     3.3.0
libcli11-dev            2.1.2
nlohmann-json3-dev      3.11.2
liblua5.4-dev           5.4.4
libgtest-dev            1.12.1
libbenchmark-dev        1.7.1
python3                 3.11.2
dpkg-dev                1.21.22
file                    5.44
LIST
}
lint_packages() {
  cat << 'LIST'
clang-format            14.0.6
clang-tidy              14.0.6
libclang-14-dev         14.0.6
llvm-14-dev             14.0.6
LIST
}

fail() {
  printf 'flyball: %s\n' "$*" >&2
  exit 1
}

# Names from `name version` lines on stdin that are not installed.
missing_of() {
  local name status
  while read -r name _; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$name" 2> /dev/null || true)
    [[ $status == installed ]] || printf '%s\n' "$name"
  done
}

# ensure_packages LIST...: installs what is missing of these lists, and touches nothing else.
ensure_packages() {
  local lists missing
  lists=$(for list in "$@"; do "$list"; done)
  if [[ ! -r /etc/os-release ]] || ! (. /etc/os-release && [[ ${ID:-} == debian && ${VERSION_ID:-} == 12 ]]); then
    may_go_on_elsewhere "$lists"
    return
  fi
  mapfile -t missing < <(missing_of <<< "$lists")
  ((${#missing[@]})) || return 0
  # The question goes to the terminal that answers it: messages may go to a file.
  if [[ -t 0 ]]; then
    local answer
    read -r -p "flyball: packages to install: ${missing[*]}"$'\n''Install them with apt-get? [Y/n] ' answer 2>&0
    [[ -z $answer || $answer == [Yy]* ]] || fail 'not installed; nothing was changed'
  else
    printf 'flyball: packages to install: %s\n' "${missing[*]}" >&2
  fi
  install_packages "${missing[@]}"
}

# Another system names its packages differently: say what is needed, and try with what is there.
may_go_on_elsewhere() {
  # Configured before, so everything was found.
  if compgen -G "$top/build/*/build.ninja" > /dev/null; then
    return
  fi
  printf 'flyball: this is not Debian 12, so nothing is installed for you. Needed are (names and versions of Debian 12):\n%s\n' "$1" >&2
  local tool
  for tool in cmake ninja ccache c++; do
    command -v "$tool" > /dev/null || fail "no $tool here; install what is listed above and call again"
  done
}

install_packages() {
  local as_root=()
  if ((EUID != 0)); then
    command -v sudo > /dev/null || fail "neither root nor sudo; as root: apt-get install -y --no-install-recommends --no-upgrade $*"
    as_root=(sudo)
  fi
  local name candidate
  for name in "$@"; do
    candidate=$(apt-cache policy "$name" 2> /dev/null | sed -n 's/^  Candidate: //p')
    if [[ -z $candidate || $candidate == '(none)' ]]; then
      "${as_root[@]}" apt-get update -q >&2
      break
    fi
  done
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends --no-upgrade "$@" >&2
}

# As many compilers as there are cores, but not more than memory has room for: 2 GiB each.
build_jobs() {
  local cores free_kib limit jobs
  cores=$(nproc)
  free_kib=$(sed -n 's/^MemAvailable: *\([0-9]*\) kB$/\1/p' /proc/meminfo)
  limit=$(cat /sys/fs/cgroup/memory.max 2> /dev/null || true)
  if [[ $limit =~ ^[0-9]+$ ]] && ((limit / 1024 < free_kib)); then
    free_kib=$((limit / 1024))
  fi
  jobs=$((free_kib / (2 * 1024 * 1024)))
  ((jobs < 1)) && jobs=1
  printf '%s\n' "$((jobs < cores ? jobs : cores))"
}

# configure PRESET: only when that was not done yet; later changes are ninja's business.
configure() {
  local folder=$top/build/$1 fresh=() home
  if [[ -f $folder/CMakeCache.txt ]]; then
    home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$folder/CMakeCache.txt")
    # A checkout that was moved or copied: its cache points elsewhere.
    [[ $home == "$top" ]] || fresh=(--fresh)
  fi
  if ((${#fresh[@]} == 0)) && [[ $folder/build.ninja -nt $top/CMakePresets.json ]]; then
    return
  fi
  (cd "$top" && cmake "${fresh[@]}" --preset "$1" > /dev/null)
}

# Else what reads a precompiled header is never taken from the cache.
export CCACHE_SLOPPINESS=pch_defines,time_macros
# A file that was never compiled is not preprocessed first: a sixteenth of a build from nothing.
export CCACHE_DEPEND=1

# build PRESET [TARGET...]: everything when no target is named.
build() {
  local preset=$1 targets=()
  shift
  (($#)) && targets=(--target "$@")
  (cd "$top" && cmake --build --preset "$preset" -j "$(build_jobs)" "${targets[@]}" >&2)
}
