#!/usr/bin/env bash
# Copies what the program needs of this machine's libraries, and a bare image of Debian has not, into a folder.
#   deploy/image_libraries.sh PROGRAM BEFORE FOLDER
#
# PROGRAM  what is linked to libraries; libcurl, which it loads where blobs are in a store, is taken too
# BEFORE   a list of the files that the image has (find / -xdev), made before packages were installed
# FOLDER   gets usr/lib/..., authorities of certificates, and of every package that a file is from its licence and its entry of
#          dpkg (var/lib/dpkg/status.d, where programs that look for known faults of libraries read it)
set -euo pipefail
program=$1 before=$2 folder=$3
libraries=/usr/lib/x86_64-linux-gnu

needed() { ldd "$program" "$libraries/libcurl.so.4" | awk '$2 == "=>" && $3 ~ /^\// { print $3 }' | sort -u; }

# Packages name files by the paths they installed: /lib is /usr/lib, and alternatives are links.
package_of() {
  local file
  for file in "$1" "$(realpath "$1")" "/usr$1"; do
    dpkg-query --search "$file" 2>/dev/null | sed 's/:.*//' && return
  done
}

copy() { install -D --mode=0644 "$1" "$folder$2"; }

mkdir -p "$folder/var/lib/dpkg/status.d"
for library in $(needed) "$libraries/libcurl.so.4"; do
  target=$libraries/$(basename "$library")
  if grep -qxF "$(realpath "$library")" "$before"; then continue; fi
  copy "$library" "$target"
  package_of "$library"
done | sort -u >"$folder/packages"
while read -r package; do
  dpkg-query --status "$package" >"$folder/var/lib/dpkg/status.d/$package"
  copy "/usr/share/doc/$package/copyright" "/usr/share/doc/$package/copyright"
done <"$folder/packages"
rm "$folder/packages"
mkdir -p "$folder/etc/ssl" "$folder/usr/share"
cp -a /etc/ssl/certs "$folder/etc/ssl/"
cp -a /usr/share/ca-certificates "$folder/usr/share/"
