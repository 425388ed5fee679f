# shellcheck shell=bash disable=SC2154,SC2034 # variables are shared with run.sh
# Processes killed: at random moments, and at the commit points of the coordinator.

any_worker() { picked=${workers[RANDOM % ${#workers[@]}]}; }

# Between a twentieth of a second and a second and a half.
pause() {
  local ms=$((RANDOM % 1450 + 50))
  sleep "$((ms / 1000)).$(printf %03d $((ms % 1000)))"
}

# Each fails when there was nothing to kill.

kill_task() {
  local tasks
  any_worker
  tasks=$(tasks_of "$picked")
  # shellcheck disable=SC2086
  [ -n "$tasks" ] && kill -KILL $tasks 2>/dev/null
}

kill_worker() {
  any_worker
  end_by KILL "$picked" && start_worker "$picked"
}

# A worker amid a task, so that its attempt ends without a result.
kill_busy_worker() {
  local i
  for i in "${workers[@]}"; do
    pause_worker "$i"
    if was_computing "$i"; then
      end_by KILL "$i" && start_worker "$i"
      return
    fi
    continue_worker "$i"
  done
  return 1
}

kill_coordinator() { end_by KILL coordinator && start_coordinator; }

# What is left is the state folder.
kill_everything() {
  local tasks i
  tasks=$(for i in "${workers[@]}"; do tasks_of "$i"; done)
  disown -a # whose end the shell need not announce
  # shellcheck disable=SC2086
  kill -KILL "${pid_of[@]}" $tasks 2>/dev/null
  stop_fleet
  start_coordinator && start_workers && start_submit "$fleet/model"
}

# TITLE KILL MOST: jobs on fresh states, each disturbed MOST times at most, until KILL was called $kills times. A task
# that crashes three times fails its job, as it should; so the processes of tasks are killed twice in a job at most.
kill_at_random_moments() {
  local here
  begin_row
  while ((times < kills)); do
    start_fleet && start_submit "$fleet/model"
    here=0
    while ((here < $3 && times < kills)) && pause && is_running submit; do
      if "$2"; then ((++here, ++times)); fi
    done
    judge
    stop_fleet
  done
  end_row "$1" "at random moments"
}

disturb_task_killed() { kill_at_random_moments "task's process killed" kill_task 2; }
disturb_worker_killed() { kill_at_random_moments "worker killed" kill_worker 4; }
disturb_coordinator_killed() { kill_at_random_moments "coordinator killed" kill_coordinator 4; }
disturb_all_killed() { kill_at_random_moments "all killed, only the state folder left" kill_everything 4; }

# POINT: a job whose coordinator dies when it passes the point for the first time, started again when it passes it for
# the second time, and so on; $kills times at most.
kill_at_point() {
  begin_row
  new_fleet
  coordinator_by=(env "ORBWEAVE_FAULT=$1:1")
  launch_coordinator
  start_workers
  start_submit "$fleet/model"
  while is_running submit; do
    if is_running coordinator; then
      # Attempts end without a result only when they are disturbed.
      if [[ $1 = ends.* ]] && ((${#coordinator_by[@]})) && kill_busy_worker; then pause; fi
      sleep 0.02
      continue
    fi
    if ((++times < kills)); then coordinator_by=(env "ORBWEAVE_FAULT=$1:$((times + 1))"); else coordinator_by=(); fi
    launch_coordinator
  done
  coordinator_by=()
  judge
  stop_fleet
  end_row "coordinator killed at \`$1\`" "$(coordinator_events task_leased) tasks leased"
}

# As in core/base/fault_point.h.
disturb_commit_points() {
  local point
  for point in {job,start,result,ends,stage,rename}.{before,after} {commit,get}.before; do kill_at_point "$point"; done
}

# POINT: a job whose workers die when they pass the point for the second to tenth time, each started again, until $kills
# have died and the others who were to.
kill_workers_at_point() {
  local i
  begin_row
  worker_by=(env "ORBWEAVE_FAULT=$1:$((RANDOM % 9 + 2))")
  start_fleet && start_submit "$fleet/model"
  while is_running submit; do
    for i in "${workers[@]}"; do
      is_running "$i" && continue
      if ((++times < kills)); then worker_by=(env "ORBWEAVE_FAULT=$1:$((RANDOM % 9 + 2))"); else worker_by=(); fi
      start_worker "$i"
    done
    sleep 0.02
  done
  worker_by=()
  judge
  stop_fleet
  end_row "worker killed at \`$1\`" "$(coordinator_events task_leased) tasks leased"
}

disturb_shared_folder() {
  local point
  shares_blobs=yes
  disturb_worker_killed
  disturb_coordinator_killed
  for point in rename.{before,after} get.before; do kill_workers_at_point "$point"; done
  disturb_coordinator_disk_full
  disturb_blobs_corrupted
  disturb_blobs_deleted
  shares_blobs=no
}
