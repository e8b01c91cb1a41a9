#!/usr/bin/env bash
# Compiles the library to WebAssembly, build/wasm/superhelix.wasm, and checks it under node. Where there is no standard library for it, that is said.
set -euo pipefail
cd "$(dirname "$0")/.."

target=wasm32-unknown-unknown
cargo_target=${CARGO_TARGET_DIR:-$PWD/target}/wasm
status=0
CARGO_TARGET_DIR=$cargo_target scripts/cross.sh $target build --quiet --locked --release --manifest-path tests/platforms/Cargo.toml || status=$?
if [ "$status" = 77 ]; then
  echo "wasm: SKIPPED, nothing was compiled or checked: no standard library for $target"
  exit 0
fi
[ "$status" = 0 ] || exit "$status"
mkdir -p build/wasm
cp "$cargo_target/$target/release/superhelix_platform_check.wasm" build/wasm/superhelix.wasm
ls -l build/wasm/superhelix.wasm
node tests/platforms/check.mjs build/wasm/superhelix.wasm
node examples_wasm/hello.mjs build/wasm/superhelix.wasm
