#!/usr/bin/env bash
# Makes of rustc's static library one that defines no global name but those of a list: a single object, so that Rust's own symbols
# and those of dependencies cannot collide with another Rust library of the same program.
# Usage: scripts/localise_symbols.sh INPUT.a NAMES.txt OUTPUT.a [OPTION OF LD...]
# LD (GNU's), OBJCOPY, AR and NM name the tools of another target.
set -euo pipefail
export LC_ALL=C

input=$1 names=$2 output=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Groups are dissolved: a linker would take local symbols of the same group in two libraries for copies of each other, and drop one.
sed 's/^/--undefined=/' "$names" >"$work/roots"
"${LD:-ld}" -r "$@" --gc-sections --force-group-allocation "@$work/roots" -o "$work/superhelix.o" "$input"
# Bitcode of the standard library serves nobody, and linkers with an LLVM of another version stumble over it.
"${OBJCOPY:-objcopy}" --keep-global-symbols="$names" --remove-section=.llvmbc --remove-section=.llvmcmd "$work/superhelix.o"
# Sections that nobody needs are gone, and what they alone asked for goes too: a linker warns of some of these names.
undefined() { "${NM:-nm}" --undefined-only --format=just-symbols "$1" | sort -u; }
"${OBJCOPY:-objcopy}" --strip-unneeded "$work/superhelix.o" "$work/needed.o"
comm -23 <(undefined "$work/superhelix.o") <(undefined "$work/needed.o") >"$work/unused"
# objcopy fails on an empty list.
[ ! -s "$work/unused" ] || "${OBJCOPY:-objcopy}" --strip-symbols="$work/unused" "$work/superhelix.o"

globals=$("${NM:-nm}" --defined-only --extern-only --format=just-symbols "$work/superhelix.o" | sort)
if [ "$globals" != "$(sort "$names")" ]; then
  echo "localise_symbols.sh: the global names of $output are not those of $names:" >&2
  diff <(sort "$names") <(echo "$globals") >&2 || true
  exit 1
fi
rm -f "$output"
"${AR:-ar}" rcsD "$output" "$work/superhelix.o"
chmod 644 "$output"
