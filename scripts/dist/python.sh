#!/usr/bin/env bash
# Sees to it that build/dist/venv holds a Python with what making a release needs: zig, which links against an old C library, and the
# schema of bills of materials. Run from the repository's root.
set -euo pipefail

venv=build/dist/venv
if ! "$venv/bin/python" -c 'import ziglang, cyclonedx, jsonschema' 2>/dev/null; then
  rm -rf "$venv"
  mkdir -p "${venv%/*}"
  python3 -m venv "$venv"
  "$venv/bin/python" -m pip install --quiet --disable-pip-version-check 'ziglang>=0.13' 'cyclonedx-python-lib[json-validation]>=8'
fi
