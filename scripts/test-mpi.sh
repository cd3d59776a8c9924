#!/bin/sh
# Builds onset::mpi with Open MPI and with MPICH, each in a folder of its own on one build of the library, and runs its tests.
#   test-mpi.sh          small scenes on 1, 2 and 4 ranks, and a few injected faults: minutes
#   test-mpi.sh --all    the recorded scenes (ONSET_DATA says where they are) and 200 generated ones on 1, 2, 3, 4 and 7 ranks, what
#                        steps exchange, and 1,000 faults, with Open MPI: about half an hour of two idle cores
# CMAKE_BUILD_PARALLEL_LEVEL is heeded.
set -eu
cd "$(dirname "$0")/.."
all=
[ "${1:-}" = --all ] && all=yes
scripts/install-packages.sh library mpi
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}" CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}"

# The library that scripts/test.sh has built, if it has.
library=build
if [ ! -f $library/libonset.a ]; then
  library=build/mpi/library
  cmake -S . -B $library -DONSET_BUILD_TESTS=OFF -DONSET_BUILD_APPS=OFF -DBUILD_SHARED_LIBS=OFF >/dev/null
fi
cmake --build $library --target onset

as_root=
[ "$(id -u)" = 0 ] && as_root=--allow-run-as-root
# More ranks than cores: waiting ranks give way.
run() {
  mpi=$1 ranks=$2
  shift 2
  case $mpi in
    openmpi) mpirun.openmpi $as_root --oversubscribe --mca mpi_yield_when_idle 1 -n "$ranks" build/mpi/openmpi/test_mpi "$@" ;;
    mpich) mpirun.mpich -n "$ranks" build/mpi/mpich/test_mpi "$@" ;;
  esac
}

for mpi in openmpi mpich; do
  cmake -S mpi -B build/mpi/$mpi -DONSET_MPI_LIBRARY_BUILD="$PWD/$library" -DMPI_CXX_COMPILER=mpicxx.$mpi \
        -DMPIEXEC_EXECUTABLE=/usr/bin/mpirun.$mpi >/dev/null
  cmake --build build/mpi/$mpi
  # MPICH gives way to no other rank while it waits, so that more ranks than cores take long.
  scenes=22
  for ranks in 1 2 4; do
    [ $mpi-$ranks != mpich-4 ] || scenes=3
    run $mpi $ranks small $scenes
  done
  run $mpi 2 faults 48
done
[ -n "$all" ] || exit 0

[ -z "${ONSET_DATA:-}" ] || run openmpi 4 exchange "$ONSET_DATA/scenes"
for ranks in 1 2 3 4 7; do
  run openmpi $ranks generated 200
  [ -z "${ONSET_DATA:-}" ] || run openmpi $ranks recorded "$ONSET_DATA/scenes"
done
run openmpi 4 faults 1000
