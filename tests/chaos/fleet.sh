# shellcheck shell=bash disable=SC2154,SC2034 # variables are shared with run.sh
# A fleet of real processes: one coordinator, three workers, one client.
#
# Expects $orbweave, $work (an empty folder), $lease_s, and the machines of network.sh.

workers=(1 2 3)
declare -A pid_of        # "coordinator", "submit" or a worker's number -> process
declare -a coordinator_by # what the coordinator is started with: env, faketime
declare -a worker_by
shares_blobs=no # whether workers read and write in the coordinator's blob folder

# MACHINE KEYS ARGUMENTS...: becomes orbweave there, under that certificate.
become() {
  if [ "$namespaces" = yes ]; then
    exec ip netns exec "$(net "$1")" "${by[@]}" "$orbweave" "${@:3}" --tls "$work/keys/$2"
  fi
  exec "${by[@]}" "$orbweave" "${@:3}"
}

is_running() { [ -n "${pid_of[$1]:-}" ] && kill -0 "${pid_of[$1]}" 2>/dev/null; }
is_gone() { ! is_running "$1"; }

# NAME LIMIT_S CONDITION...: waits until the condition holds; says what did not come and fails after the limit.
wait_until() {
  local end=$((SECONDS + $2))
  until "${@:3}"; do
    if ((SECONDS > end)); then
      echo "waited in vain for $1; logs: $fleet" >&2
      return 1
    fi
    sleep 0.02
  done
}

# SIGNAL NAME: sends it and waits for the end.
end_by() {
  is_running "$2" || return 0
  disown "${pid_of[$2]}" 2>/dev/null # whose end the shell need not announce
  kill "-$1" "${pid_of[$2]}"
  wait_until "the end of $2" 60 is_gone "$2"
}

# Does not wait until the coordinator serves.
launch_coordinator() {
  local by=("${coordinator_by[@]}")
  coordinator_log=$fleet/coordinator.$((++starts)).log
  (become hub coordinator serve --listen "$address" --state "$state" --lease "$lease_s" >"$coordinator_log" 2>&1) &
  pid_of[coordinator]=$!
  disown "${pid_of[coordinator]}"
}

start_coordinator() {
  launch_coordinator
  wait_until "the coordinator" 60 grep -qs coordinator_ready "$coordinator_log"
}

start_worker() {
  local name=worker$1 by=("${worker_by[@]}") blobs=()
  [ "$namespaces" = no ] || name=$name/slot
  [ "$shares_blobs" = no ] || blobs=(--blobs "$state/blobs")
  (become "$1" "worker$1" work --join "${relayed_address:-$address}" --name "$name" "${blobs[@]}" \
    >>"$(worker_log "$1")" 2>&1) &
  pid_of[$1]=$!
  disown "${pid_of[$1]}"
}

start_workers() {
  local i
  for i in "${workers[@]}"; do start_worker "$i"; done
}

# A fleet in a folder of its own. Its state is empty, unless it is given.
start_fleet() {
  new_fleet "$@"
  start_coordinator && start_workers
}

new_fleet() {
  fleet=$(mktemp -d "$work/fleet.XXXX")
  state=${1:-$fleet/state}
  starts=0
}

stop_fleet() {
  local i
  for i in submit "${workers[@]}" coordinator; do
    is_running "$i" && kill -CONT "${pid_of[$i]}"
    end_by KILL "$i"
  done
}

# OUTPUT [--set KEY=VALUE]...: has the street reconstructed: two clusters, adjusted in blocks.
start_submit() {
  local by=()
  (become hub client submit --coordinator "$address" "$work/street/images" --gnss "$work/street/gnss.csv" \
    --output "$1" --set partition.cluster_size=6 --set blocks.distribute_from=2 --set features.max_features=1500 \
    "${@:2}" >>"$fleet/submit.log" 2>&1) &
  pid_of[submit]=$!
}

# Whether the job came to a good end.
finish_submit() { wait_until "the job" "$job_limit_s" is_gone submit && wait "${pid_of[submit]}"; }

# Processes of the tasks of a worker.
tasks_of() { cat "/proc/${pid_of[$1]}/task/"*/children 2>/dev/null; }

# ---- What the logs tell, one JSON object per line.

worker_log() { echo "$fleet/worker$1.log"; }

# EVENT FILE...: how often it happened.
count_events() { cat "${@:2}" 2>/dev/null | grep -c "\"event\":\"$1\""; }

# TEXT FILE...: the epochs of the attempts whose events have that text.
attempts_of() { cat "${@:2}" 2>/dev/null | grep "$1" | grep -o '"epoch":[0-9]*' | sort -u; }

coordinator_events() { count_events "$1" "$fleet"/coordinator.*.log; }

# Whether a worker holds a task, as far as it has logged.
has_task() {
  local log
  log=$(worker_log "$1")
  (($(count_events task_leased "$log") > $(count_events task_done "$log") + $(count_events task_not_done "$log")))
}
has_no_task() { ! has_task "$1"; }

# ---- Workers that are held.

# The worker first, which could otherwise begin another task meanwhile.
pause_worker() {
  kill -STOP "${pid_of[$1]}"
  # shellcheck disable=SC2046
  kill -STOP $(tasks_of "$1") 2>/dev/null
}
continue_worker() {
  # shellcheck disable=SC2046
  kill -CONT "${pid_of[$1]}" $(tasks_of "$1")
}

# Whether a worker that is paused was computing: what its task needs has come, and its process has not ended. It is held
# while it is looked at, or a short task would be done meanwhile.
was_computing() {
  local pid state ticks
  has_task "$1" || return 1
  for pid in $(tasks_of "$1"); do
    read -r _ _ state _ _ _ _ _ _ _ _ _ _ ticks _ <"/proc/$pid/stat"
    [ "$state" != Z ] && ((ticks > 0)) && return 0
  done
  return 1
}
