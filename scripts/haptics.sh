#!/usr/bin/env bash
# Makes the figures and tables of docs/notebook/haptics.md: a C program combs Sintel's hair in real time, hands comb other hair in the example `haptics`.
# Needs two free cores for what runs in real time.
#   FIGURES_MEASURE=no   draws from the committed numbers without measuring again
#   SHX_BUILD_DIR        where the C library is built to, default build
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${FIGURES_MEASURE:-yes}" = yes ]; then
  build=${SHX_BUILD_DIR:-build}
  SHX_PROFILE=demo SHX_LINKAGE=shared scripts/build_lib.sh
  make --no-print-directory -C examples_c BUILD="$PWD/$build" OUT="$PWD/$build/examples" "$PWD/$build/examples/shared/haptic_comb"
  # A device's thread has a real-time priority, where this user may give it one.
  priority=$(chrt -f 20 true 2>/dev/null && echo "chrt -f 20" || true)
  out=out/haptics
  mkdir -p "$out"
  $priority "$build/examples/shared/haptic_comb" tests/data/grooms/sintel_hair_001.tfx tests/data/grooms/sintel_bust.obj "$out" 6 | tee "$out/printed.txt"
  # A line in four of what it felt is enough to draw.
  awk 'NR == 1 || NR % 4 == 2' "$out/force.csv" >docs/figures/haptics_comb.csv
  cargo build --quiet --locked --profile demo --example haptics
  haptics=${CARGO_TARGET_DIR:-target}/demo/examples/haptics
  $haptics cost docs/figures/haptics_cost.csv
  $haptics types docs/figures/haptics_types.csv docs/figures/haptics_types_means.csv
  $haptics rates docs/figures/haptics_rates.csv docs/figures/haptics_rates_curves.csv
  $priority $haptics minute docs/figures/haptics_minute.csv docs/figures/haptics_latency.csv 60 120 1
fi
scripts/python_env.sh
build/venv/bin/python docs/figures/plot_haptics.py
