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

skip() {
  printf 'flyball: %s, so the records were not read by Foxglove'\''s libraries\n' "$1" >&2
  exit 77
}

# Readers that an earlier check installed need neither npm nor its registry.
install_readers() {
  if [[ -d node_modules ]] && cmp -s "$here/package-lock.json" package-lock.json; then
    return
  fi
  command -v npm > /dev/null || skip 'npm is not installed'
  rm -rf node_modules
  cp "$here/package.json" "$here/package-lock.json" .
  npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 --fetch-retry-mintimeout=1000 \
    > npm.log 2>&1 && return
  rm -rf node_modules
  tail -n 5 npm.log >&2
  # These say that our two files, or what they name, are wrong. All others are the network's.
  if grep -qE 'code (EUSAGE|EINTEGRITY|EJSONPARSE|ERESOLVE)' npm.log; then
    exit 1
  fi
  skip 'npm cannot install them here'
}

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

command -v node > /dev/null || skip 'node is not installed'
install_readers
fly virtual 40
fly realtime 8
cp virtual.mcap cut.mcap
truncate -s "$(($(stat -c %s cut.mcap) * 4 / 5))" cut.mcap
"$flyball" log recover cut.mcap --out recovered.mcap
cp "$here/read_records.js" .
node read_records.js virtual.mcap realtime.mcap recovered.mcap
