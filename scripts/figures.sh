#!/usr/bin/env bash
# Makes every figure and measured table of docs/: runs the programs that measure, into docs/figures/*.csv, then draws them with
# matplotlib in an environment of its own, build/venv. The contact sheet is the demonstration's; path-traced pictures are `make pictures`'s.
# docs/theory/extremes.md shows what the last `make soak` recorded.
#   FIGURES_MEASURE=no   draws from the committed numbers without measuring again
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${FIGURES_MEASURE:-yes}" = yes ]; then
  BENCH_DRAW=no scripts/bench.sh
  scripts/instructions.sh
  cargo bench --locked --profile demo --bench sampling -- --csv docs/figures/sampling.csv
  cargo run --quiet --locked --profile demo --example convergence -- docs/figures/convergence.csv
  cargo run --quiet --locked --profile demo --example limits -- docs/figures/limits.csv
  cargo run --quiet --locked --profile demo --example newton -- docs/figures/newton.csv
  cargo run --quiet --locked --profile demo --example quadrature -- angles docs/figures/quadrature_angles.csv
  cargo run --quiet --locked --profile demo --example quadrature -- motions docs/figures/quadrature_motions.csv
  scripts/quadrature_cost.sh
  cargo run --quiet --locked --profile demo --example single_precision -- docs/figures/single_precision.csv
  cargo run --quiet --locked --profile demo --example hair_types -- docs/figures
  VALIDATION_CSV="$PWD/docs/figures" cargo test --quiet --locked --test physics -- statics:: vibration:: dynamics:: whirl::
  cargo run --quiet --locked --profile demo --example friction -- docs/figures/friction.csv docs/figures/friction_curve.csv
  scripts/demo.sh
  "${CARGO_TARGET_DIR:-target}/demo/superhelix" picture out/demo/render --out docs/figures/contact_sheet.png --fps 24 --scale 1 \
    --body tests/data/grooms/sintel_bust.obj --body-scale 0.01 --title "Sintel's hair on a recorded walk" --cell 220 --moments 5 --quiet
  scripts/contact_figures.sh
  mkdir -p build
  cargo test --quiet --locked --profile demo --test styling -- --nocapture --test-threads=1 > build/styling.txt
fi

scripts/python_env.sh
build/venv/bin/python docs/figures/plot.py
build/venv/bin/python docs/figures/plot_performance.py
build/venv/bin/python docs/figures/plot_validation.py
build/venv/bin/python docs/figures/plot_single_precision.py
build/venv/bin/python docs/figures/plot_hair_types.py
# (The styling tests' output is not committed.)
if [ -e build/styling.txt ]; then
  build/venv/bin/python docs/figures/plot_styling.py build/styling.txt
fi
scripts/render_hair.sh
scripts/haptics.sh
