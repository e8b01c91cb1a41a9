#!/usr/bin/env bash
# Measures what the engine costs, prints every table as it comes, and makes docs/notebook/performance.md of them. Nothing else should run on the
# machine meanwhile. The profile `demo` compiles in a third of the time of `release`.
#   BENCH_PROFILE=release   another profile
#   BENCH_ROUNDS=15         rounds that the medians are over
#   BENCH_ONLY=aims         only these parts (cold, machine, aims, cost, options, scenes, absent, scaling)
#   BENCH_DRAW=no           without the document's tables and figures
set -euo pipefail
cd "$(dirname "$0")/.."

only=()
[ -z "${BENCH_ONLY:-}" ] || only=(--only "$BENCH_ONLY")
cargo bench --locked --profile "${BENCH_PROFILE:-demo}" --bench performance -- --csv "$PWD/docs/figures" \
  --rounds "${BENCH_ROUNDS:-15}" ${only[@]+"${only[@]}"}

if [ "${BENCH_DRAW:-yes}" = yes ]; then
  scripts/python_env.sh
  build/venv/bin/python docs/figures/plot_performance.py
fi
