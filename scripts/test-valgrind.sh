#!/bin/sh
# Tests of the optimised library under valgrind's memcheck, with the scalar kernels: reads of memory that nothing wrote, and of what
# is no longer there, in the code that users run. About ten minutes on 2 cores.
#   test-valgrind.sh [TEST...]      default: those below; a test is <folder>/<program>, below tests/
# ONSET_FUZZ scales randomised tests; 0.02 where it is not set.
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library tests profile
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
[ $# -gt 0 ] || set -- base/test_base base/test_parallel scene/test_scene broadphase/test_broadphase narrowphase/test_narrowphase \
  narrowphase/test_exact src/test_src src/test_start steps/test_steps planes/test_planes in_plane/test_in_plane trajectory/test_trajectory \
  vertex_steps/test_vertex_steps maps/test_maps faults/test_every_call threads/test_threads

cmake -S . -B build -DONSET_BUILD_TESTS=ON >/dev/null
# shellcheck disable=SC2046  # one word a program
cmake --build build --parallel "$(nproc)" --target $(for test; do basename "$test"; done)

export ONSET_KERNEL=scalar ONSET_FUZZ="${ONSET_FUZZ:-0.02}"
unset ONSET_DATA
for test; do
  echo "valgrind: $test"
  # TBB keeps its workers' memory, which is reachable. Tests that count threads or time count valgrind's.
  valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite \
    --trace-children=no "build/tests/$test"
done
echo "valgrind: no error in $#"
