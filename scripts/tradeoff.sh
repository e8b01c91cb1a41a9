#!/usr/bin/env bash
# The price list: measures, writes the engine's own table (src/analysis/measured.rs), draws, and fills docs/notebook/tradeoff.md.
#   TRADEOFF_MEASURE=no   draws from the committed numbers without measuring again
set -euo pipefail
cd "$(dirname "$0")/.."

measure() {
  cargo run --quiet --locked --profile demo --example tradeoff -- "$1" docs/figures "${@:2}"
}

if [ "${TRADEOFF_MEASURE:-yes}" = yes ]; then
  measure sweep 1
  measure check
fi
measure table
scripts/python_env.sh
build/venv/bin/python docs/figures/plot_tradeoff.py
