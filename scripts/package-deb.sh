#!/bin/sh
# Makes packages for Debian and Ubuntu, of a shared library that is hardened as the distribution's are, and runs lintian on them:
# build/deb/deb/libonset0.1_*.deb, libonset-dev_*.deb and onset-tools_*.deb. About seven minutes on 2 cores.
#   package-deb.sh [FOLDER]       FOLDER: the build's; default build/deb, or ONSET_BUILD
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-${ONSET_BUILD:-$root/build/deb}}
"$root/scripts/install-packages.sh" library apps packages
export CMAKE_GENERATOR="${CMAKE_GENERATOR:-Ninja}"

# Without -g: what is not packed need not be made.
export DEB_BUILD_MAINT_OPTIONS="hardening=+all" DEB_CXXFLAGS_STRIP=-g
cd "$root"
cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DBUILD_SHARED_LIBS=ON -DONSET_DEB=ON \
  -DONSET_BUILD_APPS=ON -DONSET_BUILD_TESTS=OFF -DCMAKE_SKIP_INSTALL_ALL_DEPENDENCY=ON \
  "-DCMAKE_CXX_FLAGS=$(dpkg-buildflags --get CXXFLAGS) $(dpkg-buildflags --get CPPFLAGS)" \
  "-DCMAKE_SHARED_LINKER_FLAGS=$(dpkg-buildflags --get LDFLAGS)" "-DCMAKE_EXE_LINKER_FLAGS=$(dpkg-buildflags --get LDFLAGS)"
cmake --build "$build" --target onset_deb --parallel "$(nproc)"

rm -f "$build"/deb/*.deb
cd "$build"
cpack --config "$build/CPackConfig.cmake" >"$build/cpack.log" || { cat "$build/cpack.log"; exit 1; }
# The tag that is left out asks for the bug in which a package was announced to Debian.
lintian --allow-root --fail-on error,warning --info --suppress-tags initial-upload-closes-no-bugs "$build"/deb/*.deb
echo "lintian: no error, no warning"
ls -l "$build"/deb/*.deb
