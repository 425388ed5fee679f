# shellcheck shell=bash disable=SC2154,SC2034 # variables are shared with run.sh
# The table of results, in Markdown. A row counts the jobs that ran, what was done to them, and whether every job ended
# well with the model of the undisturbed run. A row whose jobs were not disturbed at all has failed.
#
# Expects $work/undisturbed.

failures=0

table_head() {
  echo "| disturbance | jobs | times | same bytes | |"
  echo "|---|---|---|---|---|"
}

begin_row() {
  jobs=0
  times=0
  same=yes
}

# TITLE NOTE
end_row() {
  local title=$1
  ((times > 0)) || same=no
  [ "$shares_blobs" = no ] || title+="; workers share the blob folder"
  printf '| %s | %d | %d | %s | %s |\n' "$title" "$jobs" "$times" "$same" "$2"
  [ "$same" = yes ] || ((++failures))
}

# TITLE WHY: nothing was tried.
skip_row() { printf '| %s | | | not tried | %s |\n' "$1" "$2"; }

# WHY: the row has failed.
spoil() {
  same=no
  echo "$1; logs: $fleet" >&2
}

# Whether two models are the same.
same_model() {
  local file
  for file in sparse/0/{cameras,images,points3D}.bin points.ply cameras.csv trajectory.geojson; do
    [ -s "$1/$file" ] && cmp -s "$1/$file" "$2/$file" || return 1
  done
}

# [EXPECTED]: waits for the job, which has to end well with the expected model.
judge() {
  ((++jobs))
  if ! finish_submit; then
    spoil "the job failed: $(tail -n 1 "$fleet/submit.log")"
  elif ! same_model "${1:-$work/undisturbed}" "$fleet/model"; then
    spoil "the model is another one"
  fi
  rm -rf "$fleet/model"
}
