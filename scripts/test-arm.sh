#!/bin/sh
# Compiles library and tests for 64-bit Arm with Debian's cross compiler, where a warning is an error, runs tests under qemu, and
# compares what programs print there and here: the same bytes. About 25 minutes on 2 cores. Debian only: it has the packages of all
# architectures in one place.
#   test-arm.sh [TEST...]      default: those below; a test is <folder>/<program>, below tests/
# ONSET_FUZZ scales randomised tests; 0.25 where it is not set.
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library tests arm
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
folder=$PWD/build/arm
[ $# -gt 0 ] || set -- base/test_base base/test_parallel scene/test_scene broadphase/test_broadphase narrowphase/test_narrowphase \
  narrowphase/test_exact src/test_src

# Libraries for Arm, unpacked into a folder: nothing is installed, and the package manager does not learn of another architecture.
if [ ! -e "$folder/root/unpacked" ]; then
  rm -rf "$folder/root" "$folder/apt"
  mkdir -p "$folder/root" "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial" "$folder/apt/packages"
  : >"$folder/apt/status"
  cat >"$folder/apt/apt.conf" <<END
Dir::State "$folder/apt";
Dir::State::Lists "$folder/apt/lists";
Dir::State::status "$folder/apt/status";
Dir::Cache "$folder/apt/cache";
APT::Architecture "arm64";
APT::Architectures "arm64";
APT::Sandbox::User "$(id -un)";
END
  export APT_CONFIG="$folder/apt/apt.conf"
  apt-get update -q
  # Each library with what it links; the C and C++ libraries are the compiler's.
  names=$(apt-cache depends --recurse --no-recommends --no-suggests --no-conflicts --no-breaks --no-replaces --no-enhances \
    libtbb-dev libgmp-dev libfcl-dev | grep -E '^lib(tbb|gmp|fcl|ccd|octomap)' | sort -u)
  # shellcheck disable=SC2086  # the packages are words
  (cd "$folder/apt/packages" && apt-get download -q $names)
  unset APT_CONFIG
  for package in "$folder"/apt/packages/*.deb; do dpkg-deb --extract "$package" "$folder/root"; done
  touch "$folder/root/unpacked"
fi

configure_arm() {
  cmake -S . -B "$folder/onset" -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/toolchains/aarch64-linux-gnu.cmake" -DONSET_ARM_ROOT="$folder/root" \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-Werror -DONSET_BUILD_TESTS=ON -DONSET_BUILD_APPS=OFF
}
configure_arm >"$folder/configure.log" 2>&1 || { cat "$folder/configure.log"; exit 1; }
# shellcheck disable=SC2046  # one word a program
cmake --build "$folder/onset" --parallel "$(nproc)" --target consumer_inside onset_print_answers $(for test; do basename "$test"; done)
cmake -S . -B build -DONSET_BUILD_TESTS=ON >/dev/null
cmake --build build --parallel "$(nproc)" --target consumer_inside onset_print_answers

export ONSET_FUZZ="${ONSET_FUZZ:-0.25}"
unset ONSET_DATA
on_arm() { qemu-aarch64 -L /usr/aarch64-linux-gnu "$@"; }
for program in consumer/consumer_inside platforms/onset_print_answers; do
  name=$(basename "$program")
  "build/tests/$program" >"$folder/$name.here.txt"
  on_arm "$folder/onset/tests/$program" >"$folder/$name.arm.txt"
  cmp "$folder/$name.here.txt" "$folder/$name.arm.txt"
  echo "$name: $(wc -l <"$folder/$name.arm.txt") lines, the same bytes on aarch64 and on $(uname -m)"
done
for test; do
  echo "aarch64: $test"
  on_arm "$folder/onset/tests/$test"
done
echo "aarch64: no failure in $#"
