#!/usr/bin/env python3
"""True error of adaptive against even sampling from as many rays.

    tests/bench/adaptive_gain.py NAME=RENDER-ARGUMENTS... [--triad PATH] [--size WxH] [--spp N] [--seeds K] [--reference N]

Each NAME is rendered evenly and adaptively with K seeds. The samples of the adaptive renders are chosen so that they trace as many
rays. Errors are relMSE against a reference of another seed, less the reference's own estimated error. References are kept in
--folder and used again. Prints a Markdown table; the gain is the ratio of errors at equal rays, median over seeds, with the least and
the greatest.
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
    reference, even, adaptive = (options.folder / f for f in (f"{name}-{options.reference}.exr", "even.exr", "adaptive.exr"))
    kept = reference.with_suffix(".json")
    if not kept.exists():
        kept.write_text(json.dumps(render(options, scene, reference, "--spp", options.reference, "--seed", REFERENCE_SEED)))
    noise = json.loads(kept.read_text())["relmse"]

    def error(picture):
        return triad(options, "compare", picture, reference)["relmse"] - noise

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
    parser.add_argument("--reference", type=int, default=1024, help="samples per pixel of the references")
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("build/adaptive_gain"))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    print(f"| scene | relMSE even, {options.spp} spp | adaptive | spp mean (least to most) | rays | gain at equal rays |\n"
          "|---|---|---|---|---|---|", flush=True)
    for entry in options.scenes:
        measure(options, *entry.split("=", 1))


if __name__ == "__main__":
    main()
