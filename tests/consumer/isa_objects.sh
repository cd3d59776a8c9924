#!/bin/sh
# No object compiled for a newer instruction set may define an inline function: the linker could keep that copy of it for callers on
# older machines. Inline constants (V, u) are the same bytes in every copy.
#   isa_objects.sh OBJECT...
set -eu
count=0
for object; do
  case $object in *_avx2.cpp.o* | *_avx512.cpp.o*) ;; *) continue ;; esac
  if nm -C --defined-only "$object" | grep -E ' W '; then
    echo "$object defines these inline functions"
    exit 1
  fi
  count=$((count + 1))
done
echo "$count objects: ok"
