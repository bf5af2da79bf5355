#!/usr/bin/env bash
# tests/drivers/together.sh [--rusticl]
# Several drivers make one picture: PoCL and Intel's runtime (and with --rusticl Mesa's, which compiles for minutes) share it.
# They take the same samples as PoCL alone and round otherwise: the picture differs by far less than its noise, the film says who
# took what, and a run that is interrupted goes on on one of them. TRIAD names the program (default: build/bin/triad).
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
triad=${TRIAD:-$root/build/bin/triad}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/vendors"
add() { # SCRIPT: its vendor file and its libraries
    local settings
    # shellcheck disable=SC2016  # the script sets them
    settings=$("$root/tests/drivers/$1" sh -c 'echo "$OCL_ICD_VENDORS $LD_LIBRARY_PATH"')
    cp "${settings%% *}"/*.icd "$folder/vendors/"
    libraries=${settings#* }${libraries:+:$libraries}
}
libraries=${LD_LIBRARY_PATH:-}
cp "${OCL_ICD_VENDORS:-/etc/OpenCL/vendors}"/pocl*.icd "$folder/vendors/"
devices=portable,intel names=2
add intel.sh
if [[ ${1:-} == --rusticl ]]; then
    add rusticl.sh
    export RUSTICL_ENABLE=llvmpipe
    devices+=,rusticl names=3
fi
export OCL_ICD_VENDORS=$folder/vendors LD_LIBRARY_PATH=$libraries
options=(--size 96x64 --spp 64 --max-depth 6 -q --progress none)
cd "$folder"
"$triad" render "${options[@]}" --device portable -o alone.exr --film alone.film
"$triad" render "${options[@]}" --device "$devices" -o together.exr --film together.film --json together.json
"$triad" info together.film | grep device
found=$("$triad" info together.film | grep -c '% of the samples')
((found == names)) || { echo "together.sh: the film names $found devices, not $names" >&2; exit 1; }
# The estimated relMSE of either is about .01.
"$triad" compare alone.exr together.exr --max-relmse 0.001
# One of them goes on with what all began.
"$triad" render --size 96x64 --time 1 --adaptive off -q --device "$devices" --film cut.film
"$triad" render --resume cut.film --time 0.5 -q --device portable
(($("$triad" info cut.film | grep -c '% of the samples') == names))
echo "together: $names drivers make one picture"
