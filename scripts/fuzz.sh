#!/bin/sh
# Fuzzes with libFuzzer under the address and undefined behaviour sanitizers, target after target, and prints a line for each.
#   fuzz.sh [HOURS|RUNSx] [TARGET...]     default: 8 hours, shared by all targets: meshes calls queries readers
#   fuzz.sh 5000x queries                 as many inputs instead, for each target
# What was found interesting stays in build/fuzz/corpus/TARGET and is where the next run begins; inputs that break something are
# in build/fuzz/found/TARGET, and `build/fuzz/tests/fuzz/fuzz_TARGET --files FILE` says what it is.
set -eu
cd "$(dirname "$0")/.."
scripts/install-packages.sh library apps tests clang
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
much=${1:-8}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- meshes calls queries readers

cmake --preset fuzz >/dev/null
for target; do
  cmake --build build/fuzz --parallel "$(nproc)" --target libfuzzer_"$target" fuzz_"$target"
done

case $much in
  *x) limit="-runs=${much%x}" ;;
  *) limit="-max_total_time=$(awk -v hours="$much" -v targets=$# 'BEGIN { printf "%d", hours * 3600 / targets }')" ;;
esac
export ASAN_OPTIONS="detect_stack_use_after_return=1:malloc_context_size=8${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
export UBSAN_OPTIONS=print_stacktrace=1
status=0
for target; do
  corpus=build/fuzz/corpus/$target found=build/fuzz/found/$target log=build/fuzz/$target.log
  mkdir -p "$corpus" "$found"
  [ -n "$(ls -A "$corpus")" ] || build/fuzz/tests/fuzz/fuzz_"$target" --seeds "$corpus" 500
  most=600
  [ "$target" != readers ] || most=2000
  code=0
  # A file may take that much at once; a sanitizer needs several times as much in all.
  build/fuzz/tests/fuzz/libfuzzer_"$target" "$limit" -max_len=$most -timeout=60 -malloc_limit_mb=64 -rss_limit_mb=4096 \
    -print_final_stats=1 -verbosity=0 -artifact_prefix="$found/" "$corpus" >"$log" 2>&1 || code=$?
  runs=$(awk '/number_of_executed_units/ { print $2 }' "$log")
  echo "$target: ${runs:-?} executions, $(find "$corpus" -type f | wc -l) in the corpus, $([ $code = 0 ] && echo "0 crashes" || echo "STOPPED by a crash, see $log")"
  [ $code = 0 ] || status=1
done
exit $status
