#!/usr/bin/env bash
# The engine beside pyPBD, MuJoCo's rod and PyElastica: measures all of them in one run, draws, and fills docs/notebook/peers.md. The peers come from
# PyPI, pinned in benches/peers/requirements.txt, into build/peers/venv; nothing else is touched.
#   PEERS_QUICK=yes    a ninth of the settings, one round, into build/peers/quick; docs/ stays as it is
#   PEERS_MEASURE=no   draws from the committed numbers without measuring again
set -euo pipefail
cd "$(dirname "$0")/.."

venv=build/peers/venv
if [ ! -x "$venv/bin/python" ]; then
  mkdir -p build/peers
  python3 -m venv "$venv"
fi
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r benches/peers/requirements.txt

into=docs/figures
options=()
if [ "${PEERS_QUICK:-no}" = yes ]; then
  into=build/peers/quick
  options=(--quick)
fi
if [ "${PEERS_MEASURE:-yes}" = yes ]; then
  cargo bench --locked --profile demo --bench peers --no-run
  ours=$(cargo bench --quiet --locked --profile demo --bench peers --no-run --message-format=json \
    | "$venv/bin/python" -c 'import json, sys
for line in sys.stdin:
    message = json.loads(line)
    if message.get("executable") and message["target"]["name"] == "peers":
        print(message["executable"])')
  "$venv/bin/python" benches/peers/run.py "$ours" --into "$into" ${options[@]+"${options[@]}"}
fi
"$venv/bin/python" docs/figures/plot_peers.py "$into"
