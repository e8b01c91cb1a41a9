#!/usr/bin/env bash
# Builds the C library into a folder that serves as an installation: build/lib/libsuperhelix.so.X.Y.Z with its links,
# build/lib/libsuperhelix.a, build/include/superhelix.h, the C++ headers in build/include/superhelix, pkg-config files and a CMake package. Environment:
#   SHX_PROFILE     cargo profile, default release (dev compiles in a third of the time and runs slower); test links what `cargo test`
#                   has compiled, with all features, and compiles nothing itself
#   SHX_LINKAGE     shared, static or both (the default)
#   SHX_BUILD_DIR   where to, default build
#   SHX_LINKER      the linker, as rustc's -C linker; default that of cargo's configuration
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
linkage=${SHX_LINKAGE:-both}
case $linkage in
  shared) types=(cdylib) ;;
  static) types=(staticlib) ;;
  both) types=(cdylib staticlib) ;;
  *)
    echo "build_lib.sh: SHX_LINKAGE is '$linkage': it must be shared, static or both" >&2
    exit 1
    ;;
esac
what=(--lib --profile "$profile")
output=$target/$profile/libsuperhelix
case $profile in
  dev) output=$target/debug/libsuperhelix ;;
  test)
    what=(--example c_library --all-features --profile dev)
    output=$target/debug/examples/libc_library
    types=("cdylib,staticlib")
    ;;
esac
# The C libraries alone have the allocator that a host may replace (src/capi/base/allocator.rs).
arguments=(-C "link-arg=-Wl,-soname,$soname" --print native-static-libs --cfg superhelix_c_library)
[ -z "${SHX_LINKER:-}" ] || arguments+=(-C "linker=$SHX_LINKER")

mkdir -p "$build/lib" "$build/include"
rm -f "$build"/lib/libsuperhelix.* "$build/lib/native_libraries.txt"
messages=$(mktemp)
trap 'rm -f "$messages"' EXIT
# One at a time: with two crate types cargo drops link-time optimisation silently.
for type in "${types[@]}"; do
  cargo rustc --quiet --locked "${what[@]}" --crate-type "$type" -- "${arguments[@]}" 2>"$messages" || { cat "$messages" >&2; exit 1; }
  if [[ $type == *cdylib* && $linkage != static ]]; then
    install -m 755 "$output.so" "$build/lib/libsuperhelix.so.$version"
    ln -sf "libsuperhelix.so.$version" "$build/lib/$soname"
    ln -sf "$soname" "$build/lib/libsuperhelix.so"
  fi
  if [[ $type == *staticlib* && $linkage != shared ]]; then
    # Debugging information is for those who debug; the standard library always has some.
    strip=(--strip-debug)
    [ "$profile" != dev ] || strip=()
    scripts/localise_symbols.sh "$output.a" include/exports.txt "$build/lib/libsuperhelix.a" "${strip[@]}"
    # The libraries that a program needs beside the static library, as reported by rustc. The compiler adds the unwinder itself: libgcc_s, or
    # libgcc_eh for a program that is wholly static.
    sed -n 's/^note: native-static-libs: //p' "$messages" | tail -n 1 | sed 's/-lgcc_s\b *//' >"$build/lib/native_libraries.txt"
    if [ ! -s "$build/lib/native_libraries.txt" ]; then
      echo "build_lib.sh: rustc did not say which libraries the static one needs" >&2
      exit 1
    fi
  fi
done
install -m 644 include/superhelix.h include/superhelix_inline.h "$build/include/"
# The C++ headers, which need nothing built.
rm -rf "$build/include/superhelix"
(cd bindings/cpp/include && find superhelix -name '*.hpp') | while read -r header; do
  install -D -m 644 "bindings/cpp/include/$header" "$build/include/$header"
done
[ -f "$build/lib/native_libraries.txt" ] || : >"$build/lib/native_libraries.txt"
prefix=$(cd "$build" && pwd)
scripts/package_files.sh "$prefix" "$prefix/lib" "$prefix/include" "$prefix/lib/cmake/superhelix" "$(cat "$build/lib/native_libraries.txt")"
