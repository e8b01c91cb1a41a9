#!/usr/bin/env bash
# Makes the tables of docs/notebook/render_hair.md: strands from a part of real grooms' guides, and what they cost. Its picture is path-traced.
#   FIGURES_MEASURE=no   writes them from the committed numbers without measuring again
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${FIGURES_MEASURE:-yes}" = yes ]; then
  cargo bench --locked --profile demo --bench render_hair -- --csv docs/figures/render_hair_cost.csv
  cargo run --quiet --locked --profile demo --example render_hair -- docs/figures/render_hair.csv
fi
scripts/python_env.sh
build/venv/bin/python docs/figures/plot_render_hair.py
