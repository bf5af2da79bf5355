#!/usr/bin/env bash
# Renders scenes, compares the pictures with those that are kept, and keeps what a person needs to see why they differ:
#   pictures.sh [-u] [-l LIMIT] [-f FOLDER] -r REFERENCES SCENE... [-- OPTIONS OF triad render]
# REFERENCES/NAME.exr is the picture of NAME.glb. FOLDER (default: pictures) gets NAME.exr, NAME.png, NAME.json, the numbers
# of the comparison, NAME.difference.png where it differs, and summary.md. LIMIT is of FLIP (default 0.02).
# -u makes the pictures the references instead of comparing them. Exit: the largest code of render and compare.
# Without options: --spp 64 --size 480x270. References are of the same options.
# TRIAD names the program (default: triad).
set -euo pipefail
: "${TRIAD:=triad}"
update="" limit=0.02 folder=pictures references=""
usage() { sed -n '2,/^set /s/^# \{0,1\}//p' "$0" >&2; exit 1; }
while getopts ul:f:r: option; do
    case $option in
    u) update=1 ;;
    l) limit=$OPTARG ;;
    f) folder=$OPTARG ;;
    r) references=$OPTARG ;;
    *) usage ;;
    esac
done
shift $((OPTIND - 1))
scenes=()
while (($#)) && [[ $1 != -- ]]; do
    [[ $1 != -* ]] || usage # an option of triad render: they stand after scenes and --
    scenes+=("$1")
    shift
done
(($#)) && shift
(($#)) || set -- --spp 64 --size 480x270
if [[ -z $references ]] || ((${#scenes[@]} == 0)); then usage; fi
mkdir -p "$folder" "$references"

name_of() { # SCENE
    local name
    name=$(basename "$1")
    echo "${name%.*}"
}

for scene in "${scenes[@]}"; do # what is there afterwards is of this run
    rm -f "$folder/$(name_of "$scene")".{exr,png,json,render.json,difference.png}
done
code=0
"$TRIAD" render "${scenes[@]}" "$@" -o "$folder/%s.exr" -o "$folder/%s.png" \
    --json "$folder/%s.render.json" --progress lines || code=$?

{
    echo "| scene | FLIP | limit | |"
    echo "|---|---|---|---|"
} >"$folder/summary.md"
say() { echo "| $1 | $2 | $limit | $3 |" >>"$folder/summary.md"; }
for scene in "${scenes[@]}"; do
    name=$(name_of "$scene")
    picture=$folder/$name.exr reference=$references/$name.exr
    if [[ ! -e $folder/$name.render.json ]]; then
        say "$name" "" "not rendered"
    elif [[ -n $update ]]; then
        cp "$picture" "$reference"
        say "$name" "" "kept as the reference"
    elif [[ ! -e $reference ]]; then
        say "$name" "" "has no reference: pictures.sh -u makes it"
        ((code >= 7)) || code=7
    else
        result=0
        "$TRIAD" compare "$picture" "$reference" --metric flip --max-flip "$limit" --json "$folder/$name.json" \
            --map "$folder/$name.difference.png" >/dev/null || result=$?
        flip=$(sed -n 's/.*"flip": \([^,]*\).*/\1/p' "$folder/$name.json" 2>/dev/null || true)
        if ((result == 0)); then
            rm -f "$folder/$name.difference.png"
            say "$name" "$flip" "same"
        else
            say "$name" "$flip" "**differs** (exit $result)"
        fi
        ((result <= code)) || code=$result
    fi
done
cat "$folder/summary.md"
[[ -z ${GITHUB_STEP_SUMMARY:-} ]] || cat "$folder/summary.md" >>"$GITHUB_STEP_SUMMARY"
exit "$code"
