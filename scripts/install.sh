#!/usr/bin/env bash
# Installs what scripts/build_lib.sh has built, or removes it: libraries, headers of C and C++, pkg-config files, CMake package, licences.
# Usage: scripts/install.sh [--uninstall]. Environment:
#   SHX_BUILD_DIR   where the build is, default build
#   PREFIX          default /usr/local
#   LIBDIR          default PREFIX/lib; a relative one is taken from PREFIX
#   INCLUDEDIR      default PREFIX/include; likewise
#   CMAKEDIR        of the CMake package, default LIBDIR/cmake/superhelix; likewise
#   DESTDIR         stands before every path, for packagers
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

fail() { echo "install.sh: $1" >&2; exit 1; }

build=$(realpath -m "${SHX_BUILD_DIR:-$root/build}")
prefix=${PREFIX:-/usr/local}
destdir=${DESTDIR:-}
case $prefix in
  /*) prefix=$(realpath -m -s "$prefix") ;;
  *) fail "PREFIX is '$prefix': it must be an absolute path" ;;
esac
absolute() { # absolute PATH: from the prefix
  case $1 in
    /*) realpath -m -s "$1" ;;
    *) realpath -m -s "$prefix/$1" ;;
  esac
}
libdir=$(absolute "${LIBDIR:-lib}")
includedir=$(absolute "${INCLUDEDIR:-include}")
cmakedir=$(absolute "${CMAKEDIR:-$libdir/cmake/superhelix}")
licenses=$prefix/share/licenses/superhelix
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml" | head -n 1)
major=${version%%.*}
real=libsuperhelix.so.$version

# Every file that an installation may have.
files=(
  "$includedir/superhelix.h"
  "$includedir/superhelix_inline.h"
  "$libdir/$real" "$libdir/libsuperhelix.so.$major" "$libdir/libsuperhelix.so" "$libdir/libsuperhelix.a"
  "$libdir/superhelix/libsuperhelix.a"
  "$libdir/pkgconfig/superhelix.pc" "$libdir/pkgconfig/superhelix-library.pc"
)
mapfile -t headers < <(cd "$root/bindings/cpp/include" && find superhelix -name '*.hpp' | sort)
for header in "${headers[@]}"; do
  files+=("$includedir/$header")
done
for file in "$root"/packaging/cmake/*.in; do
  name=${file##*/}
  files+=("$cmakedir/${name%.in}")
done
for file in "$root"/LICENSE-*; do
  files+=("$licenses/${file##*/}")
done

case ${1:-} in
  --uninstall)
    for file in "${files[@]}"; do
      rm -f "$destdir$file"
    done
    # Folders of its own, where nobody has put anything else.
    for folder in "$includedir/superhelix/solver" "$includedir/superhelix" "$libdir/superhelix" "$cmakedir" "$licenses"; do
      [ ! -d "$destdir$folder" ] || rmdir --ignore-fail-on-non-empty "$destdir$folder"
    done
    echo "superhelix $version is removed from $destdir$prefix"
    exit
    ;;
  "") ;;
  *) fail "unknown argument '$1': the only one is --uninstall" ;;
esac

[ -f "$build/lib/pkgconfig/superhelix.pc" ] || fail "$build holds no library: run 'make lib' first"
shared='' static=''
[ ! -f "$build/lib/$real" ] || shared=yes
[ ! -f "$build/lib/libsuperhelix.a" ] || static=yes
[ -n "$shared$static" ] || fail "$build holds no library of version $version: run 'make lib' first"

put() { # put MODE SOURCE TARGET
  install -D -m "$1" "$2" "$destdir$3"
}
put 644 "$build/include/superhelix.h" "$includedir/superhelix.h"
put 644 "$build/include/superhelix_inline.h" "$includedir/superhelix_inline.h"
for header in "${headers[@]}"; do
  put 644 "$build/include/$header" "$includedir/$header"
done
if [ -n "$shared" ]; then
  put 755 "$build/lib/$real" "$libdir/$real"
  ln -sf "$real" "$destdir$libdir/libsuperhelix.so.$major"
  ln -sf "libsuperhelix.so.$major" "$destdir$libdir/libsuperhelix.so"
fi
[ -z "$static" ] || put 644 "$build/lib/libsuperhelix.a" "$libdir/libsuperhelix.a"
for file in "$root"/LICENSE-*; do
  put 644 "$file" "$licenses/${file##*/}"
done
"$root/scripts/package_files.sh" "$prefix" "$libdir" "$includedir" "$cmakedir" "$(cat "$build/lib/native_libraries.txt")" "$destdir"

# A library in a directory that the loader knows is found from now on.
if [ -z "$destdir" ] && [ -n "$shared" ] && [ "$(id -u)" = 0 ] && command -v ldconfig >/dev/null 2>&1; then
  if ldconfig -v -N -X 2>/dev/null | grep -q "^$libdir:"; then
    ldconfig
  fi
fi
echo "superhelix $version is installed in $destdir$prefix"
