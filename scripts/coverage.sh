#!/bin/sh
# Says which share of the library's lines and branches the tests reach, folder by folder, and what they leave: Clang's coverage of
# an optimised build without assertions. About a quarter of an hour on 2 cores.
#   coverage.sh [ctest options]      build/coverage/missing.txt names the lines and branches that no test reached
# With ONSET_DATA set the tests on real data run too.
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library tests clang
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"

cmake -S . -B build/coverage -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS_RELEASE=-O1 \
  -DCMAKE_CXX_FLAGS="-fprofile-instr-generate -fcoverage-mapping" -DONSET_BUILD_TESTS=ON -DONSET_BUILD_APPS=OFF
cmake --build build/coverage --parallel "$(nproc)"

# One file a binary, into which its processes merge what they counted. Tests labelled "outside" build or run other programs, and
# the soak takes minutes to reach nothing more.
profiles=$PWD/build/coverage/profiles
rm -rf "$profiles"
mkdir -p "$profiles"
status=0
LLVM_PROFILE_FILE="$profiles/%4m.profraw" ONSET_FUZZ="${ONSET_FUZZ:-0.25}" \
  ctest --test-dir build/coverage --output-on-failure --parallel "$(nproc)" -LE outside -E '^soak' "$@" || status=$?

version=$(clang --version | sed -n 's/.*version \([0-9]*\).*/\1/p')
"llvm-profdata-$version" merge -sparse "$profiles"/*.profraw -o build/coverage/tests.profdata
set -- $(find build/coverage -type f -perm -u+x ! -name '*.so*' ! -path '*/CMakeFiles/*' ! -path '*/_deps/*' -exec sh -c \
  'for f; do head -c 4 "$f" | grep -q ELF && nm "$f" 2>/dev/null | grep -q __llvm_profile && printf -- "-object %s " "$f"; done' _ {} +)
"llvm-cov-$version" export -instr-profile build/coverage/tests.profdata "$@" > build/coverage/coverage.json
python3 scripts/coverage.py build/coverage/coverage.json build/coverage/missing.txt
exit $status
