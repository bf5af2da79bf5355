#!/bin/sh
# tests/drivers/intel.sh [COMMAND [ARGUMENT...]]
# Runs a command with Intel's OpenCL runtime for CPUs as the only driver: a second compiler, on any x86-64 machine and
# without root. The runtime comes from PyPI into build/drivers/intel (or $TRIAD_DRIVERS/intel) on the first call. Without
# a command: prints the two variables that select it, for `eval`.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=${TRIAD_DRIVERS:-$root/build/drivers}/intel
# Pinned: the tests' findings are about these versions. Raise both together.
packages="intel-opencl-rt==2026.2.0 intel-cmplr-lib-rt==2026.2.0"

if [ ! -f "$folder/vendors/intel.icd" ]; then
    rm -rf "$folder"
    mkdir -p "$folder"
    python3 -m venv "$folder/venv"
    # shellcheck disable=SC2086 # two packages
    "$folder/venv/bin/pip" install --quiet --disable-pip-version-check $packages >&2
    library=$(find "$folder/venv" -name libintelocl.so | head -n 1)
    [ -n "$library" ] || { echo "intel.sh: the packages hold no libintelocl.so" >&2; exit 1; }
    mkdir "$folder/vendors"
    echo "$library" > "$folder/vendors/intel.icd"
fi
OCL_ICD_VENDORS=$folder/vendors
LD_LIBRARY_PATH=$(dirname "$(cat "$folder/vendors/intel.icd")")${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
if [ $# -eq 0 ]; then
    printf 'export OCL_ICD_VENDORS="%s" LD_LIBRARY_PATH="%s"\n' "$OCL_ICD_VENDORS" "$LD_LIBRARY_PATH"
    exit
fi
export OCL_ICD_VENDORS LD_LIBRARY_PATH
exec "$@"
