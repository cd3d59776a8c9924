#!/bin/sh
# Measures what accuracy costs a simulation and writes the tables and plots of docs/simulation-trade.md again.
#   measure-simulation-trade.sh [quick]     quick: two small scenes, few settings, to try the script; writes
#                                           build/simulation-trade/docs instead
# About 25 minutes on 2 cores. The seconds are CPU seconds: other work on the machine changes them little.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build="${ONSET_BUILD:-$root/build}"
venv="$build/venv-ipctk"
out="$build/simulation-trade"
trade="$root/apps/simulation/trade"

"$root/scripts/install-packages.sh" library apps
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
cmake -S "$root" -B "$build" -DONSET_BUILD_APPS=ON -DONSET_BUILD_ELASTIC=ON >&2
cmake --build "$build" --parallel "$(nproc)" --target onset_cloth onset_elastic onset_baselines >&2
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/python" -c 'import ipctk, matplotlib; assert ipctk.__version__ == "1.6.1"' 2>/dev/null ||
  "$venv/bin/python" -m pip install --quiet ipctk==1.6.1 numpy matplotlib==3.11.2

rm -rf "$out" && mkdir -p "$out"
docs="$root/docs"
if [ "${1:-}" = quick ]; then
  docs="$out/docs"
  mkdir "$docs" && cp "$root/docs/simulation-trade.md" "$docs"
fi
machine=$("$build/apps/bench/onset_baselines" | python3 -c 'import json, sys; print(json.load(sys.stdin)["machine"])')
echo "Machine: $machine. CPU seconds, one thread each run, two runs at a time. ipctk 1.6.1." >"$out/machine"
"$venv/bin/python" -B "$trade/measure.py" "$out" --cloth "$build/apps/cloth/onset_cloth" --elastic "$build/apps/elastic/onset_elastic" \
  --ipctk "$venv/bin/python" ${1:+"--$1"}
"$venv/bin/python" -B "$trade/report.py" "$out" "$docs"
