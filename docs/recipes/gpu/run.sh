#!/usr/bin/env bash
# run.sh DEVICE FOLDER: on the board, in the folder that pack.sh made.
# Proves the device by the cases of triad check, replays every capture and compares its film, measures kernels against the
# device's roof, tries work-group sizes, and compares drivers of paths, formats of nodes, and tinybvh where it was packed.
# Needs bash, awk and an OpenCL driver. FOLDER gets the JSON and pages; summary.txt is also printed. A step that fails is said,
# and the others go on.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
device=${1:?which device: a number, gpu, cpu, or part of a name}
folder=${2:?which folder}
export LD_LIBRARY_PATH=$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
mkdir -p "$folder"
summary=$folder/summary.txt
: >"$summary"
failed=0
step() { # NAME COMMAND...: its output goes to NAME.txt
    local name=$1
    shift
    "$@" >"$folder/$name.txt" 2>&1 && return 0
    failed=1
    echo "FAILED with $?: $name ($(tail -1 "$folder/$name.txt"))" | tee -a "$summary"
    return 1
}

first=1
for capture in "$here"/captures/*.capture; do
    name=$(basename "$capture" .capture)
    options=(--device "$device" --repeat 5 --json "$folder/$name.json" -o "$folder/$name")
    ((first)) && options+=(--check) # once; the others have the same device
    first=0
    step "$name" "$here/triad-replay" "$capture" "${options[@]}" || continue
    awk -v name="$name" '
        / runs of .* samples: / { for (i = 1; i < NF; ++i) if ($i == "samples:") seconds = $(i + 1) }
        / %/ && kernel == "" && /(memory|arithmetic|latency)$/ { kernel = $1; roof = $(NF - 2) " % of the roof by " $NF }
        END { printf "%-32s %8.3f s a run; most time in %s, %s\n", name, seconds, kernel, roof }' \
        "$folder/$name.txt" | tee -a "$summary"
done
for capture in "$here"/captures/*-bvh4.capture; do
    name=$(basename "$capture" .capture)
    step "$name-tune" "$here/triad-replay" "$capture" --device "$device" --repeat 3 --tune --json "$folder/$name-tune.json" &&
        grep '^\* .*groups of' "$folder/$name-tune.txt" | sed "s/^/$name: /" | tee -a "$summary"
done
tinybvh=()
[[ -d $here/tinybvh ]] && tinybvh=(--tinybvh "$here/tinybvh")
for format in bvh8 bvh4; do
    step "rays-$format" "$here/triad-bench-rays" --device "$device" --format $format --size 1536 --rounds 3 "${tinybvh[@]}" \
        --json "$folder/rays-$format.json" && { echo "rays, $format"; cat "$folder/rays-$format.txt"; } | tee -a "$summary"
done
step display "$here/triad-bench-resolve" "$device" && tee -a "$summary" <"$folder/display.txt"
exit $failed
