#!/usr/bin/env bash
# How long it takes from nothing to hair, host by host: installs, runs, draws, scrubs and bakes in folders of its own, out/hosts, and leaves
# docs/figures/hosts.csv: host, step, seconds, seconds of processor. Usage: scripts/hosts.sh [HOST ...], of
# library command_line c cpp csharp webassembly python usd alembic godot blender_5.0 blender_4.5 compare (default: all). What is not there is left out, and
# that is said. `compare` says which hosts' frames are the same to the bit, and fails where they must be and are not: scripts/hosts/compare.py.
# Environment:
#   SUPERHELIX_BUILD    a folder with lib/ and include/; else the step `library` builds it, with SHX_PROFILE (default demo)
#   SUPERHELIX_BINARY   the command line; else the same step builds it
set -euo pipefail
cd "$(dirname "$0")/.."

out=$PWD/out/hosts
grooms=$PWD/tests/data/grooms
profile=${SHX_PROFILE:-demo}
build=${SUPERHELIX_BUILD:-$out/library/build}
binary=${SUPERHELIX_BINARY:-$out/library/target/$profile/superhelix}
threads=$(getconf _NPROCESSORS_ONLN)
table=docs/figures/hosts.csv
# What a user has: nothing set.
unset PYTHONPATH SUPERHELIX_LIBRARY
mkdir -p "$out"
[ -s "$table" ] || echo "host,step,seconds,processor_seconds" >"$table"

# The rows of a host are replaced by those of its new run.
begin() {
  host=$1
  folder=$out/$host
  rm -rf "$folder"
  mkdir -p "$folder"
  sed -i "/^$host,/d" "$table"
}
put() { # put STEP SECONDS PROCESSOR
  echo "$host,$1,$2,$3" | tee -a "$table"
}
timed() { # timed STEP COMMAND...
  local step=$1 times
  shift
  TIMEFORMAT="%R %U %S"
  times=$({ time "$@" >"$folder/$step.txt" 2>&1; } 2>&1) || { tail -n 20 "$folder/$step.txt" >&2; echo "hosts.sh: $host: $step fails" >&2; exit 1; }
  read -r wall user system <<<"$times"
  put "$step" "$wall" "$(awk "BEGIN { print $user + $system }")"
}
absent() {
  echo "hosts.sh: $1: left out: $2"
}

host_library() {
  begin library
  # Everything compiled anew, dependencies too.
  timed library env CARGO_TARGET_DIR="$folder/target" SHX_PROFILE="$profile" SHX_LINKAGE=shared SHX_BUILD_DIR="$out/library/build" scripts/build_lib.sh
  timed command_line env CARGO_TARGET_DIR="$folder/target" cargo build --quiet --locked --profile "$profile" --features cli --bin superhelix
  build=$out/library/build
  binary=$folder/target/$profile/superhelix
}
simulate() { # simulate FORMAT
  "$binary" simulate "$grooms/sintel_hair_001.tfx" --scale 0.01 --body "$folder/bust.obj" --body-cell 0.005 --motion "$grooms/walk_figure8_head.csv" --duration 4.125 --fps 24 \
    --substeps 2 --threads "$threads" --samples 32 --format "$1" --out "$folder/$1" --quiet
}
host_command_line() {
  begin command_line
  # The grid of distances is kept beside the mesh.
  cp "$grooms/sintel_bust.obj" "$folder/bust.obj"
  timed run simulate hair
  timed draw "$binary" picture "$folder/hair" --scale 0.01 --body "$folder/bust.obj" --moments 1 --threads "$threads" --out "$folder/walk.png"
  timed bake simulate usda
}
host_c() {
  begin c
  timed install cc -std=c99 -O2 -I "$build/include" examples_c/groom.c -o "$folder/groom" -L "$build/lib" -lsuperhelix -lm -Wl,-rpath,"$(cd "$build/lib" && pwd)"
  mkdir -p "$folder/frames"
  timed run "$folder/groom" "$grooms/sintel_hair_001.tfx" "$grooms/walk_figure8_head.csv" "$folder/frames" --scale 0.01 --body "$grooms/sintel_bust.obj" \
    --seconds 4.125 --rate 24 --substeps 2 --threads "$threads" --format hair
  timed draw "$binary" picture "$folder/frames" --scale 1 --body "$grooms/sintel_bust.obj" --body-scale 0.01 --moments 1 --threads "$threads" --out "$folder/walk.png"
}
host_cpp() {
  begin cpp
  if ! command -v cmake >/dev/null; then absent cpp "no cmake"; return; fi
  both() { cmake -S bindings/cpp/examples -B "$folder/build" -DCMAKE_PREFIX_PATH="$(cd "$build" && pwd)" && cmake --build "$folder/build"; }
  timed install both
  "$binary" convert "$grooms/sintel_hair_001.tfx" "$folder/hair.hair" --scale 0.01 >"$folder/convert.txt" 2>&1
  awk '/^v / { print "v", $2 / 100, $3 / 100, $4 / 100; next } { print }' "$grooms/sintel_bust.obj" >"$folder/bust.obj"
  timed run "$folder/build/game_loop" "$folder/hair.hair" "$folder/bust.obj" "$grooms/walk_figure8_head.csv" 4.125
}
host_csharp() {
  begin csharp
  if ! command -v mcs >/dev/null; then absent csharp "no mono"; return; fi
  compile() {
    find bindings/csharp/com.superhelix.hair/Runtime -name '*.cs' -print0 | xargs -0 mcs -unsafe -langversion:7.2 -target:library -out:"$folder/Superhelix.dll"
    mcs -unsafe -r:"$folder/Superhelix.dll" -out:"$folder/hello.exe" bindings/csharp/examples/Hello.cs
  }
  timed install compile
  timed run env LD_LIBRARY_PATH="$build/lib" mono "$folder/hello.exe"
}
host_webassembly() {
  begin webassembly
  if ! command -v node >/dev/null; then absent webassembly "no node"; return; fi
  timed install scripts/wasm.sh
  if grep -q SKIPPED "$folder/install.txt"; then absent webassembly "no standard library for it"; sed -i "/^webassembly,/d" "$table"; return; fi
  timed run node examples_wasm/hello.mjs build/wasm/superhelix.wasm
}
fresh_python() { # fresh_python [EXTRA]: as a user installs it, with the library that is there
  python3 -m venv "$folder/venv"
  SUPERHELIX_LIBRARY=$(cd "$build/lib" && pwd)/libsuperhelix.so "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check "./bindings/python$1"
}
walk() {
  "$folder/venv/bin/python" scripts/hosts/walk.py "$@"
}
host_python() {
  begin python
  timed install fresh_python ""
  timed run walk run "$folder"
  "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check matplotlib
  timed draw walk draw "$folder"
  timed scrub walk scrub "$folder"
  cat "$folder/scrub.txt"
  timed bake walk bake "$folder" hair.usda
}
cache() { # cache HOST EXTRA FILE
  begin "$1"
  timed install fresh_python "$2"
  timed bake walk bake "$folder" "$3"
  timed scrub walk read "$folder" "$3"
  cat "$folder/scrub.txt"
}
host_usd() { cache usd "[usd]" hair.usdc; }
host_alembic() { cache alembic "" hair.abc; }
host_godot() {
  begin godot
  if ! command -v godot3-runner >/dev/null; then absent godot "no godot3-runner (apt-get install godot3-runner xvfb libgl1-mesa-dri)"; return; fi
  timed install bindings/godot/build.sh "$(cd "$build/lib" && pwd)" "$(cd "$build/include" && pwd)" "$folder/project"
  SUPERHELIX_BUILD=$build timed run scripts/test_godot.sh picture "$folder/hair.png"
}
blender() { # blender VERSION
  begin "blender_${1%.*}"
  fresh_blender() {
    python3 -m venv "$folder/venv"
    "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check "bpy==$1" setuptools wheel
  }
  pack() { SUPERHELIX_LIBRARY=$(cd "$build/lib" && pwd)/libsuperhelix.so "$folder/venv/bin/python" bindings/blender/pack.py --out "$folder"; }
  timed pip fresh_blender "$1"
  timed pack pack
  timed all "$folder/venv/bin/python" scripts/hosts/blender_walk.py "$(find "$folder" -maxdepth 1 -name '*.zip')" "$folder"
  grep '^STEP' "$folder/all.txt" | while read -r _ step seconds processor; do put "$step" "$seconds" "$processor"; done
  for other in alembic/hair.abc usd/hair.usdc; do
    [ ! -e "$out/$other" ] || timed "draw_${other#*.}" "$folder/venv/bin/python" scripts/hosts/blender_walk.py "$out/$other" "$folder"
  done
}
host_compare() {
  "$out/usd/venv/bin/python" scripts/hosts/compare.py "$out" | tee "$out/compare.txt"
}
host_blender_5.0() { blender 5.0.1; }
host_blender_4.5() { blender 4.5.15; }

everything="command_line c cpp csharp webassembly python usd alembic godot blender_5.0 blender_4.5 compare"
[ -n "${SUPERHELIX_BUILD:-}" ] || everything="library $everything"
for name in ${*:-$everything}; do
  "host_$name"
done
