#!/usr/bin/env bash
# Format, lints and types of all Python but the Blender extension's, without anything compiled: half a minute.
set -euo pipefail
cd "$(dirname "$0")/.."

. scripts/python_test_env.sh
cd bindings/python
"$python" -m ruff format --check --quiet ../../abi ../../scripts/docs ../../scripts/hosts ../api.py ../coverage.py ../tables.py ../cpp ../csharp . || { echo "lint_python.sh: ruff format bindings/python" >&2; exit 1; }
"$python" -m ruff check --quiet ../../abi ../../scripts/docs ../../scripts/hosts ../api.py ../coverage.py .
"$python" -m mypy
for generator in ../cpp/generate.py ../csharp/generate.py ../csharp/pack.py; do
  MYPYPATH=.. "$python" -m mypy "$generator"
done
"$python" -m mypy ../../scripts/hosts/{walk,compare}.py
MYPYPATH=../../scripts/docs "$python" -m mypy ../../scripts/docs/{links,folders,snippets,header}.py
