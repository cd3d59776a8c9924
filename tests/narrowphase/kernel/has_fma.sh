#!/bin/sh
# Fused multiplications are in the program: the test of contracted code tests what it says.
#   has_fma.sh PROGRAM
set -eu
count=$(objdump -d "$1" | grep -c vfm || true)
echo "$count fused multiplications"
[ "$count" -gt 100 ]
