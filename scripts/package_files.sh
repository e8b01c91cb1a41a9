#!/usr/bin/env bash
# Writes the pkg-config files and the CMake package of an installation, from packaging/, into LIBDIR/pkgconfig and CMAKEDIR.
# They find everything from where they lie, so that an installation can be moved.
# Usage: scripts/package_files.sh PREFIX LIBDIR INCLUDEDIR CMAKEDIR NATIVE_LIBRARIES [DESTDIR]
#   PREFIX, LIBDIR, INCLUDEDIR, CMAKEDIR   absolute paths of the installation
#   NATIVE_LIBRARIES                       what the static library needs, as "-lm -lpthread"
#   DESTDIR                                stands before every path while files are laid out
# Which of the libraries there are is read from DESTDIR LIBDIR.
set -euo pipefail
cd "$(dirname "$0")/.."

prefix=$1 libdir=$2 includedir=$3 cmake=$4 native=$5 destdir=${6:-}
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
pkgconfig=$libdir/pkgconfig

relative() { # relative TO FROM: both are paths that need not exist
  realpath -m -s --relative-to="$2" "$1"
}
# In the prefix a path is written from the prefix, elsewhere it is absolute.
from_prefix() {
  case $1 in
    "$prefix"/*) echo "\${prefix}/${1#"$prefix"/}" ;;
    *) echo "$1" ;;
  esac
}

shared='' static=''
[ -e "$destdir$libdir/libsuperhelix.so.$version" ] && shared=yes
[ -e "$destdir$libdir/libsuperhelix.a" ] && static=yes
if [ "$shared$static" = yesyes ]; then
  # A linker looks for -lsuperhelix in directory after directory, and takes the shared library where it finds both. With --static the
  # first directory is one that holds the static library alone. That directory has to come first, so the rest is another package.
  libs="Requires: superhelix-library
Libs.private: -L\${libdir}/superhelix"
elif [ "$static" = yes ]; then
  libs="Libs: -L\${libdir} -lsuperhelix $native"
else
  libs="Libs: -L\${libdir} -lsuperhelix"
fi
# The class of the objects, 1 or 2: 32 or 64 bit.
if [ "$shared" = yes ]; then
  object() { cat "$destdir$libdir/libsuperhelix.so.$version"; }
else
  object() { "${AR:-ar}" p "$destdir$libdir/libsuperhelix.a"; }
fi
pointer=$((4 * $(od -An -tu1 -j4 -N1 <(object 2>/dev/null))))


fill() { # fill TEMPLATE OUTPUT
  local text
  text=$(<"$1")
  text=${text//@VERSION@/$version}
  text=${text//@VERSION_MAJOR@/${version%%.*}}
  text=${text//@VERSION_MINOR@/$(cut -d. -f2 <<<"$version")}
  text=${text//@PREFIX_FROM_PKGCONFIG@/$(relative "$prefix" "$pkgconfig")}
  text=${text//@PREFIX_FROM_CMAKE@/$(relative "$prefix" "$cmake")}
  text=${text//@INCLUDEDIR@/$(from_prefix "$includedir")}
  text=${text//@LIBDIR@/$(from_prefix "$libdir")}
  text=${text//@INCLUDEDIR_FROM_PREFIX@/$(relative "$includedir" "$prefix")}
  text=${text//@LIBDIR_FROM_PREFIX@/$(relative "$libdir" "$prefix")}
  text=${text//@LIBS@/$libs}
  text=${text//@NATIVE_LIBRARIES@/$native}
  text=${text//@STATIC_LIBRARIES@/$(sed 's/-l//g; s/ \+/;/g' <<<"$native")}
  text=${text//@POINTER_BYTES@/$pointer}
  text=${text//@POINTER_BITS@/$((8 * pointer))}
  if [[ $text =~ @[A-Z_]+@ ]]; then
    echo "package_files.sh: $1 has the unknown ${BASH_REMATCH[0]}" >&2
    exit 1
  fi
  printf '%s\n' "$text" >"$2"
  chmod 644 "$2"
}

mkdir -p "$destdir$pkgconfig" "$destdir$cmake"
fill packaging/pkgconfig/superhelix.pc.in "$destdir$pkgconfig/superhelix.pc"
if [ "$shared$static" = yesyes ]; then
  fill packaging/pkgconfig/superhelix-library.pc.in "$destdir$pkgconfig/superhelix-library.pc"
  mkdir -p "$destdir$libdir/superhelix"
  ln -sf ../libsuperhelix.a "$destdir$libdir/superhelix/libsuperhelix.a"
else
  rm -f "$destdir$pkgconfig/superhelix-library.pc" "$destdir$libdir/superhelix/libsuperhelix.a"
fi
for file in packaging/cmake/*.in; do
  name=${file##*/}
  fill "$file" "$destdir$cmake/${name%.in}"
done
