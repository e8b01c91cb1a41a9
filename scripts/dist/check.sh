#!/usr/bin/env bash
# Uses the release as strangers do: unpacks the archive, installs the Debian packages into a root of their own, builds the examples
# against each with pkg-config and CMake, shared and static, and runs them. Nothing of the repository is used but the files of DIST.
# DIST: default out/dist.
set -euo pipefail
cd "$(dirname "$0")/../.."

dist=$(realpath -m "${DIST:-out/dist}")
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
glibc=${SHX_GLIBC:-2.17}
name=superhelix-$version-$(uname -m)-linux
scripts=$PWD/scripts/dist
python=$PWD/build/dist/venv/bin/python
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "check.sh: $1" >&2; exit 1; }

uses() { # uses EXAMPLES PREFIX LIBDIR: hello by pkg-config and CMake, shared and static, prints the same each time
  local out=$work/use linkage printed="" now
  rm -rf "$out"
  cp -r "$1" "$out"
  make -s -C "$out" -j2 BUILD= OUT="$out/pc" PKG_CONFIG_PATH="$3/pkgconfig" "$out/pc/shared/hello" "$out/pc/static/hello"
  for linkage in shared static; do
    cmake -S "$out" -B "$out/$linkage" -DCMAKE_PREFIX_PATH="$2" -DCMAKE_LIBRARY_ARCHITECTURE="$(uname -m)-linux-gnu" \
      -DSUPERHELIX_STATIC="$([ $linkage = static ] && echo ON || echo OFF)" >/dev/null
    cmake --build "$out/$linkage" --target hello >/dev/null
    for program in "$out/pc/$linkage/hello" "$out/$linkage/hello"; do
      now=$("$program")
      [ -z "$printed" ] || [ "$now" = "$printed" ] || fail "$program prints something else: $now"
      printed=$now
      if readelf -d "$program" | grep -q libsuperhelix; then
        [ $linkage = shared ] || fail "$program is linked to the shared library"
      else
        [ $linkage = static ] || fail "$program is not linked to the shared library"
      fi
    done
  done
  [ "$(wc -l <<<"$printed")" = 6 ] || fail "hello prints: $printed"
  echo "$2: pkg-config and CMake, shared and static"
}

(cd "$dist" && sha256sum --quiet --check "$name.tar.gz.sha256")
tar xf "$dist/$name.tar.gz"
archive=$work/$name
echo "the shared library needs glibc $("$scripts/glibc.sh" "$archive/lib/libsuperhelix.so" "$glibc")"
docs=$archive/share/doc/superhelix
licenses=$archive/share/licenses/superhelix
"$python" -B "$scripts/check_sbom.py" "$docs/superhelix.cdx.json"
for file in "$archive/LICENSE-MIT" "$archive/LICENSE-APACHE" "$licenses/third_party.txt" "$licenses/rust_standard_library.html" \
  "$docs/README.md" "$docs/CHANGELOG.md" "$docs/docs/reference/overview.md"; do
  [ -s "$file" ] || fail "the archive lacks ${file#"$archive/"}"
done
# Everything in the bill has its licence.
"$python" - "$docs/superhelix.cdx.json" "$licenses/third_party.txt" <<'PYTHON'
import json, sys
bill, texts = json.load(open(sys.argv[1])), open(sys.argv[2], encoding="utf-8").read()
missing = [c["name"] for c in bill["components"] if "purl" in c and f"{c['name']} {c['version']}: " not in texts]
sys.exit(f"check.sh: no licence of {missing}" if missing or len(bill["components"]) < 2 else 0)
PYTHON
uses "$docs/examples_c" "$archive" "$archive/lib"

packages=("$dist"/libsuperhelix*.deb)
if [ -e "${packages[0]}" ]; then
  [ ${#packages[@]} = 2 ] || fail "there are ${#packages[@]} Debian packages: ${packages[*]}"
  system=$work/system
  mkdir -p "$system/var/lib/dpkg/"{info,updates} "$system/usr/bin"
  : >"$system/var/lib/dpkg/status"
  if [ "$(id -u)" = 0 ]; then
    # The C library is not there.
    dpkg --root="$system" --force-depends --install "${packages[@]}" >"$work/dpkg.log" 2>&1 || { cat "$work/dpkg.log" >&2; fail "dpkg failed"; }
    for package in "${packages[@]}"; do
      state=$(dpkg-query --admindir="$system/var/lib/dpkg" -W -f '${db:Status-Status}' "$(dpkg-deb -f "$package" Package)")
      [ "$state" = installed ] || fail "$package is $state"
    done
  else
    for package in "${packages[@]}"; do dpkg-deb -x "$package" "$system"; done
  fi
  (cd "$system" && for list in "${packages[@]}"; do dpkg-deb --ctrl-tarfile "$list" | tar xO ./md5sums | md5sum --quiet --check; done)
  uses "$system/usr/share/doc/libsuperhelix-dev/examples" "$system/usr" "$system/usr/lib/$(uname -m)-linux-gnu"
fi
