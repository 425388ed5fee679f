# shellcheck shell=bash disable=SC2154,SC2034 # variables are shared with run.sh
# Workers that are not heard for longer than their lease, or a coordinator that does not listen; bad networks.

pause_coordinator() { kill -STOP "${pid_of[coordinator]}"; }
continue_coordinator() { kill -CONT "${pid_of[coordinator]}"; }
cut_one_way() { drop_incoming "$1"; }
cut_other_way() { drop_incoming hub "ip saddr 10.77.0.1$1"; }
mend_other_way() { drop_nothing hub; }

# How many attempts ended because their worker was told so, before anything of them was refused.
called_off() {
  comm -23 <(attempts_of "gave it up" "$fleet"/worker?.log) <(attempts_of result_refused "$fleet"/coordinator.*.log) | wc -l
}

# BEGIN: begins in the middle of a task of a worker that is met computing, which is then $picked. Fails when the job
# ended before one was met.
silence_in_a_task() {
  while is_running submit; do
    any_worker
    pause_worker "$picked"
    if was_computing "$picked"; then
      "$1" "$picked"
      [ "$1" = pause_worker ] || continue_worker "$picked"
      return 0
    fi
    continue_worker "$picked"
  done
  return 1
}

# BEGIN: the same in a job of a fresh fleet, which may end before a worker is met: then another is begun, and looked at
# from its beginning.
silence_in_a_job() {
  local try
  for try in 1 2 3 4 5; do
    if ((try > 1)); then judge && stop_fleet; fi
    start_fleet && start_submit "$fleet/model"
    ((try > 1)) || pause
    silence_in_a_task "$1" && return 0
  done
  return 1
}

# TITLE SECONDS BEGIN END [REFUSED]: in the middle of a worker's task it is silent, until the lease is over and longer.
# So many late results have to be refused at least.
silence_a_worker() {
  local run refused=0 expired=0 given_up=0
  begin_row
  for ((run = 0; run < repeats; ++run)); do
    if silence_in_a_job "$3"; then ((++times)); else spoil "five jobs ended before they were disturbed"; fi
    sleep "$2"
    "$4" "$picked"
    wait_until "the end of the late task" 60 has_no_task "$picked" || spoil "the late task did not end"
    judge
    ((expired += $(coordinator_events lease_expired), refused += $(coordinator_events result_refused)))
    ((given_up += $(called_off)))
    stop_fleet
  done
  ((expired > 0)) || spoil "no lease expired"
  ((refused >= ${5:-0})) || spoil "no late result was refused"
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

# The task ends meanwhile; its result waits in the worker until it can be handed in, when another has the task. One of
# three is called off before, hence some jobs more.
disturb_late_result() {
  local repeats=$((repeats > 4 ? repeats : 4))
  needs_wires "late result" && needs_nft "late result" || return 0
  silence_a_worker "all from a worker lost, all to it arrives," "$longer_than_lease_s" cut_other_way mend_other_way 1
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
