#!/usr/bin/env bash
# Builds the Godot 3 host into a folder that `godot3-runner --path FOLDER` runs: the project, the library, the NativeScript in C, a head.
#   build.sh LIBRARY HEADERS OUT     the folders of libsuperhelix.so and of superhelix.h; where the project goes
#   GODOT_HEADERS   the folder of gdnative_api_struct.gen.h (github.com/godotengine/godot-headers, branch 3.x). Without it cargo downloads them: the crate
#                   gdnative-sys has a copy (MIT licence), of which nothing is used but these headers. Where it cannot, the exit status is 3
set -euo pipefail
library=$(cd "$1" && pwd)
headers=$(cd "$2" && pwd)
out=$3
cd "$(dirname "$0")/../.."
mkdir -p "$out"

godot_headers=${GODOT_HEADERS:-}
if [ -z "$godot_headers" ]; then
  manifest=$out-headers
  mkdir -p "$manifest/src"
  printf '[package]\nname = "headers"\nversion = "0.0.0"\nedition = "2021"\n[dependencies]\ngdnative-sys = "=0.11.3"\n[workspace]\n' >"$manifest/Cargo.toml"
  : >"$manifest/src/lib.rs"
  godot_headers=$(cargo metadata --quiet --format-version 1 --manifest-path "$manifest/Cargo.toml" |
    python3 -c 'import json, os, sys; print(*(os.path.dirname(p["manifest_path"]) + "/godot_headers" for p in json.load(sys.stdin)["packages"] if p["name"] == "gdnative-sys"))') ||
    { echo "build.sh: cargo cannot download Godot's headers: set GODOT_HEADERS" >&2; exit 3; }
fi
[ -f "$godot_headers/gdnative_api_struct.gen.h" ] || { echo "build.sh: $godot_headers has no gdnative_api_struct.gen.h: set GODOT_HEADERS" >&2; exit 1; }

cp bindings/godot/project/* "$out/"
cp tests/data/grooms/sintel_bust.obj "$out/head.obj"
soname=$(basename "$(ls "$library"/libsuperhelix.so.? | head -n 1)")
cp -L "$library/$soname" "$out/$soname"
sed -i "s/libsuperhelix\.so\.0/$soname/" "$out/superhelix.gdnlib"
"${CC:-cc}" -std=c99 -Wall -Wextra -Wpedantic -Werror -O2 -fPIC -shared -I "$headers" -isystem "$godot_headers" \
  bindings/godot/src/*.c -o "$out/libsuperhelix_godot.so" -L "$library" -lsuperhelix -lm "-Wl,-rpath,\$ORIGIN"
