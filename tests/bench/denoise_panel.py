#!/usr/bin/env python3
"""What denoising the bins of a panel would do to the error that an eye sees, as a table.

    tests/bench/denoise_panel.py [--program build/bin/triad] [--samples 2,8,32] [--scenes built-in,cornell] [--reference 256]

A picture of one pixel per bin, three times as wide and high as that of the panel, is denoised and then resolved for it
(`triad resolve --bins 3x3 --panel`); so the denoiser has halves and guides of every bin. Columns: the perceived error of the
samples as they are, of S-CIELAB and of FLIP's eye, and what is left of it with `own` and, where it is found, `oidn`.
"""
import argparse
import json
import pathlib
import shlex
import subprocess
import tempfile

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default="build/bin/triad")
parser.add_argument("--samples", default="2,8,32", help="per bin")
parser.add_argument("--scenes", default="built-in,cornell,knot,glass", help="of the suite")
parser.add_argument("--panels", default="rgb,pentile")
parser.add_argument("--reference", default=256, type=int, help="samples per bin of the reference")
parser.add_argument("--ppd", default=30)
arguments = parser.parse_args()


def triad(*words):
    done = subprocess.run([arguments.program, *map(str, words), "-q"], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stderr)
    return done.stdout


def suite():
    """Name, words of the scene three times 192 x 108 large, words of its exposure."""
    for line in subprocess.check_output([arguments.program, "bench", "--list"], text=True).splitlines():
        name, words = line.split(": ", 1)
        if name not in arguments.scenes.split(","):
            continue
        words = shlex.split(words.replace("320x180", "576x324").replace("240x240", "432x432"))
        exposure = []
        if "--exposure" in words:
            at = words.index("--exposure")
            exposure = words[at : at + 2]
            del words[at : at + 2]
        yield name, words, exposure


def errors(picture, reference, panel):
    report = json.loads(triad("compare", picture, reference, "--metric", "perceived", "--panel", panel, "--ppd", arguments.ppd, "--json", "-"))
    eyes = {eye["eye"]: eye["error"] for eye in report["rows"][0]["perceived"]}
    return eyes["scielab"], eyes["flip"]


def measure(folder, name, words, exposure):
    reference = folder / "reference.png"
    linear = folder / "reference.exr"
    triad("render", *words, "--spp", arguments.reference, "--seed", 77, "-o", linear)
    triad("resolve", linear, *exposure, "--bits", 16, "-o", reference)
    for samples in arguments.samples.split(","):
        film, picture, drives = folder / f"{samples}.film", folder / "a.exr", folder / "a.png"
        triad("render", *words, "--spp", samples, "--denoise", "own", "--film", film)
        rows = {panel: [] for panel in arguments.panels.split(",")}
        for denoiser in ("off", "own", "oidn"):
            try:
                triad("resolve", film, "--denoise", denoiser, "-o", picture)
            except RuntimeError:  # Open Image Denoise is not there
                continue
            for panel, row in rows.items():
                triad("resolve", picture, "--bins", "3x3", "--panel", panel, "--ppd", arguments.ppd, *exposure, "-o", drives)
                row.append(errors(drives, reference, panel))
        for panel, (off, *left) in rows.items():
            cells = [f"{off[0]:.3g}", f"{off[1]:.3g}"] + [f"{each[eye] / off[eye]:.2f}" for each in left for eye in range(2)]
            print(f"| {name} | {samples} | {panel} | " + " | ".join(cells) + " |", flush=True)


print("| scene | samples per bin | panel | S-CIELAB | FLIP's eye | own: S-CIELAB | FLIP's | oidn: S-CIELAB | FLIP's |")
print("|---|---|---|---|---|---|---|---|---|")
for scene in suite():
    with tempfile.TemporaryDirectory() as temporary:
        measure(pathlib.Path(temporary), *scene)
