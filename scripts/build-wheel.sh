#!/bin/sh
# Builds the wheel of the Python package, with oneTBB inside, into dist/: installs what is missing first.
#   build-wheel.sh [PYTHON]     python3 by default
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library python
venv=build/venv-wheel
if ! cmp -s python/requirements-wheel.txt "$venv/installed.txt"; then
  rm -rf "$venv"
  "${1:-python3}" -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check -r python/requirements-wheel.txt
  cp python/requirements-wheel.txt "$venv/installed.txt"
fi
rm -rf build/wheel dist
PATH=$PWD/$venv/bin:$PATH "$venv/bin/python" -m build --wheel --outdir build/wheel . "-Cbuild-dir=build/wheel-objects"
# auditwheel names the oldest glibc that the wheel runs on, and puts libtbb in.
PATH=$PWD/$venv/bin:$PATH "$venv/bin/auditwheel" repair --wheel-dir dist build/wheel/*.whl
ls dist
