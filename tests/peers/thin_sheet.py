#!/usr/bin/env python3
"""What a thin rough sheet (KHR_materials_transmission without volume) reflects, by a closed form, by Triad and by Cycles.

  python tests/peers/thin_sheet.py --triad build/bin/triad

The sheet lies in the plane between a white and a black half of the world: seen from the white side it shows what it reflects,
R; with the halves swapped what it lets through, 1 - R, as the sheet is white. R is the mean of 2F / (1 + F) over the visible
microfacets (cycles_scene.rough_wall). A third world is white only below and away from the eye, so that what is seen of it says how
widely the sheet spreads what it lets through. Exit 1 where Triad is further from a closed form than LIMIT."""
import argparse
import math
import os
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "../../scenes")]
import cycles_agreement as agreement
import cycles_scene
import shapes
from glb import Gltf

LIMIT = 0.006


def part_of_world(path, part):
    """White above the horizon, below it, or below it where x < 0; Radiance, flat."""
    height, width = 1024, 1024
    white, black = bytes((128, 128, 128, 129)), bytes(4)
    filled = {"above": (white * width, black * width), "below": (black * width, white * width),
              "beyond": (black * width, white * (width // 4) + black * (width // 2) + white * (width // 4))}[part]
    rows = [filled[y >= height // 2] for y in range(height)]
    with open(path, "wb") as f:
        f.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + f"-Y {height} +X {width}\n".encode() + b"".join(rows))


def sheet(path, roughness):
    scene = Gltf()
    material = scene.material("sheet", pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": roughness}, doubleSided=True,
                              extensions={"KHR_materials_transmission": {"transmissionFactor": 1}})
    scene.node(mesh=scene.mesh(scene.primitive(**shapes.quad((-50, 0, 50), (100, 0, 0), (0, 0, -100)), material=material)))
    scene.write(path)


def in_cycles(path, world, eye, options, macroscopic):
    kept = cycles_scene.thin_walls
    cycles_scene.thin_walls = lambda material, definition: kept(material, definition, macroscopic)
    try:
        scene = cycles_scene.CyclesScene(path, world, 16, options.threads)
    finally:
        cycles_scene.thin_walls = kept
    scene.look_at(eye, (0, 0, 0), 1.0)
    return scene.render(options.spp, 1).mean()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--triad", default="build/bin/triad")
    parser.add_argument("--spp", type=int, default=1024)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--without-cycles", action="store_true")
    options = parser.parse_args()
    options.size, agreement.FOV = 16, 1.0
    wrong = 0
    heads = ["roughness", "cosine", "R, closed form", "Triad R", "Triad 1 - T", "beyond, closed form", "Triad, beyond"]
    heads += [] if options.without_cycles else ["Cycles, R of microfacets", "Cycles, R of the macroscopic normal"]
    print("| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|")
    with tempfile.TemporaryDirectory() as folder:
        parts = ("above", "below", "beyond")
        worlds = [os.path.join(folder, f"{part}.hdr") for part in parts]
        for world, part in zip(worlds, parts):
            part_of_world(world, part)
        for roughness in (0.0, 0.2, 0.5, 0.8):
            path = os.path.join(folder, "sheet.glb")
            sheet(path, roughness)
            for mu in (0.2, 0.4, 0.7, 0.95):
                eye = (4 * math.sqrt(max(0, 1 - mu * mu)), 4 * mu, 1e-3)
                closed = cycles_scene.rough_wall(mu, roughness, 1.5, samples=1 << 18)
                triad = [agreement.render_triad(options, path, world, eye, (0, 0, 0), options.spp, 1).mean() for world in worlds]
                beyond = cycles_scene.through_wall(mu, roughness, 1.5, 1 << 18)
                cycles = [] if options.without_cycles else [
                    in_cycles(path, worlds[0], eye, options, macroscopic) for macroscopic in (False, True)]
                wrong += max(abs(triad[0] - closed), abs(1 - triad[1] - closed), abs(triad[2] - beyond)) > LIMIT
                values = [closed, triad[0], 1 - triad[1], beyond, triad[2], *cycles]
                print(f"| {roughness} | {mu} | " + " | ".join(f"{value:.4f}" for value in values) + " |", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    os._exit(code)  # bpy does not always survive its own clean-up
