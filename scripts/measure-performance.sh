#!/bin/sh
# Measures speed and memory and writes the tables of docs/performance.md and docs/scaling.md again.
#   measure-performance.sh [quick] [PART ...]     parts: ipctk, candidates, peers, loop, threads, size, huge, profile, memory,
#                                                 traffic, serial; default: all
# quick: one small scene, few repeats, to try the script; writes into build/performance-quick/ instead.
# Needs ONSET_DATA, the folder of the real data. About half an hour on 2 cores and 16 GiB; nothing else should run meanwhile.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build="${ONSET_BUILD:-$root/build}"
venv="$build/venv-ipctk"
out="$build/performance"
bench="$root/apps/bench/scripts"
: "${ONSET_DATA:?the folder that holds scenes/}"

documents="$root/docs"
repeats=3 rounds=15 every=60 largest=10000000 refine=4 seconds=4 limit=40 memory=10 factor=10 rounds_of_peers=15 mib=256 calls=15 repeats_small=60 scenes='*'
if [ "${1:-}" = quick ]; then
  shift
  out="$build/performance-quick"
  repeats=1 rounds=2 every=600 largest=10000 refine=1 seconds=1 limit=2 memory=1 factor=0.1 rounds_of_peers=1 mib=16 calls=5 repeats_small=3 scenes='cloth-funnel'
  mkdir -p "$out" && cp "$documents/performance.md" "$documents/scaling.md" "$out"
  documents=$out
fi
[ $# -gt 0 ] || { rm -f "$out/load"; set -- ipctk candidates peers loop threads size huge profile memory traffic serial; }

"$root/scripts/install-packages.sh" library apps peers
{ command -v perf && command -v valgrind; } >/dev/null || "$root/scripts/install-packages.sh" profile
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
cmake -S "$root" -B "$build" -DONSET_BUILD_APPS=ON >&2
cmake --build "$build" --parallel "$(nproc)" \
  --target onset_cli onset_bench_server onset_broad_phase_peers onset_baselines onset_memory_bandwidth >&2
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/python" -c 'import ipctk; assert ipctk.__version__ == "1.6.1"' 2>/dev/null ||
  "$venv/bin/python" -m pip install --quiet ipctk==1.6.1 numpy

wanted=$*
two_frames() { echo "$1,$2"; }
set --
for scene in "$ONSET_DATA"/scenes/$scenes/; do
  set -- "$@" "$(basename "$scene")=$(two_frames "$scene"frames/*.ply)"
done
small=$1
for scene; do  # the one with the smallest files: its huge step already has more pairs than memory can hold elsewhere
  case $scene in cloth-funnel=*) small=$scene ;; esac
done
mkdir -p "$out"
touch "$out/load"

python() { "$venv/bin/python" "$bench/$@"; }
server="$build/apps/bench/onset_bench_server"

measure() {  # part, scenes
  part=$1
  shift
  case $part in
    ipctk)
      python compare_ipctk.py --server "$server" "$@" --repeats "$repeats" ;;
    candidates)
      python every_candidate.py --server "$server" "$@" --every "$every" ;;
    peers)
      for scene; do
        frames=${scene#*=}
        printf '%s\n\n```text\n' "${scene%%=*}"
        "$build/apps/bench/onset_broad_phase_peers" "${frames%%,*}" "${frames#*,}" "$rounds_of_peers"
        printf '```\n\n'
      done ;;
    threads)
      python two_threads.py --server "$server" --onset "$build/apps/onset" "$@" --rounds "$rounds" --repeats "$repeats_small" ;;
    loop)
      python newton_loop.py --onset "$build/apps/onset" "$@" --calls "$calls" ;;
    size)
      python size_curve.py --onset "$build/apps/onset" --largest "$largest" --refine "$refine" ;;
    huge)
      python huge_step.py --onset "$build/apps/onset" --server "$server" "$small" \
        --limit "$limit" --memory "$memory" --factor "$factor" ;;
    profile)
      python profile.py --server "$server" "$@" --seconds "$seconds" ;;
    memory)
      "$build/apps/bench/onset_memory_bandwidth" "$mib" ;;
    traffic)
      copied=$(awk -F '|' '$2 == " 1 " { print $3 }' "$out/memory.md")
      python memory_traffic.py --server "$server" --copied "$copied" "$@" ;;
    serial)
      python serial_share.py --server "$server" "$@" ;;
    *)
      echo "measure-performance.sh: no part '$part'" >&2
      exit 2 ;;
  esac
}

for part in $wanted; do
  echo "$(date +%T) $part" >&2
  load=$(cut -d ' ' -f 1 /proc/loadavg)
  measure "$part" "$@" >"$out/$part.md.part"
  mv "$out/$part.md.part" "$out/$part.md"
  { grep -v "^$part " "$out/load" || true; echo "$part $load"; } >"$out/load.new"
  mv "$out/load.new" "$out/load"
done
machine=$("$build/apps/bench/onset_baselines" | python3 -c 'import json, sys; print(json.load(sys.stdin)["machine"])')
loads=$(awk '{ printf "%s%s %s", sep, $1, $2; sep = ", " }' "$out/load")
echo "Machine: $machine. Load average before each part: $loads." >"$out/machine.md"

for document in performance scaling; do
  python fill_measured.py "$documents/$document.md" "$out"
done
echo "$(date +%T) $documents" >&2
