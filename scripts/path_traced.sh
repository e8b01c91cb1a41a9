#!/usr/bin/env bash
# Makes the pictures that open README: docs/figures/hair_walk.jpg, simulated, with render hair grown, path-traced by Mitsuba 3
# (mitsuba-renderer.org) in an environment of its own, build/venv; and docs/figures/shake_*.png, drawn by the command line. Where Mitsuba is not
# to be had it says so, and leaves the pictures as they are.
#   SUPERHELIX=program      simulates with that program instead of building one
#   PATH_TRACED_SAMPLES=n   a pixel, default 96
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/python_env.sh
python=build/venv/bin/python
if ! "$python" -m pip install --quiet --disable-pip-version-check mitsuba pillow; then
  echo "path_traced.sh: pip finds no Mitsuba for this machine: docs/figures/hair_walk.jpg and shake_*.png stay as they are" >&2
  exit 0
fi
superhelix=${SUPERHELIX:-}
if [ -z "$superhelix" ]; then
  superhelix=${CARGO_TARGET_DIR:-target}/demo/superhelix
  cargo build --locked --profile demo --features cli --bin superhelix
fi
samples=${PATH_TRACED_SAMPLES:-96}
grooms=tests/data/grooms
bust=$grooms/sintel_bust.obj
scale=0.01 # metres a unit of the bust and of what is drawn on it
out=out/path_traced
rm -rf "$out"
mkdir -p "$out"
# Nine tenths of Sintel's guides have another within 1.2 cm.
"$superhelix" place "$bust" --scale "$scale" --count 160 --near "$grooms/sintel_hair_001.tfx" --within 0.012 --out "$out/follicles.csv"
"$python" docs/figures/drawn_grooms.py "$out/follicles.csv" "$bust" "$scale" "$out"

simulate() { # simulate NAME GROOM MOTION SECONDS FRAMES: the frames that are wanted, and the first, in NAME/some
  local name=$1 groom=$2 motion=$3 seconds=$4 frames=$5
  shift 5
  "$superhelix" simulate "$groom" --scale "$scale" --body "$bust" --motion "$motion" --duration "$seconds" --fps 24 --substeps 4 \
    --contact penalty --allow-overlaps --threads "$(getconf _NPROCESSORS_ONLN)" --format hair --samples 65 \
    --out "$out/$name/all" "$@"
  mkdir -p "$out/$name/some"
  for frame in 1 $frames; do
    cp "$(printf '%s/hair.%04d.hair' "$out/$name/all" "$frame")" "$out/$name/some/"
  done
}
grow() { # grow NAME HAIRS FLAGS...: render hair of these frames, in NAME/render
  local name=$1 hairs=$2
  shift 2
  "$superhelix" interpolate "$out/$name/some" --scale "$scale" --scalp "$bust" --count "$hairs" --out "$out/$name/render" "$@"
}
trace() { # trace NAME PICTURE FLAGS...: all frames but the first, which only says where the head was
  local name=$1 picture=$2
  shift 2
  local frames=("$out/$name/render"/*.hair)
  echo "path tracing $picture (about a minute a panel)"
  "$python" docs/figures/path_trace.py "$picture" --hair "${frames[@]:1}" --rest "${frames[0]}" --body "$bust" --scale "$scale" \
    --samples "$samples" "$@"
}
simulate walk "$grooms/sintel_hair_001.tfx" "$grooms/walk_figure8_head.csv" 1.5 "30" --hair-contact 0.002
grow walk 60000 --points 24 --frizz 0.0006
trace walk docs/figures/hair_walk.jpg

# The same shake, five moments, drawn by the command line itself.
shake() { # shake NAME COLOUR
  simulate "$1" "$out/$1.hair" "$out/shake.csv" 1.0 "6 11 16 21" --hold 0.35
  "$superhelix" picture "$out/$1/some" --scale "$scale" --body "$bust" --plain --moments 5 --cell 250 --views three-quarter \
    --colour "$2" --threads "$(getconf _NPROCESSORS_ONLN)" --out "docs/figures/shake_$1.png"
}
shake straight dark-brown
shake curls auburn
