#!/bin/sh
# tests/unit/kernel_syntax.sh KERNELS-FOLDER
# Every kernel file, headers alone too, through a strict compiler as OpenCL C 1.2 and as 3.0, with either format of nodes
# and in packets where rays are traced, and programs with each option alone off: catches what one driver forgives and another refuses, and
# headers that lean on what happens to be included before them. And no vector of three: Intel's runtime (2026.2.0) gets those
# wrong that a function is called with (docs/testing.md).
set -u
clang=$(command -v clang || command -v clang-15 || command -v clang-14) || { echo "no clang: skipped"; exit 77; }
cd "$1" || exit 1
failed=0
jobs=$(mktemp)
trap 'rm -f "$jobs"' EXIT
files=$(find . -name '*.h' -o -name '*.cl' | sort)
[ -n "$files" ] || { echo "no kernel files in $1" >&2; exit 1; }
# A header's functions are all unused when it stands alone. 3.0 without generic pointers, which are optional in it: with them
# a pointer and an array parameter live in different address spaces.
compile="$clang -x cl --target=spir64-unknown-unknown -Xclang -finclude-default-header -fsyntax-only
    -Xclang -cl-ext=-__opencl_c_generic_address_space,-__opencl_c_device_enqueue,-__opencl_c_pipes
    -Wall -Wextra -Wshadow -Wdouble-promotion -Wno-unused-function -Werror -I ."
options=$(sed -n 's/^#ifndef \(TRIAD_[A-Z0-9_]*\) .*/\1/p' features.h)
[ -n "$options" ] || { echo "no options in features.h" >&2; exit 1; }
for file in ${files}; do
    case $file in ./traversal/*) formats='0 1' ;; *) formats=0 ;; esac
    for format in $formats; do
        echo "-cl-std=CL1.2 -DTRIAD_BVH4=$format $file"
        echo "-cl-std=CL3.0 -DTRIAD_BVH4=$format $file"
    done
    case $file in ./traversal/* | ./path/*) echo "-cl-std=CL1.2 -DTRIAD_PACKETS=1 $file" ;; esac
    case $file in *.cl) # options that its text asks for
        text=$($clang -x cl --target=spir64-unknown-unknown -I . -M "$file" | tr -d '\\:' | tr ' ' '\n' | grep -v -e '^$' -e '\.o$' -e features.h)
        for option in $options; do
            # shellcheck disable=SC2086 # one word per file
            grep -qw "$option" $text && echo "-cl-std=CL1.2 -Wno-unused-parameter -DTRIAD_PACKETS=1 -D$option=0 $file"
        done ;;
    esac
done >"$jobs"
# shellcheck disable=SC2086 # words
xargs -P "$(nproc)" -L 1 $compile <"$jobs" || failed=1
threes='\b(u?(char|short|int|long)|half|float|double)3\b'
echo 'float3 v;' | grep -qE "$threes" || { echo "vectors of three are not seen" >&2; failed=1; }
# shellcheck disable=SC2086 # one word per file
grep -nE "$threes" $files >&2 && { echo "vectors of three: take the structs of common/vector.h" >&2; failed=1; }
[ $failed -eq 0 ] && echo "$(echo "$files" | wc -l) files are clean"
exit $failed
