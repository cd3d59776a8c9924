#!/bin/sh
# Compiles the library for Windows on x86-64 and macOS on Arm with zig, where a warning is an error: both backs of threads, a shared
# library for Windows and a static one for macOS, and a program that uses it as others do. Where wine is installed, the program for
# Windows has to print what it prints here. About ten minutes on 2 cores; zig comes from PyPI.
#   test-portable.sh
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library tests
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
folder=$PWD/build/portable
zig_version=0.17.1
mkdir -p "$folder/tools" "$folder/headers"
if [ "$(cat "$folder/venv/zig-version" 2>/dev/null)" != $zig_version ]; then
  rm -rf "$folder/venv"
  python3 -m venv "$folder/venv"
  "$folder/venv/bin/pip" install --quiet --disable-pip-version-check ziglang==$zig_version
  echo $zig_version >"$folder/venv/zig-version"
fi

# The headers beside Boost's and TBB's in /usr/include are this system's, and nothing to compile for another with.
for headers in boost tbb oneapi; do ln -sfn "/usr/include/$headers" "$folder/headers/$headers"; done
write_tool() {  # name arguments
  printf '#!/bin/sh\nexport ZIG_GLOBAL_CACHE_DIR="%s/cache"\nexec "%s/venv/bin/python" -m ziglang %s "$@"\n' \
    "$folder" "$folder" "$2" >"$folder/tools/$1"
  chmod +x "$folder/tools/$1"
}
for tool in ar ranlib rc; do write_tool $tool $tool; done
# Boost 1.74, which Debian 12 has, uses what C++17 removed and LLVM's library only has when it is told.
cxx() { echo "c++ -target $1 -D_LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION"; }

configure() {  # target source build [options...]
  target=$1 source=$2 into=$3
  shift 3
  cmake -S "$source" -B "$into" -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/toolchains/zig.cmake" -DONSET_ZIG_TOOLS="$folder/tools" \
    -DONSET_ZIG_TARGET="$target" -DONSET_HEADERS="$folder/headers" -DEigen3_DIR=/usr/share/eigen3/cmake \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror" "$@" >"$into.log" ||
    { cat "$into.log"; exit 1; }
}

build() {  # target shared
  target=$1
  write_tool "cxx-$target" "$(cxx "$target")"
  configure "$target" . "$folder/$target" -DBoost_NO_BOOST_CMAKE=ON -DBoost_INCLUDE_DIR="$folder/headers" -DONSET_THREADS=STD \
    -DONSET_BUILD_TESTS=OFF -DONSET_BUILD_APPS=OFF -DBUILD_SHARED_LIBS="$2"
  cmake --build "$folder/$target" --parallel "$(nproc)"
  "$folder/tools/cxx-$target" -std=c++17 -O1 -Wall -Wextra -Werror -I. -Iinclude -isystem "$folder/headers" \
    -c base/threads/parallel_tbb.cpp -o "$folder/$target/parallel_tbb.o"
  rm -rf "$folder/$target-prefix"
  cmake --install "$folder/$target" --prefix "$folder/$target-prefix" >/dev/null
  configure "$target" tests/consumer/app "$folder/$target-consumer" -Donset_DIR="$folder/$target-prefix/lib/cmake/onset"
  cmake --build "$folder/$target-consumer"
  echo "$target: no warning"
}

build x86_64-windows-gnu ON
build aarch64-macos OFF

# A plugin that uses the shared library, and a host that loads it.
windows="$folder/x86_64-windows-gnu"
for part in plugin host; do
  options=
  [ $part = host ] || options="-shared $windows-prefix/lib/libonset.dll.a"
  # shellcheck disable=SC2086  # the options are words
  "$folder/tools/cxx-x86_64-windows-gnu" -std=c++17 -O1 -Wall -Wextra -Werror -DONSET_SHARED -isystem "$windows-prefix/include" \
    -isystem /usr/include/eigen3 tests/platforms/windows/$part.cpp $options -o "$windows-consumer/$part.$([ $part = host ] && echo exe || echo dll)"
done

wine=$(command -v wine64 || command -v wine || ls /usr/lib/wine/wine64 2>/dev/null) || true
if [ -z "$wine" ]; then
  echo "wine is not installed (Debian: wine64): the programs for Windows were built, and did not run"
  exit 0
fi
cmake -S . -B build -DONSET_BUILD_TESTS=ON >/dev/null
cmake --build build --target consumer_inside --parallel "$(nproc)"
build/tests/consumer/consumer_inside >"$folder/here.txt"
export WINEPREFIX="$folder/wine" WINEDEBUG=-all WINEPATH="$windows-prefix/bin"
timeout 300 "$wine" "$windows-consumer/consumer.exe" >"$folder/wine.txt" 2>"$folder/wine.log"
tr -d '\r' <"$folder/wine.txt" >"$folder/windows.txt"
cmp "$folder/here.txt" "$folder/windows.txt"
cat "$folder/windows.txt"
echo "x86_64-windows-gnu: the same bytes as here"
timeout 300 "$wine" "$windows-consumer/host.exe" 2>>"$folder/wine.log"
