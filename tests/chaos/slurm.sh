#!/usr/bin/env bash
# `orbweave launch slurm` on a real Slurm of three nodes, each in a network namespace of its own on this machine.
#
#   tests/chaos/slurm.sh [REQUEUES [PREEMPTIONS [PANORAMAS [ROW...]]]]
#
# One job is run undisturbed on this machine, then by Slurm
#   disturbed          while its coordinator is requeued (5 times) and its workers are preempted by jobs of another
#                      partition (20 times)
#   short_allocations  with its dense cloud, by one worker in allocations of 4 minutes (ALLOCATION), of which 5 % (MOST_REPEATED) may be computed twice at most
#   elastic            by one to three workers as there is work for
#   exit_codes         small jobs whose end `sbatch --wait` tells
#   scaling            orbweave bench scaling --engine slurm, of a corridor
# Prints a table in Markdown;
# 1 if a row failed. Needs root and Debian's slurmctld, slurmd, slurm-client, munge, jq and iproute2: 77 without them.
# ORBWEAVE: the program (build/release/cli/orbweave). Takes half an hour.
# shellcheck disable=SC2016,SC2317 # words for another shell; functions that a trap calls
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
orbweave=$(realpath "${ORBWEAVE:-$here/../../build/release/cli/orbweave}")
requeues=${1:-5}
preemptions=${2:-20}
panoramas=${3:-192}
rows=("${@:4}")
[ ${#rows[@]} -gt 0 ] || rows=(disturbed short_allocations elastic exit_codes scaling)
minutes=${ALLOCATION:-4}
most_repeated=${MOST_REPEATED:-5}
nodes=(n1 n2 n3)
# shellcheck source=/dev/null
source "$here/judge.sh"
# shellcheck source=/dev/null
source "$here/computed_twice.sh"

for tool in slurmctld slurmd sbatch munged ip nsenter jq; do
  command -v "$tool" >/dev/null || { echo "$tool is missing" >&2; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "only root can make namespaces" >&2; exit 77; }

lab=$(mktemp -d /tmp/orbweave_slurm.XXXX)
export SLURM_CONF=$lab/slurm.conf

# MACHINE COMMAND...: as if on that machine.
on() {
  nsenter --net="/var/run/netns/ow-$1" unshare --uts --mount sh -c \
    'mount --bind "$1" /etc/hosts; hostname "$2"; shift 2; exec "$@"' sh "$lab/hosts" "$@"
}

network_up() {
  echo "127.0.0.1 localhost" >"$lab/hosts"
  local number=100 name
  for name in hub "${nodes[@]}"; do
    ip netns add "ow-$name" && ip -n "ow-$name" link set lo up || return 1
    echo "10.78.0.$number $name" >>"$lab/hosts"
    if [ "$name" = hub ]; then
      ip -n ow-hub link add ow-bridge type bridge && ip -n ow-hub link set ow-bridge up
      ip -n ow-hub addr add "10.78.0.$number/24" dev ow-bridge
      number=1
    else
      ip link add "to-$name" netns ow-hub type veth peer name eth0 netns "ow-$name"
      ip -n ow-hub link set "to-$name" master ow-bridge up
      ip -n "ow-$name" addr add "10.78.0.$((number++))/24" dev eth0
      ip -n "ow-$name" link set eth0 up
    fi
  done
}

slurm_up() {
  mkdir -p "$lab"/{state,spool,munge}
  chmod 711 "$lab" && chmod 755 "$lab/munge"
  head -c 1024 /dev/urandom >"$lab/munge/key" && chmod 600 "$lab/munge/key"
  munged --force --key-file="$lab/munge/key" --socket="$lab/munge/socket" --pid-file="$lab/munge/pid" \
    --log-file="$lab/munge/log" --seed-file="$lab/munge/seed" || return 1
  {
    cat <<END
ClusterName=chaos
SlurmctldHost=hub(10.78.0.100)
SlurmUser=root
SlurmdUser=root
AuthInfo=socket=$lab/munge/socket
StateSaveLocation=$lab/state
SlurmdSpoolDir=$lab/spool/%n
SlurmctldPidFile=$lab/slurmctld.pid
SlurmdPidFile=$lab/slurmd.%n.pid
SlurmctldLogFile=$lab/slurmctld.log
SlurmdLogFile=$lab/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=1,bf_interval=2,sched_interval=2
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
ReturnToService=2
KillWait=5
MpiDefault=none
SlurmdParameters=config_overrides
END
    local number=1 name
    for name in "${nodes[@]}"; do
      echo "NodeName=$name NodeHostname=$name NodeAddr=10.78.0.$((number++)) CPUs=2 RealMemory=4000"
    done
    echo "PartitionName=main Nodes=ALL Default=YES PriorityTier=1 GraceTime=4 PreemptMode=REQUEUE"
    echo "PartitionName=urgent Nodes=ALL PriorityTier=10 PreemptMode=OFF"
  } >"$SLURM_CONF"
  on hub slurmctld -c
  local name
  for name in "${nodes[@]}"; do on "$name" slurmd -c -N "$name"; done
  for _ in {1..50}; do
    [ "$(on hub sinfo --noheader --format=%t --partition=main)" = idle ] && return
    sleep 0.2
  done
  return 1
}

clean_up() {
  on hub scancel --me 2>/dev/null
  local file name
  sleep 1
  for file in "$lab"/slurmctld.pid "$lab"/slurmd.*.pid "$lab"/munge/pid; do
    [ ! -s "$file" ] || kill "$(cat "$file")" 2>/dev/null
  done
  sleep 1
  for name in hub "${nodes[@]}"; do
    ip netns pids "ow-$name" 2>/dev/null | xargs -r kill -9 2>/dev/null
    ip netns del "ow-$name" 2>/dev/null
  done
  if ((failures == 0)); then rm -rf "$lab"; else echo "what is left: $lab" >&2; fi
}

# NAME TIME [NODES [ARGUMENTS...]]: launches the job, whose number goes to $job.
launch() {
  model=$lab/$1
  on hub "$orbweave" launch slurm "$lab/street/images" --gnss "$lab/street/gnss.csv" --output "$model" \
    --nodes "${3:-2}" --cpus 1 --time "$2" "${@:4}" >"$lab/$1.log" || return 1
  job=$(grep -o '[0-9]*$' "$lab/$1.log" | tail -n 1)
  began=$SECONDS
}

state_of_job() { on hub squeue --noheader --jobs="$job" --format=%T 2>/dev/null; }

# A node on which a worker of the launch runs.
node_of_worker() { on hub squeue --noheader --array --states=RUNNING --format='%j %N' | awk '/-worker-/ {print $2}' | shuf -n 1; }

preempt() {
  local node
  node=$(node_of_worker)
  [ -n "$node" ] && on hub sbatch --partition=urgent --nodelist="$node" --ntasks=2 --output=/dev/null --wrap='sleep 1' >/dev/null
}

# TITLE [NOTE]: waits until Slurm has forgotten the job.
end_launch() {
  local note=${2:-}
  while [ -n "$(state_of_job)" ] && ((SECONDS - began < 3600)); do sleep 1; done
  local same=yes
  same_model "$lab/alone" "$model" || { same=no; ((++failures)); }
  [ -n "$note" ] || note="$(($(grep -c 'DUE TO JOB REQUEUE' "$model/.orbweave/launch/coordinator.log") + 1)) allocations of the coordinator"
  printf '| %s | %d | %s | %s |\n' "$1" $((SECONDS - began)) "$same" "$note"
}

disturbed() {
  launch disturbed 60 || return 1
  local requeued=0 preempted=0
  while [ -n "$(state_of_job)" ] && ((requeued < requeues || preempted < preemptions)); do
    sleep 5
    ((preempted >= preemptions)) || ! preempt || ((++preempted))
    ((requeued * preemptions > preempted * requeues || requeued >= requeues)) && continue
    [ "$(state_of_job)" = RUNNING ] && on hub scontrol requeue "$job" && ((++requeued))
  done
  end_launch "coordinator requeued, workers preempted" "$requeued times, $preempted times"
}

# Slurm counts in whole minutes and warns a minute before the end.
short_allocations() {
  launch short "$minutes" 1 --dense || return 1
  while [ -n "$(state_of_job)" ] && ((SECONDS - began < 3600)); do sleep 1; done
  local all lost percent allocations
  read -r all lost < <(computed_twice "$model"/.orbweave/launch/worker-*.log)
  percent=$(awk "BEGIN { printf \"%.1f\", 100 * $lost / $all }")
  allocations=$(cat "$model"/.orbweave/launch/worker-*.log | grep -c '"event":"worker_started"')
  awk "BEGIN { exit !($percent > $most_repeated) }" && ((++failures)) && echo "more than $most_repeated % was computed twice" >&2
  ((allocations > 1)) || { ((++failures)); echo "the job was too short to need two allocations" >&2; }
  end_launch "allocations of $minutes minutes" \
    "$allocations allocations of the worker; $lost of $all s of slots computed twice: $percent %"
}

# EXPECTED ARGUMENTS...: launches and waits.
expect_code() {
  local code=0
  on hub "$orbweave" launch slurm "${@:2}" --nodes 1 --cpus 1 --time 60 --wait >>"$lab/codes.log" 2>&1 || code=$?
  [ $code -eq "$1" ] && codes+=" $code" && return
  ((++failures))
  codes+=" $code instead of $1"
}

exit_codes() {
  local codes="" few=$lab/few
  mkdir -p "$few"
  find "$lab/street/images" -type f | sort | head -n 8 | xargs cp -t "$few"
  began=$SECONDS
  expect_code 0 "$few" --gnss "$lab/street/gnss.csv" --output "$lab/well"
  # Eight positions that nobody took: the model contradicts them.
  awk -F, 'NR == 1 { print; next } { OFS = ","; $2 += (NR % 3) * 0.001; print }' "$lab/street/gnss.csv" >"$lab/wrong.csv"
  expect_code 4 "$few" --gnss "$lab/wrong.csv" --output "$lab/doubted" --fail-on doubtful
  expect_code 2 "$lab/nowhere" --output "$lab/failed"
  printf '| exit codes by sbatch --wait | %d | |%s |\n' $((SECONDS - began)) "$codes"
}

scaling() {
  began=$SECONDS
  local note=failed
  if on hub "$orbweave" bench scaling --engine slurm --nodes 1,2 --strong 60 --weak 30 --set partition.cluster_size=16 \
    --output "$lab/scaling" >"$lab/scaling.log" 2>&1; then
    note=$(jq -r '.study | "\(.points | length) jobs; \(.simulator)"' "$lab/scaling/scaling.json")
  else
    ((++failures))
    tail -n 3 "$lab/scaling.log" >&2
  fi
  printf '| bench scaling --engine slurm | %d | | %s |\n' $((SECONDS - began)) "$note"
}

count_workers() { on hub squeue --noheader --array --states=RUNNING --format=%j | grep -c -- -worker-; }

elastic() {
  launch elastic 60 1:3 || return 1
  local most=0 now
  while [ -n "$(state_of_job)" ] && ((SECONDS - began < 3600)); do
    now=$(count_workers)
    ((now <= most)) || most=$now
    sleep 1
  done
  ((most > 1)) || ((++failures))
  end_launch "one to three workers" "$most at a time at most"
}

trap clean_up EXIT
if ! network_up || ! slurm_up; then
  failures=1
  echo "Slurm does not come up" >&2
  exit 1
fi
"$orbweave" synth street --panoramas "$panoramas" --size 1024x512 --output "$lab/street" >/dev/null 2>&1 || exit 1
began=$SECONDS
echo "| $panoramas panoramas on 2 workers of a core | s | same bytes | |"
echo "|---|---|---|---|"
if [[ " ${rows[*]} " =~ \ (disturbed|short_allocations|elastic)\  ]]; then
  "$orbweave" run "$lab/street/images" --gnss "$lab/street/gnss.csv" --output "$lab/alone" --workers 2 >/dev/null 2>&1 || exit 1
  printf '| this machine, undisturbed | %d | | |\n' $((SECONDS - began))
fi
for row in "${rows[@]}"; do "$row" || failures=$((failures + 1)); done
exit $((failures > 0))
