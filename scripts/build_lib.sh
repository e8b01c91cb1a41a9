#!/usr/bin/env bash
# Builds the C library: build/lib/libsuperhelix.so.X.Y.Z with its links, build/lib/libsuperhelix.a, build/lib/pkgconfig/superhelix.pc,
# build/include/superhelix.h. Environment:
#   SHX_PROFILE     cargo profile, default release (dev compiles in a third of the time and runs slower); test links what `cargo test`
#                   has compiled, with all features, and compiles nothing itself
#   SHX_BUILD_DIR   where to, default build
#   SHX_PREFIX      the prefix that superhelix.pc states, default the absolute SHX_BUILD_DIR
#
# The artifacts are made with `cargo rustc --crate-type`: crate-type = ["lib", "cdylib", "staticlib"] in Cargo.toml would make cargo
# drop link-time optimisation silently, and a plain cdylib has no SONAME.
set -euo pipefail
cd "$(dirname "$0")/.."

profile=${SHX_PROFILE:-release}
build=${SHX_BUILD_DIR:-build}
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
major=${version%%.*}
soname=libsuperhelix.so.$major
target=${CARGO_TARGET_DIR:-target}
what=(--lib --profile "$profile")
output=$target/$profile/libsuperhelix
case $profile in
  dev) output=$target/debug/libsuperhelix ;;
  test)
    what=(--example c_library --all-features --profile dev)
    output=$target/debug/examples/libc_library
    ;;
esac

messages=$(mktemp)
trap 'rm -f "$messages"' EXIT
build_types() {
  cargo rustc --quiet --locked "${what[@]}" --crate-type "$1" -- \
    -C "link-arg=-Wl,-soname,$soname" --print native-static-libs 2>"$messages" || { cat "$messages" >&2; exit 1; }
}
mkdir -p "$build/lib/pkgconfig" "$build/include"
if [ "$profile" = test ]; then
  build_types cdylib,staticlib
  install -m 755 "$output.so" "$build/lib/libsuperhelix.so.$version"
else
  # One at a time: with two crate types cargo drops link-time optimisation silently.
  build_types cdylib
  install -m 755 "$output.so" "$build/lib/libsuperhelix.so.$version"
  build_types staticlib
fi
# What a program that links the static library needs beside it, as rustc says.
libraries=$(sed -n 's/^note: native-static-libs: //p' "$messages" | tail -n 1)
if [ -z "$libraries" ]; then
  echo "build_lib.sh: rustc did not say which libraries the static one needs" >&2
  exit 1
fi

ln -sf "libsuperhelix.so.$version" "$build/lib/$soname"
ln -sf "$soname" "$build/lib/libsuperhelix.so"
install -m 644 "$output.a" "$build/lib/libsuperhelix.a"
install -m 644 include/superhelix.h "$build/include/superhelix.h"

prefix=${SHX_PREFIX:-$(cd "$build" && pwd)}
cat >"$build/lib/pkgconfig/superhelix.pc" <<PC
prefix=$prefix
includedir=\${prefix}/include
libdir=\${prefix}/lib

Name: superhelix
Description: A hair engine: strands as Super-Helices
Version: $version
Cflags: -I\${includedir}
Libs: -L\${libdir} -lsuperhelix
Libs.private: $libraries
PC
