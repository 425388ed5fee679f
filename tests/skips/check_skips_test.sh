#!/usr/bin/env bash
# tests/check_skips.sh on what ctest writes of three small tests, two of them skipped; and its list, which names tests
# of the build in the folder BUILD.
#
#   tests/skips/check_skips_test.sh BUILD
set -euo pipefail
check=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)/check_skips.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.21)
project(skips NONE)
enable_testing()
add_test(NAME some/Suite.ByItsCode COMMAND sh -c "exit 77")
set_tests_properties(some/Suite.ByItsCode PROPERTIES SKIP_RETURN_CODE 77)
add_test(NAME some/Suite.ByItsWords COMMAND sh -c "echo '[  SKIPPED ] here'")
set_tests_properties(some/Suite.ByItsWords PROPERTIES SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\]")
add_test(NAME some/Suite.Runs COMMAND true)
END
cmake -S "$work" -B "$work/build" >/dev/null
ctest --test-dir "$work/build" --output-junit "$work/ran.xml" >/dev/null

# LIST-LINE... EXPECTED: the exit code with that list, and the names it printed.
expect() {
  printf '%s\n' "${@:1:$#-2}" >"$work/list"
  local code=0 named
  named=$("$check" "$work/ran.xml" "$work/list" 2>&1 | grep -o 'Suite\.[A-Za-z]*' | tr '\n' ' ') || true
  "$check" "$work/ran.xml" "$work/list" 2>/dev/null || code=$?
  if [ $code -ne "${@: -2:1}" ] || [ "$named" != "${@: -1}" ]; then
    echo "with the list '${*:1:$#-2}': $code, $named" >&2
    exit 1
  fi
}

unset ORBWEAVE_CI
expect '# nothing' 1 'Suite.ByItsCode Suite.ByItsWords '
expect 'some/Suite.ByItsCode why' 1 'Suite.ByItsWords '
expect 'some/* why' 0 ''
expect 'some/Suite.ByItsCode why' 'elsewhere some/Suite.ByItsWords why' 0 ''
export ORBWEAVE_CI=yes
expect 'some/Suite.ByItsCode why' 'elsewhere some/Suite.ByItsWords why' 1 'Suite.ByItsWords '
if "$check" "$work/nothing.xml" 2>/dev/null; then
  echo "a run that left nothing passes" >&2
  exit 1
fi

# Whoever is on the list exists, under that name.
tests=$(dirname "$check")
names=$(ctest --test-dir "$1" -N | sed -n 's/^ *Test *#[0-9]*: //p')
if grep -q _NOT_BUILT <<<"$names"; then
  echo "the build in $1 is not finished: what the list names is not looked at" >&2
  exit 0
fi
while read -r first second _; do
  case $first in
    '' | '#'*) continue ;;
    elsewhere) name=$second ;;
    *) name=$first ;;
  esac
  # shellcheck disable=SC2053 # the list has patterns
  while read -r test; do [[ $test != $name ]] || continue 2; done <<<"$names"
  echo "there is no test $name, which the list names" >&2
  exit 1
done <"$tests/may_skip.txt"
