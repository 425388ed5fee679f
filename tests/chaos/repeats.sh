# shellcheck shell=bash disable=SC2154,SC2034 # variables are shared with run.sh
# What is not to be computed again.

disturb_same_job_twice() {
  begin_row
  copy_finished_state
  start_fleet "$work/finished" && start_submit "$fleet/model"
  judge
  times=1
  (($(coordinator_events task_leased) == 0)) || spoil "tasks were computed"
  stop_fleet
  end_row "the same job again" "$(coordinator_events task_leased) tasks computed"
}

# The number of rounds belongs to the global adjustment; all before it stays.
disturb_one_option_changed() {
  local stages
  begin_row
  start_fleet && start_submit "$work/changed" --set global.rounds=3
  finish_submit || spoil "the job with another option failed"
  stop_fleet
  copy_finished_state
  start_fleet "$work/finished" && start_submit "$fleet/model" --set global.rounds=3
  judge "$work/changed"
  times=1
  stages=$(grep -h '"event":"task_leased"' "$fleet"/worker?.log | grep -o '"stage":"[a-z_]*' | cut -d'"' -f4 | sort -u | xargs)
  [[ $stages = *steer_adjustment* && ! $stages =~ ingest|extract|select|match|partition|reconstruct|align|review ]] ||
    spoil "computed again: $stages"
  stop_fleet
  end_row "one option changed" "computed again only: $stages"
}
