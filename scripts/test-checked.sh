#!/bin/sh
# Builds the library and its tests once more and runs the unit tests: with Clang, for debugging, with assertions, under the address
# and undefined behaviour sanitizers, where a warning is an error. Randomised tests try a quarter of what they try elsewhere.
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library tests clang
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"

cmake --preset checked
cmake --build build/checked --parallel "$(nproc)"

# Real data is for optimised builds, as are tests labelled long; those labelled outside build for themselves.
# Exact arithmetic allocates so much that recording where each block came from takes a third of the time: a report says what went
# wrong and where, and with ASAN_OPTIONS=malloc_context_size=30 also where the block was made.
export ASAN_OPTIONS="detect_stack_use_after_return=1:malloc_context_size=1${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
export UBSAN_OPTIONS=print_stacktrace=1 ONSET_FUZZ="${ONSET_FUZZ:-0.25}"
env -u ONSET_DATA ctest --test-dir build/checked --output-on-failure --parallel "$(nproc)" -LE "outside|long"
