#!/usr/bin/env bash
# Tests the Godot 3 host (bindings/godot): compiled with every warning an error, run in Godot under a virtual display: 20,000 strands on a head that turns;
# that they cover the scalp, have no spikes, move by themselves, and that failures have a message and an exit status. Where there is no
# Godot 3 it says so, and ends well. Usage: test_godot.sh [picture FILE]   the picture of docs/guide/game-engine.md instead
# Environment:
#   GODOT              the program, default godot3-runner, then godot3 (Debian: apt-get install godot3-runner xvfb libgl1-mesa-dri)
#   GODOT_HEADERS      as bindings/godot/build.sh says
#   SUPERHELIX_BUILD   as scripts/test_library.sh says
set -euo pipefail
cd "$(dirname "$0")/.."

godot=${GODOT:-$(command -v godot3-runner || command -v godot3 || true)}
for needed in "${godot:-godot3-runner}" Xvfb; do
  if ! command -v "$needed" >/dev/null; then
    echo "test_godot.sh: SKIPPED: there is no $needed (Debian: apt-get install godot3-runner xvfb libgl1-mesa-dri)"
    exit 0
  fi
done
. scripts/test_library.sh
out=$PWD/build/godot
built=0
bindings/godot/build.sh "$library" "$headers" "$out" || built=$?
if [ "$built" = 3 ]; then
  echo "test_godot.sh: SKIPPED: Godot's headers are not here and cannot be downloaded"
  exit 0
fi
[ "$built" = 0 ] || exit "$built"

# A display of our own: xvfb-run may wait for ever when its program has ended.
scratch=$(mktemp -d)
exec 3>"$scratch/display"
Xvfb -displayfd 3 -screen 0 1600x1200x24 -nolisten tcp 2>"$scratch/xvfb" &
display=$!
trap 'kill "$display" 2>/dev/null || true; rm -rf "$scratch"' EXIT
for _ in $(seq 100); do
  [ -s "$scratch/display" ] && break
  sleep 0.1
done
[ -s "$scratch/display" ] || { cat "$scratch/xvfb" >&2; echo "test_godot.sh: Xvfb does not start" >&2; exit 1; }
DISPLAY=:$(cat "$scratch/display")
export DISPLAY LC_ALL=C

# play NAME ARGUMENT...: runs the project; what it says goes to NAME.txt, its report to NAME.json.
play() {
  local name=$1
  shift
  HOME=$scratch timeout 300 "$godot" --path "$out" --report="$scratch/$name.json" "$@" >"$scratch/$name.txt" 2>&1
}
fail() {
  tail -n 20 "$scratch"/*.txt >&2
  echo "test_godot.sh: $1" >&2
  exit 1
}

if [ "${1:-}" = picture ]; then
  play picture --resolution 720x940 --frames=66 --moments=0,38,65 --shrink=yes --screenshot="${2:?}" || fail "Godot fails"
  grep -E "grown|median" "$scratch/picture.txt"
  exit 0
fi

play turning --resolution 400x300 --frames=90 --screenshot="$scratch/turning.png" || fail "Godot fails"
play covered --resolution 400x300 --frames=1 --bare=yes --view=180 --screenshot="$scratch/covered.png" || fail "Godot fails"
play bald --resolution 400x300 --frames=1 --bare=yes --hide=yes --view=180 --screenshot="$scratch/bald.png" || fail "Godot fails"
python3 - "$scratch" <<'PYTHON' || fail "a check fails"
import json, sys
turning, covered, bald = (json.load(open(f"{sys.argv[1]}/{name}.json")) for name in ("turning", "covered", "bald"))
checks = {
    "every vertex is finite and has a unit quaternion": turning["broken_vertices"] == 0,
    "no strand has a spike": 0.005 < turning["longest_segment"] < 0.03,
    "hair moves": turning["kinetic_energy"] > 1e-5,
    "hair is in contact with the head": turning["contacts"] > 0,
    "and not in it": turning["penetration"] < 0.003,
    "no strand was quarantined": turning["quarantined"] == 0,
    "the scalp can be seen without hair": bald["scalp_pixels"] > 2000,
    "and not with it": covered["scalp_pixels"] < 0.01 * bald["scalp_pixels"],
}
for name, holds in checks.items():
    print(f"{'ok    ' if holds else 'FAILED'} {name}")
print(f"{sum(checks.values())} passed, {len(checks) - sum(checks.values())} failed")
sys.exit(not all(checks.values()))
PYTHON
grep -E "median" "$scratch/turning.txt"

# refuses NAME PATTERN ARGUMENT...: leaves with an error status and this message.
refuses() {
  local name=$1 pattern=$2
  shift 2
  if play "$name" "$@"; then
    fail "$name: Godot leaves with status 0"
  fi
  grep -q "superhelix: .*$pattern" "$scratch/$name.txt" || fail "$name: no message with '$pattern'"
}
refuses head "cannot read the head" --frames=2 --head=/no/such/head.obj
refuses hold "wisp.hold is 2" --frames=2 --hold=2
refuses length "length is -1" --frames=2 --length=-1
refuses points "points_per_strand is 1" --frames=2 --points=1 --hairs=100
refuses screenshot "cannot write" --frames=2 --hairs=100 --guides=20 --screenshot=/no/such/folder/picture.png
echo "5 failures reported"
