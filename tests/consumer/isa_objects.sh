#!/bin/sh
# No object compiled for a newer instruction set may define a weak symbol: the linker could keep that copy of an inline function
# for callers on older machines.
#   isa_objects.sh OBJECT...
set -eu
count=0
for object; do
  case $object in *_avx2.cpp.o*) ;; *) continue ;; esac
  if nm -C --defined-only "$object" | grep -E ' [WVu] '; then
    echo "$object defines these weak symbols"
    exit 1
  fi
  count=$((count + 1))
done
echo "$count objects: ok"
