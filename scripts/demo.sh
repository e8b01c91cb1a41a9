#!/usr/bin/env bash
# The demonstration: builds the C library and examples_c/groom.c, simulates a real groom on a recorded walk for 3 s, leaves the frames
# and a contact sheet in out/demo/.
set -euo pipefail
cd "$(dirname "$0")/.."
started=$SECONDS

groom=tests/data/grooms/sintel_hair_001.tfx # 228 strands; metres a unit: tests/data/grooms/README.md
scale=0.01
motion=tests/data/grooms/walk_figure8_head.csv
out=out/demo
build=build/demo
target=${CARGO_TARGET_DIR:-target}

# The command line first: it compiles every dependency, once, and the library needs a part of the same.
echo "== building the command line and the C library (profile demo)"
cargo build --quiet --locked --profile demo --features cli --bin superhelix
SHX_PROFILE=demo SHX_BUILD_DIR=$build scripts/build_lib.sh
cc -std=c99 -Wall -Wextra -Wpedantic -Werror -O2 -I "$build/include" examples_c/groom.c -o "$build/groom" \
  -L "$build/lib" -lsuperhelix -lm -Wl,-rpath,"$PWD/$build/lib"
echo "== built in $((SECONDS - started)) s"

rm -rf "$out"
mkdir -p "$out/frames"
"$build/groom" "$groom" "$motion" "$out/frames" --scale "$scale" --seconds 3 --rate 60 --threads 2 --format obj
"$target/demo/superhelix" picture "$out/frames" --out "$out/contact_sheet.png" --fps 60 --scale 1 \
  --title "Sintel's hair on a recorded walk"

echo "== done in $((SECONDS - started)) s"
echo "frames:        $PWD/$out/frames/ ($(find "$out/frames" -name '*.obj' | wc -l) Wavefront OBJ files, one a frame at 60 Hz)"
echo "contact sheet: $PWD/$out/contact_sheet.png"
