#!/usr/bin/env python3
"""What triad says of every bad file among the test models, as the tables of docs/faults.md.

    tests/fuzz/fault_table.py [PROGRAM] > docs/faults.md

Scenes are given to `triad info`, pictures to `triad compare`. Ends with 1 when a file crashed the program, hung it or
got no sentence. TRIAD_TEST_ASSETS names the test models."""
import collections
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
ASSETS = pathlib.Path(os.environ.get("TRIAD_TEST_ASSETS", ROOT / "../shared/assets"))
PROGRAM = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/bin/triad"
# Of malformed-minimal, what glTF allows (buffers and skins without data, data URIs of other media types).
VALID = {"00", "39", "43", "44", "45", "51", "52", "53"}
SECONDS = 60

HEAD = """# Bad files

What Triad makes of every file of the two collections of bad files among the test models: `malformed-minimal`, one fault
each, and `malformed`, from the tests of other projects. Written by `tests/fuzz/fault_table.py > docs/faults.md`.

- *refused*: exit 2 (scene or file), 3 (a feature or version that is not supported) or 4 (memory), with a sentence that names what is wrong.
- *told*: read, with a warning that `triad info` lists under faults. Where data are damaged (images, normals, coordinates,
  colours, corners that are no numbers) `--strict`, of `triad render` and `triad info`, makes that exit 2.
- *empty*: read, and there is nothing to draw, which a render says with exit 2.
- *read*: as if nothing were wrong. Of invalid files these are such as break a rule that no picture depends on: bounds and
  types of animations, names that are not unique, members that nobody reads, alignment.

A JPEG has no check sum: flipped bits are told where its decoder meets a code that cannot be; others are noise in the picture.
"""


def got(path):
    """(verdict, sentence) of one file."""
    scene = path.suffix in (".gltf", ".glb")
    command = [PROGRAM, "info", path] if scene else [PROGRAM, "compare", path, path, "--metric", "rmse"]
    try:
        done = subprocess.run(command, capture_output=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return "HANGS", ""
    out, errors = done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")
    if done.returncode in (2, 3, 4):
        sentence = errors.strip().removeprefix("triad: ").split("\n")[0]
        return f"refused ({done.returncode})" if sentence else "NO SENTENCE", sentence
    if done.returncode != 0:
        return f"EXIT {done.returncode}", errors.strip().split("\n")[0]
    if not scene and "is damaged" in errors:
        return "told", errors.strip().removeprefix("triad: warning: ").split("\n")[0]
    faults = re.search(r"^faults +(\d+)\n( .*)?", out, re.M)
    if faults and int(faults[1]):
        return "told", (faults[2] or "").strip()
    if scene and re.search(r"^triangles +\d+ in meshes, 0 as placed", out, re.M):
        return "empty", ""
    return "read", ""


def cell(text, folder):
    text = text.replace(str(folder) + "/", "").replace("|", "\\|").replace("`", "'")
    text = "".join(c if c.isprintable() else "?" for c in text)
    return text if len(text) <= 150 else text[:147] + "..."


def minimal_table(bad):
    folder = (ASSETS / "malformed-minimal").resolve()
    print("\n## One fault each\n\n| file | expected | got | sentence |\n|---|---|---|---|")
    for path in sorted(folder.glob("*.gl*")):
        verdict, sentence = got(path)
        sentence = re.sub(r"^\S*" + re.escape(path.name) + r": ", "", sentence)
        print(f"| {path.stem} | {'valid' if path.name[:2] in VALID else 'invalid'} | {verdict} | {cell(sentence, folder)} |")
        bad += [path] * verdict.isupper()


def class_of(entry):
    codes = (entry.get("report") or {}).get("codes")
    return codes[0] if codes else entry["kind"]


def corpus_table(bad):
    folder = (ASSETS / "malformed").resolve()
    rows = collections.defaultdict(collections.Counter)
    for entry in json.loads((folder / "INDEX.json").read_text()):
        path = ASSETS / entry["file"]
        if not path.exists():
            continue
        verdict, _ = got(path.resolve())
        rows[entry["expect"], class_of(entry)][verdict] += 1
        bad += [path] * verdict.isupper()
    print("\n## From the tests of others\n\nThe class is the first error that Khronos' validator finds in the file, else what "
          "the file is there for.\n\n| class | expected | got |\n|---|---|---|")
    for (expected, name), counts in sorted(rows.items()):
        print(f"| {name} | {expected} | {', '.join(f'{verdict} {n}' for verdict, n in sorted(counts.items()))} |")
    total = collections.Counter()
    for (expected, _), counts in rows.items():
        for verdict, n in counts.items():
            total[expected, verdict] += n
    print("\n| expected | got | files |\n|---|---|---|")
    for (expected, verdict), n in sorted(total.items()):
        print(f"| {expected} | {verdict} | {n} |")


def main():
    if not (ASSETS / "malformed").exists():
        sys.exit(f"{ASSETS} has no bad files; TRIAD_TEST_ASSETS names the folder of the test models.")
    bad = []
    print(HEAD, end="")
    minimal_table(bad)
    corpus_table(bad)
    for path in bad:
        print(f"bad: {path}", file=sys.stderr)
    sys.exit(1 if bad else 0)


main()
