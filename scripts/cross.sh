#!/usr/bin/env bash
# Runs cargo for another target with a standard library for it. Usage: scripts/cross.sh TARGET COMMAND [ARGUMENT ...]
#   scripts/cross.sh wasm32-unknown-unknown build --lib
#
# The standard library comes from the first of these that has it:
#   1. the toolchain that cargo runs with, where it has the target (`rustup target add TARGET` gives it to a toolchain of rustup's; that is yours to
#      do: this script changes no toolchain);
#   2. on Debian, the compiler and the library's sources of the packages rustc-web and rust-web-src (1.89 or later), unpacked into
#      build/cross without being installed; cargo compiles the library from them.
# Where neither has it: says "skipped: no standard library for TARGET" and ends with status 77.
set -euo pipefail
cd "$(dirname "$0")/.."

target=$1
shift
command=$1
shift
cross=$PWD/build/cross
sources=$cross/debian/usr/lib/rustlib/src/rust/library

has_library() {
  ls "$(rustc --print target-libdir --target "$target" 2>/dev/null)"/libstd-*.rlib >/dev/null 2>&1
}

debian_version() {
  apt-cache policy rustc-web 2>/dev/null | sed -n 's/^ *Candidate: \([0-9.]*\).*/\1/p'
}

offered() {
  local version
  version=$(debian_version)
  [ -n "$version" ] && [ "$(printf '%s\n1.89\n' "$version" | sort -V | head -n 1)" = 1.89 ]
}

unpack_debian() {
  local version library llvm file packages
  command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null || return 1
  # The lists of a machine may be missing, or older than the package.
  offered || { [ "$(id -u)" = 0 ] && apt-get update -qq && offered; } || return 1
  version=$(debian_version)
  echo "cross.sh: unpacking Debian's rustc $version into build/cross" >&2
  rm -rf "$cross/debian.new"
  mkdir -p "$cross/packages" "$cross/debian.new"
  library=libstd-rust-web-${version%.*}
  llvm=$(apt-cache depends "$library" | sed -n 's/.*Depends: libllvm//p')
  packages=(rustc-web "$library" libstd-rust-web-dev rust-web-src "libllvm$llvm" "lld-$llvm")
  (cd "$cross/packages" && rm -f ./*.deb && apt-get download -qq "${packages[@]}" >/dev/null 2>&1) || return 1
  for file in "$cross"/packages/*.deb; do
    case $file in
      # Nothing but the library of what is half a gigabyte.
      */rust-web-src_*) dpkg-deb --fsys-tarfile "$file" | tar -x -C "$cross/debian.new" --wildcards './usr/src/*/library' './usr/lib/*' ;;
      *) dpkg-deb -x "$file" "$cross/debian.new" ;;
    esac
  done
  rm -rf "$cross/packages" "$cross/debian"
  mv "$cross/debian.new" "$cross/debian"
}

if has_library; then
  exec cargo "$command" --target "$target" "$@"
fi
if [ ! -d "$sources" ] && ! unpack_debian; then
  echo "skipped: no standard library for $target" >&2
  exit 77
fi
# One compiler and one library for all that is built, build scripts too. Unstable cargo options are allowed for this call alone.
mkdir -p "$cross/bin"
cat >"$cross/bin/rustc" <<WRAPPER
#!/bin/sh
LD_LIBRARY_PATH=$cross/debian/usr/lib/x86_64-linux-gnu\${LD_LIBRARY_PATH:+:\$LD_LIBRARY_PATH} exec $cross/debian/usr/bin/rustc "\$@"
WRAPPER
cat >"$cross/bin/wasm-ld" <<WRAPPER
#!/bin/sh
LD_LIBRARY_PATH=$cross/debian/usr/lib/x86_64-linux-gnu\${LD_LIBRARY_PATH:+:\$LD_LIBRARY_PATH} exec $cross/debian/usr/lib/llvm-*/bin/wasm-ld "\$@"
WRAPPER
chmod +x "$cross/bin/rustc" "$cross/bin/wasm-ld"
export RUSTC=$cross/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$cross/bin/wasm-ld
exec cargo "$command" -Z build-std=std,panic_abort --target "$target" "$@"
