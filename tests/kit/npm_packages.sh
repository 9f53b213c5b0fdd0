# Functions for checks that need packages of npm; to be sourced. The caller's folder `here` has
# package.json and package-lock.json, and the working directory is where they are installed. Exit code 77:
# nothing was checked, because something is missing that nothing else depends on.

skip() {
  printf 'flyball: %s, so nothing was checked by other libraries\n' "$1" >&2
  exit 77
}

# Packages that an earlier check installed need neither npm nor its registry. The copy of the lock beside them
# says that they are complete: one that was interrupted has none.
install_packages() {
  command -v node > /dev/null || skip 'node is not installed'
  local complete=node_modules/.flyball-lock.json
  if cmp -s "$here/package-lock.json" "$complete"; then
    return
  fi
  command -v npm > /dev/null || skip 'npm is not installed'
  rm -rf node_modules
  cp "$here/package.json" "$here/package-lock.json" .
  if npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 --fetch-retry-mintimeout=1000 \
    > npm.log 2>&1; then
    cp package-lock.json "$complete"
    return
  fi
  rm -rf node_modules
  tail -n 5 npm.log >&2
  # These say that our two files, or what they name, are wrong. All others are the network's.
  if grep -qE 'code (EUSAGE|EINTEGRITY|EJSONPARSE|ERESOLVE)' npm.log; then
    exit 1
  fi
  skip 'npm cannot install them here'
}
