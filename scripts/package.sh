#!/usr/bin/env bash
# What crates.io would get: packs the crate, fails on any warning but those about tests and benches that stay in the repository, and compiles what was
# packed, the command line included.
set -euo pipefail
cd "$(dirname "$0")/.."

target=${CARGO_TARGET_DIR:-$PWD/target}
said=$(mktemp)
unpacked=$(mktemp -d)
trap 'rm -rf "$said" "$unpacked"' EXIT
cargo package --locked --no-verify --allow-dirty 2>&1 | tee "$said" | grep -v '^warning: ignoring \(test\|benchmark\|example\) ' || true
if grep -q '^error' "$said"; then exit 1; fi
if grep '^warning' "$said" | grep -qv '^warning: ignoring \(test\|benchmark\|example\) '; then
  echo "package.sh: cargo warns about the package" >&2
  exit 1
fi
crate=$(ls -t "$target"/package/superhelix-*.crate | head -n 1)
# crates.io takes no more than 10 MB.
[ "$(stat -c %s "$crate")" -lt 10000000 ] || { echo "package.sh: $crate is larger than crates.io takes" >&2; exit 1; }
tar -xzf "$crate" -C "$unpacked"
for file in LICENSE-MIT LICENSE-APACHE README.md CHANGELOG.md include/superhelix.h docs/guide/rust.md src/facade/mod.rs; do
  [ -f "$unpacked"/superhelix-*/"$file" ] || { echo "package.sh: the package has no $file" >&2; exit 1; }
done
cargo check --quiet --locked --all-features --target-dir "$target" --manifest-path "$unpacked"/superhelix-*/Cargo.toml
echo "package.sh: $(basename "$crate"), $(stat -c %s "$crate") bytes, compiles"
