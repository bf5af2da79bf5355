#!/usr/bin/env bash
# pip.sh SOURCE: `pip install` of a copy of the source into a fresh virtual environment, and this folder's tests there.
set -euo pipefail
source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# As a fresh clone has it: nothing of a build.
mkdir "$folder/source"
(cd "$source" && tar -c --exclude='./build*' --exclude=./.git --exclude=./.ccache .) | tar -x -C "$folder/source"
python=$(for each in python3 /usr/bin/python3; do "$each" -c 'import venv, sysconfig, os; assert os.path.exists(sysconfig.get_path("include") + "/Python.h")' 2>/dev/null && command -v "$each" && break; done)
"$python" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet "$folder/source" pytest mypy
cd "$folder"
"$folder/venv/bin/python" -c 'import triad; print("installed:", triad.__version__, triad.__file__)' | grep -F "$folder/venv"
"$folder/venv/bin/mypy" --strict -p triad # its types, as an editor sees them
TRIAD=none "$folder/venv/bin/python" -m pytest -q -p no:cacheprovider "$folder/source/tests/python"
