# shellcheck shell=bash
# How much of what workers computed was for nothing.

# LOG...: of workers, which may have been started again and again. Prints how many seconds their slots spent on tasks
# and how many of these on attempts that came to nothing: given back, cut off by the worker's end, or of a task that was
# done once more. From when a task begins in its slot to the line that says how it ended.
computed_twice() {
  local log
  for log in "$@"; do
    # Lines of Slurm stand between those of the worker.
    jq -R -r 'fromjson? | objects | select(.time != null) |
      [(.time[:19] + "Z" | fromdateiso8601) + (.time[20:23] | tonumber) / 1000, .event, .epoch // 0, .task // "-",
       .slot // 0, input_filename] | @tsv' "$log"
    echo -e "end\tworker_started\t0\t-\t0\t$log"
  done | awk -F '\t' '
    function ends(epoch, now, is_good,    begun, held) {
      begun = since[epoch] > busy_to[slot_of[epoch]] ? since[epoch] : busy_to[slot_of[epoch]]
      held = now > begun ? now - begun : 0
      busy_to[slot_of[epoch]] = now
      total += held
      if (!is_good || task_of[epoch] in is_done) lost += held
      if (is_good) is_done[task_of[epoch]] = 1
      delete since[epoch]
    }
    $2 == "worker_started" {  # whatever the process before it had is gone
      for (epoch in since) ends(epoch, last, 0)
      delete busy_to
    }
    $1 != "end" { last = $1 }
    $2 == "task_leased" { since[$3] = $1; task_of[$3] = $4; slot_of[$3] = $5 }
    ($2 == "task_done" || $2 == "task_not_done") && $3 in since { ends($3, $1, $2 == "task_done") }
    END { printf "%.1f %.1f\n", total, lost }'
}
