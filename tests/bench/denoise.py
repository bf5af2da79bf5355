#!/usr/bin/env python3
"""Errors of denoised pictures of the suite, and what they cost, as a table (needs openimageio-tools; gnuplot-nox for --plot).

    tests/bench/denoise.py [--program build/bin/triad] [--spp 4,16,64,256] [--seeds 3] [--scenes NAME,...] [--reference 4096] [--plot FILE.svg]

For each scene at its own size and each number of samples: processor seconds of rendering; relMSE, FLIP and the error that an eye sees
(S-CIELAB, whole pixels, 60 of them per degree) of the samples' picture; what `--denoise own` and, where Open Image Denoise is found,
`--denoise oidn` leave of each, as a share; and the processor seconds that they add, what guides them included. Medians over the seeds. What is
left of the reference's own noise is subtracted from relMSE. The plot shows relMSE against processor seconds.
"""
import argparse
import json
import os
import pathlib
import shlex
import statistics
import subprocess
import tempfile

METRICS = ["relMSE", "FLIP", "seen"]
REFERENCE_SEED = 99

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--program", default="build/bin/triad")
parser.add_argument("--spp", default="4,16,64,256")
parser.add_argument("--seeds", type=int, default=3)
parser.add_argument("--scenes", default="", help="of the suite, comma-separated (default: all)")
parser.add_argument("--reference", type=int, default=4096, help="samples per pixel of the references")
parser.add_argument("--plot", help="relMSE against processor seconds, as SVG")
arguments = parser.parse_args()


def triad(*words):
    """Standard output, and processor seconds of the whole process."""
    with tempfile.TemporaryFile("w+") as errors:
        process = subprocess.Popen([arguments.program, *map(str, words)], stdout=subprocess.PIPE, stderr=errors, text=True)
        out = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        if status:
            errors.seek(0)
            raise RuntimeError(f"{words}: {errors.read()}")
    return out, usage.ru_utime + usage.ru_stime


def rendered(words, spp, seed, *more):
    """Row of the report, and processor seconds of the whole process."""
    out, seconds = triad("render", *words, "--spp", spp, "--seed", seed, "--quiet", "--json", "-", *more)
    return json.loads(out)["rows"][0], seconds


def suite():
    """Name, words of the scene, words of its exposure."""
    for line in triad("bench", "--list")[0].splitlines():
        name, words = line.split(": ", 1)
        words, exposure = shlex.split(words), []
        if "--exposure" in words:
            at = words.index("--exposure")
            exposure = words[at : at + 2]
            del words[at : at + 2]
        if not arguments.scenes or name in arguments.scenes.split(","):
            yield name, words, exposure


class Reference:
    def __init__(self, folder, words, exposure):
        self.linear, self.seen, self.exposure = folder / "reference.exr", folder / "seen.png", exposure
        self.noise = rendered(words, arguments.reference, REFERENCE_SEED, "-o", self.linear)[0]["relmse"]
        drives = folder / "reference.png"
        triad("resolve", self.linear, *exposure, "--bits", 16, "-o", drives)
        subprocess.run(["oiiotool", drives, "--resize:filter=box", "300%", "-o", self.seen], check=True)

    def errors(self, picture):
        row = json.loads(triad("compare", picture, self.linear, "--metric", "relmse,flip", "--json", "-")[0])["rows"][0]
        drives = picture.with_suffix(".png")
        triad("resolve", picture, *self.exposure, "-o", drives)
        seen = json.loads(triad("compare", drives, self.seen, "--metric", "perceived", "--eye", "scielab", "--panel", "off", "--ppd", 60,
                                "--json", "-")[0])["rows"][0]["perceived"][0]["error"]
        return max(row["relmse"] - self.noise, 0), row["flip"], seen


def cost(words, folder, denoiser):
    """Processor seconds that a denoiser adds to a render."""
    return statistics.median(rendered(words, 4, seed, "--denoise", denoiser, "-o", folder / "cost.exr")[1]
                             - rendered(words, 4, seed, "-o", folder / "cost.exr")[1] for seed in range(3))


def measure(folder, name, words, exposure, denoisers):
    """Rows of the table; yields points of the plot: denoiser, processor seconds, relMSE."""
    reference = Reference(folder, words, exposure)
    costs = {d: cost(words, folder, d) for d in denoisers[1:]}
    for spp in map(int, arguments.spp.split(",")):
        found, seconds = {d: [] for d in denoisers}, []
        for seed in range(1, arguments.seeds + 1):
            film, picture = folder / "a.film", folder / "a.exr"
            film.unlink(missing_ok=True)
            seconds.append(rendered(words, spp, seed, "--denoise", "own", "--film", film)[0]["render_cpu_s"])
            for d in denoisers:
                triad("resolve", film, "--denoise", d, "-o", picture)
                found[d].append(reference.errors(picture))
        time = statistics.median(seconds)
        cells = [f"{time:.2f}"] + [f"{statistics.median(e[m] for e in found['off']):.3g}" for m in range(len(METRICS))]
        for d in denoisers:
            yield d, time + costs.get(d, 0), statistics.median(e[0] for e in found[d])
            if d != "off":
                cells += [f"{statistics.median(e[m] / raw[m] for e, raw in zip(found[d], found['off'])):.2f}" for m in range(len(METRICS))]
                cells.append(f"{costs[d]:.2f}")
        print(f"| {name} | {spp} | " + " | ".join(cells) + " |", flush=True)


def plot(points, denoisers):
    rows = (len(points) + 3) // 4
    script = [f"set terminal svg size 1200,{60 + 260 * rows} dynamic background rgb 'white'", f"set output '{arguments.plot}'",
              "set logscale xy", "set format y '10^{%T}'", "set key bottom left", f"set multiplot layout {rows},4"]
    for name, of_scene in points.items():
        for i, d in enumerate(denoisers):
            script += [f"$d{i} << E", *(f"{x} {y}" for who, x, y in of_scene if who == d), "E"]
        script += [f"set title '{name}'"]
        script.append("plot " + ", ".join(f"$d{i} with linespoints linewidth 2 title '{d}'" for i, d in enumerate(denoisers)))
        script.append("unset key")
    subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    denoisers = ["off", "own", "oidn"]
    try:
        rendered(["--size", "32x32"], 2, 0, "--denoise", "oidn", "-o", folder / "probe.exr")
    except RuntimeError:  # Open Image Denoise is not there
        denoisers.pop()
    heads = ["scene", "spp", "CPU s", *METRICS] + [f"{d}: {m}" for d in denoisers[1:] for m in (*METRICS, "CPU s")]
    print("| " + " | ".join(heads) + " |")
    print("|---" * len(heads) + "|")
    points = {}
    for scene, words, exposure in suite():
        points[scene] = list(measure(folder, scene, words, exposure, denoisers))
    if arguments.plot:
        plot(points, denoisers)
