#!/usr/bin/env bash
# installed.sh BUILD CMAKE: installs the build into an empty folder, then builds and runs the examples of docs/library.md with
# what is there and nothing else.
set -euo pipefail
build=$1 cmake=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }

prefix=$folder/prefix
"$cmake" --install "$build" --prefix "$prefix" >"$folder/log" || fail "the installation: $(tail "$folder/log")"
for file in bin/triad bin/triad-replay include/triad/triad.h share/doc/triad/LICENSE share/doc/triad/docs/library.md \
    share/triad/scenes/cornell/cornell.gltf; do
    [[ -e $prefix/$file ]] || fail "$file is not installed"
done
library=$(find "$prefix" -name libtriad.so)
[[ -n $library ]] || fail "libtriad.so is not installed"
# Names that programs may have, too, stay inside: operator new above all.
foreign=$(nm -D --defined-only --demangle "$library" | grep -vE ' (triad::api::|(typeinfo|typeinfo name|vtable) for triad::api::)' || true)
[[ -z $foreign ]] || fail "libtriad.so shows more than its interface: $foreign"

mkdir "$folder/example"
"$(dirname -- "$0")/page_code.py" "$prefix/share/doc/triad/docs/library.md" "$folder/example"
cd "$folder/example"
cat >>CMakeLists.txt <<'END'
add_executable(page page.cpp)
target_link_libraries(page PRIVATE Triad::triad)
target_compile_options(page PRIVATE -Wall -Wextra -Werror)
END
"$cmake" -S . -B build -DCMAKE_PREFIX_PATH="$prefix" >../log || fail "the configuration: $(cat ../log)"
"$cmake" --build build >../log || fail "the build: $(cat ../log)"
build/example "$prefix/share/triad/scenes/cornell/cornell.gltf" cornell.png 2>../log || fail "main.cpp: $(cat ../log)"
build/page 2>../log || fail "page.cpp: $(cat ../log)"
status=0
build/example /no/such.glb none.png 2>../log || status=$?
((status == 2)) || fail "a scene that is missing ends the example with $status"
grep -q 'no/such.glb' ../log || fail "what is said of it is: $(cat ../log)"
"$prefix/bin/triad" compare cornell.png cornell.png --max-rmse 0 || fail "cornell.png is no picture"
printf 'right: %s\n' "$(ls)"
