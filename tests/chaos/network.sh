# shellcheck shell=bash disable=SC2154,SC2034 # variables are shared with run.sh
# The machines of a fleet. As root, where network namespaces are allowed, the coordinator and each worker have one of
# their own behind a bridge, and certificates; otherwise all share a unix socket, and no wire can be disturbed.
#
# Expects $orbweave, $work and $workers.

net() { echo "orbweave$$_$1"; }
wire_of() { echo "wire$1"; } # the bridge's end of the wire to a worker

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
  for i in hub "${workers[@]}"; do ip netns delete "$(net "$i")" 2>/dev/null; done
}

cut_wire() { ip -n "$(net hub)" link set "$(wire_of "$1")" down; }
mend_wire() { ip -n "$(net hub)" link set "$(wire_of "$1")" up; }

# MACHINE RULE...: drops the packets that come to it and match; all of them without a rule.
drop_incoming() {
  ip netns exec "$(net "$1")" nft -f - <<RULES
table inet chaos {
  chain incoming {
    type filter hook input priority 0;
    iif lo accept
    ${*:2} counter drop
  }
}
RULES
}

# How many packets were dropped.
dropped() { ip netns exec "$(net "$1")" nft list table inet chaos | grep -o 'packets [0-9]*' | cut -d' ' -f2; }

drop_nothing() { ip netns exec "$(net "$1")" nft delete table inet chaos; }

# DELAY_MS: from now on, workers reach the coordinator through a relay on its machine, which holds all that goes
# either way back for so long. Kernels need no netem for it.
start_relay() {
  relayed_address=10.77.0.1:7001
  (exec ip netns exec "$(net hub)" "$relay" "$relayed_address" "$address" "$1" >"$work/relayed") &
  pid_of[relay]=$!
  disown "${pid_of[relay]}"
}

# How many pieces were held back is then in $relayed.
stop_relay() {
  end_by TERM relay
  relayed_address=
  relayed=$(<"$work/relayed")
}
