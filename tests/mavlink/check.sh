#!/usr/bin/env bash
# Has another library for MAVLink read what Flyball sends, and Flyball read what that library writes:
# check.sh PROGRAM FOLDER. PROGRAM is the built mavlink_samples; FOLDER is where the library is installed.
# .ci/run calls it. The library is under the LGPL, so that nothing but this check may need it. Exit code
# 77: nothing was checked, because the library is not there and cannot be installed; the sentence on standard
# error says why.
set -euo pipefail
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
samples=$(readlink -f -- "$1")
mkdir -p "$2"
cd "$2"
. "$here/../kit/npm_packages.sh"

install_packages
"$samples" write sent.bin > kinds.txt
cp "$here/exchange.js" .
node exchange.js "$samples" kinds.txt sent.bin
