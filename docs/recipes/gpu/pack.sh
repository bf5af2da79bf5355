#!/usr/bin/env bash
# docs/recipes/gpu/pack.sh FOLDER
# Packs what a board needs to be checked, measured and tuned: triad-replay, the programs of tests/bench, and captures of some
# scenes by each driver of paths and format of nodes. With TINYBVH=CHECKOUT its OpenCL kernels go along, to be measured on the
# same rays. Copy FOLDER to the board and start run.sh there. PoCL suffices to pack; it takes minutes.
set -euo pipefail
root=$(cd "$(dirname "$0")/../../.." && pwd)
folder=${1:?which folder}
scenes=${SCENES:-built-in cornell glass garden}
size=${SIZE:-480x270}
mkdir -p "$folder/captures"
cmake -S "$root" -B "$root/build-bench" --preset bench ${TINYBVH:+-DTRIAD_TINYBVH="$TINYBVH"} >/dev/null
cmake --build "$root/build-bench" --target triad triad-replay triad-bench-rays triad-bench-resolve
bin=$root/build-bench/bin
for scene in $scenes; do
    case $scene in
        built-in) file=() ;;
        cornell) file=("$root/scenes/cornell/cornell.gltf") ;;
        *) file=("$root/scenes/suite/$scene.glb") ;;
    esac
    for driver in mega wave-stages; do
        for format in bvh8 bvh4; do
            "$bin/triad" capture "${file[@]}" --size "$size" --spp 4 --driver $driver --format $format -q \
                -o "$folder/captures/$scene-$driver-$format.capture"
        done
    done
done
cp "$bin/triad-replay" "$(find "$root/build-bench" -name triad-bench-rays -type f)" \
    "$(find "$root/build-bench" -name triad-bench-resolve -type f)" "$root/docs/recipes/gpu/run.sh" "$folder"
mkdir -p "$folder/lib" # what the programs need beside the C and C++ libraries and the OpenCL loader, which are the board's
for program in "$folder"/triad-*; do ldd "$program"; done | awk '$3 ~ /^\// { print $3 }' | sort -u |
    grep -vE '/(libc|libm|libgcc_s|libstdc\+\+|libOpenCL)\.so' | xargs -r cp -L -t "$folder/lib"
if [[ -n ${TINYBVH:-} ]]; then
    mkdir -p "$folder/tinybvh"
    cp "$TINYBVH"/traverse*.cl "$folder/tinybvh"
fi
echo "Copy $folder to the board, and there: ./run.sh gpu report"
