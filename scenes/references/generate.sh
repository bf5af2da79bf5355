#!/bin/sh
# The references of `triad bench device`, made anew: generate.sh [TRIAD [FOLDER]]. A few minutes for each on two cores.
# The suite's scenes at .4 of their size, a seed that no run has, half floats.
set -eu
triad=${1:-triad} folder=${2:-$(dirname "$0")}
"$triad" bench --list | sed 's/--size 320x180/--size 128x72/; s/--size 240x240/--size 96x96/' | while IFS= read -r line; do
    eval "\"\$triad\" render ${line#*: } --spp 8192 --seed 4294967279 --half -q -o \"\$folder/${line%%: *}.exr\"" < /dev/null
done
