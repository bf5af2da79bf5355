#!/usr/bin/env python3
"""One scene per material (scenes/materials), rendered with Triad and with Blender's Cycles, compared as
cycles_agreement.py compares: means of tiles of 16 x 16 pixels, in the worst channel.

  pip install bpy==4.5.*            (Python 3.11)
  python tests/peers/material_agreement.py --triad build/bin/triad --out agreement

Prints a row per scene. EXPLAINED says what share
of the tiles may differ by more than 2 %; exit 1 beyond that. Writes OUT/materials.json and a PNG per scene: Triad, Cycles,
difference (full colour at 10 %)."""
import argparse
import os
import sys
import tempfile
import time

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "../../scenes/materials")]
import cycles_agreement as agreement
import cycles_scene
import generate

# Share of tiles; reasons in docs/measurements/2026-11-25-materials-against-cycles.md
EXPLAINED = {"plastic": 0.2, "clearcoat": 0.15, "specular": 0.35, "sheen": 0.4, "anisotropy": 0.55, "volume": 0.05,
             "volume-rough": 0.1, "thin-rough-.2": 0.4, "thin-rough-.5": 0.7}


def render_both(options, name):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, name + ".glb")
        generate.SCENES[name]().write(path)
        environment = os.path.realpath(generate.SKY)
        scene = cycles_scene.CyclesScene(path, environment, options.size, options.threads)
        scene.look_at(generate.EYE, generate.TARGET, generate.FOV)
        start = time.time()
        cycles = [scene.render(options.spp, seed) for seed in (1, 2)]
        middle = time.time()
        triad = [agreement.render_triad(options, path, environment, generate.EYE, generate.TARGET, options.spp, seed)
                 for seed in (1, 2)]
        return triad, cycles, middle - start, time.time() - middle


def run(name, options):
    triad, cycles, seconds_cycles, seconds_triad = render_both(options, name)
    row, signed = agreement.compare(triad, cycles)
    row.update(name=name, spp=2 * options.spp, seconds_cycles=seconds_cycles, seconds_triad=seconds_triad,
               worst=signed.round(4).tolist())
    row["pass"] = 1 - row["within"] <= EXPLAINED.get(name, 0) + 1e-9
    agreement.write_picture(os.path.join(options.out, f"material-{name}.png"), triad, cycles, signed)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="scenes; default all")
    parser.add_argument("--triad", default="build/bin/triad")
    parser.add_argument("--out", default="agreement")
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--spp", type=int, default=256, help="of each of two renders with either")
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    agreement.FOV = generate.FOV
    return agreement.report((run(name, options) for name in options.names or generate.SCENES),
                            os.path.join(options.out, "materials.json"))


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    os._exit(code)  # bpy does not always survive its own clean-up
