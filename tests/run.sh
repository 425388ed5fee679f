#!/usr/bin/env bash
# Installs what is missing, builds everything, runs all tests. Arguments go to ctest, e.g. -L fast or -R Mapping.
# Fails too when a test is skipped that tests/may_skip.txt does not name.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$root/deploy/install_packages.sh"
"$root/deploy/build.sh" release -DORBWEAVE_TESTS=ON -DORBWEAVE_BENCH=ON
cd "$root"
ran=build/release/ran.xml
rm -f "$ran"
# Two more than processors: many tests wait, for who was killed to be missed, or for a store that does not answer.
ctest --preset release -j "$(($(nproc) + 2))" --output-junit "$root/$ran" "$@"
tests/check_skips.sh "$ran"
