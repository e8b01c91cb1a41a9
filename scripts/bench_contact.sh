#!/usr/bin/env bash
# Measures what contact costs and errs by, and writes the tables of docs/contact.md. Nothing else should run on the machine meanwhile.
set -euo pipefail
cd "$(dirname "$0")/.."

cargo bench --locked --profile "${BENCH_PROFILE:-demo}" --bench contact -- --csv "$PWD/docs/figures"
scripts/python_env.sh
build/venv/bin/python docs/figures/plot_contact.py
