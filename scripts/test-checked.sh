#!/bin/sh
# Builds the library and its tests twice more, with assertions, and runs the unit tests: with GCC, for debugging, under the address
# and undefined behaviour sanitizers; with Clang, optimised, where a warning is an error.
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library tests clang
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"

# Real data is for optimised builds; tests labelled outside build for themselves.
check() {  # build folder, then options for cmake
  folder=$1
  shift
  cmake -S . -B "$folder" -DONSET_BUILD_APPS=OFF -DONSET_BUILD_TESTS=ON "$@"
  cmake --build "$folder" --parallel "$(nproc)"
  env -u ONSET_DATA ctest --test-dir "$folder" --output-on-failure --parallel "$(nproc)" -LE outside
}

export ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1
check build/sanitized -DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Debug \
  "-DCMAKE_CXX_FLAGS=-O1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all -D_GLIBCXX_ASSERTIONS"
check build/clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS_RELEASE=-O2 "-DCMAKE_CXX_FLAGS=-Werror -D_GLIBCXX_ASSERTIONS"
