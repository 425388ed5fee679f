#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Orbweave authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Realistic streets of docs/hard_cases.md as a markdown table: each is rendered, reconstructed with
# its GNSS and without, and held against the truth. Errors are those of the largest model after a
# similarity; "beyond" counts cameras that are off by more than three claimed sigmas and 5 cm;
# "claims" are squared errors over claimed variances along x, y and z. Below the table: their means
# over the models that are judged good.
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
good=$(mktemp)
trap 'rm -rf "$folder" "$good"' EXIT
source "$(dirname "$0")/report.sh"

# reconstruct OPTIONS...: "24 in 1 | 0.01 / 0.02 | 0 | 0.9, 1.1, 0.8 | `good`", or why there is none.
reconstruct() {
  rm -rf "$folder/out"
  if ! "$orbweave" run "$folder/in/images" --masks "$folder/in/masks" "$@" "${more[@]}" \
    --output "$folder/out" >"$folder/log" 2>&1; then
    echo "failed: $(tail -1 "$folder/log") | | | | "
    return
  fi
  "$orbweave" evaluate "$folder/out" --truth "$folder/in/truth.csv" >"$folder/errors" 2>&1 || true
  local errors beyond claims
  errors=$(sed -n 's/.* \([0-9.]*\) m RMSE, \([0-9.]*\) m max.*/\1 \/ \2/p' "$folder/errors" | head -1)
  beyond=$(sed -n 's/ *\([0-9]*\) of [0-9]* cameras off by more.*/\1/p' "$folder/errors" | head -1)
  claims=$(sed -n 's/^ *claimed *\([0-9., ]*\) squared.*/\1/p' "$folder/errors" | head -1)
  if [ "$(level)" = good ]; then echo "$claims" >>"$good"; fi
  echo "$(field registered) in $(field models) | ${errors:-?} | ${beyond:-?} | ${claims:-?} | \`$(level)\`"
}

echo "| m, seed | with GNSS | RMSE / worst m | beyond | claims | verdict | without | RMSE / worst m | beyond | claims | verdict |"
echo "|---|---|---|---|---|---|---|---|---|---|---|"
for street in "$@"; do
  rm -rf "$folder"/*
  "$orbweave" synth street --realistic --panoramas 24 --size 2048x1024 --gnss-datum-m 0 \
    --spacing "${street%%:*}" --seed "${street##*:}" "${scene[@]}" --output "$folder/in" \
    >"$folder/log" 2>&1
  with=$(reconstruct --gnss "$folder/in/gnss.csv")
  without=$(reconstruct)
  echo "| ${street%%:*}, ${street##*:} | $with | $without |"
done
awk -F', *' '{ for (i = 1; i <= 3; ++i) sum[i] += $i }
  END { if (NR) printf "\n%d good, claims %.2f, %.2f, %.2f on average\n", NR, sum[1] / NR, sum[2] / NR, sum[3] / NR }' "$good"
