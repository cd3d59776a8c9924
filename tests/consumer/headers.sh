#!/bin/sh
# Each public header compiles alone, as C++17 and C++20, without a warning, and pulls in no TBB.
#   headers.sh SOURCE EIGEN_INCLUDE...      The environment gives CXX.
set -eu
source=$1
shift
includes="-I$source/include"
for dir; do includes="$includes -isystem $dir"; done

preprocessed=$(mktemp)
trap 'rm -f "$preprocessed"' EXIT
count=0
for header in "$source"/include/onset/*.hpp "$source"/include/onset/compat/*.hpp; do
  name=${header#"$source"/include/}
  # It includes another library's headers: the test toolkit_plugin compiles it with those.
  [ "$name" != onset/compat/ipc_toolkit.hpp ] || continue
  for std in c++17 c++20; do
    # Twice: it is guarded against itself.
    printf '#include <%s>\n#include <%s>\n' "$name" "$name" |
      "$CXX" -std=$std -Wall -Wextra -Werror -pedantic $includes -fsyntax-only -x c++ -
  done
  printf '#include <%s>\n' "$name" | "$CXX" -std=c++17 $includes -E -x c++ - >"$preprocessed"
  if grep -i -m 3 'tbb' "$preprocessed"; then
    echo "$name shows TBB"
    exit 1
  fi
  count=$((count + 1))
done
[ $count -ge 8 ] || { echo "found only $count headers in $source/include/onset"; exit 1; }
echo "$count headers: ok"
