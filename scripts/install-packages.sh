#!/bin/sh
# Installs the Debian or Ubuntu packages that are missing, and nothing when none is.
#   install-packages.sh GROUP...     groups: library, apps, tests, peers, clang, tidy, profile, python, site, packages, arm,
#                                    mpi, petsc
set -eu

library="g++ cmake ninja-build libeigen3-dev libtbb-dev libboost-dev"
apps="libcli11-dev nlohmann-json3-dev libcgal-dev libboost-dev"
tests="catch2 nlohmann-json3-dev libboost-dev libgmp-dev libfcl-dev git pkg-config python3 python3-venv ca-certificates"
peers="libfcl-dev libembree-dev python3 python3-venv ca-certificates"
clang="clang libclang-rt-dev"
tidy="clang clang-tidy"
profile="linux-perf valgrind"
python="python3 python3-dev python3-venv ca-certificates libegl1 libgl1-mesa-dri"
site="doxygen python3 python3-venv ca-certificates"
packages="debootstrap dpkg-dev file help2man lintian"
arm="g++-aarch64-linux-gnu qemu-user"
mpi="libopenmpi-dev openmpi-bin libmpich-dev mpich nlohmann-json3-dev"
petsc="petsc-dev"

wanted=
for group; do
  case $group in
    library) wanted="$wanted $library" ;;
    apps) wanted="$wanted $apps" ;;
    tests) wanted="$wanted $tests" ;;
    peers) wanted="$wanted $peers" ;;
    clang) wanted="$wanted $clang" ;;
    tidy) wanted="$wanted $tidy" ;;
    profile) wanted="$wanted $profile" ;;
    python) wanted="$wanted $python" ;;
    site) wanted="$wanted $site" ;;
    packages) wanted="$wanted $packages" ;;
    arm) wanted="$wanted $arm" ;;
    mpi) wanted="$wanted $mpi" ;;
    petsc) wanted="$wanted $petsc" ;;
    *) echo "install-packages.sh: no group '$group'" >&2; exit 2 ;;
  esac
done

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "This system has no apt-get. Install what these packages of Debian hold, then use cmake:$wanted" >&2
  exit 1
fi

missing=
for package in $wanted; do
  status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [ "$status" = "install ok installed" ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || { echo "As root: apt-get install$missing" >&2; exit 1; }
  as_root=sudo
fi
echo "Installing:$missing"
$as_root apt-get update -q
# shellcheck disable=SC2086  # the packages are words
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
