#!/usr/bin/env bash
# From a fresh checkout to a model and a dense cloud one can look at.
#
#   deploy/quickstart.sh                            the built-in street: rendered, reconstructed, compared with truth
#   deploy/quickstart.sh IMAGES [orbweave options]  your own folder of 360 degree images
#
# Installs what is missing (apt, as root), builds Release, then runs one coordinator and two worker processes.
# A second run installs and builds nothing. Outputs: build/quickstart/.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$root/deploy/install_packages.sh"
echo "Building (log: build/release/build.log) ..." >&2
"$root/deploy/build.sh" release -DORBWEAVE_TESTS=OFF -DORBWEAVE_BENCH=OFF
orbweave=$root/build/release/cli/orbweave

if [ $# -gt 0 ] && [[ $1 != -* ]]; then
  images=$1
  shift
  name=$(basename "$(cd "$images" && pwd)")
  output=$root/build/quickstart/$name
  "$orbweave" run "$images" --output "$output" --workers 2 "$@"
else
  street=$root/build/quickstart/street
  output=$root/build/quickstart/street_model
  if [ ! -f "$street/truth.csv" ]; then
    "$orbweave" synth street --panoramas 48 --size 2048x1024 --output "$street"
  fi
  "$orbweave" run "$street/images" --output "$output" --gnss "$street/gnss.csv" --masks "$street/masks" \
    --workers 2 --dense "$@"
  "$orbweave" evaluate "$output" --truth "$street/truth.csv" --surface "$street/surface.ply"
fi
