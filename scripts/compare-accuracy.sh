#!/bin/sh
# Prints the tables of docs/accuracy.md: extreme queries with exact truth, asked of onset and of ipctk 1.6.1.
#   compare-accuracy.sh [COUNT [SEED]]     queries of each family and kind
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build="${ONSET_BUILD:-$root/build}"
venv="$build/venv-ipctk"
queries="$build/extreme-queries"

"$root/scripts/install-packages.sh" library apps tests
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
cmake -S "$root" -B "$build" -DONSET_BUILD_TESTS=ON -DONSET_BUILD_APPS=ON >&2
cmake --build "$build" --target onset_cli onset_extreme_queries --parallel "$(nproc)" >&2
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/python" -c 'import ipctk; assert ipctk.__version__ == "1.6.1"' 2>/dev/null ||
  "$venv/bin/python" -m pip install --quiet ipctk==1.6.1 numpy

rm -rf "$queries"
"$build/tests/accuracy/onset_extreme_queries" "$queries" "${1:-20}" "${2:-1}"
exec "$venv/bin/python" "$root/apps/bench/scripts/compare_accuracy.py" --onset "$build/apps/onset" --queries "$queries"
