#!/usr/bin/env bash
# Makes the pictures of docs/guide/blender.md: the extension simulates and grows hair in Blender as a Python module, Cycles renders it. A quarter of an hour
# each on two quiet cores. Usage: blender_pictures.sh [walk] [shake]; without any, both. Environment:
#   BPY_VERSION        as scripts/blender_env.sh says
#   SUPERHELIX_BUILD   as scripts/test_library.sh says
set -euo pipefail
cd "$(dirname "$0")/.."

. scripts/test_library.sh
export SUPERHELIX_LIBRARY=$library/libsuperhelix.so PYTHONPATH=$PWD/bindings/python/src
. scripts/blender_env.sh
for picture in ${*:-walk shake}; do
  "$python" bindings/blender/pictures.py "$picture" "docs/figures/blender_$picture.jpg"
done
