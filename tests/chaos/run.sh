#!/usr/bin/env bash
# Disturbs a fleet of real processes and compares each model, byte for byte, with that of an undisturbed run.
#
#   tests/chaos/run.sh [KILLS [SEED [NAME...]]]
#
# KILLS    how often each kind of process is killed (20); other disturbances are repeated for a fifth of it
# SEED     of the random moments (1)
# NAME...  the disturbances to try (all; names lists them)
# ORBWEAVE the program (build/release/cli/orbweave); what holds back bytes is looked for in the same build
#
# Prints a table in Markdown; 1 if any row failed, whose logs are then kept. Needs a few minutes for KILLS=2.
# shellcheck disable=SC2034,SC2154,SC2317 # variables are for the parts, functions are called by name
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
orbweave=${ORBWEAVE:-$here/../../build/release/cli/orbweave}
relay=$(dirname "$orbweave")/../tests/chaos/relay
kills=${1:-20}
RANDOM=${2:-1}
chosen=("${@:3}")
repeats=$(((kills + 4) / 5))
lease_s=8
longer_than_lease_s=16
stopped_s=60
job_limit_s=600
for part in fleet network judge kills silence disks clocks repeats; do
  # shellcheck source=/dev/null
  source "$here/$part.sh"
done

disturbances=(task_killed worker_killed coordinator_killed all_killed commit_points shared_folder worker_stopped
  coordinator_stopped worker_cut_off one_way_loss late_result packet_loss latency coordinator_disk_full worker_disk_full blobs_corrupted blobs_cut_short blobs_deleted
  clock_jumped same_job_twice one_option_changed)
if [ "${1:-}" = names ]; then
  printf '%s\n' "${disturbances[@]}"
  exit
fi
((${#chosen[@]})) || chosen=("${disturbances[@]}")
for name in "${chosen[@]}"; do
  declare -F "disturb_$name" >/dev/null && continue
  echo "there is no disturbance $name; there are: ${disturbances[*]}" >&2
  exit 2
done

clean_up() {
  stop_fleet
  end_by KILL relay
  remove_network
  umount "$work/disk" 2>/dev/null
  if ((failures == 0)); then rm -rf "$work"; else echo "what is left: $work" >&2; fi
}

# The model that every other is compared with, and the state it left.
undisturbed() {
  "$orbweave" synth street --panoramas 12 --size 512x256 --output "$work/street" >"$work/synth.log" 2>&1 || return 1
  sha256sum "$work"/street/images/* | cut -d' ' -f1 >"$work/image_digests"
  start_fleet && start_submit "$work/undisturbed"
  finish_submit || return 1
  end_by TERM coordinator
  stop_fleet
  cp -a "$state" "$work/undisturbed_state"
}

work=$(mktemp -d /tmp/orbweave_chaos.XXXX)
trap clean_up EXIT
make_network
if ! undisturbed; then
  failures=1
  echo "the undisturbed run failed" >&2
  exit 1
fi
echo "One coordinator and three workers; each in a network namespace of its own, with certificates: $namespaces."
echo
table_head
for name in "${chosen[@]}"; do "disturb_$name"; done
exit $((failures > 0))
