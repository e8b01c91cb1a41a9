#!/usr/bin/env bash
# Format, lints and types of all Python here, without anything compiled: half a minute. Makes the environment that the Python tests run in.
set -euo pipefail
cd "$(dirname "$0")/.."

venv=build/python-venv
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check "numpy>=1.23" bokeh distributed matplotlib mypy nbclient ipykernel pytest ruff "usd-core>=24.11"
python=$PWD/$venv/bin/python

cd bindings/python
"$python" -m ruff format --check --quiet ../../abi ../../scripts/docs ../api.py ../coverage.py ../tables.py ../cpp ../csharp . || { echo "lint_python.sh: ruff format bindings/python" >&2; exit 1; }
"$python" -m ruff check --quiet ../../abi ../../scripts/docs ../api.py ../coverage.py .
"$python" -m mypy
for generator in ../cpp/generate.py ../csharp/generate.py ../csharp/pack.py; do
  MYPYPATH=.. "$python" -m mypy "$generator"
done
MYPYPATH=../../scripts/docs "$python" -m mypy ../../scripts/docs/{links,folders,snippets,header}.py
