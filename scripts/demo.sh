#!/bin/sh
# Sets up, builds and runs the demo. Options are handed to `onset demo`.
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library apps
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
cmake -S . -B build -DONSET_BUILD_APPS=ON
cmake --build build --target onset_cli --parallel "$(nproc)"
build/apps/onset demo "$@"
