#!/usr/bin/env bash
# Installs the build into a folder, builds examples/ against it and reconstructs a small street:
#   tests/install/run.sh BUILD_FOLDER
set -euo pipefail
source_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$1" --prefix "$work/prefix" >"$work/install.log"
cmake -S "$source_folder/examples" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/configure.log"
cmake --build "$work/build"
"$work/prefix/bin/orbweave" synth street --panoramas 6 --size 1024x512 --output "$work/street"
"$work/build/reconstruct_folder" "$work/street/images" "$work/blobs" | tee "$work/positions.txt"
[ "$(grep -c '^street_000[0-5].jpg ' "$work/positions.txt")" -eq 6 ] ||
  { echo "not all 6 panoramas have a position" >&2; exit 1; }
