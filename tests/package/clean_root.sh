#!/usr/bin/env bash
# clean_root.sh ARCHITECTURE DEBS ROOT [SCENARIO]: installs the packages of the folder DEBS, which cpack
# made for amd64 or arm64, into a new Debian 12 in ROOT that has nothing else, flies a mission there, and
# removes them again. The summary with the trace's hash is printed. Needs root, the network and mmdebstrap;
# for arm64 also arch-test and qemu-user-static, with binfmt_misc, so that its programs start by themselves.
set -euo pipefail
architecture=${1:?amd64 or arm64}
debs=${2:?a folder with the packages}
root=${3:?a folder that is not there yet}
scenario=${4:-delivery_forest}
export DEBIAN_FRONTEND=noninteractive LC_ALL=C
export QEMU_CPU=cortex-a57 # of a Jetson TX2; nobody else reads it

inside() {
  chroot "$root" "$@"
}

[[ ! -e $root ]] || { printf '"%s" is there already; remove it or name another folder\n' "$root" >&2 && exit 2; }
mmdebstrap --mode=root --variant=minbase --architectures="$architecture" bookworm "$root" >&2
cp /etc/resolv.conf "$root/etc/resolv.conf"
mkdir "$root/packages"
cp "$debs"/flyball_*_"$architecture".deb "$debs"/flyball-data_*_all.deb "$debs"/libflyball-governor0_*_"$architecture".deb \
  "$root/packages"
inside dpkg --get-selections | sort > "$root/packages/before"
inside apt-get -q update >&2
inside sh -c 'apt-get -q install -y /packages/*.deb' >&2

# A board is looked for below these two.
trap 'umount "$root/sys" "$root/proc"' EXIT
mount -t proc proc "$root/proc"
mount -t sysfs -o ro sysfs "$root/sys"

inside flyball version
inside flyball board
inside sh -c "cd /root && flyball run $scenario --json --out flight"
# With people to look for: where they are not installed it is refused, with another code than a flight
# whose time is over.
code=0
inside sh -c 'cd /root && flyball run search_collapsed_building --set mission.time_limit_s=5 --out search' >&2 || code=$?
((code == 1))

# apt recommends certificates itself, and would keep those that came with a library.
inside sh -c 'apt-get -q purge -y flyball flyball-data libflyball-governor0 &&
  apt-get -q autoremove -y --purge -o APT::AutoRemove::RecommendsImportant=false' >&2
inside dpkg --get-selections | sort > "$root/packages/after"
diff "$root/packages/before" "$root/packages/after"
left=$(find "$root/usr" "$root/etc" "$root/var/lib" -iname '*flyball*')
[[ -z $left ]] || { printf 'purging leaves %s\n' "$left" >&2 && exit 1; }
