#!/bin/sh
# tests/drivers/gpu_compilers.sh [--long] [OPTION...]
# Compiles every program of kernels/ with the compilers of real GPUs, on a machine without one: how many registers each
# kernel takes, how much stack, what spills (docs/testing.md; --help lists the options). Clang and AMD's device library are
# Debian's and must be installed (the launcher does that). NVIDIA's ptxas comes from PyPI and Intel's compiler from Debian on
# the first call, both into build/drivers (or $TRIAD_DRIVERS): installing Intel's package would register a driver.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=${TRIAD_DRIVERS:-$root/build/drivers}
ptxas=$folder/nvidia-compiler
intel=$folder/intel-compiler
# Pinned: the limits of gpu_budgets.json are about this version. Clang's and Intel's are those of Debian 12.
nvcc="nvidia-cuda-nvcc-cu12==12.9.86"

command -v clang-15 >/dev/null || { echo "gpu_compilers.sh: no clang-15, which Debian 12 has: skipped" >&2; exit 77; }
if [ ! -f "$ptxas/done" ]; then
    rm -rf "$ptxas"
    python3 -m venv "$ptxas"
    "$ptxas/bin/pip" install --quiet --disable-pip-version-check "$nvcc" >&2
    touch "$ptxas/done"
fi
if [ ! -f "$intel/done" ]; then
    rm -rf "$intel"
    mkdir -p "$intel/packages"
    # The package and what it needs beside what is installed.
    packages=$(apt-get -s install --no-install-recommends intel-opencl-icd | sed -n 's/^Inst \([^ ]*\).*/\1/p')
    # shellcheck disable=SC2086 # one word per package
    (cd "$intel/packages" && apt-get -qq download ${packages:-intel-opencl-icd} >&2)
    for package in "$intel"/packages/*.deb; do dpkg -x "$package" "$intel"; done
    touch "$intel/done"
fi
exec python3 "$root/tests/drivers/gpu_compilers.py" \
    --ptxas "$(find "$ptxas" -name ptxas -type f | head -n 1)" --intel "$intel" "$@"
