#!/usr/bin/env bash
# What a Linux machine can check of other systems: the library and the command line compile for macOS and Windows; for Windows they are linked, and the
# golden hashes and a C example run under wine. What is skipped is said.
set -euo pipefail
cd "$(dirname "$0")/.."

export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}/platforms
macos=aarch64-apple-darwin
windows=x86_64-pc-windows-gnu

# cross TARGET ...: as scripts/cross.sh; false, and a word of it, where there is no standard library for the target.
cross() {
  local status=0
  scripts/cross.sh "$@" || status=$?
  [ "$status" != 77 ] || { echo "platforms: $1 SKIPPED: no standard library for it"; return 1; }
  [ "$status" = 0 ] || exit "$status"
}

if cross $macos check --quiet --locked --features cli; then
  echo "platforms: the library and the command line compile for $macos (checked, neither linked nor run)"
fi

cross $windows build --quiet --locked --release --manifest-path tests/platforms/Cargo.toml || exit 0
cross $windows check --quiet --locked --features cli
out=$PWD/build/windows
mkdir -p "$out"
cp "$CARGO_TARGET_DIR/$windows/release/superhelix_platform_check.dll" "$out/"
for program in tests/platforms/check.c examples_c/hello.c; do
  x86_64-w64-mingw32-gcc -std=c99 -D__USE_MINGW_ANSI_STDIO=1 -Wall -Wextra -Wpedantic -Werror -O1 -Iinclude -Iexamples_c "$program" \
    -o "$out/$(basename "$program" .c).exe" "$out/superhelix_platform_check.dll"
done
echo "platforms: the library and the command line compile for $windows, and C programs link to its DLL"
if ! command -v wine >/dev/null; then
  echo "platforms: $windows programs SKIPPED: no wine to run them"
  exit 0
fi
x86_64-w64-mingw32-gcc -shared -O1 -Wall -Wextra -Wpedantic -Werror tests/platforms/bcryptprimitives.c -o "$out/bcryptprimitives.dll" -ladvapi32
# Not in build/: it has a link to the root of the file system, which cargo would follow.
prefix=$(mktemp -d)
trap 'wineserver -k 2>/dev/null || true; rm -rf "$prefix"' EXIT
export WINEPREFIX=$prefix/wine WINEDEBUG=-all DISPLAY=
wine "$out/check.exe"
wine "$out/hello.exe"
