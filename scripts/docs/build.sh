#!/usr/bin/env bash
# Builds the site: `make docs`. mdBook is MDBOOK, or in build/tools, or in the path; where it is nowhere cargo installs it into build/tools (minutes).
set -euo pipefail
cd "$(dirname "$0")/../.."

version=0.5.4
mdbook=${MDBOOK:-}
if [ -z "$mdbook" ]; then
  mdbook=build/tools/bin/mdbook
  if [ ! -x "$mdbook" ]; then
    if command -v mdbook >/dev/null && [ "$(mdbook --version)" = "mdbook v$version" ]; then
      mdbook=$(command -v mdbook)
    else
      CARGO_TARGET_DIR=build/tools/target cargo install mdbook --quiet --locked --version "$version" --no-default-features --features search --root build/tools
      rm -rf build/tools/target
    fi
  fi
fi
venv=build/docs-venv
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check latex2mathml==3.81.1
"$venv/bin/python" -B scripts/docs/site.py "$mdbook" "$@"
