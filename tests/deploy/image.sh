#!/usr/bin/env bash
# Tries deploy/image.sh and the pods of deploy/kubernetes with podman, on this machine.
#
#   tests/deploy/image.sh [--once]
#
# Builds the image twice, from bases made anew, which are to have one digest (--once: not the second time). Then plays the
# base of deploy/kubernetes (for_podman.py says what of it), waits for /readyz, has a client in a container reconstruct 16
# panoramas, and holds the model against that of `orbweave run` here, byte for byte. Prints what it saw; 1 if something
# differs. Needs root, buildah, podman, runc or crun, catatonit and mmdebstrap: 77 without them. Takes ten minutes.
# ORBWEAVE: the program (build/release/cli/orbweave), which goes into the image as it is. Ports 7000 and 9464 are to be free.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
orbweave=$(realpath "${ORBWEAVE:-$here/../../build/release/cli/orbweave}")
for tool in buildah podman catatonit mmdebstrap curl; do
  command -v "$tool" >/dev/null || { echo "$tool is missing" >&2; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "only root owns files of user 10001" >&2; exit 77; }

lab=$(mktemp -d /var/tmp/orbweave_image.XXXX)
printf '[storage]\ndriver = "vfs"\ngraphroot = "%s/root"\nrunroot = "%s/run"\n' "$lab" "$lab" >"$lab/storage.conf"
# Who may not raise limits keeps those that there are. crun 1.8 does not run where both versions of cgroups are mounted.
printf '[containers]\ndefault_ulimits = ["nofile=%s:%s","nproc=5000:5000"]\n' "$(ulimit -n)" "$(ulimit -n)" >"$lab/containers.conf"
command -v runc >/dev/null && printf '[engine]\nruntime = "runc"\n' >>"$lab/containers.conf"
export CONTAINERS_STORAGE_CONF=$lab/storage.conf CONTAINERS_CONF=$lab/containers.conf STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot
leave() {
  podman pod rm --all --force >/dev/null 2>&1
  podman rm --all --force >/dev/null 2>&1
  podman volume rm --all --force >/dev/null 2>&1
  rm -rf "$lab"
}
trap leave EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

image=localhost/orbweave
build() { "$here/../../deploy/image.sh" --program "$orbweave" --name "$image" | tail -1; }
first=$(build) || fail "the image was not built"
echo "built $first, $(podman image inspect --format '{{.Size}}' "$image:latest" | numfmt --to=si)"
if [ "${1:-}" != --once ]; then
  second=$(build) || fail "the image was not built again"
  [ "$first" = "$second" ] || fail "two builds differ: $first, then $second"
  echo "built again: the same"
fi

cd "$lab" || exit 1
"$orbweave" synth street --panoramas 16 --size 512x256 --output street >/dev/null 2>&1 || fail "no street"
"$orbweave" run street/images --gnss street/gnss.csv --output expected --workers 2 >/dev/null 2>&1 || fail "no model here"
"$orbweave" keys init keys --fleet city --host localhost >/dev/null &&
  "$orbweave" keys add keys worker workers >/dev/null || fail "no keys"
mkdir out && chown -R 10001:10001 keys out
chmod 755 "$lab" street street/images

"$here/for_podman.py" "$image:latest" keys >pods.yaml || fail "no pods"
podman kube play pods.yaml >played 2>&1 || { cat played >&2; fail "podman does not play the pods"; }
for _ in $(seq 120); do
  ready=$(curl -s http://127.0.0.1:9464/readyz) && [ "$ready" = ok ] && break
  sleep 1
done
[ "${ready:-}" = ok ] || { podman logs orbweave-coordinator-coordinator >&2; fail "the coordinator is not ready"; }
echo "the coordinator is ready"
coordinator=$(podman inspect --format '{{.Config.User}} read-only={{.HostConfig.ReadonlyRootfs}} caps={{.EffectiveCaps}}' orbweave-coordinator-coordinator)
echo "it runs as $coordinator"
[[ $coordinator == 10001*"read-only=true caps=[]" ]] || fail "that is too much"

client() {
  timeout 300 podman run --rm --network host --read-only --cap-drop all --tmpfs /tmp \
    -v "$lab/street:/street:ro" -v "$lab/keys/client:/keys:ro" -v "$lab/out:/out" "$image:latest" "$@"
}
client \
  submit --coordinator localhost:7000 --tls /keys /street/images --gnss /street/gnss.csv --output /out/model \
  >client.log 2>&1 || { tail -5 client.log >&2; fail "the client"; }
grep -E '^  registered' client.log
client status --coordinator localhost:7000 --tls /keys --json | grep -o '"name":"workers/[^"]*"' || fail "no worker of the certificate's name"
for file in cameras.bin images.bin points3D.bin; do
  cmp "expected/sparse/0/$file" "out/model/sparse/0/$file" || fail "$file is not that of orbweave run"
done
echo "its model is that of orbweave run on this machine, byte for byte"
