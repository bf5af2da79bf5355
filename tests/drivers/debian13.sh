#!/bin/sh
# tests/drivers/debian13.sh [COMMAND [ARGUMENT...]]
# Builds a copy of this source on Debian 13 with its GCC 14, warnings being errors, and runs the unit and device tests and
# triad check there, on its PoCL 6; or COMMAND in the copy's folder. Debian 13 is a chroot below build/drivers (or
# $TRIAD_DRIVERS) that the first call makes, from where apt takes its packages. Needs root.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=${TRIAD_DRIVERS:-$root/build/drivers}
chroot=$folder/debian13
assets=${TRIAD_TEST_ASSETS:-$root/../shared/assets}
say() { echo "debian13.sh: $*" >&2; }

[ "$(id -u)" -eq 0 ] || { say "a chroot needs root: skipped"; exit 77; }
command -v apt-get >/dev/null || { say "this is no Debian: skipped"; exit 77; }
# Mounts of a namespace of its own end with the last process in it, however that ends.
if [ "${1:-}" != --mounting ]; then
    exec unshare --mount --propagation private "$0" --mounting "$@"
fi
shift

if [ ! -f "$chroot/made" ]; then
    say "making the chroot; this takes a few minutes"
    rm -rf "$chroot"
    mkdir -p "$chroot"
    command -v debootstrap >/dev/null || DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends debootstrap >&2
    # shellcheck disable=SC2016 # apt's own fields
    mirror=$(apt-get indextargets --format '$(ORIGIN) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' | sed -n 's/^Debian main //p' | head -n 1)
    [ -n "$mirror" ] || { say "apt's sources name no Debian"; exit 1; }
    debootstrap --variant=minbase --include=ca-certificates trixie "$chroot" "$mirror" >&2
    touch "$chroot/made"
fi
apt-config dump | grep -i '^Acquire::https\?::proxy' > "$chroot/etc/apt/apt.conf.d/proxy" || true
cp -L /etc/resolv.conf "$chroot/etc/resolv.conf"

# A copy, with the times of the original, for builds after the first one. /proc and /sys tell PoCL 6 how much memory there is.
mkdir -p "$chroot/triad" "$chroot/shared/assets"
find "$chroot/triad" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
tar -C "$root" --exclude='./build*' --exclude=./.git --exclude=./.ccache -c . | tar -C "$chroot/triad" -x
mount --bind "$chroot" "$chroot" # a mount point, so that a test within may make a namespace of its own
mount -t proc proc "$chroot/proc"
mount --rbind /sys "$chroot/sys"
mount --rbind /dev "$chroot/dev"
[ ! -d "$assets" ] || mount --bind "$assets" "$chroot/shared/assets"

inside() {
    chroot "$chroot" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 CI="${CI:-}" CXXFLAGS=-Werror \
        sh -c 'cd /triad && exec "$@"' sh "$@"
}
if [ $# -gt 0 ]; then
    inside "$@"
else
    status=0
    inside ./triad test unit device || status=$?
    inside ./triad check || status=$?
    exit "$status"
fi
