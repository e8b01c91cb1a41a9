# Sourced, in the repository's root, by the scripts that run Python's lints and tests: sees to it that build/python-venv has what they need, and sets
# python to its interpreter.
python=$PWD/build/python-venv/bin/python
[ -x "$python" ] || python3 -m venv build/python-venv
"$python" -m pip install --quiet --disable-pip-version-check "numpy>=1.23" bokeh distributed ipykernel matplotlib mypy nbclient pytest ruff "usd-core>=24.11"
