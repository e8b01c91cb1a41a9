#!/usr/bin/env bash
# Makes the path-traced pictures of README and docs: simulated, with render hair grown, by Mitsuba 3 (mitsuba-renderer.org) in an environment of
# its own, build/venv. Where Mitsuba is not to be had it says so, and leaves the pictures as they are.
#   path_traced.sh [walk] [hold] [straight] [curls] [types] [kinds]    makes some of them; without any, all
#   SUPERHELIX=program      simulates with that program instead of building one
#   PATH_TRACED_SAMPLES=n   a pixel, default 40
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/python_env.sh
python=build/venv/bin/python
if ! "$python" -m pip install --quiet --disable-pip-version-check mitsuba pillow; then
  echo "path_traced.sh: pip finds no Mitsuba for this machine: the path-traced pictures stay as they are" >&2
  exit 0
fi
superhelix=${SUPERHELIX:-}
if [ -z "$superhelix" ]; then
  superhelix=${CARGO_TARGET_DIR:-target}/demo/superhelix
  cargo build --locked --profile demo --features cli --bin superhelix
fi
samples=${PATH_TRACED_SAMPLES:-40}
threads=$(getconf _NPROCESSORS_ONLN)
grooms=tests/data/grooms
sintel=$grooms/sintel_hair_001.tfx
bust=$grooms/sintel_bust.obj
walk=$grooms/walk_figure8_head.csv
scale=0.01 # metres a unit of the bust and of what is drawn on it
out=out/path_traced
mkdir -p "$out"

simulate() { # simulate NAME GROOM MOTION SECONDS FRAMES FLAGS...: the first frame and those that are wanted, in NAME/guides
  local name=$1 groom=$2 motion=$3 seconds=$4 frames=$5
  shift 5
  rm -rf "${out:?}/$name"
  "$superhelix" simulate "$groom" --scale "$scale" --body "$bust" --motion "$motion" --duration "$seconds" --fps 24 --substeps 2 \
    --contact penalty --hair-contact 0.002 --threads "$threads" --format hair --samples 65 --out "$out/$name/all" "$@"
  mkdir -p "$out/$name/guides"
  for frame in 1 $frames; do
    cp "$(printf '%s/hair.%04d.hair' "$out/$name/all" "$frame")" "$out/$name/guides/"
  done
}
grow() { # grow NAME HAIRS FLAGS...: render hair of these frames, in NAME/render
  local name=$1 hairs=$2
  shift 2
  "$superhelix" interpolate "$out/$name/guides" --scale "$scale" --scalp "$bust" --count "$hairs" --threads "$threads" \
    --out "$out/$name/render" "$@"
}
trace() { # trace PICTURE FLAGS...
  local picture=$1
  shift
  echo "path tracing $picture"
  "$python" docs/figures/path_trace.py "docs/figures/$picture" --samples "$samples" "$@"
}
frame() { # frame NAME K: render hair of the K-th of the frames that are kept, from 1
  find "$out/$1/render" -name '*.hair' | sort | sed -n "$2p"
}
bust_flags=(--body "$bust" --scale "$scale")
looks=(--points 24 --wisps 6 --wisp-profile 1,0.75,0.3 --frizz 0.0008 --flyaways 0.01 --flyaway-distance 0.003)

make_walk() {
  simulate walk "$sintel" "$walk" 1.5 "30"
  grow walk 60000 "${looks[@]}"
  trace hair_walk.jpg --hair "$(frame walk 2)" --rest "$(frame walk 1)" "${bust_flags[@]}"
}

# The same moment of the walk, from single hairs to lacquer.
make_hold() {
  local hold frames=()
  for hold in bare 0 0.4 0.7 1; do
    if [ "$hold" = bare ]; then flags=(--bare); else flags=(--hold "$hold"); fi
    simulate "hold_$hold" "$sintel" "$walk" 1.75 "42" "${flags[@]}"
    grow "hold_$hold" 60000 "${looks[@]}"
    frames+=("$(frame "hold_$hold" 2)")
  done
  trace hold.jpg --hair "${frames[@]}" --rest "$(frame hold_bare 1)" "${bust_flags[@]}" --labels bare "hold 0" "hold 0.4" "hold 0.7" "hold 1" \
    --width 340 --pixels 425 --height 0.40 --lift -0.05
}

# Long hair drawn by formula, before, in and after a shake.
draw_grooms() {
  local made=$out/shake.csv
  if [ ! -e "$made" ] || [ docs/figures/drawn_grooms.py -nt "$made" ] || [ scripts/path_traced.sh -nt "$made" ]; then
    # Nine tenths of Sintel's guides have another within 1.2 cm; her parting is wider and would be bald above the forehead.
    "$superhelix" place "$bust" --scale "$scale" --count 400 --near "$sintel" --within 0.017 --out "$out/follicles.csv"
    "$python" docs/figures/drawn_grooms.py "$out/follicles.csv" "$bust" "$scale" "$out"
  fi
}
make_straight() {
  draw_grooms
  simulate straight "$out/straight.hair" "$out/shake.csv" 2.2 "16 53" --hold 0.35
  grow straight 60000 --points 33 --curliness 0.3 --max-tip-distance 0.04 --wisps 6 --wisp-profile 1,0.8,0.4 --frizz 0.0008 \
    --flyaways 0.01 --flyaway-distance 0.003
  trace hair_straight.jpg --hair "$(frame straight 1)" "$(frame straight 2)" "$(frame straight 3)" "${bust_flags[@]}" --colour dark-brown \
    --width 420 --pixels 500 --height 0.50 --lift -0.13
}
make_curls() {
  draw_grooms
  simulate curls "$out/curls.hair" "$out/shake.csv" 2.2 "16 53" --hold 0.35
  grow curls 60000 --points 65 --space curvature --curliness 0.8 --max-tip-distance 0.06 --wisps 2 --wisp-profile 1,0.5,0.25 --frizz 0.001 \
    --free-length --length-variation 0.1 --flyaways 0.01 --flyaway-distance 0.003
  trace hair_curls.jpg --hair "$(frame curls 1)" "$(frame curls 2)" "$(frame curls 3)" "${bust_flags[@]}" --colour auburn \
    --width 420 --pixels 460 --height 0.44 --lift -0.10
}

# Locks of 30 cm, at rest.
make_types() {
  local kind frames=()
  for kind in asian caucasian1 caucasian2 african h1 h2 ga1 gc3; do
    rm -rf "$out/type_$kind"
    mkdir -p "$out/type_$kind"
    "$superhelix" lock --type "$kind" --length 0.3 --strands 40 --spacing 0.002 --up y --direction 0,-1,0 --out "$out/type_$kind/lock.json"
    "$python" - "$out/type_$kind/lock.json" <<'EOF'
import json, sys
scene = json.load(open(sys.argv[1]))
scene["duration"], scene["samples"] = 0, 257
json.dump(scene, open(sys.argv[1], "w"))
EOF
    "$superhelix" run "$out/type_$kind/lock.json" --settle --cache "$out/type_$kind/lock.usda" --out "$out/type_$kind/result.json" --quiet
    "$superhelix" interpolate "$out/type_$kind/lock.usda" --count 800 --points 257 --space curvature --curliness 0.3 --wisps 1 \
      --free-length --length-variation 0.08 --flyaways 0 --out "$out/type_$kind/render.hair"
    frames+=("$out/type_$kind/render.hair")
  done
  trace hair_types.jpg --hair "${frames[@]}" --labels asian caucasian1 caucasian2 african h1 h2 ga1 gc3 \
    --width 170 --pixels 540 --height 0.36 --lift -0.15 --turn 0 --radius 5.5e-5 --thin 0.7
}

# Figure 4 of Bertails et al. 2006, from every fourth of Sintel's guides, drawn by the command line itself.
make_kinds() {
  local kind name of frames=()
  mkdir -p "$out/kinds"
  for kind in "a --curliness 0 --length-variation 0" "b" "c --curliness 1 --wisps 2" "d --curliness 0 --length-variation 0 --max-tip-ratio 0.25" \
    "e --curliness 0 --length-variation 0 --max-tip-ratio 0"; do
    read -r name of <<<"$kind"
    # shellcheck disable=SC2086
    "$superhelix" interpolate "$sintel" --scale "$scale" --every 4 --scalp "$bust" --count 20000 --points 33 --out "$out/kinds/$name.hair" $of
    frames+=("$out/kinds/$name.hair")
  done
  "$superhelix" picture "${frames[@]}" --scale "$scale" --body "$bust" --plain --moments 5 --cell 300 --views three-quarter --hairs 0 \
    --colour auburn --threads "$threads" --out docs/figures/render_hair.png
}

for picture in ${*:-walk hold straight curls types kinds}; do
  "make_$picture"
done
