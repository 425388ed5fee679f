#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Orbweave authors
# SPDX-License-Identifier: BSD-3-Clause
#
# The ladder of docs/hard_cases.md as a markdown table: for each hardship of a rendered street the
# widest spacing of 2, 5, 8, 12 m at which every panorama is registered rightly. Rightly: all in one
# model, and after a similarity none further from its true place than 5 % of the spacing. The search
# starts at 8 m and goes up while it is right, or down until it is.
#
#   bench/ladder.sh [path of the orbweave program] [panoramas] [size] [first row] [last row]
#
# ORBWEAVE_SYNTH names another program that renders; ORBWEAVE_RUN holds more options for `run`.
set -euo pipefail
orbweave=${1:-build/release/cli/orbweave}
panoramas=${2:-24}
size=${3:-1536x768}
first=${4:-1}
last=${5:-99}
synth=${ORBWEAVE_SYNTH:-$orbweave}
read -r -a more <<<"${ORBWEAVE_RUN:-}"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
source "$(dirname "$0")/report.sh"

# climb SPACING OPTIONS...: reconstructs one street; sets found ("24 of 24, 0.01 m") and is true
# when all is right.
climb() {
  local spacing=$1
  shift
  rm -rf "$folder"/*
  "$synth" synth street --panoramas "$panoramas" --size "$size" --spacing "$spacing" "$@" \
    --output "$folder/in" >"$folder/log" 2>&1
  if ! "$orbweave" run "$folder/in/images" --gnss "$folder/in/gnss.csv" --masks "$folder/in/masks" \
    --output "$folder/out" "${more[@]}" >>"$folder/log" 2>&1; then
    found="failed: $(tail -1 "$folder/log")"
    return 1
  fi
  "$orbweave" evaluate "$folder/out" --truth "$folder/in/truth.csv" >"$folder/errors" 2>&1 || true
  local worst
  worst=$(sed -n 's/.* RMSE, \([0-9.]*\) m max.*/\1/p' "$folder/errors" | head -1)
  found="$(field registered) of $panoramas in $(field models), worst ${worst:-?} m"
  [ "$(field registered)" = "$panoramas" ] && [ "$(field models)" = 1 ] && [ -n "$worst" ] &&
    awk -v w="$worst" -v s="$spacing" 'BEGIN { exit !(w <= 0.05 * s) }'
}

number=0
row() {
  local name=$1 found at_8 widest=none
  shift
  number=$((number + 1))
  [ "$number" -ge "$first" ] && [ "$number" -le "$last" ] || return 0
  local right=false
  climb 8 "$@" && right=true
  at_8=$found
  if $right; then
    widest=8
    if climb 12 "$@"; then widest=12; fi
  elif climb 5 "$@"; then
    widest=5
  elif climb 2 "$@"; then
    widest=2
  fi
  printf '| %s | `%s` | %s | %s |\n' "$name" "$*" "$widest" "$at_8"
}

echo "| street | options | widest m | at 8 m |"
echo "|---|---|---|---|"
row "no hardship"
row "plain walls and ground" --plain-share 1
row "panes that mirror" --reflection 1
row "equal windows, repeated houses" --equal-windows --repeat-share 1
row "wind in trees and clouds" --wind-m 0.15
row "gain, white balance, vignetting" --exposure-spread 0.4 --white-balance-spread 0.1 \
  --vignetting 0.3
row "two days" --second-day-share 0.4
row "JPEG 75, noise and blur in the shade" --jpeg-quality 75 --harsh-light 0.3 \
  --shade-noise-levels 8 --shade-blur-px 1.2
row "lenses 6 cm off the centre" --lens-offset-m 0.06
row "rolling shutter of 30 ms at 8 m/s" --rolling-shutter-s 0.03
row "nothing below -45 degrees" --nadir black
row "uneven steps" --spacing-spread 0.4
row "people and traffic, not masked" --pedestrians 25 --vehicles 6 --no-mask-moving-cars
row "behind a bus in a dim street" --bus-ahead --no-mask-moving-cars --daylight 0.1
row "GNSS: multipath, late, two datums" --second-day-share 0.4 --gnss-multipath-m 4 \
  --gnss-late-s 0.4 --gnss-datum-m 40
row "all at once" --realistic
