#!/usr/bin/env python3
"""The error that pictures are said to have over the error that they have.

    tests/bench/error_estimates.py NAME=RENDER-ARGUMENTS... [--triad PATH] [--size WxH] [--spp N,...] [--error E,...] [--seeds K] [--reference N]

Each NAME is rendered with K seeds at each number of samples, and until each error. The true error is the relMSE against a reference of
another seed, less the reference's own estimated error. References are kept in --folder and used again. Prints a Markdown table:
estimated over true error with N samples, true over wanted error at --error E; median over seeds, the least and the greatest, and the
share of seeds within a factor of 1.3.
"""
import argparse
import json
import pathlib
import statistics

from adaptive_gain import REFERENCE_SEED, render, triad


def cell(ratios):
    close = sum(1 / 1.3 < ratio < 1.3 for ratio in ratios) / len(ratios)
    return f"**{statistics.median(ratios):.2f}** ({min(ratios):.2f} to {max(ratios):.2f}), {close:.0%}"


def measure(options, name, scene):
    reference = options.folder / f"{name}-{options.size}-{options.reference}.exr"
    kept = reference.with_suffix(".json")
    if not kept.exists():
        kept.write_text(json.dumps(render(options, scene, reference, "--spp", options.reference, "--seed", REFERENCE_SEED)))
    noise = json.loads(kept.read_text())["relmse"]
    picture = options.folder / "picture.exr"

    def errors(*how):
        for seed in range(options.seeds):
            row = render(options, scene, picture, *how, "--seed", seed)
            yield row["relmse"], triad(options, "compare", picture, reference)["relmse"] - noise

    cells = [cell([said / true for said, true in errors("--spp", spp)]) for spp in options.spp]
    cells += [cell([true / wanted for _, true in errors("--error", wanted)]) for wanted in options.error]
    print(f"| {name} | {' | '.join(cells)} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="NAME=ARGUMENTS")
    parser.add_argument("--triad", default="build/bin/triad")
    parser.add_argument("--size", default="96x64")
    parser.add_argument("--spp", type=lambda text: [int(n) for n in text.split(",")], default=[16, 64, 256])
    parser.add_argument("--error", type=lambda text: [float(e) for e in text.split(",")], default=[])
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--reference", type=int, default=4096, help="samples per pixel of the references")
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("build/error_estimates"))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    heads = [f"{spp} spp" for spp in options.spp] + [f"--error {error:g}" for error in options.error]
    print(f"| scene | {' | '.join(heads)} |\n|{'---|' * (len(heads) + 1)}", flush=True)
    for entry in options.scenes:
        measure(options, *entry.split("=", 1))


if __name__ == "__main__":
    main()
