#!/usr/bin/env python3
"""True error of adaptive against even sampling from as many rays.

    tests/bench/adaptive_gain.py NAME=RENDER-ARGUMENTS... [--triad PATH] [--size WxH] [--spp N] [--seeds K] [--reference N] [--panel P]

Each NAME is rendered evenly and adaptively with K seeds. The samples of the adaptive renders are chosen so that they trace as many
rays. Errors are relMSE against a reference of another seed, less the reference's own estimated error. References are kept in
--folder and used again. With --panel errors are E of S-CIELAB on that display, against references of 6 x 6 samples per pixel.
Prints a Markdown table; the gain is the ratio of errors at equal rays, median over seeds, with the least and the greatest.
"""
import argparse
import json
import pathlib
import shlex
import statistics
import subprocess

REFERENCE_SEED = 4711


def triad(options, command, *arguments):
    report = options.folder / "report.json"
    report.unlink(missing_ok=True)
    subprocess.run([options.triad, command, *map(str, arguments), "--json", report, "-q"], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads(report.read_text())["rows"][0]


def render(options, scene, out, *arguments):
    return triad(options, "render", *shlex.split(scene), "--size", options.size, "-o", out, *arguments)


def measure(options, name, scene):
    if options.panel:
        return measure_perceived(options, name, scene)
    reference = options.folder / f"{name}-{options.reference}.exr"
    kept = reference.with_suffix(".json")
    if not kept.exists():
        kept.write_text(json.dumps(render(options, scene, reference, "--spp", options.reference, "--seed", REFERENCE_SEED)))
    noise = json.loads(kept.read_text())["relmse"]
    return compare(options, name, scene, lambda picture: triad(options, "compare", picture, reference)["relmse"] - noise)


def measure_perceived(options, name, scene):
    reference = options.folder / f"{name}-{options.reference}-fine.exr"
    if not reference.exists():
        fine = "x".join(str(6 * int(n)) for n in options.size.split("x"))
        triad(options, "render", *shlex.split(scene), "--size", fine, "--reconstruct", "pane:1", "--spp", options.reference, "--seed",
              REFERENCE_SEED, "-o", reference)
    perceived = ["--metric", "perceived", "--panel", options.panel, "--eye", "scielab"]
    return compare(options, name, f"{scene} --panel {options.panel}",
                   lambda picture: triad(options, "compare", reference, picture, *perceived)["perceived"][0]["error"])


def compare(options, name, scene, error):
    even, adaptive = options.folder / "even.exr", options.folder / "adaptive.exr"
    at = render(options, scene, adaptive, "--spp", options.spp, "--adaptive", "on")
    rays = render(options, scene, even, "--spp", options.spp)["rays"]
    spp = max(1, round(options.spp * rays / at["rays"]))
    rows = []
    for seed in range(options.seeds):
        a = render(options, scene, even, "--spp", options.spp, "--seed", seed)
        b = render(options, scene, adaptive, "--spp", spp, "--seed", seed, "--adaptive", "on")
        rows.append((error(even), error(adaptive), b["rays"] / a["rays"], b["spp_min"], b["spp_max"]))
    gains = [even / (adaptive * rays) for even, adaptive, rays, _, _ in rows]
    median = [statistics.median(column) for column in zip(*rows)]
    print(f"| {name} | {median[0]:.3g} | {median[1]:.3g} | {spp} ({median[3]:.0f} to {median[4]:.0f}) | {median[2]:.3f} | "
          f"**{statistics.median(gains):.2f}** ({min(gains):.2f} to {max(gains):.2f}) |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="NAME=ARGUMENTS")
    parser.add_argument("--triad", default="build/bin/triad")
    parser.add_argument("--size", default="192x192")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--panel", help="a display, instead of the relMSE")
    parser.add_argument("--reference", type=int, default=1024, help="samples per pixel of the references")
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("build/adaptive_gain"))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    print(f"| scene | {'E' if options.panel else 'relMSE'} even, {options.spp} spp | adaptive | spp mean (least to most) | rays | gain at equal rays |\n"
          "|---|---|---|---|---|---|", flush=True)
    for entry in options.scenes:
        measure(options, *entry.split("=", 1))


if __name__ == "__main__":
    main()
