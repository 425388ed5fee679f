# shellcheck shell=bash disable=SC2154,SC2034 # variables are shared with run.sh
# Full disks, and blobs that were damaged behind the coordinator's back.

corrupt() { printf '\xff\x00\xff' | dd of="$1" bs=1 seek=$(($(stat -c %s "$1") / 2)) conv=notrunc status=none; }
cut_short() { truncate -s "$(($(stat -c %s "$1") / 2))" "$1"; }
remove() { rm "$1"; }

# STATE: its blobs, in the order of their names.
blobs_of() { find "$1"/blobs/?? -type f -size +0 | sort; }

is_image() { grep -qx "${1##*/}" "$work/image_digests"; }

copy_finished_state() {
  rm -rf "$work/finished"
  cp -a "$work/undisturbed_state" "$work/finished"
}

# TITLE DAMAGE: to a fifth of the blobs of a finished job, which is submitted again. Images are the client's: those that
# are deleted it sends again, and those with other bytes once somebody has read them; they are left alone here.
damage_finished_job() {
  local run blob again=0
  begin_row
  for ((run = 0; run < repeats; ++run)); do
    copy_finished_state
    while read -r blob; do
      is_image "$blob" && continue
      ((RANDOM % 5 == 0)) && "$2" "$blob" && ((++times))
    done < <(blobs_of "$work/finished")
    start_fleet "$work/finished" && start_submit "$fleet/model"
    judge
    ((again += $(coordinator_events task_leased)))
    stop_fleet
  done
  end_row "blobs of a finished job $1" "$again tasks computed again"
}

# TITLE DAMAGE: to a result, in the middle of the job that needs it.
damage_running_job() {
  local run blob
  begin_row
  for ((run = 0; run < repeats; ++run)); do
    start_fleet && start_submit "$fleet/model"
    wait_until "some results" 60 has_results 12 || spoil "the job did not begin"
    blob=$(blobs_of "$state" | xargs -r ls -t | grep -vf "$work/image_digests" | head -n 3 | tail -n 1)
    is_running submit && [ -n "$blob" ] && "$2" "$blob" && ((++times))
    judge
    stop_fleet
  done
  end_row "a blob of a running job $1" ""
}

has_results() { (($(cat "$fleet"/worker?.log | grep -c '"event":"task_done"') >= $1)); }

disturb_blobs_corrupted() { damage_finished_job corrupted corrupt && damage_running_job corrupted corrupt; }
disturb_blobs_cut_short() { damage_finished_job "cut short" cut_short && damage_running_job "cut short" cut_short; }
disturb_blobs_deleted() { damage_finished_job deleted remove && damage_running_job deleted remove; }

# TITLE SIZE: a small disk at $work/disk.
mount_disk() {
  mkdir -p "$work/disk"
  mount -t tmpfs -o "size=$2" none "$work/disk" 2>/dev/null && return 0
  skip_row "$1" "mounting is not allowed"
  return 1
}

disk_errors() { cat "$coordinator_log" "$fleet/submit.log" | grep -Eic "No space left on device|disk (is )?full"; }
has_disk_errors() { (($(disk_errors) > 0)); }

# Half of what the job needs; then there is more. A client that had given up is called again.
disturb_coordinator_disk_full() {
  local half_kib end
  half_kib=$(($(du -sk "$work/undisturbed_state" | cut -f1) / 2))
  mount_disk "coordinator's disk full" "${half_kib}k" || return 0
  begin_row
  start_fleet "$work/disk/state" && start_submit "$fleet/model"
  wait_until "a full disk" 60 has_disk_errors || spoil "nobody noticed"
  sleep 2
  times=$(disk_errors)
  mount -o remount,size=1g "$work/disk"
  is_gone submit && end="the client gave up"
  is_gone submit && start_submit "$fleet/model"
  judge
  stop_fleet
  umount "$work/disk"
  end_row "coordinator's disk full, then not" "times: errors logged; ${end:-the job stood still, then went on by itself}"
}

# A worker's folders are full: it cannot write its log, nor a temporary file.
disturb_worker_disk_full() {
  local i
  mount_disk "worker's disk full" 64k || return 0
  begin_row
  head -c 1M /dev/zero >"$work/disk/filler" 2>/dev/null
  new_fleet
  for i in "${workers[@]}"; do ln -s "$work/disk/worker$i.log" "$(worker_log "$i")"; done
  worker_by=(env "TMPDIR=$work/disk")
  start_coordinator && start_workers && start_submit "$fleet/model"
  judge
  times=$(coordinator_events task_leased)
  [ "$(stat -fc %f "$work/disk")" = 0 ] || spoil "the disk was not full"
  worker_by=()
  stop_fleet
  umount "$work/disk"
  end_row "workers' disks full" "times: tasks done so"
}
