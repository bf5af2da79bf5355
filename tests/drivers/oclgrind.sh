#!/bin/sh
# tests/drivers/oclgrind.sh [OCLGRIND-OPTION...] PROGRAM [ARGUMENT...]
# Runs a program in Oclgrind, which sees reads and writes out of bounds, and with --data-races and --uninitialized those too.
# Ends with 1 when it saw something, whatever the program says: Oclgrind itself does not. Its device is --device oclgrind.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# Its interpreter knows no optimiser's intrinsics, and takes what an optimiser leaves undefined for a fault. The cache is apart
# because binaries made without this option would not run.
status=0
XDG_CACHE_HOME=$folder oclgrind --build-options "-cl-opt-disable -DTRIAD_CALLS" --log "$folder/log" "$@" || status=$?
if [ -s "$folder/log" ]; then
    head -n 60 "$folder/log" >&2
    exit 1
fi
exit "$status"
