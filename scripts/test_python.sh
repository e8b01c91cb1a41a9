#!/usr/bin/env bash
# Tests the bindings' description and the Python binding: generated files, tests, examples of the guide, the notebook, and an installed
# wheel in a fresh venv. (Lints: lint_python.sh.) Environment:
#   SUPERHELIX_BINARY   a built `superhelix` for the tests of the farm; else that of `cargo test`
#   SUPERHELIX_BUILD    as scripts/test_library.sh says
set -euo pipefail
cd "$(dirname "$0")/.."

. scripts/test_library.sh
SUPERHELIX_LIBRARY=$library/libsuperhelix.so
if [ -z "${SUPERHELIX_BINARY:-}" ]; then
  build_binary
  SUPERHELIX_BINARY=${CARGO_TARGET_DIR:-$PWD/target}/debug/superhelix
fi
export SUPERHELIX_LIBRARY SUPERHELIX_BINARY

. scripts/python_test_env.sh

PYTHONPATH=bindings/python/src prints_as_c build/python "$python" bindings/python/examples/hello.py
cd bindings/python
PYTHONPATH=$PWD/src "$python" -m pytest --all-functions

# What a user does, with the library that is built already.
fresh=$(mktemp -d)
trap 'rm -rf "$fresh"' EXIT
python3 -m venv "$fresh"
"$fresh/bin/python" -m pip install --quiet --disable-pip-version-check .
cd "$fresh"
env -u SUPERHELIX_LIBRARY "$fresh/bin/python" - <<'PYTHON'
import superhelix as shx

with shx.Solver() as solver:
    solver.add_strands(shx.StrandDefs(2, element_count=4, length=0.1))
    solver.step(1 / 60)
    print("installed:", shx.build_info(), solver.sample_strands(3).shape)
PYTHON
