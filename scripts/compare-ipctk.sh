#!/bin/sh
# Measures onset against ipctk 1.6.1 on the same frames in the same run, intersections at rest included, and its broad phase
# against FCL's and Embree's.
#   compare-ipctk.sh [NAME=A,B ...] [--repeats N] [--threads N ...]     frames of a scene; default: all scenes of ONSET_DATA
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build="${ONSET_BUILD:-$root/build}"
venv="$build/venv-ipctk"

"$root/scripts/install-packages.sh" library apps peers
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"
cmake -S "$root" -B "$build" -DONSET_BUILD_APPS=ON
cmake --build "$build" --target onset_bench_server onset_broad_phase_peers --parallel "$(nproc)"
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/python" -c 'import ipctk; assert ipctk.__version__ == "1.6.1"' 2>/dev/null ||
  "$venv/bin/python" -m pip install --quiet ipctk==1.6.1 numpy

two_frames() { echo "$1,$2"; }

case "${1:-}" in
  *=*) ;;
  *)
    : "${ONSET_DATA:?name the scenes, or the folder that holds scenes/}"
    for scene in "$ONSET_DATA"/scenes/*/; do
      set -- "$(basename "$scene")=$(two_frames "$scene"frames/*.ply)" "$@"
    done
    ;;
esac

"$venv/bin/python" "$root/apps/bench/scripts/compare_ipctk.py" --server "$build/apps/bench/onset_bench_server" "$@"

echo
echo "Intersections of one frame, one thread, CPU time"
"$venv/bin/python" "$root/apps/bench/scripts/compare_intersections.py" --server "$build/apps/bench/onset_bench_server" "$@"

echo
echo "Broad phases of other libraries, one thread, swept boxes, CPU time"
for scene; do
  case $scene in
    *=*) ;;
    *) break ;;
  esac
  frames=${scene#*=}
  echo
  echo "${scene%%=*}"
  "$build/apps/bench/onset_broad_phase_peers" "${frames%%,*}" "${frames#*,}"
done
