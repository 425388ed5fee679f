#!/usr/bin/env bash
# Says which C++ files are not as .clang-format has them:  tests/format.sh [--fix]
# With --fix brings them there. Needs clang-format 14 (deploy/install_packages.sh deploy/packages_gates.txt).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
clang_format=$(command -v clang-format-14 || command -v clang-format) ||
  { echo "clang-format is missing: deploy/install_packages.sh deploy/packages_gates.txt" >&2; exit 1; }

mapfile -t files < <(git ls-files --cached --others --exclude-standard -- '*.h' '*.cc' | sort -u |
  while read -r file; do if [ -f "$file" ]; then echo "$file"; fi; done)
if [ "${1:-}" = --fix ]; then
  exec "$clang_format" -i "${files[@]}"
fi
if ! found=$("$clang_format" --dry-run --Werror "${files[@]}" 2>&1); then
  grep -E ': (warning|error):' <<<"$found" | cut -d: -f1 | sort | uniq -c >&2 || echo "$found" >&2
  echo "These files are not as .clang-format has them: tests/format.sh --fix" >&2
  exit 1
fi
echo "${#files[@]} files are formatted"
