# A fleet of real processes for tests/chaos/run.sh: one coordinator, three workers, one client.
#
# As root, where network namespaces are allowed, each is a machine of its own behind a bridge, with certificates;
# otherwise they share a unix socket. Expects $orbweave, $work (an empty folder) and $lease_s.

workers=(1 2 3)
declare -A pid_of  # "coordinator", "submit" or a worker's number -> process

net() { echo "orbweave$$_$1"; }
wire_of() { echo "wire$1"; }  # the bridge's end of the wire to a worker

# One namespace for the coordinator and the bridge, one for each worker.
make_network() {
  local hub i
  hub=$(net hub)
  namespaces=no
  address=unix:$work/socket
  ip netns add "$hub" 2>/dev/null && ip -n "$hub" link add bridge type bridge 2>/dev/null || return 0
  namespaces=yes
  address=10.77.0.1:7000
  ip -n "$hub" address add 10.77.0.1/24 dev bridge
  ip -n "$hub" link set lo up
  ip -n "$hub" link set bridge up
  for i in "${workers[@]}"; do
    ip netns add "$(net "$i")"
    ip -n "$hub" link add "$(wire_of "$i")" type veth peer name eth0 netns "$(net "$i")"
    ip -n "$hub" link set "$(wire_of "$i")" master bridge up
    ip -n "$(net "$i")" address add "10.77.0.1$i/24" dev eth0
    ip -n "$(net "$i")" link set lo up
    ip -n "$(net "$i")" link set eth0 up
  done
  "$orbweave" keys init "$work/keys" --fleet chaos --host 10.77.0.1 >/dev/null
  for i in "${workers[@]}"; do "$orbweave" keys add "$work/keys" worker "worker$i" >/dev/null; done
}

remove_network() {
  local i
  for i in hub "${workers[@]}"; do ip netns delete "$(net "$i")" 2>/dev/null || true; done
}

# PLACE KEYS ARGUMENTS...: becomes orbweave there, under that certificate.
become() {
  if [ "$namespaces" = yes ]; then
    exec ip netns exec "$(net "$1")" "$orbweave" "${@:3}" --tls "$work/keys/$2"
  fi
  exec "$orbweave" "${@:3}"
}

is_running() { [ -n "${pid_of[$1]:-}" ] && kill -0 "${pid_of[$1]}" 2>/dev/null; }

# NAME LIMIT_S CONDITION...: waits until the condition holds; says what did not come and fails after the limit.
wait_until() {
  local end=$((SECONDS + $2))
  until "${@:3}"; do
    if ((SECONDS > end)); then
      echo "waited in vain for $1; logs: $fleet" >&2
      return 1
    fi
    sleep 0.05
  done
}

is_gone() { ! is_running "$1"; }

# SIGNAL NAME: sends it and waits for the end.
end_by() {
  is_running "$2" || return 0
  disown "${pid_of[$2]}" 2>/dev/null  # whose end the shell need not announce
  kill "-$1" "${pid_of[$2]}"
  wait_until "the end of $2" 60 is_gone "$2"
}

start_coordinator() {
  local log
  log=$fleet/coordinator.$((++starts)).log
  (become hub coordinator serve --listen "$address" --state "$state" --lease "$lease_s" >"$log" 2>&1) &
  pid_of[coordinator]=$!
  wait_until "the coordinator" 30 grep -qs "coordinator_ready" "$log"
}

start_worker() {
  local name=worker$1
  [ "$namespaces" = no ] || name=$name/slot
  (become "$1" "worker$1" work --join "$address" --name "$name" >>"$fleet/worker$1.log" 2>&1) &
  pid_of[$1]=$!
}

start_workers() {
  local i
  for i in "${workers[@]}"; do start_worker "$i"; done
}

# A fleet in a folder of its own. Its state is empty, unless $state is given.
start_fleet() {
  fleet=$(mktemp -d "$work/fleet.XXXX")
  state=${1:-$fleet/state}
  starts=0
  start_coordinator
  start_workers
}

stop_fleet() {
  local i
  for i in submit "${workers[@]}" coordinator; do end_by KILL "$i"; done
}

# OUTPUT [--set KEY=VALUE]...: has the street reconstructed: two clusters, adjusted in blocks.
start_submit() {
  (become hub client submit --coordinator "$address" "$work/street/images" --gnss "$work/street/gnss.csv" \
    --output "$1" --set partition.cluster_size=6 --set blocks.distribute_from=2 --set features.max_features=1500 \
    "${@:2}" >"$fleet/submit.log" 2>&1) &
  pid_of[submit]=$!
}

# Whether the job came to a good end.
finish_submit() { wait_until "the job" 300 is_gone submit && wait "${pid_of[submit]}"; }
