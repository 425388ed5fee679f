#!/usr/bin/env bash
# A fleet with its blobs in a real S3 server: Ceph's RADOS gateway, with one monitor and one object store in memory, all
# on the loopback of this machine.
#
#   tests/chaos/rgw.sh [PANORAMAS [REPEATS]]
#
# `orbweave store check`, then the same job by a coordinator and two workers that share its folder and by ones that have
# only the store, whose workers have no keys to it, in turns; once with all blobs in parts; at last with the images in the
# store too (`submit s3://`).
# Prints a table in Markdown; 1 if a row failed: other bytes, images copied, more than 3 objects a panorama, or more than
# 1.15 times the time of the folder (medians). Needs Debian's radosgw,
# ceph-mon, ceph-osd and curl: 77 without them. ORBWEAVE: the program (build/release/cli/orbweave). Takes two minutes.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
orbweave=$(realpath "${ORBWEAVE:-$here/../../build/release/cli/orbweave}")
panoramas=${1:-16}
repeats=${2:-3}
# shellcheck disable=SC2317 # functions that a trap calls
# shellcheck source=/dev/null
source "$here/judge.sh"

for tool in radosgw radosgw-admin ceph ceph-authtool ceph-mon ceph-osd monmaptool curl; do
  command -v "$tool" >/dev/null || { echo "$tool is missing" >&2; exit 77; }
done

lab=$(mktemp -d /tmp/orbweave_rgw.XXXX)
export CEPH_CONF=$lab/ceph.conf
daemons=()
fleet=()
access_key=ORBWEAVE
secret_key=$(head -c 20 /dev/urandom | od -An -tx1 | tr -d ' \n')

# Ports that nobody listens on now.
free_port() {
  local port
  while :; do
    port=$((20000 + RANDOM))
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo "$port"; return; }
  done
}
mon_port=$(free_port)
s3_port=$(free_port)
endpoint=http://127.0.0.1:$s3_port

# NAME COMMAND...: in the background, until the end.
daemon() {
  local name=$1
  shift
  "$@" >"$lab/$name.out" 2>&1 &
  daemons+=($!)
}

ceph_up() {
  mkdir -p "$lab"/{mon,osd,run,rgw}
  local id key
  id=$(cat /proc/sys/kernel/random/uuid)
  cat >"$CEPH_CONF" <<END
[global]
fsid = $id
mon host = [v2:127.0.0.1:$mon_port]
public addr = 127.0.0.1
auth cluster required = cephx
auth service required = cephx
auth client required = cephx
keyring = $lab/keyring
run dir = $lab/run
log file = $lab/\$name.log
admin socket = $lab/run/\$name.asok
osd pool default size = 1
osd pool default min size = 1
osd pool default pg num = 4
osd pool default pgp num = 4
osd pool default pg autoscale mode = off
osd crush chooseleaf type = 0
mon allow pool size one = true
mon data avail warn = 1
mon data avail crit = 1
[mon.a]
mon data = $lab/mon
mon initial members = a
[osd.0]
osd data = $lab/osd
osd objectstore = memstore
memstore device bytes = 2147483648
osd class load list = *
osd class default list = *
[client.rgw.a]
rgw data = $lab/rgw
rgw frontends = beast endpoint=127.0.0.1:$s3_port
END
  ceph-authtool -C "$lab/keyring" --gen-key -n mon. --cap mon 'allow *' &&
    ceph-authtool "$lab/keyring" --gen-key -n client.admin --cap mon 'allow *' --cap osd 'allow *' &&
    ceph-authtool "$lab/keyring" --gen-key -n osd.0 --cap mon 'allow profile osd' --cap osd 'allow *' &&
    ceph-authtool "$lab/keyring" --gen-key -n client.rgw.a --cap mon 'allow rwx' --cap osd 'allow rwx' &&
    monmaptool --create --fsid "$id" --addv a "[v2:127.0.0.1:$mon_port]" "$lab/monmap" &&
    ceph-mon --mkfs -i a --monmap "$lab/monmap" --keyring "$lab/keyring" || return 1
  daemon mon ceph-mon -i a -f
  key=$(cat /proc/sys/kernel/random/uuid)
  timeout 30 ceph osd new "$key" && ceph-osd -i 0 --mkfs --osd-uuid "$key" || return 1
  daemon osd ceph-osd -i 0 -f
  daemon rgw radosgw -n client.rgw.a -f
  for _ in {1..120}; do
    curl -s -m 2 "$endpoint" >/dev/null && break
    sleep 0.5
  done
  timeout 60 radosgw-admin -n client.rgw.a user create --uid=orbweave --display-name=orbweave \
    --access-key="$access_key" --secret-key="$secret_key" || return 1
  curl -sf -m 30 -X PUT --aws-sigv4 aws:amz:us-east-1:s3 -K - "$endpoint/blobs" \
    -H 'x-amz-content-sha256: e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855' \
    <<<"user = \"$access_key:$secret_key\""
}

clean_up() {
  local pid
  for pid in "${fleet[@]}" "${daemons[@]}"; do kill "$pid" 2>/dev/null; done
  wait
  if ((failures == 0)); then rm -rf "$lab"; else echo "what is left: $lab" >&2; fi
}

objects_of_store() {
  radosgw-admin -n client.rgw.a bucket stats --bucket=blobs 2>/dev/null |
    awk -F'[:,]' '/"num_objects"/ {sum += $2} END {print sum + 0}'
}

# NAME WORKER_OPTION... -- SERVE_OPTION...: one job by two workers; its seconds go to $seconds.
fleet_does_the_job() {
  local name=$1 folder=$lab/$1 worker=() began
  shift
  while [ "$1" != -- ]; do
    worker+=("$1")
    shift
  done
  shift
  mkdir "$folder"
  "$orbweave" serve --listen "unix:$folder/socket" --state "$folder/state" "$@" 2>"$folder/serve.log" &
  fleet=($!)
  for _ in {1..100}; do
    grep -qs coordinator_ready "$folder/serve.log" && break
    sleep 0.1
  done
  local number
  for number in 1 2; do
    "$orbweave" work --join "unix:$folder/socket" --name "w$number" "${worker[@]}" 2>"$folder/w$number.log" &
    fleet+=($!)
  done
  began=$(date +%s.%N)
  "$orbweave" submit --coordinator "unix:$folder/socket" --patience 20 "${images[@]}" --gnss "$lab/street/gnss.csv" \
    --output "$folder/model" >"$folder/submit.log" 2>&1 || echo "$name: $(tail -n 1 "$folder/submit.log")" >&2
  seconds=$(echo "$(date +%s.%N) - $began" | bc)
  kill -INT "${fleet[0]}"
  wait "${fleet[@]}"
  fleet=()
}

median() { printf '%s\n' "$@" | sort -n | sed -n "$((($# + 1) / 2))p"; }

trap clean_up EXIT
if ! ceph_up >"$lab/up.log" 2>&1; then
  failures=1
  echo "Ceph does not come up" >&2
  exit 1
fi
umask 077
printf 'aws_access_key_id = %s\naws_secret_access_key = %s\n' "$access_key" "$secret_key" >"$lab/store.keys"
unset AWS_ACCESS_KEY_ID AWS_SECRET_ACCESS_KEY AWS_SESSION_TOKEN
echo "$(radosgw --version)"
echo
"$orbweave" store check "s3://blobs/check?endpoint=$endpoint" --store-keys "$lab/store.keys" || failures=1
"$orbweave" synth street --panoramas "$panoramas" --size 1024x512 --output "$lab/street" >/dev/null 2>&1 || exit 1

# The images of the street as objects below city/images.
upload_images() {
  local file
  for file in "$lab"/street/images/*; do
    curl -sf -m 30 -T "$file" --aws-sigv4 aws:amz:us-east-1:s3 -K - "$endpoint/blobs/city/images/$(basename "$file")" \
      -H "x-amz-content-sha256: $(sha256sum "$file" | cut -d ' ' -f 1)" <<<"user = \"$access_key:$secret_key\"" || return 1
  done
}

# STATE: the number of images that its folder has copies of.
copies_of_images() {
  local file digest copies=0
  for file in "$lab"/street/images/*; do
    digest=$(sha256sum "$file" | cut -d ' ' -f 1)
    [ -e "$1/blobs/${digest:0:2}/$digest" ] && ((++copies))
  done
  echo "$copies"
}

images=("$lab/street/images")
folder_s=()
store_s=()
for ((turn = 1; turn <= repeats; ++turn)); do
  fleet_does_the_job "folder$turn" --blobs "$lab/folder$turn/state/blobs" --
  folder_s+=("$seconds")
  before=$(objects_of_store)
  fleet_does_the_job "store$turn" -- --store "s3://blobs/store$turn?endpoint=$endpoint" --store-keys "$lab/store.keys"
  store_s+=("$seconds")
  objects=$(($(objects_of_store) - before - 1)) # one says whose the store is
  same_model "$lab/folder1/model" "$lab/store$turn/model" || { echo "turn $turn: other bytes" >&2; failures=1; }
done
# Every blob that goes to the store goes in parts.
fleet_does_the_job parts -- --store "s3://blobs/parts?endpoint=$endpoint" --store-keys "$lab/store.keys" --store-put-limit 64KiB --store-part 5MiB
parts_s=$seconds
same_model "$lab/folder1/model" "$lab/parts/model" || { echo "blobs in parts: other bytes" >&2; failures=1; }
upload_images || { echo "the images cannot be put into the store" >&2; failures=1; }
images=("s3://blobs/city/images?endpoint=$endpoint" --store-keys "$lab/store.keys")
fleet_does_the_job images -- --root "city=s3://blobs/city?endpoint=$endpoint" --store-keys "$lab/store.keys"
images_s=$seconds
copies=$(copies_of_images "$lab/images/state")
same_model "$lab/folder1/model" "$lab/images/model" || { echo "images of the store: other bytes" >&2; failures=1; }
((copies == 0)) || failures=1
ratio=$(echo "scale=3; $(median "${store_s[@]}") / $(median "${folder_s[@]}")" | bc)
per_panorama=$(echo "scale=2; $objects / $panoramas" | bc)
echo
echo "| $panoramas panoramas, 2 workers, $repeats turns | s | objects a panorama |"
echo "|---|---|---|"
echo "| shared folder | $(median "${folder_s[@]}") (${folder_s[*]}) | |"
echo "| object store | $(median "${store_s[@]}") (${store_s[*]}) | $per_panorama |"
echo "| ratio | $ratio | |"
echo "| object store, all blobs in parts | $parts_s | |"
echo "| images in the store | $images_s | $copies copied |"
(($(echo "$ratio <= 1.15 && $per_panorama <= 3 && $objects >= $panoramas" | bc))) || failures=1
exit $((failures > 0))
