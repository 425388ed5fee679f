#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Orbweave authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Realistic streets of docs/hard_cases.md as a markdown table: each is rendered, reconstructed with
# its GNSS and without, and held against the truth. Errors are those of the largest model after a
# similarity; "beyond" counts cameras that are off by more than three claimed sigmas and 5 cm.
#
#   bench/streets.sh ORBWEAVE SPACING:SEED...
#   bench/streets.sh build/release/cli/orbweave 5:1 8:2 12:3
#
# ORBWEAVE_RUN holds more options for `run`, ORBWEAVE_SYNTH for `synth street`.
set -euo pipefail
orbweave=$1
shift
read -r -a more <<<"${ORBWEAVE_RUN:-}"
read -r -a scene <<<"${ORBWEAVE_SYNTH:-}"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
source "$(dirname "$0")/report.sh"

# reconstruct OPTIONS...: "24 in 1 | 0.01 / 0.02 | 0 | `good`", or why there is none.
reconstruct() {
  rm -rf "$folder/out"
  if ! "$orbweave" run "$folder/in/images" --masks "$folder/in/masks" "$@" "${more[@]}" \
    --output "$folder/out" >"$folder/log" 2>&1; then
    echo "failed: $(tail -1 "$folder/log") | | | "
    return
  fi
  "$orbweave" evaluate "$folder/out" --truth "$folder/in/truth.csv" >"$folder/errors" 2>&1 || true
  local errors beyond
  errors=$(sed -n 's/.* \([0-9.]*\) m RMSE, \([0-9.]*\) m max.*/\1 \/ \2/p' "$folder/errors" | head -1)
  beyond=$(sed -n 's/ *\([0-9]*\) of [0-9]* cameras off by more.*/\1/p' "$folder/errors" | head -1)
  echo "$(field registered) in $(field models) | ${errors:-?} | ${beyond:-?} | \`$(level)\`"
}

echo "| m, seed | with GNSS | RMSE / worst m | beyond | verdict | without | RMSE / worst m | beyond | verdict |"
echo "|---|---|---|---|---|---|---|---|---|"
for street in "$@"; do
  rm -rf "$folder"/*
  "$orbweave" synth street --realistic --panoramas 24 --size 2048x1024 --gnss-datum-m 0 \
    --spacing "${street%%:*}" --seed "${street##*:}" "${scene[@]}" --output "$folder/in" \
    >"$folder/log" 2>&1
  with=$(reconstruct --gnss "$folder/in/gnss.csv")
  without=$(reconstruct)
  echo "| ${street%%:*}, ${street##*:} | $with | $without |"
done
