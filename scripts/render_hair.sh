#!/usr/bin/env bash
# Makes the figure and the tables of docs/render_hair.md: strands from a part of real grooms' guides, what they cost, and the four kinds of hair of
# figure 4 of Bertails et al. 2006.
#   FIGURES_MEASURE=no   draws from the committed numbers without measuring again
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${FIGURES_MEASURE:-yes}" = yes ]; then
  cargo bench --locked --profile demo --bench render_hair -- --csv docs/figures/render_hair_cost.csv
  cargo run --quiet --locked --profile demo --example render_hair -- docs/figures/render_hair.csv
fi
cargo build --quiet --locked --profile demo --features cli --bin superhelix
superhelix="${CARGO_TARGET_DIR:-target}/demo/superhelix"
frames=$(mktemp -d)
trap 'rm -rf "$frames"' EXIT
make_hair() {
  "$superhelix" interpolate tests/data/grooms/sintel_hair_001.tfx --scale 0.01 --every 4 --scalp tests/data/grooms/sintel_bust.obj \
    --count 12000 --points 33 --out "$frames/$1.hair" "${@:2}"
}
make_hair a --curliness 0 --length-variation 0
make_hair b
make_hair c --curliness 1 --wisps 2
make_hair d --curliness 0 --length-variation 0 --max-tip-ratio 0.25
make_hair e --curliness 0 --length-variation 0 --max-tip-ratio 0

scripts/python_env.sh
build/venv/bin/python docs/figures/plot_render_hair.py "$frames"
