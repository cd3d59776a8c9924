#!/bin/sh
# Concurrent calls, calls from callbacks, and the tests of bytes, budgets and line searches, under ThreadSanitizer: no report,
# and one for a deliberate race. About three minutes on 2 cores.
#   test-threads.sh                   the library on threads of its own (ONSET_THREADS=STD), which the sanitizer sees through
#   test-threads.sh tbb [SOURCE]      on a oneTBB that is built to be seen through, too, among hosts that use it: with the one of
#                                     the distribution every hand-over of a task would be reported. SOURCE: a folder; default:
#                                     oneTBB v2021.8.0 from GitHub, into build/tsan-tbb
# ONSET_FUZZ scales randomised tests; 0.1 where it is not set.
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library tests clang
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
export TSAN_OPTIONS="halt_on_error=1:history_size=7:die_after_fork=0${TSAN_OPTIONS:+:$TSAN_OPTIONS}"
export ONSET_FUZZ="${ONSET_FUZZ:-0.1}"
unset ONSET_DATA

case "${1:-}" in
  "")
    cmake --preset tsan
    cmake --build --preset tsan --parallel "$(nproc)"
    ctest --test-dir build/tsan --output-on-failure --label-regex threads
    ;;
  tbb)
    folder=build/tsan-tbb
    tbb=${2:-$folder/source}
    if [ ! -e "$tbb/CMakeLists.txt" ]; then
      git clone --quiet --depth 1 --branch v2021.8.0 https://github.com/uxlfoundation/oneTBB "$tbb"
    fi
    cmake -S "$tbb" -B "$folder/tbb" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang \
      -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF -DTBB_SANITIZE=thread \
      -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_INSTALL_PREFIX="$PWD/$folder/install"
    cmake --build "$folder/tbb" --target tbb --parallel "$(nproc)"
    cmake --install "$folder/tbb" >/dev/null
    cmake --preset tsan -B "$folder/onset" -DONSET_THREADS=TBB "-DTBB_DIR=$PWD/$folder/install/lib/cmake/TBB"
    cmake --build "$folder/onset" --target test_parallel test_threads test_src --parallel "$(nproc)"
    ctest --test-dir "$folder/onset" --output-on-failure --label-regex threads
    ;;
  *)
    echo "usage: test-threads.sh [tbb [SOURCE]]" >&2
    exit 2
    ;;
esac
