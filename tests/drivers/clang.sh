#!/bin/sh
# tests/drivers/clang.sh [COMPILER]
# Builds the host with Clang (default clang++), warnings as errors, into build-clang, and runs the unit tests of that build.
# A whole second build: minutes.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
cmake -S "$root" -B "$root/build-clang" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="${1:-clang++}" \
    -DCMAKE_COMPILE_WARNING_AS_ERROR=ON > /dev/null
cmake --build "$root/build-clang" --target triad triad-test-unit
exec "$root/build-clang/tests/unit/triad-test-unit"
