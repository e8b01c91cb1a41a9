# Sourced, in the repository's root, by the scripts that need Blender as a Python module: sees to it that build/blender-venv-VERSION has it (1 GB, once), and
# sets `python` to its interpreter. Where pip has none, or it does not load, that is said, and the script ends well. Environment:
#   BPY_VERSION   default 5.0.1; also tried: 4.5.15

version=${BPY_VERSION:-5.0.1}
venv=build/blender-venv-$version
if [ ! -e "$venv/complete" ]; then
  rm -rf "$venv"
  python3 -m venv "$venv"
  if ! "$venv/bin/python" -m pip install --quiet --disable-pip-version-check "bpy==$version" pytest setuptools wheel; then
    rm -rf "$venv"
    echo "$0: SKIPPED: pip has no bpy $version for $(python3 --version) on $(uname -sm)"
    exit 0
  fi
  touch "$venv/complete"
fi
python=$PWD/$venv/bin/python
if ! "$python" -c "import bpy, os; os._exit(0)"; then
  echo "$0: SKIPPED: bpy $version does not load on $(uname -sm)"
  exit 0
fi
