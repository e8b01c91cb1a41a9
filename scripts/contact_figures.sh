#!/usr/bin/env bash
# Makes the pictures of scenes with contact: hair that falls on shoulders, a sphere of hair before, while and after it is combed.
set -euo pipefail
cd "$(dirname "$0")/.."
out=out/scenes
superhelix=${CARGO_TARGET_DIR:-target}/demo/superhelix

cargo build --quiet --locked --profile demo --features cli --bin superhelix
mkdir -p "$out"
python3 examples/scenes/make_scenes.py
for name in shoulder combed_sphere; do
  "$superhelix" run "examples/scenes/$name.json" --out "$out/$name.json" --quiet
done
"$superhelix" picture "$out/shoulder.json" --scene examples/scenes/shoulder.json --up z --moments 4 --cell 300 \
  --title "Hair falls on shoulders" --out docs/figures/contact_shoulder.png --quiet
"$superhelix" picture "$out/combed_sphere.json" --scene examples/scenes/combed_sphere.json --up z --moments 5 --cell 300 \
  --title "A sphere of hair is combed" --out docs/figures/contact_combed_sphere.png --quiet
