#!/usr/bin/env bash
# Makes Debian packages of what archive.sh has built: libsuperhelix0, the shared library, and libsuperhelix-dev, what compiling against
# it needs. DIST: where archive.sh put its stage and where the packages go, default out/dist.
set -euo pipefail
cd "$(dirname "$0")/../.."

dist=$(realpath -m "${DIST:-out/dist}")
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
major=${version%%.*}
revision=$version-1
architecture=$(dpkg --print-architecture)
triplet=$(uname -m)-linux-gnu
archive=$dist/stage/superhelix-$version-$(uname -m)-linux
build=$dist/lib
[ -d "$archive" ] || { echo "debian.sh: $archive is missing: run scripts/dist/archive.sh first" >&2; exit 1; }
: "${SOURCE_DATE_EPOCH:=$(git log -1 --format=%ct 2>/dev/null || stat -c %Y Cargo.toml)}"
export SOURCE_DATE_EPOCH
# The packager, as Debian's tools take it.
maintainer="${DEBFULLNAME:-superhelix developers} <${DEBEMAIL:-superhelix@localhost}>"

libdir=usr/lib/$triplet
runtime=$dist/debian/libsuperhelix$major
develop=$dist/debian/libsuperhelix-dev
rm -rf "$dist/debian" "$dist"/*.deb
SHX_BUILD_DIR=$build PREFIX=/usr LIBDIR=/$libdir DESTDIR=$develop scripts/install.sh >/dev/null
rm -rf "$develop/usr/share/licenses"
mkdir -p "$runtime/$libdir"
mv "$develop/$libdir/libsuperhelix.so.$major" "$develop/$libdir/libsuperhelix.so.$version" "$runtime/$libdir/"
ln -sf "libsuperhelix.so.$version" "$develop/$libdir/libsuperhelix.so"
chmod 644 "$runtime/$libdir/libsuperhelix.so.$version"

documents() { # documents ROOT PACKAGE: what Debian wants of each package
  local folder=$1/usr/share/doc/$2
  mkdir -p "$folder"
  {
    echo "superhelix is MIT or Apache-2.0, at your choice."
    echo "On Debian the Apache License 2.0 is /usr/share/common-licenses/Apache-2.0."
    echo
    cat LICENSE-MIT
    echo
    cat "$archive/share/licenses/superhelix/third_party.txt"
  } >"$folder/copyright"
  gzip -9 -n -c "$archive/share/licenses/superhelix/rust_standard_library.html" >"$folder/rust_standard_library.html.gz"
  gzip -9 -n -c CHANGELOG.md >"$folder/changelog.gz"
  {
    echo "superhelix ($revision) unstable; urgency=medium"
    echo
    echo "  * Version $version."
    echo
    echo " -- $maintainer  $(date -u -R -d "@$SOURCE_DATE_EPOCH")"
  } | gzip -9 -n >"$folder/changelog.Debian.gz"
}
documents "$runtime" "libsuperhelix$major"
documents "$develop" libsuperhelix-dev
cp "$archive/share/doc/superhelix/superhelix.cdx.json" "$develop/usr/share/doc/libsuperhelix-dev/"
mkdir -p "$develop/usr/share/doc/libsuperhelix-dev/examples"
cp examples_c/* "$develop/usr/share/doc/libsuperhelix-dev/examples/"

package() { # package ROOT NAME SECTION DEPENDS TEXT
  local root=$1
  mkdir -p "$root/DEBIAN"
  (cd "$root" && find usr -type f -print0 | LC_ALL=C sort -z | xargs -0 md5sum) >"$root/DEBIAN/md5sums"
  cat >"$root/DEBIAN/control" <<CONTROL
Package: $2
Source: superhelix
Version: $revision
Architecture: $architecture
Multi-Arch: same
Maintainer: $maintainer
Installed-Size: $(du -sk --exclude=DEBIAN "$root" | cut -f1)
Depends: $4
Section: $3
Priority: optional
Description: hair engine: strands as Super-Helices ($5)
 Simulates strands of hair as inextensible rods made of helical elements,
 with bending, twist and contact, behind a stable C interface.
 .
 This package holds $6
CONTROL
  find "$root" -type d -exec chmod 755 {} +
  dpkg-deb --root-owner-group --build "$root" "$dist/$2_${revision}_$architecture.deb" >/dev/null
  echo "$dist/$2_${revision}_$architecture.deb"
}
mkdir -p "$runtime/DEBIAN"
echo "libsuperhelix $major libsuperhelix$major (>= $version)" >"$runtime/DEBIAN/shlibs"
echo "activate-noawait ldconfig" >"$runtime/DEBIAN/triggers"
glibc=$(scripts/dist/glibc.sh "$runtime/$libdir/libsuperhelix.so.$version")
package "$runtime" "libsuperhelix$major" libs "libc6 (>= $glibc), libgcc-s1 (>= 4.2)" "shared library" "the shared library."
package "$develop" libsuperhelix-dev libdevel "libsuperhelix$major (= $revision), libc6-dev" "development files" \
  "the header, the static library, pkg-config files
 and the CMake package."
