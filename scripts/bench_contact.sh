#!/usr/bin/env bash
# Measures what contact costs and errs by, and writes the tables of docs/notebook/contact.md and of docs/notebook/tradeoff.md. Nothing else should run on the machine
# meanwhile.
#   CONTACT_QUICK=yes    forty guides, four steps, one step size, into build/contact_quick, tables to the terminal; docs/ stays as it is
set -euo pipefail
cd "$(dirname "$0")/.."

into=docs/figures
options=()
if [ "${CONTACT_QUICK:-no}" = yes ]; then
  into=build/contact_quick
  options=(--quick --guides 40 --steps 4)
fi
mkdir -p "$into"
cargo bench --locked --profile "${BENCH_PROFILE:-demo}" --bench contact -- --csv "$PWD/$into" ${options[@]+"${options[@]}"}
cargo bench --locked --profile "${BENCH_PROFILE:-demo}" --bench contact -- --csv "$PWD/$into" --jumps-only --random "${CONTACT_RANDOM:-1000}" ${options[@]+"${options[@]}"}
scripts/python_env.sh
build/venv/bin/python docs/figures/plot_contact.py "$into"
