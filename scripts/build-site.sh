#!/bin/sh
# Builds the documentation site into build/site: installs what is missing, and builds the Python package if there is none.
# After that nothing is fetched: the site needs no network, neither to be built nor to be read.
#   build-site.sh [BUILD]     the build folder, build by default
set -eu
cd "$(dirname "$0")/.."
build=${1:-build}
scripts/install-packages.sh site
tests/make_venv.sh "$build/venv-site" docs/site/requirements.txt
package=$build/python/onset_ccd
if grep -q "ONSET_BUILD_PYTHON:BOOL=ON" "$build/CMakeCache.txt" 2>/dev/null; then
  cmake --build "$build" --target onset_python onset_stub --parallel "$(nproc)" >"$build/venv-site/build.log" || { cat "$build/venv-site/build.log"; exit 1; }
elif [ ! -f "$package/_onset.pyi" ]; then
  scripts/install-packages.sh library python
  tests/make_venv.sh "$build/venv-python" tests/python/requirements.txt
  CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}" cmake -S . -B "$build" -DONSET_BUILD_PYTHON=ON \
    "-DPython_EXECUTABLE=$(realpath "$build")/venv-python/bin/python"
  cmake --build "$build" --target onset_python onset_stub --parallel "$(nproc)"
fi

work=$(realpath "$build")/site-work
python=$build/venv-site/bin/python
mkdir -p "$work/doxygen"
export ONSET_SITE_WORK="$work" PYTHONDONTWRITEBYTECODE=1
{
  cat docs/site/Doxyfile
  echo "INPUT = include mpi/include"
  echo "OUTPUT_DIRECTORY = \"$work/doxygen\""
  echo "INPUT_FILTER = \"python3 docs/site/doxygen_filter.py\""
} > "$work/Doxyfile"
doxygen "$work/Doxyfile"
"$python" docs/site/cpp_reference.py "$work/doxygen/xml"
"$python" docs/site/python_reference.py python/onset_ccd "$package/_onset.pyi" "$work/python"
"$python" -m sphinx -q -E -W --keep-going -c docs/site -d "$work/doctrees" docs "$build/site"
echo "$build/site/index.html"
