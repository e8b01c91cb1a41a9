#!/usr/bin/env bash
# Tests the pages: links, anchors and names of pages (scripts/docs/links.py), what each folder of src says it holds (scripts/docs/folders.py), and the
# code of the pages, compiled and run (scripts/docs/snippets.py). Usage: scripts/test_docs.sh [PAGE ...]; only the code of these pages. Environment:
#   SUPERHELIX_BINARY   a built `superhelix`; else that of `cargo test`
#   SUPERHELIX_BUILD    as scripts/test_library.sh says
set -euo pipefail
cd "$(dirname "$0")/.."

python3 scripts/docs/links.py
python3 scripts/docs/folders.py --check

. scripts/test_library.sh
target=${CARGO_TARGET_DIR:-$PWD/target}
# What `cargo test` has compiled already.
build_binary
. scripts/python_test_env.sh

csharp=()
if command -v mcs >/dev/null; then
  mkdir -p build/docs-test
  find bindings/csharp/com.superhelix.hair/Runtime -name '*.cs' -print0 |
    xargs -0 mcs -unsafe -langversion:7.2 -target:library -out:build/docs-test/Superhelix.dll
  csharp=(--csharp build/docs-test/Superhelix.dll)
fi
python3 scripts/docs/snippets.py --library "$library" --headers "$headers" --binary "${SUPERHELIX_BINARY:-$target/debug/superhelix}" \
  --python "$python" --target "$target/debug" "${csharp[@]}" "$@"
