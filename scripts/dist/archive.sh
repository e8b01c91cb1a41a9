#!/usr/bin/env bash
# Makes the release archive: out/dist/superhelix-VERSION-PROCESSOR-linux.tar.gz and its SHA-256, linked against an old C library, with
# header, pkg-config, CMake, documentation, examples, the licences of all that is linked in, and a bill of materials. Environment:
#   SHX_PROFILE   cargo profile, default release
#   SHX_GLIBC     the C library that is needed at least, default 2.17
#   DIST          where to, default out/dist
set -euo pipefail
cd "$(dirname "$0")/../.."

dist=$(realpath -m "${DIST:-out/dist}")
export SHX_GLIBC=${SHX_GLIBC:-2.17}
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
processor=$(uname -m)
target=$processor-unknown-linux-gnu
name=superhelix-$version-$processor-linux
if [ -z "${SOURCE_DATE_EPOCH:-}" ]; then
  SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || stat -c %Y Cargo.toml)
fi
export SOURCE_DATE_EPOCH

scripts/dist/python.sh
export SHX_PYTHON=$PWD/build/dist/venv/bin/python

build=$dist/lib
SHX_BUILD_DIR=$build SHX_LINKER=$PWD/scripts/dist/zig_cc.sh scripts/build_lib.sh
scripts/dist/glibc.sh "$build/lib/libsuperhelix.so" "$SHX_GLIBC"
strip --strip-unneeded "$(realpath "$build/lib/libsuperhelix.so")"
strip --strip-debug "$build/lib/libsuperhelix.a"

stage=$dist/stage
rm -rf "$stage" "$dist/$name".*
SHX_BUILD_DIR=$build PREFIX=/$name DESTDIR=$stage scripts/install.sh
docs=$stage/$name/share/doc/superhelix
licenses=$stage/$name/share/licenses/superhelix
mkdir -p "$docs"
cp -r docs examples_c README.md CHANGELOG.md "$docs"
cp LICENSE-APACHE LICENSE-MIT "$stage/$name"
"$SHX_PYTHON" -B scripts/dist/licenses.py "$target" "$licenses"
"$SHX_PYTHON" -B scripts/dist/sbom.py "$target" "$docs/superhelix.cdx.json"
"$SHX_PYTHON" -B scripts/dist/check_sbom.py "$docs/superhelix.cdx.json"

find "$stage" -type d -exec chmod 755 {} +
tar --create --directory="$stage" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" --format=gnu "$name" \
  | gzip -9 -n >"$dist/$name.tar.gz"
(cd "$dist" && sha256sum "$name.tar.gz" >"$name.tar.gz.sha256")
echo "$dist/$name.tar.gz"
