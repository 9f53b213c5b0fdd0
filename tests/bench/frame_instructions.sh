#!/usr/bin/env bash
# frame_instructions.sh [BUILD]: instructions that a frame takes on 64-bit Arm, with vector instructions
# switched off, with the portable loops, and with those of NEON; counted under qemu. The mean of ten
# frames of 320 x 240 pixels. After `cmake --build build/arm64 --target frame_work frame_work_scalar`.
# Needs qemu-user: the static one takes no plug-ins.
set -euo pipefail
shopt -s inherit_errexit # a count that fails ends the program
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
built=${1:-$here/../../build/arm64}
sysroot=${FLYBALL_ARM64_SYSROOT:-$here/../../build/arm64-sysroot}
for program in frame_work frame_work_scalar; do
  if [[ ! -x $built/bin/$program ]]; then
    printf 'no program %s; build it: cmake --build --preset arm64 --target frame_work frame_work_scalar\n' \
      "$built/bin/$program" >&2
    exit 2
  fi
done
counter=$built/count_instructions.so
cc -O2 -shared -fPIC "$here/count_instructions.c" -o "$counter"

# count PROGRAM ARGUMENTS...: instructions, and what it printed.
count() {
  local said
  if ! said=$(qemu-aarch64 -cpu cortex-a57 -L "$sysroot" -plugin "$counter" "$built/bin/$1" "${@:2}" 2>&1); then
    printf '%s\n' "$said" >&2
    return 1
  fi
  awk '/^instructions/ { n = $2; next } { sum = $1 } END { print n, sum }' <<< "$said"
}

# per_frame PROGRAM WHAT [portable]: million instructions for a frame, and the sum over its results.
per_frame() {
  local one eleven
  one=$(count "$1" "$2" 1 "${@:3}")
  eleven=$(count "$1" "$2" 11 "${@:3}")
  awk -v a="${one% *}" -v b="${eleven% *}" -v sum="${eleven#* }" 'BEGIN { printf "%.3f %s", (b - a) / 1e7, sum }'
}

printf '%-8s %12s %12s %12s   million instructions a frame\n' '' scalar portable NEON
for what in points map walk; do
  scalar=$(per_frame frame_work_scalar "$what")
  portable=$(per_frame frame_work "$what" portable)
  neon=$(per_frame frame_work "$what")
  printf '%-8s %12s %12s %12s\n' "$what" "${scalar% *}" "${portable% *}" "${neon% *}"
  if [[ ${scalar#* } != "${portable#* }" || ${portable#* } != "${neon#* }" ]]; then
    printf 'the results differ: %s %s %s\n' "${scalar#* }" "${portable#* }" "${neon#* }" >&2
    exit 1
  fi
done
