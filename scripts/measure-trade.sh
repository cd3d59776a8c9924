#!/bin/sh
# Measures the trade of speed against accuracy and writes the tables and plots of docs/accuracy-and-speed.md again.
#   measure-trade.sh [quick]     quick: few queries and repeats, to try the script
# Needs ONSET_DATA, the folder of the real data. About 7 minutes on 2 cores; nothing else should run meanwhile.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build="${ONSET_BUILD:-$root/build}"
venv="$build/venv-ipctk"
out="$build/trade"
: "${ONSET_DATA:?the folder that holds queries/ and scenes/}"

sample=3000 count=12 repeats=9 seconds=4 every=2
[ "${1:-}" != quick ] || { sample=300 count=6 repeats=2 seconds=1 every=5; }

"$root/scripts/install-packages.sh" library apps tests
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
cmake -S "$root" -B "$build" -DONSET_BUILD_TESTS=ON -DONSET_BUILD_APPS=ON >&2
cmake --build "$build" --parallel "$(nproc)" \
  --target onset_cli onset_baselines onset_recorded_queries onset_stability_queries >&2
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/python" -c 'import ipctk, matplotlib; assert ipctk.__version__ == "1.6.1"' 2>/dev/null ||
  "$venv/bin/python" -m pip install --quiet ipctk==1.6.1 numpy matplotlib==3.11.2

say() { echo "$(date +%T) $*" >&2; }

say "queries with exact truth"
rm -rf "$out" && mkdir -p "$out"
cut -d ' ' -f 1 /proc/loadavg >"$out/load"
"$build/tests/accuracy/onset_recorded_queries" "$ONSET_DATA" "$out" "$sample"
"$build/tests/accuracy/onset_stability_queries" "$out/stability" "$count"

trade() {  # name, arguments
  name=$1
  shift
  say "trade: $name"
  "$build/apps/onset" trade "$@" --repeats "$repeats" --seconds "$seconds" --json "$out/trade-$name.json" >/dev/null
}
for scene in "$ONSET_DATA"/scenes/*/; do
  name=$(basename "$scene")
  trade "$name" "$scene"frames/*.ply --truth "$out/scenes/$name/truth.csv"
done
trade handmade --queries "$out"/handmade/*/*/data.csv
trade scene-pairs --queries "$out"/scenes/*/*/data.csv

ask() {  # name, boxes, checks, seconds, every, folders
  name=$1 boxes=$2 checks=$3 limit=$4 each=$5
  shift 5
  say "root finders: $name"
  "$venv/bin/python" "$root/apps/bench/scripts/ask_ipctk.py" --every "$each" --checks "$checks" --limit "$limit" "$@" \
    >"$out/ipctk-$name.json"
  for folder; do
    set -- "$@" "$folder/data.csv"
    shift
  done
  "$build/apps/bench/onset_baselines" --every "$each" --boxes "$boxes" "$@" >"$out/baselines-$name.json"
}
ask handmade 100000 1000000 3 "$every" "$out"/handmade/*/*
ask scenes 100000 1000000 3 "$every" "$out"/scenes/*/*-*
ask stability 20000 10000 0.2 1 "$out"/stability/*/*/*

say "minimum separation"
for d in 1e-2 1e-8 1e-16 1e-30 1e-100; do
  for name in handmade scenes; do
    "$build/apps/bench/onset_baselines" --every "$every" --boxes 10000 --separation "$d" "$out/$name"/*/*/data.csv \
      >"$out/separation-$name-$d.json"
  done
done

say "tolerance"
for delta in 1e-1 1e-2 1e-3 1e-4 1e-5 1e-6 1e-7 1e-8; do
  for name in handmade scenes; do
    "$build/apps/bench/onset_baselines" --every "$((10 * every))" --tolerance "$delta" "$out/$name"/*/*/data.csv \
      >"$out/tolerance-$name-$delta.json"
  done
done

say "tables and plots"
"$venv/bin/python" "$root/apps/bench/scripts/report_trade.py" "$out" "$root/docs"
