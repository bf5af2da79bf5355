#!/bin/sh
# tests/drivers/rusticl.sh COMMAND [ARGUMENT...]
# Runs a command with Mesa's rusticl on llvmpipe as the only driver: a third compiler. Debian's mesa-opencl-icd is unpacked
# into build/drivers/rusticl (or $TRIAD_DRIVERS/rusticl) on the first call, so that no other program sees it; the libraries
# that it uses, libclc and libllvmspirvlib of the launcher's list, must be installed (libclc is found in its own place alone).
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=${TRIAD_DRIVERS:-$root/build/drivers}/rusticl
if [ ! -f "$folder/vendors/rusticl.icd" ]; then
    rm -rf "$folder"
    mkdir -p "$folder/packages" "$folder/vendors"
    (cd "$folder/packages" && apt-get -qq download mesa-opencl-icd >&2)
    for package in "$folder"/packages/*.deb; do dpkg -x "$package" "$folder/files"; done
    library=$(find "$folder/files" -name 'libRusticlOpenCL.so*' | head -n 1)
    [ -n "$library" ] || { echo "rusticl.sh: the packages hold no libRusticlOpenCL.so" >&2; exit 1; }
    echo "$library" > "$folder/vendors/rusticl.icd"
fi
libraries=$(find "$folder/files" -name '*.so*' -exec dirname {} + | sort -u | paste -sd :)
export RUSTICL_ENABLE=llvmpipe OCL_ICD_VENDORS="$folder/vendors" LD_LIBRARY_PATH="$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
exec "$@"
