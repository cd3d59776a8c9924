#!/bin/sh
# Concurrent calls with one shared mesh under ThreadSanitizer, with a oneTBB that is instrumented too: with the one of the
# distribution, which is not, every hand-over of a task would be reported.
#   test-threads.sh [TBB_SOURCE]      default: oneTBB v2021.8.0 from GitHub, into build/tsan
set -eu
cd "$(dirname "$0")/.."
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
folder=build/tsan
tbb=${1:-$folder/onetbb}
if [ ! -e "$tbb/CMakeLists.txt" ]; then
  git clone --quiet --depth 1 --branch v2021.8.0 https://github.com/uxlfoundation/oneTBB "$tbb"
fi
cmake -S "$tbb" -B "$folder/tbb" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF \
  -DTBB_SANITIZE=thread -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_INSTALL_PREFIX="$PWD/$folder/install"
cmake --build "$folder/tbb" --target tbb --parallel "$(nproc)"
cmake --install "$folder/tbb" >/dev/null
cmake -S . -B "$folder/onset" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DONSET_BUILD_APPS=OFF -DONSET_BUILD_TESTS=ON \
  "-DCMAKE_CXX_FLAGS=-fsanitize=thread" "-DTBB_DIR=$PWD/$folder/install/lib/cmake/TBB"
cmake --build "$folder/onset" --target test_threads --parallel "$(nproc)"
export TSAN_OPTIONS="halt_on_error=1 history_size=7"
"$folder/onset/tests/threads/test_threads"
if "$folder/onset/tests/threads/test_threads" race >/dev/null 2>&1; then
  echo "test-threads.sh: a deliberate race was not reported" >&2
  exit 1
fi
