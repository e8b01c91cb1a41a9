#!/usr/bin/env bash
# Makes the pictures of scenes with contact: hair that falls on shoulders, the same where nothing keeps it out, a sphere of hair before,
# while and after it is combed.
#   SUPERHELIX=program    draws with that program instead of building one
set -euo pipefail
cd "$(dirname "$0")/.."
out=out/scenes
superhelix=${SUPERHELIX:-}
if [ -z "$superhelix" ]; then
  superhelix=${CARGO_TARGET_DIR:-target}/demo/superhelix
  cargo build --quiet --locked --profile demo --features cli --bin superhelix
fi
mkdir -p "$out"
python3 examples/scenes/make_scenes.py
# A strand that touches nothing for its first metre touches nothing.
sed 's/"exempt_length": 0.004/"exempt_length": 1.0/' examples/scenes/shoulder.json >"$out/shoulder_without_scene.json"
"$superhelix" run "$out/shoulder_without_scene.json" --out "$out/shoulder_without.json" --quiet
for name in shoulder combed_sphere; do
  "$superhelix" run "examples/scenes/$name.json" --out "$out/$name.json" --quiet
done
"$superhelix" picture "$out/shoulder_without.json" --scene "$out/shoulder_without_scene.json" --up z --moments 4 --cell 300 --as lines \
  --title "The same hair without contact" --out docs/figures/contact_shoulder_without.png --quiet
"$superhelix" picture "$out/shoulder.json" --scene examples/scenes/shoulder.json --up z --moments 4 --cell 300 --as lines \
  --title "Hair falls on shoulders" --out docs/figures/contact_shoulder.png --quiet
"$superhelix" picture "$out/combed_sphere.json" --scene examples/scenes/combed_sphere.json --up z --moments 5 --cell 300 --as lines \
  --title "A sphere of hair is combed" --out docs/figures/contact_combed_sphere.png --quiet
