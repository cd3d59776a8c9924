#!/bin/sh
# Builds the wheel of the Python package, with oneTBB inside, into dist/: installs what is missing first.
#   build-wheel.sh [PYTHON]     python3 by default; from 3.12 on one wheel is for all later versions too
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library python
python=${1:-python3}
version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
venv=build/venv-wheel-$version
if ! cmp -s python/requirements-wheel.txt "$venv/installed.txt"; then
  rm -rf "$venv"
  "$python" -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check -r python/requirements-wheel.txt
  cp python/requirements-wheel.txt "$venv/installed.txt"
fi
rm -rf build/wheel
PATH=$PWD/$venv/bin:$PATH "$venv/bin/python" -m build --wheel --outdir build/wheel . "-Cbuild-dir=build/wheel-objects-$version"
# auditwheel names the oldest glibc that the wheel runs on, and puts libtbb in.
PATH=$PWD/$venv/bin:$PATH "$venv/bin/auditwheel" repair --wheel-dir dist build/wheel/*.whl
ls dist
