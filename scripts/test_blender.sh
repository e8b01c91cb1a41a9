#!/usr/bin/env bash
# Tests the Blender extension: format, lints, types, its core without Blender; then in Blender as a Python module, which it installs itself (1 GB, once):
# a real groom on a walking head against the engine's own run, scrubbing, a bake that is killed and continued, colliders, errors, and the .zip
# installed as a user does. Where pip has no bpy it says so, and ends well. Usage: test_blender.sh [core]   core: without Blender (seconds)
# Environment:
#   BPY_VERSION        as scripts/blender_env.sh says
#   SUPERHELIX_BUILD   as scripts/test_library.sh says
set -euo pipefail
cd "$(dirname "$0")/.."

. scripts/test_library.sh
export SUPERHELIX_LIBRARY=$library/libsuperhelix.so PYTHONPATH=$PWD/bindings/python/src

. scripts/python_test_env.sh
cd bindings/blender
"$python" -m ruff format --check --quiet . || { echo "test_blender.sh: ruff format bindings/blender" >&2; exit 1; }
"$python" -m ruff check --quiet .
"$python" -m mypy
"$python" -m pytest tests/test_core.py
[ "${1:-}" != core ] || exit 0
cd ../..

. scripts/blender_env.sh
(cd bindings/blender && "$python" -m pytest)

# What a user does, with the library that is built already.
zip=$("$python" bindings/blender/pack.py --out build/blender)
scripts=$("$python" -c 'import bpy, os; print(bpy.utils.system_resource("SCRIPTS"), flush=True); os._exit(0)')
"$python" "$scripts/addons_core/bl_pkg/cli/blender_ext.py" validate "$zip"
"$python" bindings/blender/tests/install.py "$zip"
