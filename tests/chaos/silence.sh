# shellcheck shell=bash disable=SC2154,SC2034 # variables are shared with run.sh
# Workers that are not heard for longer than their lease, or a coordinator that does not listen; bad networks.

pause_worker() {
  # shellcheck disable=SC2046
  kill -STOP "${pid_of[$1]}" $(tasks_of "$1")
}
continue_worker() {
  # shellcheck disable=SC2046
  kill -CONT "${pid_of[$1]}" $(tasks_of "$1")
}
pause_coordinator() { kill -STOP "${pid_of[coordinator]}"; }
continue_coordinator() { kill -CONT "${pid_of[coordinator]}"; }
cut_one_way() { drop_incoming "$1"; }

# BEGIN END: begins in the middle of a task of worker $picked.
silence_in_a_task() {
  until wait_until "a task of worker $picked" 60 has_task "$picked" && "$1" "$picked" && has_task "$picked"; do
    "$2" "$picked"
    is_running submit || return 1
  done
}

# TITLE SECONDS BEGIN END: in the middle of a worker's task it is silent, until the lease is over and longer.
silence_a_worker() {
  local run refused=0 expired=0 given_up=0
  begin_row
  for ((run = 0; run < repeats; ++run)); do
    start_fleet && start_submit "$fleet/model"
    any_worker
    pause
    if silence_in_a_task "$3" "$4"; then ((++times)); else spoil "the job ended before it was disturbed"; fi
    sleep "$2"
    "$4" "$picked"
    wait_until "the end of the late task" 60 has_no_task "$picked" || spoil "the late task did not end"
    judge
    ((expired += $(coordinator_events lease_expired), refused += $(coordinator_events result_refused)))
    ((given_up += $(cat "$fleet"/worker?.log | grep -c "gave it up")))
    stop_fleet
  done
  ((expired > 0)) || spoil "no lease expired"
  end_row "$1 for $2 s" "$expired leases expired; late results: $refused refused, $given_up called off before"
}

disturb_worker_stopped() { silence_a_worker "worker stopped" "$stopped_s" pause_worker continue_worker; }

disturb_coordinator_stopped() {
  silence_a_worker "coordinator stopped" "$longer_than_lease_s" pause_coordinator continue_coordinator
}

disturb_worker_cut_off() {
  needs_wires "worker cut off" || return 0
  silence_a_worker "worker cut off" "$longer_than_lease_s" cut_wire mend_wire
}

disturb_one_way_loss() {
  needs_wires "one-way loss" && needs_nft "one-way loss" || return 0
  silence_a_worker "all to a worker lost, all from it arrives," "$longer_than_lease_s" cut_one_way drop_nothing
}

# TITLE
needs_wires() {
  [ "$namespaces" = yes ] && return 0
  skip_row "$1" "no network namespaces here"
  return 1
}

needs_nft() {
  drop_incoming hub && drop_nothing hub && return 0
  skip_row "$1" "nft cannot drop packets here"
  return 1
}

jobs_on_bad_wires() {
  local run
  for ((run = 0; run < repeats; ++run)); do
    start_fleet && start_submit "$fleet/model"
    judge
    stop_fleet
  done
}

disturb_packet_loss() {
  local i title="2 % of all packets lost"
  needs_wires "$title" && needs_nft "$title" || return 0
  begin_row
  for i in hub "${workers[@]}"; do drop_incoming "$i" "numgen random mod 1000 < 20"; done
  jobs_on_bad_wires
  for i in hub "${workers[@]}"; do
    ((times += $(dropped "$i")))
    drop_nothing "$i"
  done
  end_row "$title" "dropped by nft; times: packets"
}

disturb_latency() {
  local title="20 ms latency both ways"
  needs_wires "$title" || return 0
  if [ ! -x "$relay" ]; then
    skip_row "$title" "the relay is not built"
    return 0
  fi
  begin_row
  start_relay 20
  jobs_on_bad_wires
  stop_relay
  times=$relayed
  end_row "$title" "by a relay; times: pieces held back"
}
