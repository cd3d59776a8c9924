#!/bin/sh
# Builds and runs the project in app/ against onset as an outside user would.
#   consumer.sh MODE SOURCE FROM WORK PROGRAM
# MODE installed: the build FROM, as it is, installed; shared: a shared library, installed in FROM and moved from there.
# PROGRAM prints what every one of them must print.
# The environment gives CMAKE, CMAKE_GENERATOR, CONFIG (of a build), CXX, and LAUNCHER (ccache or nothing). WORK is emptied first.
set -eu
mode=$1 source=$2 from=$3 work=$4 program=$5
app=$source/tests/consumer/app
user_flags="-O3 -march=native -ffast-math"
strict="-Wall -Wextra -Werror -pedantic"
rm -rf "$work"
mkdir -p "$work"
export CMAKE_BUILD_PARALLEL_LEVEL=2

configure() {  # build [options...]
  into=$1
  shift
  "$CMAKE" -S "$app" -B "$into" -DCMAKE_CXX_COMPILER="$CXX" -DCMAKE_CXX_COMPILER_LAUNCHER="$LAUNCHER" "$@" >"$into.log"
}

# Builds the outside project, runs it, and compares what it prints with what it should.
consume() {  # name [options...]
  name=$1
  shift
  configure "$work/$name" "$@" || { cat "$work/$name.log"; return 1; }
  "$CMAKE" --build "$work/$name" >"$work/$name.log" || { cat "$work/$name.log"; return 1; }
  check "$name" "$work/$name/consumer"
}

check() {  # name program
  "$2" >"$work/$1.txt" || { cat "$work/$1.txt"; return 1; }
  cmp "$work/expected.txt" "$work/$1.txt"
  echo "$mode, $1: ok"
}

installed() {
  "$CMAKE" --install "$from" ${CONFIG:+--config "$CONFIG"} --prefix "$work/prefix" >/dev/null
  cmp "$source/LICENSE" "$work/prefix/share/doc/onset/LICENSE"
  found=-DCMAKE_PREFIX_PATH=$work/prefix
  consume plain "$found" -DCMAKE_BUILD_TYPE=Release
  consume user_flags "$found" "-DCMAKE_CXX_FLAGS=$user_flags"
  consume cxx20_debug "$found" -DCMAKE_CXX_STANDARD=20 -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS=$strict"
  with_pkg_config
}

with_pkg_config() {
  pc=$(find "$work/prefix" -name onset.pc)
  PKG_CONFIG_PATH=$(dirname "$pc")
  export PKG_CONFIG_PATH
  # shellcheck disable=SC2046  # the flags are words
  "$CXX" -std=c++17 -o "$work/by_pkg_config" "$app"/*.cpp $(pkg-config --cflags --libs onset)
  LD_LIBRARY_PATH=$(pkg-config --variable=libdir onset) check pkg_config "$work/by_pkg_config"
}

shared() {
  mv "$from" "$work/prefix"
  consume plain "-DCMAKE_PREFIX_PATH=$work/prefix" -DCMAKE_BUILD_TYPE=Release
  consume user_flags "-DCMAKE_PREFIX_PATH=$work/prefix" "-DCMAKE_CXX_FLAGS=$user_flags"
  with_pkg_config
  shows_only_onset "$(find "$work/prefix" -name libonset.so)"
}

# What a shared library defines for others (weak copies of the standard library's inline functions apart) is onset's, and no
# Eigen or TBB type is in any signature.
shows_only_onset() {
  nm -DC --defined-only "$1" | grep -E ' [TDBR] ' >"$work/symbols.txt"
  grep -q 'onset::compute_collision_free_stepsize' "$work/symbols.txt"
  if grep -vE ' [TDBR] (onset::|(vtable|typeinfo|typeinfo name) for onset::)' "$work/symbols.txt"; then
    echo "the shared library shows these symbols, which are not onset's"
    return 1
  fi
  if grep -E 'Eigen::|tbb::' "$work/symbols.txt"; then
    echo "these signatures show Eigen or TBB"
    return 1
  fi
  echo "shared, symbols: ok"
}

"$program" >"$work/expected.txt"
"$mode"
