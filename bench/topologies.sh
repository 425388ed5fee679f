#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Orbweave authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Seams of streets of all shapes as a markdown table: each street is made, divided into clusters of
# 40 panoramas and reconstructed from its matches by the orbweave program.
#
#   bench/topologies.sh [path of the orbweave program] [panoramas]
set -euo pipefail
orbweave=${1:-build/release/cli/orbweave}
panoramas=${2:-200}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
source "$(dirname "$0")/report.sh"

# How many seams have this verdict.
verdicts() { grep -c "\"verdict\": \"$1\"" "$folder/out/report.json" || true; }

# Reasons of seams that are not used, then warnings.
remarks() {
  sed -n '/^ "seams": \[/,/^ \]/s/^   "reason": "\(..*\)",*$/\1/p' "$folder/out/report.json"
  sed -n '/^ "warnings": \[/,/^ \]/s/^  "\(.*\)",*$/\1/p' "$folder/out/report.json"
}

row() {
  local name=$1
  shift
  rm -rf "$folder"/*
  "$orbweave" synth corridor --features-per-panorama 300 --panoramas "$panoramas" "$@" \
    --output "$folder/in" >"$folder/log"
  if ! "$orbweave" reconstruct --database "$folder/in/corridor.db" --gnss "$folder/in/gnss.csv" \
    --set partition.cluster_size=40 --workers 2 --output "$folder/out" >>"$folder/log" 2>&1; then
    echo "| $name | | | | | | failed: $(tail -1 "$folder/log") |"
    return
  fi
  local good doubtful bad
  good=$(verdicts good)
  doubtful=$(verdicts doubtful)
  bad=$(verdicts bad)
  printf '| %s | %s of %s | %s | %s | %s | %s | %s |\n' "$name" "$(field registered)" \
    "$(field images_total)" "$(field models)" "$good" "$doubtful" "$bad" \
    "$(remarks | head -3 | paste -sd ';' | sed 's/;/; /g')"
}

echo "| street | registered | models | good seams | doubtful | bad | the report says |"
echo "|---|---|---|---|---|---|---|"
row "straight" --shape straight
row "bends" --shape bends
row "grid with crossings" --shape grid
row "loop" --shape loop
row "out and back" --shape uturn
row "two drives over the same street" --drives 2
row "two parts joined by GNSS alone" --tunnel-panoramas 12 --tunnel-features 10
row "tunnel of 12 panoramas, 36 features" --tunnel-panoramas 12 --tunnel-features 36
