#!/usr/bin/env bash
# Instructions of an element and step over the points of its quadrature rule, by callgrind: docs/figures/quadrature_cost.csv. Two runs of
# each, one with twice the steps: what starting costs falls out. For points, the tolerances at which elements that turn by four fifths of a radian get them.
set -euo pipefail
cd "$(dirname "$0")/.."

cargo build --quiet --locked --profile demo --example quadrature
program="${CARGO_TARGET_DIR:-target}/demo/examples/quadrature"
counts=$(mktemp)
trap 'rm -f "$counts"' EXIT

# Prints "points iterations element-steps instructions".
count() {
  local said
  said=$(valgrind --quiet --tool=callgrind --callgrind-out-file="$counts" "$program" cost "$1" "$2")
  echo "$said $(awk '/^(totals|summary):/ { print $2; exit }' "$counts")"
}

{
  echo "tolerance,points,iterations,instructions"
  for tolerance in 1e-2 1e-4 1e-6 1e-9 1e-12; do
    read -r _ _ few fewer_instructions <<<"$(count "$tolerance" 60)"
    read -r points iterations many instructions <<<"$(count "$tolerance" 120)"
    awk -v t="$tolerance" -v p="$points" -v i="$iterations" -v a="$fewer_instructions" -v b="$instructions" -v n="$few" -v m="$many" \
      'BEGIN { printf "%s,%d,%s,%.0f\n", t, p, i, (b - a) / (m - n) }'
  done
} | tee docs/figures/quadrature_cost.csv
