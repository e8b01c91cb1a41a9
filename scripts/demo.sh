#!/usr/bin/env bash
# The demonstration: a C program hosts a real groom on a bust that it collides with, on a recorded walk of 3 s, and 20,000 render hairs that
# follow it; the command line draws them, lit. Leaves the frames, an animation and a contact sheet in out/demo/.
#   DEMO_THREADS   default: one for each core
set -euo pipefail
cd "$(dirname "$0")/.."

grooms=tests/data/grooms
groom=$grooms/sintel_hair_001.tfx # 228 strands; metres a unit: tests/data/grooms/README.md
body=$grooms/sintel_bust.obj
scale=0.01
motion=$grooms/walk_figure8_head.csv
out=out/demo
build=build/demo
target=${CARGO_TARGET_DIR:-target}
threads=${DEMO_THREADS:-$(getconf _NPROCESSORS_ONLN)}
soname=libsuperhelix.so.$(sed -n 's/^version = "\([0-9]*\).*/\1/p' Cargo.toml | head -n 1)

began=$SECONDS
phase() { # phase TEXT COMMAND...: says what begins, does it, says how long it took
  local title=$1 from=$SECONDS
  shift
  echo "== $title"
  "$@"
  echo "== took $((SECONDS - from)) s ($((SECONDS - began)) s so far)"
}

# One compilation of the crate and of each dependency: the shared library is linked out of what the command line is linked from.
compile() {
  cargo build --locked --profile demo --features cli --lib --bin superhelix
  mkdir -p "$build"
  "${RUSTC:-rustc}" --edition 2024 --crate-type cdylib tests/c/library.rs -o "$build/$soname" \
    --extern "superhelix=$target/demo/libsuperhelix.rlib" -L "dependency=$target/demo/deps" -C "link-arg=-Wl,-soname,$soname"
  ln -sf "$soname" "$build/libsuperhelix.so"
  cc -std=c99 -Wall -Wextra -Wpedantic -Werror -O2 -I include examples_c/groom.c -o "$build/groom" \
    -L "$build" -lsuperhelix -lm -Wl,-rpath,"$PWD/$build"
}

simulate() {
  rm -rf "$out"
  mkdir -p "$out/frames" "$out/render"
  "$build/groom" "$groom" "$motion" "$out/frames" --scale "$scale" --body "$body" --wisp 0.002 --seconds 3 --rate 24 --substeps 2 \
    --threads "$threads" --format obj --hairs 20000 --render "$out/render"
}

# The hair is in metres, the bust in centimetres.
draw() {
  "$target/demo/superhelix" picture "$out/render" --scale 1 --body "$body" --body-scale "$scale" --fps 24 --threads "$threads" \
    --animate "$out/walk.png" --out "$out/contact_sheet.png" --moments 5 --title "Sintel's hair on a recorded walk"
}

phase "compiling the command line, the C library and examples_c/groom.c (the longest part)" compile
phase "simulating 3 s of a recorded walk: hair on the bust and on hair" simulate
phase "drawing 73 frames and a contact sheet" draw

echo "== done in $((SECONDS - began)) s"
echo "animation:     $PWD/$out/walk.png (an animated PNG: open it in a browser)"
echo "contact sheet: $PWD/$out/contact_sheet.png"
echo "frames:        $PWD/$out/frames/ (strands, Wavefront OBJ) and $PWD/$out/render/ (render hair, .hair), 24 a second"
echo "Hair and bust: (c) Blender Foundation, durian.blender.org, CC-BY-3.0"
