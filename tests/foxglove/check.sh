#!/usr/bin/env bash
# Flies, cuts and recovers a record, and has Foxglove's own readers look at it: check.sh FLYBALL FOLDER
# FLYBALL is the built command; FOLDER is where the readers are installed and the records written.
# .ci/run calls it. Exit code 77: nothing was checked, because the readers are not there and cannot be
# installed; the sentence on standard error says why.
set -euo pipefail
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
flyball=$(readlink -f -- "$1")
mkdir -p "$2"
cd "$2"

. "$here/../kit/npm_packages.sh"

# fly EXECUTOR SECONDS: to EXECUTOR.mcap. The mission has no time to arrive: exit code 1.
fly() {
  local code=0
  "$flyball" run delivery_forest --policy mission_energy --set "mission.time_limit_s=$2" \
    --executor "$1" --mcap "$1.mcap" --out run --json > "$1.json" || code=$?
  ((code == 1)) || {
    printf 'flyball: the flight for the record ended with code %s\n' "$code" >&2
    exit 1
  }
}

install_packages
fly virtual 40
fly realtime 8
cp virtual.mcap cut.mcap
truncate -s "$(($(stat -c %s cut.mcap) * 4 / 5))" cut.mcap
"$flyball" log recover cut.mcap --out recovered.mcap
cp "$here/read_records.js" .
node read_records.js virtual.mcap realtime.mcap recovered.mcap
