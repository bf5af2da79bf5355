#!/usr/bin/env bash
# deb.sh BUILD CMAKE: makes the Debian package, unpacks it into an empty folder and runs the programs from there.
set -euo pipefail
build=$1 cpack=${2%cmake}cpack
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }

"$cpack" --config "$build/CPackConfig.cmake" -B "$folder/made" >"$folder/log" || fail "cpack: $(tail "$folder/log")"
deb=("$folder"/made/*.deb)
dpkg-deb -x "${deb[0]}" "$folder/root"
version=$(dpkg-deb -f "${deb[0]}" Version) depends=$(dpkg-deb -f "${deb[0]}" Depends)
for package in libc6 libstdc++6 'libopencl1 ' libopenimageio libpng16 libopenexr libfftw3; do
    [[ "$depends " == *$package* ]] || fail "the package does not depend on $package: $depends"
done
programs=$folder/root/usr/bin
[[ $("$programs/triad" --version) == "triad $version" ]] || fail "triad --version does not say $version"
cd "$folder"
"$programs/triad" render "$folder/root/usr/share/triad/scenes/cornell/cornell.gltf" --size 32x32 --spp 4 -q -o a.png
"$programs/triad" info "$folder/root/usr/share/triad/scenes/suite/glass.glb" >/dev/null
"$programs/triad-replay" --help >/dev/null
"$programs/triad" render --size 32x32 --spp 4 -q -o a.exr -o a.hdr
[[ -s a.png && -s a.exr && -s a.hdr ]] || fail "no picture"
[[ -e root/usr/share/doc/triad/copyright ]] || fail "no licence"
printf 'right: %s, depends on %s\n' "${deb[0]##*/}" "$depends"
