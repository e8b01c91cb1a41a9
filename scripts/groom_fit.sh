#!/usr/bin/env bash
# Fits strands to every groom of a directory and writes the tables of docs/notebook/groom_fit.md. Nothing else should run on the machine meanwhile.
#   GROOMS=directory    .hair, .tfx, .usda and .data files, as they are or as .gz, also in folders of it; without it those of tests/data/grooms
#   GROOM_FIT_THREADS=2
set -euo pipefail
cd "$(dirname "$0")/.."

grooms=$(mktemp -d)
trap 'rm -rf "$grooms"' EXIT
while IFS= read -r -d '' file; do
  case "$file" in
    *.hair | *.tfx | *.usda | *.data) cp "$file" "$grooms" ;;
    *.hair.gz | *.tfx.gz | *.usda.gz | *.data.gz) gunzip -c "$file" > "$grooms/$(basename "${file%.gz}")" ;;
  esac
done < <(find "${GROOMS:-tests/data/grooms}" -type f -print0)
cargo run --quiet --locked --profile demo --example groom_fit -- "$PWD/docs/figures" "$grooms" "${GROOM_FIT_THREADS:-2}"
scripts/python_env.sh
build/venv/bin/python docs/figures/plot_groom_fit.py
