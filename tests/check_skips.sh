#!/usr/bin/env bash
# Names the tests of a run that were skipped though tests/may_skip.txt does not let them; 1 if there are any.
#
#   tests/check_skips.sh JUNIT [LIST]
#
# JUNIT: what `ctest --output-junit` wrote. With ORBWEAVE_CI=yes lines "elsewhere ..." of the list count for nothing.
set -euo pipefail
junit=${1:?the file of ctest --output-junit}
list=${2:-$(dirname "${BASH_SOURCE[0]}")/may_skip.txt}

may_skip() {
  local first second
  while read -r first second _; do
    case $first in
      '' | '#'*) continue ;;
      elsewhere) [ "${ORBWEAVE_CI:-no}" = yes ] && continue || first=$second ;;
    esac
    # shellcheck disable=SC2053 # the list has patterns
    [[ $1 != $first ]] || return 0
  done <"$list"
  return 1
}

[ -s "$junit" ] || { echo "$junit is empty or missing: what was skipped is not known" >&2; exit 1; }
unlisted=0
while IFS= read -r name; do
  may_skip "$name" && continue
  echo "skipped, and not in $list: $name" >&2
  unlisted=1
done < <(sed -n 's/.*<testcase name="\([^"]*\)".*status="notrun".*/\1/p' "$junit")
exit $unlisted
