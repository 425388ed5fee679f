#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Orbweave authors
# SPDX-License-Identifier: BSD-3-Clause
#
# The hard cases of docs/hard_cases.md as a markdown table: each street is made, reconstructed from
# its matches and compared with the truth by the orbweave program.
#
#   bench/hard_cases.sh [path of the orbweave program] [panoramas]
set -euo pipefail
orbweave=${1:-build/release/cli/orbweave}
panoramas=${2:-60}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
source "$(dirname "$0")/report.sh"

# What the report says beyond numbers: GNSS not used, GNSS outliers, warnings, verdict and its first reason.
remarks() {
  local file=$folder/out/report.json gnss used reason outliers warnings seams
  gnss=$(sed -n '/^ "gnss": {/,/^ }/p' "$file")
  used=$(sed -n 's/^  "used": \([a-z]*\),*$/\1/p' <<<"$gnss")
  reason=$(sed -n 's/^  "reason": "\(.*\)",*$/\1/p' <<<"$gnss")
  outliers=$(sed -n '/"outliers": \[/,/\]/p' <<<"$gnss" | grep -c '^   "' || true)
  warnings=$(sed -n '/^ "warnings": \[/,/^ \]/s/^  "\(.*\)",*$/\1/p' "$file" | head -1)
  [ "$used" = true ] || echo -n "GNSS not used: $reason; "
  [ "$outliers" = 0 ] || echo -n "GNSS outliers named: $outliers; "
  seams=$(sed -n '/^ "seams": \[/,/^ \]/p' "$file" | grep -c '"used": false' || true)
  [ "$seams" = 0 ] || echo -n "seams switched off: $seams; "
  [ "${#warnings}" -le 110 ] || warnings="${warnings:0:107} ..."
  [ -z "$warnings" ] || echo -n "$warnings; "
  reason=$(sed -n '/"reasons": \[$/,/\]/s/^   "\(.*\)",*$/\1/p' <<<"$(verdict)" | head -1)
  [ "${#reason}" -le 110 ] || reason="${reason:0:107} ..."
  echo -n "$(level)${reason:+: $reason}; "
}

# error REGEX: the number before it in what evaluate printed.
error() { sed -n "s/.* \([0-9.]*\) m $1.*/\1/p" "$folder/errors" | head -1; }

row() {
  local name=$1
  shift
  rm -rf "$folder"/*
  "$orbweave" synth corridor --features-per-panorama 300 "$@" --output "$folder/in" >"$folder/log"
  local gnss=(--gnss "$folder/in/gnss.csv")
  [ "$(wc -l <"$folder/in/gnss.csv")" -gt 1 ] || gnss=()
  if ! "$orbweave" reconstruct --database "$folder/in/corridor.db" "${gnss[@]}" --workers 1 \
    --output "$folder/out" >>"$folder/log" 2>&1; then
    echo "| $name | | | | | | | failed: $(tail -1 "$folder/log") |"
    return
  fi
  "$orbweave" evaluate "$folder/out" --truth "$folder/in/truth.csv" >"$folder/errors" 2>&1 || true
  local said
  said=$(remarks)
  printf '| %s | %s | %s | %s | %.2f | %s | %s | %s |\n' "$name" "$(field images_total)" \
    "$(field registered)" "$(field models)" "$(field residual_px_rms)" "$(error 'RMSE, ')" \
    "$(error 'RMSE within')" "${said%; }"
}

echo "| case | panoramas | registered | models | RMS px | position RMSE m | 30 in a row m | the report says |"
echo "|---|---|---|---|---|---|---|---|"
n=(--panoramas "$panoramas")
row "straight street, 3 m steps" "${n[@]}" --shape straight
row "U-turn" "${n[@]}" --shape uturn
row "50 panoramas at a traffic light" --panoramas $((panoramas + 50)) --stop-panoramas 50
row "tunnel of 20 panoramas, 40 features" "${n[@]}" --tunnel-panoramas 20
row "30 % wrong matches" "${n[@]}" --outlier-share 0.3
row "GNSS jump of 100 m" "${n[@]}" --gnss-jump-panoramas $((panoramas / 5))
row "20 % of GNSS 20 to 100 m off" "${n[@]}" --gnss-outlier-share 0.2
row "two drives, 30 % of points last, GNSS offsets of 3 m" "${n[@]}" --drives 2 --gnss-bias-m 3
row "mount leans 12 degrees sideways, straight street" "${n[@]}" --shape straight --mount-roll-deg 12
row "mount leans 12 degrees sideways, U-turn" "${n[@]}" --shape uturn --mount-roll-deg 12
row "mount leans 10 degrees backwards, straight street" "${n[@]}" --shape straight --mount-pitch-deg 10
row "GNSS errors of 5 m, alike over 150 m" --panoramas $((4 * panoramas)) --gnss-sigma-m 5 --gnss-correlation-m 150
row "hills of 20 %, 10 m steps" --panoramas $((2 * panoramas)) --spacing-m 10 --hill-grade 0.2
row "hills of 15 %, GNSS errors of 4 m, alike over 150 m" --panoramas $((2 * panoramas)) --spacing-m 5 --hill-grade 0.15 --gnss-sigma-m 4 --gnss-correlation-m 150
row "GNSS clock 0.8 s late" --panoramas $((2 * panoramas)) --gnss-delay-s 0.8
row "GNSS clock 0.4 s late at 4 to 16 m/s, straight street" --panoramas $((2 * panoramas)) --shape straight --gnss-delay-s 0.4 --speed-spread 0.6
row "antenna 3 m to the left, U-turn" "${n[@]}" --shape uturn --gnss-left-m 3
row "second day 47 m higher" --panoramas $((2 * panoramas)) --drives 2 --gnss-datum-m 47
row "hills of 15 %, positions without heights" --panoramas $((2 * panoramas)) --spacing-m 5 --hill-grade 0.15 --gnss-heights false
row "GNSS reports every sixth panorama" --panoramas $((2 * panoramas)) --gnss-held-panoramas 6
row "roof of 100 features" "${n[@]}" --roof-features 100
row "roof of 400 features" "${n[@]}" --roof-features 400
row "lenses 4 cm off the centre" "${n[@]}" --lens-offset-m 0.04
row "no GNSS" "${n[@]}" --gnss-sigma-m 0
for share in 0.5 1; do
  repeat=("${n[@]}" --shape straight --repeat-after 20 --repeat-share "$share")
  row "facades repeat, share $share" "${repeat[@]}"
  row "facades repeat, share $share, no GNSS" "${repeat[@]}" --gnss-sigma-m 0
done
