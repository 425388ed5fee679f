#!/usr/bin/env bash
# Fuzzes the decoders for long:  tests/fuzz/run.sh [SECONDS [TARGET...]]
# SECONDS per target, 600 by default; all targets by default, as many at a time as there are processors.
# Needs clang with libFuzzer (Debian: clang). Starts from tests/fuzz/corpus; what is found on the way stays
# in build/fuzz/corpus, an input that breaks a law in build/fuzz/faults: copy it to tests/fuzz/corpus/TARGET.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
export seconds=${1:-600}
shift || true
cd "$root"

if [ -d /dev/shm ]; then export TMPDIR=/dev/shm; fi  # some targets write a file for every input
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
if [ $# -eq 0 ]; then
  for source in tests/fuzz/*_fuzz.cc; do set -- "$@" "$(basename "$source" _fuzz.cc)"; done
fi

# One target: "TARGET ok, N executions", or what it said last.
fuzz() {
  local target=$1 log=build/fuzz/logs/$1.log
  mkdir -p "build/fuzz/corpus/$target" build/fuzz/faults build/fuzz/logs
  if "build/fuzz/tests/fuzz/fuzz_$target" "build/fuzz/corpus/$target" "tests/fuzz/corpus/$target" \
    -max_total_time="$seconds" -max_len=20000 -timeout=10 -malloc_limit_mb=64 -rss_limit_mb=1024 \
    -print_final_stats=1 -artifact_prefix="build/fuzz/faults/$target-" >"$log" 2>&1; then
    echo "$target ok, $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") executions"
  else
    echo "$target FAILED, see $log"
    tail -n 20 "$log"
    return 1
  fi
}
export -f fuzz
printf '%s\n' "$@" | xargs -P "$(nproc)" -I{} bash -c 'fuzz {}'
