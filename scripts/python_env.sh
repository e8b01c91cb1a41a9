#!/usr/bin/env bash
# Sees to it that build/venv holds a Python with what the scripts that draw need. Run from the repository's root.
set -euo pipefail

venv=build/venv
if [ ! -x "$venv/bin/python" ]; then
  mkdir -p build
  python3 -m venv "$venv"
fi
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check numpy scipy matplotlib mpmath
