#!/bin/sh
# Looks through the library's sources with clang-tidy and the checks of .clang-tidy; ends with 1 where one complains.
#   tidy.sh [FILE...]       default: all; about three minutes on 2 cores
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library tidy
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
cmake -S . -B build/tidy -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DONSET_BUILD_TESTS=OFF \
  -DONSET_BUILD_APPS=OFF >/dev/null
[ $# -gt 0 ] || set -- base scene broadphase narrowphase src
git ls-files -z -- "$@" | grep -z '\.cpp$' | xargs -0 -n 2 -P "$(nproc)" clang-tidy -p build/tidy --quiet
echo "clang-tidy: nothing to say"
