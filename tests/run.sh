#!/usr/bin/env bash
# Installs what is missing, builds everything, runs all tests. Arguments go to ctest, e.g. -L fast or -R Mapping.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$root/deploy/install_packages.sh"
"$root/deploy/build.sh" release -DORBWEAVE_TESTS=ON -DORBWEAVE_BENCH=ON
cd "$root"
ctest --preset release -j "$(nproc)" "$@"
