#!/usr/bin/env bash
# Runs clang-tidy (.clang-tidy) over the lines changed since a commit:  tests/tidy.sh [COMMIT]
# COMMIT is what this branch left of origin/main by default, on main itself the commit before. Any remark fails, and
# so does a file that does not compile by itself: the build it asks has no precompiled headers.
# A file takes about ten seconds. Of more than ORBWEAVE_TIDY_FILES (120) those that changed most are read, the others named.
# Needs clang-tidy 14 (deploy/install_packages.sh deploy/packages_gates.txt).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
tidy_diff=$(command -v clang-tidy-diff-14.py || command -v clang-tidy-diff) ||
  { echo "clang-tidy is missing: deploy/install_packages.sh deploy/packages_gates.txt" >&2; exit 1; }

head=$(git rev-parse HEAD)
base=${1:-$(git merge-base origin/main HEAD 2>/dev/null || true)}
if [ -z "$base" ] || [ "$(git rev-parse "$base^{commit}")" = "$head" ]; then
  base=$(git rev-parse --verify --quiet HEAD~1) || { echo "No commit before this one: nothing is compared"; exit 0; }
fi

mapfile -t files < <(git diff --name-only --diff-filter=d "$base" -- '*.h' '*.cc')
if [ ${#files[@]} -eq 0 ]; then
  echo "No C++ file has changed since ${base:0:10}"
  exit 0
fi
limit=${ORBWEAVE_TIDY_FILES:-120}
if [ ${#files[@]} -gt "$limit" ]; then
  mapfile -t files < <(git diff --numstat --no-renames --diff-filter=d "$base" -- '*.h' '*.cc' | sort -k1,1nr -k3 | cut -f3)
  echo "Not read by clang-tidy, as more than $limit files have changed:" "${files[@]:$limit}"
  files=("${files[@]:0:$limit}")
fi
mkdir -p build/tidy
log=build/tidy/tidy.log
if ! { cmake --preset tidy && cmake --build --preset tidy; } >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  exit 1
fi
git diff -U0 --diff-filter=d "$base" -- "${files[@]}" |
  "$tidy_diff" -p1 -j "$(nproc)" -path build/tidy -quiet -extra-arg=-Wno-unknown-warning-option >"$log" 2>&1 ||
  { tail -n 40 "$log" >&2; exit 1; }
if grep -qE '(: |^)(warning|error|fatal error):' "$log"; then
  grep -vE '^[0-9]+ warnings? (generated|treated)|^$' "$log" >&2
  echo "clang-tidy has remarks on lines changed since ${base:0:10}; the log is $log" >&2
  exit 1
fi
echo "${#files[@]} changed files have no remarks of clang-tidy on what changed since ${base:0:10}"
