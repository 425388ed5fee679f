#!/usr/bin/env bash
# Holds the rules of deploy/prometheus against their tests, and every expression of the dashboard against Prometheus'
# own parser. 77 where promtool (Debian's package prometheus) or jq is missing.
#   tests/deploy/rules.sh
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
for tool in promtool jq; do
  command -v "$tool" >/dev/null || { echo "$tool is missing" >&2; exit 77; }
done

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
promtool check rules --lint-fatal "$root/deploy/prometheus/alerts.yaml"
promtool test rules "$root/deploy/prometheus/alerts_test.yaml"

# Each alert is tried both ways: on series that it is for, and on others.
tests=$root/deploy/prometheus/alerts_test.yaml
while read -r alert; do
  grep -q "alertname: $alert$" "$tests" || { echo "$alert is never expected" >&2; exit 1; }
  grep -q "alertname: $alert, exp_alerts: \[\]" "$tests" || { echo "$alert is never expected to be silent" >&2; exit 1; }
done < <(sed -n 's/^ *- alert: //p' "$root/deploy/prometheus/alerts.yaml")

{
  echo 'groups: [{name: panels, rules: ['
  jq -c '.panels[].targets[] | .expr | gsub("\\$instance"; ".*") | {record: "panel", expr: .}' \
    "$root/deploy/grafana/orbweave.json" | nl -ba -w1 -s' ' |
    sed -E 's/^([0-9]+) \{"record":"panel"/{"record":"panel_\1"/; s/$/,/'
  echo ']}]'
} >"$scratch/panels.yaml"
promtool check rules "$scratch/panels.yaml"
