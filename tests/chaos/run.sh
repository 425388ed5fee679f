#!/usr/bin/env bash
# Disturbs a fleet of real processes and compares each model, byte for byte, with that of an undisturbed run.
#
#   tests/chaos/run.sh [KILLS [SEED]]    KILLS random moments for each kind of process (20), SEED of the moments (1)
#
# ORBWEAVE names the program (default: build/release/cli/orbweave). Prints a line per disturbance; 1 if any failed.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
kills=${1:-20}
RANDOM=${2:-1}
orbweave=${ORBWEAVE:-$here/../../build/release/cli/orbweave}
lease_s=3
longer_than_lease_s=8
work=$(mktemp -d /tmp/orbweave_chaos.XXXX)
failures=0
# shellcheck source=tests/chaos/fleet.sh
source "$here/fleet.sh"

clean_up() {
  stop_fleet
  remove_network
  umount "$work/disk" 2>/dev/null
  if ((failures == 0)); then rm -rf "$work"; else echo "what is left: $work"; fi
}

# NAME RUNS SAME_BYTES(yes|no) NOTE
report() {
  printf '%-36s runs %3d   same bytes %-3s   %s\n' "$@"
  [ "$3" = yes ] || ((++failures))
}

skip() { printf '%-36s not tried: %s\n' "$@"; }

# Whether two models are the same.
same_model() {
  local file
  for file in sparse/0/{cameras,images,points3D}.bin points.ply cameras.csv; do
    [ -s "$1/$file" ] && cmp -s "$1/$file" "$2/$file" || return 1
  done
}

# [EXPECTED]: $verdict is "yes" if the job ends well with the expected model.
judge() {
  verdict=no
  if finish_submit && same_model "${1:-$work/undisturbed}" "$fleet/model"; then verdict=yes; fi
}

# Between a tenth of a second and two seconds.
pause() {
  local ms=$((RANDOM % 1900 + 100))
  sleep "$((ms / 1000)).$(printf %03d $((ms % 1000)))"
}

any_worker() { picked=${workers[RANDOM % ${#workers[@]}]}; }

# ---- Killed at random moments. Each fails when there was nothing to kill.

kill_task() {
  any_worker
  local child children
  children=$(cat "/proc/${pid_of[$picked]}/task/"*/children 2>/dev/null)
  [ -n "$children" ] || return 1
  for child in $children; do kill -KILL "$child"; done
}

kill_worker() {
  any_worker
  end_by KILL "$picked" && start_worker "$picked"
}

kill_coordinator() { end_by KILL coordinator && start_coordinator; }

kill_everything() {
  local children
  children=$(for i in "${workers[@]}"; do cat "/proc/${pid_of[$i]}/task/"*/children; done 2>/dev/null)
  disown -a  # whose end the shell need not announce
  # shellcheck disable=SC2086
  kill -KILL "${pid_of[@]}" $children 2>/dev/null
  stop_fleet
  start_coordinator && start_workers && start_submit "$fleet/model"
}

# A client waits for a coordinator that is away only once its job is accepted; before, and while it fetches the
# results, it fails and is to be called again. A job that failed is not submitted again.
submit_until_it_arrives() {
  until finish_submit || grep -q "the job did not finish" "$fleet/submit.log" || ((called_again > 2 * kills)); do
    ((++called_again))
    start_submit "$fleet/model"
  done
}

# NAME KILL: jobs on fresh states until KILL has been called often enough.
disturb_by_killing() {
  local killed=0 runs=0 same=yes
  called_again=0
  while ((killed < kills)); do
    start_fleet && start_submit "$fleet/model"
    while pause && is_running submit && ((killed < kills)); do "$2" && ((++killed)); done
    submit_until_it_arrives
    judge
    [ "$verdict" = yes ] || same=no
    stop_fleet
    ((++runs))
  done
  report "$1" "$runs" "$same" "$killed kills; client called again $called_again times"
}

# ---- A worker that is not heard for longer than its lease.

stop_worker() { kill -STOP "${pid_of[$1]}"; }
continue_worker() { kill -CONT "${pid_of[$1]}"; }
cut_wire() { ip -n "$(net hub)" link set "$(wire_of "$1")" down; }
mend_wire() { ip -n "$(net hub)" link set "$(wire_of "$1")" up; }
# What the coordinator sends goes to nobody; what the worker sends arrives.
lose_one_way() {
  ip -n "$(net hub)" neighbour replace "10.77.0.1$1" lladdr 02:00:00:00:00:99 dev bridge nud permanent
}
find_again() { ip -n "$(net hub)" neighbour delete "10.77.0.1$1" dev bridge; }

has_task() { tail -n 1 "$fleet/worker$1.log" | grep -q "task leased"; }
has_no_task() { ! has_task "$1"; }

# BEGIN END: begins in the middle of a task of worker $picked.
silence_in_a_task() {
  until wait_until "a task of worker $picked" 60 has_task "$picked" && "$1" "$picked" && has_task "$picked"; do
    is_running submit || return 1
    "$2" "$picked"
  done
}

# NAME BEGIN END
disturb_by_silence() {
  local run same=yes refused=0
  for ((run = 0; run < repeats; ++run)); do
    start_fleet && start_submit "$fleet/model"
    any_worker
    pause
    silence_in_a_task "$2" "$3" || same=no
    sleep "$longer_than_lease_s"
    "$3" "$picked"
    wait_until "the late result" 120 has_no_task "$picked" || same=no
    grep -q "task not done" "$fleet/worker$picked.log" && ((++refused))
    judge
    [ "$verdict" = yes ] || same=no
    stop_fleet
  done
  report "$1" "$repeats" "$same" "$refused late results refused or called off"
}

# NAME NETEM: every wire is that bad, both ways.
disturb_by_bad_wires() {
  local run i same=yes
  for i in "${workers[@]}"; do
    # shellcheck disable=SC2086
    if ! ip netns exec "$(net hub)" tc qdisc replace dev "$(wire_of "$i")" root netem $2 2>/dev/null ||
      ! ip netns exec "$(net "$i")" tc qdisc replace dev eth0 root netem $2 2>/dev/null; then
      skip "$1" "this kernel has no netem"
      return
    fi
  done
  for ((run = 0; run < repeats; ++run)); do
    start_fleet && start_submit "$fleet/model"
    judge
    [ "$verdict" = yes ] || same=no
    stop_fleet
  done
  for i in "${workers[@]}"; do
    ip netns exec "$(net hub)" tc qdisc delete dev "$(wire_of "$i")" root
    ip netns exec "$(net "$i")" tc qdisc delete dev eth0 root
  done
  report "$1" "$repeats" "$same" ""
}

# ---- The state of a finished job.

corrupt() { printf '\xff\x00\xff' | dd of="$1" bs=1 seek=$(($(stat -c %s "$1") / 2)) conv=notrunc status=none; }
cut_short() { truncate -s "$(($(stat -c %s "$1") / 2))" "$1"; }
remove() { rm "$1"; }

start_fleet_on_finished_state() {
  rm -rf "$work/finished"
  cp -a "$work/undisturbed_state" "$work/finished"
  start_fleet "$work/finished"
}

tasks_leased() { cat "$fleet"/worker?.log | grep -c "task leased"; }

# NAME DAMAGE: to a fifth of all blobs, before the coordinator starts and the job is submitted again.
disturb_blobs() {
  local run blob same=yes damaged=0 again=0
  for ((run = 0; run < repeats; ++run)); do
    rm -rf "$work/finished"
    cp -a "$work/undisturbed_state" "$work/finished"
    while read -r blob; do
      ((RANDOM % 5 == 0)) && "$2" "$blob" && ((++damaged))
    done < <(find "$work/finished/blobs" -type f -size +0 | sort)
    start_fleet "$work/finished" && start_submit "$fleet/model"
    judge
    [ "$verdict" = yes ] || same=no
    ((again += $(tasks_leased)))
    stop_fleet
  done
  report "$1" "$repeats" "$same" "$damaged blobs, $again tasks computed again"
}

same_job_twice() {
  start_fleet_on_finished_state && start_submit "$fleet/model"
  judge
  local count
  count=$(tasks_leased)
  ((count == 0)) || verdict=no
  report "same job again" 1 "$verdict" "$count tasks computed"
}

changed_option() {
  local stages
  start_fleet && start_submit "$work/changed" --set global.rounds=3
  finish_submit
  stop_fleet
  start_fleet_on_finished_state && start_submit "$fleet/model" --set global.rounds=3
  judge "$work/changed"
  stages=$(cat "$fleet"/worker?.log | grep "task leased" | grep -o "stage=[a-z_]*" | sort -u | cut -d= -f2 | xargs)
  [[ -n $stages && ! $stages =~ ingest|extract|select|match|partition|reconstruct|align|review ]] || verdict=no
  report "one option changed" 1 "$verdict" "computed only: $stages"
  stop_fleet
}

full_disk() {
  local half_kib message
  half_kib=$(($(du -sk "$work/undisturbed_state" | cut -f1) / 2))
  mkdir "$work/disk"
  if ! mount -t tmpfs -o "size=${half_kib}k" none "$work/disk" 2>/dev/null; then
    skip "coordinator's disk full" "mounting is not allowed"
    return
  fi
  start_fleet "$work/disk" && start_submit "$fleet/model"
  if finish_submit; then verdict=no; fi
  message=$(grep -Eo "No space left on device|disk is full" "$fleet/submit.log" | head -n 1)
  mount -o remount,size=1g "$work/disk"
  start_submit "$fleet/model"
  judge
  [ -n "$message" ] || verdict=no
  report "coordinator's disk full" 1 "$verdict" "failed with \"$message\", went on"
  stop_fleet
  umount "$work/disk"
}

undisturbed() {
  "$orbweave" synth street --panoramas 14 --size 512x256 --output "$work/street" >"$work/synth.log" 2>&1 || return 1
  start_fleet && start_submit "$work/undisturbed"
  finish_submit || return 1
  end_by TERM coordinator
  stop_fleet
  cp -a "$state" "$work/undisturbed_state"
}

repeats=$(((kills + 4) / 5))
trap clean_up EXIT
make_network
echo "one coordinator, three workers; each in a network namespace of its own, with certificates: $namespaces"
if ! undisturbed; then
  failures=1
  echo "the undisturbed run failed" >&2
  exit 1
fi

disturb_by_killing "task's process killed" kill_task
disturb_by_killing "worker killed" kill_worker
disturb_by_killing "coordinator killed" kill_coordinator
disturb_by_killing "all killed, only the state left" kill_everything
disturb_by_silence "worker stopped beyond its lease" stop_worker continue_worker
if [ "$namespaces" = yes ]; then
  disturb_by_silence "worker cut off beyond its lease" cut_wire mend_wire
  disturb_by_silence "what goes to a worker is lost" lose_one_way find_again
  disturb_by_bad_wires "2 % of packets lost" "loss 2%"
  disturb_by_bad_wires "20 ms latency" "delay 20ms"
else
  skip "networks cut, lossy or slow" "no network namespaces here"
fi
disturb_blobs "blobs corrupted" corrupt
disturb_blobs "blobs cut short" cut_short
disturb_blobs "blobs deleted" remove
same_job_twice
stop_fleet
changed_option
full_disk
exit $((failures > 0))
