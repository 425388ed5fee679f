#!/usr/bin/env bash
# Builds the image of orbweave: Debian 12, libraries of deploy/packages_image.txt, the program; user 10001.
#   deploy/image.sh [--base IMAGE@sha256:DIGEST] [--program FILE] [--name NAME]
#
# --base     an image of Debian 12 by its digest; without it mmdebstrap makes one from the machine's Debian mirror
# --program  takes this orbweave instead of building one within; it is to be of Debian 12
# --name     of the image (localhost/orbweave); its tag is the version of the program
#
# Times in the image are SOURCE_DATE_EPOCH (by default that of the last commit): the same sources, packages and base give
# the same digest, which is printed. Needs buildah, and mmdebstrap where there is no --base; root, or whoever may make
# user namespaces. STORAGE_DRIVER, BUILDAH_ISOLATION and CONTAINERS_STORAGE_CONF are those of buildah.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
base='' program='' name=localhost/orbweave
while [ $# -gt 0 ]; do
  case $1 in
    --base) base=$2 ;;
    --program) program=$(realpath "$2") ;;
    --name) name=$2 ;;
    *) sed -n '2,/^set/p' "$0" | sed '$d; s/^# \{0,1\}//' >&2 && exit 2 ;;
  esac
  shift 2
done
if [ -n "$base" ] && [[ $base != *@sha256:* ]]; then
  echo "the base is named by its digest: IMAGE@sha256:DIGEST" >&2
  exit 2
fi
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct)}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
if [ -z "$base" ]; then
  echo "Making a base by mmdebstrap ..." >&2
  base=localhost/orbweave-base
  mmdebstrap --quiet --variant=minbase --include=ca-certificates bookworm "$scratch/base.tar"
  printf 'FROM scratch\nADD base.tar /\nCMD ["/bin/sh"]\n' >"$scratch/Containerfile"
  buildah bud --quiet --timestamp "$SOURCE_DATE_EPOCH" --tag "$base" --file "$scratch/Containerfile" "$scratch" >/dev/null
  rm "$scratch/base.tar"
fi

context=$scratch/context
mkdir "$context"
if [ -n "$program" ]; then
  mkdir -p "$context/program" "$context/deploy"
  strip --strip-unneeded -o "$context/program/orbweave" "$program"
  cp "$root/deploy/packages_image.txt" "$root/deploy/image_libraries.sh" "$context/deploy/"
else
  git -C "$root" ls-files -z --cached --others --exclude-standard |
    tar -C "$root" --null --ignore-failed-read -cf - --files-from=- | tar -C "$context" -xf -
fi
echo "Building the image ..." >&2
buildah bud --quiet --timestamp "$SOURCE_DATE_EPOCH" --build-arg BASE="$base" --file "$root/deploy/Containerfile" \
  --iidfile "$scratch/id" --tag "$name:latest" "$context" >/dev/null
container=$(buildah from "$(cat "$scratch/id")")
trap 'buildah rm "$container" >/dev/null; rm -rf "$scratch"' EXIT
version=$(buildah run "$container" -- /usr/bin/orbweave --version)
version=${version#orbweave }
buildah tag "$name:latest" "$name:${version//+/-}"
echo "$name:${version//+/-} $(cat "$scratch/id")"
