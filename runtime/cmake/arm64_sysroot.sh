#!/usr/bin/env bash
# arm64_sysroot.sh [FOLDER]: the headers and libraries of a Debian 12 for arm64, which the preset
# `arm64` builds against. Takes some minutes and 2 GB; a folder that is complete is left alone.
# Needs root, because it unpacks packages as their owners. A folder that it has begun and not completed is
# removed and made anew; one that holds anything else is refused.
set -euo pipefail
top=$(dirname -- "$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")")
source "$top/runtime/cmake/setup.sh"
sysroot=${1:-$top/build/arm64-sysroot}

cross_packages() {
  cat << 'LIST'
g++-aarch64-linux-gnu   12.2.0
qemu-user-static        7.2
mmdebstrap              1.3.5
LIST
}

# What the build links: of the one list of packages the libraries, and those of the compiler.
libraries() {
  build_packages | awk '$1 ~ /-dev$/ && $1 !~ /^(libbenchmark|dpkg)-dev$/ { printf "%s,", $1 }'
  printf 'libc6-dev,libstdc++-12-dev,opencv-data'
}

# Links from the root of the system point at this machine's own files: make them relative.
make_links_relative() {
  local link target
  find "$1" -type l -lname '/*' -print0 |
    while IFS= read -r -d '' link; do
      target=$(readlink "$link")
      if [[ -e $1$target ]]; then
        ln -sfn "$(realpath -m --relative-to="$(dirname "$link")" "$1$target")" "$link"
      fi
    done
}

# So do libraries in some packages' files for CMake.
name_own_libraries() {
  local here=/usr/lib/aarch64-linux-gnu/lib
  grep -rlE --include='*.cmake' "$here" "$1/usr/lib" "$1/usr/share" |
    xargs sed -i -E "s|(^\|[^}])$here|\1\${CMAKE_SYSROOT}$here|g"
}

# What update-alternatives does when packages are installed, not only unpacked.
choose_alternatives() {
  local name ending
  for name in blas lapack; do
    for ending in so so.3; do
      ln -sfn "$name/lib$name.$ending" "$1/usr/lib/aarch64-linux-gnu/lib$name.$ending"
    done
  done
}

if [[ -e $sysroot/.complete ]]; then
  printf '%s is complete; remove it to make it anew\n' "$sysroot"
  exit 0
fi
# With root's rights nothing is removed that was not made here.
if [[ -e $sysroot && ! -e $sysroot/.made-by-flyball ]] && ! { [[ -d $sysroot ]] && [[ -z $(ls -A -- "$sysroot") ]]; }; then
  fail "\"$sysroot\" is not empty, and no sysroot that this script has begun; name another folder, or remove it yourself"
fi
ensure_packages cross_packages
rm -rf -- "$sysroot"
mkdir -p "$(dirname "$sysroot")"
# Which package has which shared library stands in the packages, and they are gone afterwards. The marker
# comes first, because mmdebstrap takes an empty folder only.
# shellcheck disable=SC2016 # $1: the hooks' own
mmdebstrap --mode=root --architectures=arm64 --variant=extract --include="$(libraries)" \
  --aptopt='APT::Install-Recommends "false"' \
  --setup-hook='touch "$1/.made-by-flyball"' \
  --extract-hook='for deb in "$1"/var/cache/apt/archives/*.deb; do dpkg-deb --info "$deb" shlibs 2> /dev/null || true; done > "$1/shlibs"' \
  bookworm "$sysroot" >&2
make_links_relative "$sysroot"
name_own_libraries "$sysroot"
choose_alternatives "$sysroot"
touch "$sysroot/.complete"
printf '%s: %s\n' "$sysroot" "$(du -sh "$sysroot" | cut -f1)"
