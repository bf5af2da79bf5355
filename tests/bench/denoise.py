#!/usr/bin/env python3
"""Errors of denoised pictures of the suite against its references (scenes/references), as a table.

    tests/bench/denoise.py [--program build/bin/triad] [--spp 4,16,64,256] [--seeds 3]

For each scene and number of samples: relMSE and FLIP of the samples' picture, and what `--denoise own` and, where
Open Image Denoise is found, `--denoise oidn` make of them, relative; and the seconds that a picture of 1280 x 720
takes to denoise. Medians over the seeds.
"""
import argparse
import json
import pathlib
import shlex
import statistics
import subprocess
import tempfile
import time

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default="build/bin/triad")
parser.add_argument("--spp", default="4,16,64,256")
parser.add_argument("--seeds", type=int, default=3)
parser.add_argument("--scenes", default="", help="of the suite, comma-separated (default: all)")
arguments = parser.parse_args()
root = pathlib.Path(__file__).resolve().parents[2]


def triad(*words):
    return subprocess.run([arguments.program, *map(str, words)], capture_output=True, text=True)


def errors(picture, reference):
    """relMSE and FLIP."""
    report = triad("compare", picture, reference, "--json", "-")
    row = json.loads(report.stdout)["rows"][0]
    return row["relmse"], row["flip"]


def suite():
    for line in triad("bench", "--list").stdout.splitlines():
        name, words = line.split(": ", 1)
        words = words.replace("--size 320x180", "--size 128x72").replace("--size 240x240", "--size 96x96")
        if not arguments.scenes or name in arguments.scenes.split(","):
            yield name, shlex.split(words)


def measure(folder, name, words, denoisers):
    reference = root / "scenes" / "references" / f"{name}.exr"
    for spp in map(int, arguments.spp.split(",")):
        found = {denoiser: [] for denoiser in denoisers}
        for seed in range(1, arguments.seeds + 1):
            film, picture = folder / "a.film", folder / "a.exr"
            film.unlink(missing_ok=True)
            triad("render", *words, "--spp", spp, "--seed", seed, "--denoise", "own", "--film", film, "-q", "--progress", "none")
            for denoiser in denoisers:
                triad("resolve", film, "--denoise", denoiser, "-o", picture)
                found[denoiser].append(errors(picture, reference))
        cells = []
        for denoiser in denoisers:
            for metric in range(2):
                values = [error[metric] for error in found[denoiser]]
                raw = [error[metric] for error in found["off"]]
                cells.append(f"{statistics.median(values):.3g}" if denoiser == "off"
                             else f"{statistics.median(v / r for v, r in zip(values, raw)):.2f}")
        print(f"| {name} | {spp} | " + " | ".join(cells) + " |", flush=True)


def seconds(folder, denoisers):
    film = folder / "large.film"
    triad("render", "--size", "1280x720", "--spp", 2, "--denoise", "own", "--film", film, "-q", "--progress", "none")
    times = {denoiser: [] for denoiser in denoisers}
    for _ in range(4):
        for denoiser in denoisers:
            start = time.monotonic()
            triad("resolve", film, "--denoise", denoiser, "-o", folder / "large.exr")
            times[denoiser].append(time.monotonic() - start)
    least = min(times["off"])
    for denoiser in denoisers[1:]:
        print(f"{denoiser}: {statistics.median(times[denoiser]) - least:.2f} s for 1280 x 720 pixels")


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    probe = folder / "probe.film"
    triad("render", "--size", "32x32", "--spp", 2, "--denoise", "own", "--film", probe, "-q")
    denoisers = ["off", "own"]
    if triad("resolve", probe, "--denoise", "oidn", "-o", folder / "probe.exr").returncode == 0:
        denoisers.append("oidn")
    print("| scene | spp | relMSE | FLIP | " + " | ".join(f"{d}: relMSE | FLIP" for d in denoisers[1:]) + " |")
    print("|---" * (4 + 2 * (len(denoisers) - 1)) + "|")
    for scene, words in suite():
        measure(folder, scene, words, denoisers)
    seconds(folder, denoisers)
