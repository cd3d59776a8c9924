#!/bin/sh
# Sets up, builds and tests everything. Options are handed to ctest.
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library apps tests python site
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
tests/make_venv.sh build/venv-python tests/python/requirements.txt
cmake -S . -B build -DONSET_BUILD_TESTS=ON -DONSET_BUILD_APPS=ON -DONSET_BUILD_PYTHON=ON "-DPython_EXECUTABLE=$PWD/build/venv-python/bin/python"
cmake --build build --parallel "$(nproc)"
if [ -n "${ONSET_DATA:-}" ]; then
  echo "Tests on real data: ONSET_DATA=$ONSET_DATA"
else
  echo "ONSET_DATA is not set: tests on real data are skipped."
fi
ctest --test-dir build --output-on-failure --parallel "$(nproc)" "$@"
