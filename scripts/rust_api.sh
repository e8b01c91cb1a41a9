#!/usr/bin/env bash
# The public Rust interface as text, compared with abi/rust.txt. Usage: scripts/rust_api.sh [--bless|--install]
#   (nothing)   fails where the interface differs from the text; says so where cargo-public-api is not installed
#   --bless     writes the text
#   --install   installs cargo-public-api into build/tools, where the registry can be reached (unoptimised: it compiles for longer than it runs)
set -euo pipefail
cd "$(dirname "$0")/.."

version=0.52.0
PATH=$PWD/build/tools/bin:$PATH
installed() { [ "$(cargo-public-api --version 2>/dev/null)" = "cargo-public-api $version" ]; }

if [ "${1:-}" = --install ]; then
  installed || cargo install --quiet --locked --debug --root build/tools cargo-public-api@$version ||
    echo "rust_api.sh: cargo-public-api $version could not be installed: the registry is out of reach, perhaps" >&2
  exit 0
fi
if ! installed; then
  echo "rust_api.sh: skipped: cargo-public-api $version is not installed (scripts/rust_api.sh --install)"
  exit 0
fi

# The description of the interface as JSON is unstable, and so is asked for as if rustdoc were of a nightly compiler. Of rustdoc alone: that variable
# would have cargo compile everything again.
target=${CARGO_TARGET_DIR:-target}/rust-api
mkdir -p "$target"
printf '#!/bin/sh\nRUSTC_BOOTSTRAP=1 exec rustdoc "$@"\n' >"$target/rustdoc"
chmod +x "$target/rustdoc"
RUSTDOC=$(realpath "$target/rustdoc") cargo rustdoc --quiet --locked --all-features --lib -- -Z unstable-options --output-format json --cap-lints allow
if ! cargo-public-api public-api -sss --rustdoc-json "${CARGO_TARGET_DIR:-target}/doc/superhelix.json" >"$target/rust.txt" 2>"$target/errors.txt"; then
  if grep -qi 'format.version\|rustdoc JSON' "$target/errors.txt"; then
    echo "rust_api.sh: skipped: cargo-public-api $version does not read what $(rustc --version) writes"
    exit 0
  fi
  cat "$target/errors.txt" >&2
  exit 1
fi
if grep -nE 'superhelix::(internals|facade|capi|chain|contact|energy|error|files|groom|haptics|math|memory|meter|platform|rod|solver|step|analysis|styling|workers)::' "$target/rust.txt"; then
  echo "rust_api.sh: the lines above name private modules: the facade (src/facade) does not export these types" >&2
  exit 1
fi
if [ "${1:-}" = --bless ]; then
  cp "$target/rust.txt" abi/rust.txt
elif ! diff -u abi/rust.txt "$target/rust.txt"; then
  echo "rust_api.sh: the public Rust interface has changed; if it should have: scripts/rust_api.sh --bless, and an entry in CHANGELOG.md" >&2
  exit 1
fi
echo "rust_api.sh: $(wc -l <"$target/rust.txt") lines of public Rust interface"
