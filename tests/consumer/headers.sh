#!/bin/sh
# Each public header compiles alone, as C++17, without a warning, and pulls in no TBB; those that include all of an interface, also
# as C++20.
#   headers.sh SOURCE EIGEN_INCLUDE...      The environment gives CXX.
set -eu
source=$1
shift
includes="-I$source/include"
for dir; do includes="$includes -isystem $dir"; done

read_files=$(mktemp)
trap 'rm -f "$read_files"' EXIT
count=0
compile() {  # name std
  # Twice: it is guarded against itself.
  printf '#include <%s>\n#include <%s>\n' "$1" "$1" |
    "$CXX" "-std=$2" -Wall -Wextra -Werror -pedantic $includes -fsyntax-only -MD -MF "$read_files" -x c++ -
}
for header in "$source"/include/onset/*.hpp "$source"/include/onset/compat/*.hpp; do
  name=${header#"$source"/include/}
  # It includes another library's headers: the test toolkit_plugin compiles it with those.
  [ "$name" != onset/compat/ipc_toolkit.hpp ] || continue
  case $name in onset/onset.hpp | onset/compat/ipc.hpp) compile "$name" c++20 ;; esac
  compile "$name" c++17
  grep -q "$name" "$read_files"
  if tr ' ' '\n' <"$read_files" | grep -iE -m 3 '(^|/)(one)?tbb(/|\.)'; then
    echo "$name reads TBB"
    exit 1
  fi
  count=$((count + 1))
done
[ $count -ge 8 ] || { echo "found only $count headers in $source/include/onset"; exit 1; }
echo "$count headers: ok"
