# shellcheck shell=bash disable=SC2154,SC2034 # variables are shared with run.sh
# Clocks that jump. libfaketime shifts the time of day as a process sees it; time that only goes on is left alone, as a
# machine's own would be when somebody sets its clock.

faketime_library=$(find /usr/lib -name libfaketimeMT.so.1 -print -quit)

# TITLE WHO(coordinator|worker) JUMP
jump() {
  local run by=(env "LD_PRELOAD=$faketime_library" "FAKETIME_TIMESTAMP_FILE=$work/clock"
    FAKETIME_CACHE_DURATION=1 FAKETIME_DONT_FAKE_MONOTONIC=1)
  begin_row
  for ((run = 0; run < repeats; ++run)); do
    echo "+0" >"$work/clock"
    if [ "$2" = coordinator ]; then coordinator_by=("${by[@]}"); else worker_by=("${by[@]}"); fi
    start_fleet && start_submit "$fleet/model"
    coordinator_by=()
    worker_by=()
    wait_until "a result" 60 has_results 3 || spoil "the job did not begin"
    echo "$3" >"$work/clock"
    judge
    ((times += $(jumps_in "$fleet/$2"?*.log)))
    stop_fleet
  done
  end_row "$1" "by libfaketime; times: jumps seen in the logs"
}

# FILE...: steps of more than half an hour between one line and the next.
jumps_in() {
  local file
  for file in "$@"; do
    grep -o '"time":"[^"]*' "$file" | cut -d'"' -f4 | date -f - +%s |
      awk 'NR > 1 && ($1 - last > 1800 || last - $1 > 1800) {print} {last = $1}'
  done | wc -l
}

disturb_clock_jumped() {
  local who
  if [ -z "$faketime_library" ]; then
    skip_row "clock jumps by an hour" "libfaketime is not installed"
    return 0
  fi
  for who in coordinator worker; do
    jump "clock of the $who jumps an hour ahead" "$who" "+3600"
    jump "clock of the $who jumps an hour back" "$who" "-3600"
  done
}
