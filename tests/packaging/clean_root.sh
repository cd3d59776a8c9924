#!/bin/sh
# Makes the packages, and tries them in a clean root of this distribution: they are installed there with what they depend on, a
# program is built against them with CMake and with pkg-config, the command line runs, and after a purge nothing of them is left.
#   clean_root.sh SOURCE WORK PROGRAM      PROGRAM prints what the one in the clean root must print
# Needs root, for chroot, and what `scripts/install-packages.sh packages` installs; where one is missing it ends with 77.
# shellcheck disable=SC2046,SC2086,SC2016  # lists of packages are words, and what is quoted is for the shell inside
set -eu
source=$1 work=$2 program=$3
root=$work/root
[ "$(id -u)" = 0 ] || { echo "skipped: to make a clean root needs root"; exit 77; }
for needed in apt-get debootstrap dpkg-shlibdeps help2man lintian; do
  command -v $needed >/dev/null || { echo "skipped: no $needed here, which scripts/install-packages.sh packages installs"; exit 77; }
done

# Whatever is mounted in the root goes first: nothing of this system may be removed through it.
remove_root() {
  for mounted in $(awk -v root="$root/" 'index($2, root) == 1 { print $2 }' /proc/mounts | sort -r); do umount "$mounted"; done
  rm -rf --one-file-system "$root"
}
remove_root
mkdir -p "$work"
trap remove_root EXIT
trap 'exit 1' HUP INT TERM

"$source/scripts/package-deb.sh" "$work/build"

codename=$(. /etc/os-release && echo "$VERSION_CODENAME")
indexed() { apt-get indextargets --format "$1" "Codename: $codename" "Created-By: Packages"; }
mirror=$(indexed '$(REPO_URI)' | head -n 1)
debootstrap --variant=minbase --components="$(indexed '$(COMPONENT)' | sort -u | paste -s -d ,)" "$codename" "$root" "$mirror" >"$work/debootstrap.log" 2>&1 ||
  { tail -n 20 "$work/debootstrap.log"; exit 1; }
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
apt() { inside apt-get -q -y --no-install-recommends "$@" >"$work/apt.log" 2>&1 || { cat "$work/apt.log"; return 1; }; }
[ ! -e /etc/resolv.conf ] || cp -L /etc/resolv.conf "$root/etc/resolv.conf"
apt update
apt install g++ cmake make pkg-config

# All files but those in which dpkg, apt and ld.so note what was done.
list() {
  (cd "$root" && find . -xdev -regextype posix-extended -regex './(var/(lib/(dpkg|apt)|cache|log)|proc|sys|dev|tmp|root|packages)' -prune \
    -o ! -path ./etc/ld.so.cache -print | LC_ALL=C sort)
}
packages() { inside dpkg-query -W -f '${Package}\n' | LC_ALL=C sort; }
list >"$work/before.txt"
packages >"$work/packages_before.txt"

mkdir "$root/packages"
cp "$work"/build/deb/*.deb "$root/packages"
apt install $(cd "$work/build/deb" && ls -- *.deb | sed 's|^|/packages/|')
list >"$work/with.txt"
packages | LC_ALL=C comm -13 "$work/packages_before.txt" - >"$work/packages_new.txt"
echo "installed:" $(cat "$work/packages_new.txt")
if grep -q libtbb-dev "$work/packages_new.txt"; then echo "oneTBB's headers came along, which no user of a shared onset needs"; exit 1; fi

cp -R "$source/tests/consumer/app" "$root/root/app"
"$program" >"$work/expected.txt"
inside sh -eu -c 'cmake -S /root/app -B /root/build -DCMAKE_BUILD_TYPE=Release && cmake --build /root/build' >"$work/consumer.log" 2>&1 ||
  { cat "$work/consumer.log"; exit 1; }
inside /root/build/consumer >"$work/by_cmake.txt"
cmp "$work/expected.txt" "$work/by_cmake.txt"
inside sh -eu -c 'g++ -std=c++17 -o /root/by_pkg_config /root/app/*.cpp $(pkg-config --cflags --libs onset)'
inside /root/by_pkg_config >"$work/by_pkg_config.txt"
cmp "$work/expected.txt" "$work/by_pkg_config.txt"
inside onset --help | grep -q '^Usage: onset'
echo "a program by find_package, one by pkg-config, onset --help: ok"

apt purge $(cd "$work/build/deb" && ls -- *.deb | sed 's|_.*||')
apt autoremove --purge
list >"$work/after.txt"
packages | cmp "$work/packages_before.txt" -
diff "$work/before.txt" "$work/after.txt" || { echo "the purge left this, or took it"; exit 1; }
[ "$(LC_ALL=C comm -13 "$work/before.txt" "$work/with.txt" | grep -c onset)" -ge 40 ]
echo "purged: of $(LC_ALL=C comm -13 "$work/before.txt" "$work/with.txt" | wc -l) files and folders nothing is left"
