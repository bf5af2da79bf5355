#!/bin/sh
# tests/unit/struct_parameters.sh KERNELS-FOLDER
# No function writes to a struct that it was given by value: Mesa (22.3.6) makes no copy, so the caller's variable changes
# (docs/kernels.md). A copy of the kernels is compiled in which every such parameter is const.
set -eu
clang=$(command -v clang || command -v clang-15 || command -v clang-14) || { echo "no clang: skipped"; exit 77; }
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r "$1/." "$copy"
cd "$copy"

# What the test must find, in both of its forms.
printf '%s\n' '#include "common/language.h"' '#include "common/vector.h"' \
    'TRIAD_FUNCTION Vec2 assigned(float a,' '    Vec2 v) { v.x = a; return v; }' >planted_assigned.cl
printf '%s\n' '#include "common/language.h"' '#include "common/vector.h"' 'TRIAD_FUNCTION void set(Vec2* v) { v->x = 1.0f; }' \
    'TRIAD_FUNCTION Vec2 given(Vec2 v) { set(&v); return v; }' >planted_given.cl

structs=$(grep -rhoE '^typedef struct [A-Za-z0-9]+' . | cut -d ' ' -f 3 | sort -u | paste -sd '|')
structs="$structs|$(grep -rhoE "^typedef ($structs) [A-Za-z0-9]+;" . | cut -d ' ' -f 3 | tr -d ';' | sort -u | paste -sd '|')"
find . -name '*.[hc]*' -type f -exec sed -i -zE ":again; s/([(,][ \n]*)($structs)( +[a-z_0-9]+[,)])/\1const \2\3/; t again" {} +

writes() { # FILE [OPTION]
    ! "$clang" -x cl -cl-std=CL1.2 --target=spir64-unknown-unknown -Xclang -finclude-default-header -fsyntax-only \
        -Wall -Wextra -Wno-unused-function -Werror -ferror-limit=0 -I . "$@"
}
failed=0
for planted in planted_assigned.cl planted_given.cl; do
    writes "$planted" 2>/dev/null || { echo "the write in $planted is not seen" >&2; failed=1; }
    rm "$planted"
done
for file in $(find . -name '*.cl' | sort); do
    for lanes in 1 0; do
        ! writes -D TRIAD_ITEM_LANES=$lanes "$file" || failed=1
    done
done
[ $failed -eq 0 ] && echo "no function writes to a struct parameter"
exit $failed
