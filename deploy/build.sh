#!/usr/bin/env bash
# Configures and builds a preset (default: release) into build/PRESET; prints only on failure.
#   deploy/build.sh [PRESET] [cmake -D options]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
preset=${1:-release}
shift || true

cd "$root"
mkdir -p "build/$preset"
log=build/$preset/build.log
if ! { cmake --preset "$preset" "$@" && cmake --build --preset "$preset"; } >"$log" 2>&1; then
  tail -n 60 "$log" >&2
  echo "The build failed; the whole log is in $log" >&2
  exit 1
fi
