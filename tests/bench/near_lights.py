#!/usr/bin/env python3
"""Points on triangle lights by solid angle against points by area: error and processor time at equal samples.

    tests/bench/near_lights.py [--triad PATH] [--size WxH] [--spp N] [--seeds K] [--reference N] [--folder F]

Renders small scenes whose lamps are near what they light, in turns with the kernels and with a copy of them in which all lights
are drawn by area. Errors are relMSE, means over K seeds, against a reference by area of another seed; times are processor seconds
of whole processes, medians. Prints a Markdown table of both over those by area. Needs numpy.
"""
import argparse
import json
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scenes"), str(ROOT / "scenes/suite")]
import shapes  # noqa: E402
from common import camera, lamp, put, surface  # noqa: E402
from glb import Gltf  # noqa: E402

REFERENCE_SEED = 4711


def square_lamp(scene, corner, u, v, radiance, double_sided=True):
    put(scene, shapes.quad(corner, u, v), lamp(scene, "lamp", [radiance] * 3, double_sided), "lamp")


def stage(scene):
    """A floor with a ball on it, in the dark."""
    put(scene, shapes.quad((-3, 0, 3), (6, 0, 0), (0, 0, -6)), surface(scene, "floor", (0.6, 0.6, 0.6)), "floor")
    ball(scene)
    camera(scene, (0, 1, 3), (0, 0.35, 0), 46, 1.5)


def ball(scene):
    put(scene, shapes.sphere(0.3, centre=(0, 0.3, 0)), surface(scene, "ball", (0.7, 0.5, 0.3)), "ball")


def room(scene):
    """4 x 2.6 x 5 without its front wall, a ball on the floor."""
    for name, colour, corner, u, v in (("floor", (0.7, 0.7, 0.7), (-2, 0, 2.5), (4, 0, 0), (0, 0, -5)),
                                       ("ceiling", (0.7, 0.7, 0.7), (-2, 2.6, -2.5), (4, 0, 0), (0, 0, 5)),
                                       ("back", (0.7, 0.7, 0.7), (-2, 0, -2.5), (4, 0, 0), (0, 2.6, 0)),
                                       ("left", (0.7, 0.3, 0.3), (-2, 0, 2.5), (0, 0, -5), (0, 2.6, 0)),
                                       ("right", (0.3, 0.7, 0.3), (2, 0, -2.5), (0, 0, 5), (0, 2.6, 0))):
        put(scene, shapes.quad(corner, u, v), surface(scene, name, colour, doubleSided=True), name)
    ball(scene)
    camera(scene, (0, 1.4, 2.4), (0, 1.16, 0), 57, 1.5)


def panel_above_floor(scene):
    put(scene, shapes.quad((-5, 0, 5), (10, 0, 0), (0, 0, -10)), surface(scene, "floor", (0.7, 0.7, 0.7)), "floor")
    square_lamp(scene, (-1, 0.3, -1), (2, 0, 0), (0, 0.9, 2), 5)
    camera(scene, (0, 3, 6), (0, 0.2, 0), 46, 1.5)


def softboxes(scene):
    stage(scene)
    square_lamp(scene, (-1.3, 0.2, -0.5), (0, 0, 1), (0, 1, 0), 8)
    square_lamp(scene, (1.3, 0.2, 0.5), (0, 0, -1), (0, 1, 0), 4)


def standing(scene):
    stage(scene)
    square_lamp(scene, (-1, 0, -0.6), (2, 0, 0), (0, 1.2, 0), 4)


def tubes(scene):
    room(scene)
    for height in (2.45, 0.05):
        square_lamp(scene, (-1.8, height, -2.45), (3.6, 0, 0), (0, 0, 0.03), 60)


def window(scene):
    room(scene)
    square_lamp(scene, (-1.99, 0.9, 0.8), (0, 0, -1.6), (0, 1.4, 0), 10)


def television(scene):
    room(scene)
    square_lamp(scene, (-0.7, 0.8, -2.4), (1.4, 0, 0), (0, 0.8, 0), 4, False)


SCENES = {"panel above a floor": panel_above_floor, "two softboxes": softboxes, "lamp that stands on the floor": standing,
          "tubes along a wall": tubes, "window of light": window, "television": television}


def kernels_by_area(folder):
    """A copy of the kernels in which no light is near."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "kernels", folder)
    light = folder / "shading/light.h"
    text = light.read_text()
    assert "#if TRIAD_NEAR_LIGHTS" in text
    light.write_text(text.replace("#if TRIAD_NEAR_LIGHTS", "#if 0"))
    return folder


def render(options, scene, out, kernels, spp, seed):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([options.triad, "render", scene, "--kernels", kernels, "--size", options.size, "--spp", str(spp), "--seed",
                    str(seed), "-q", "--force", "-o", out], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def error(options, picture, reference):
    report = subprocess.run([options.triad, "compare", picture, reference, "--metric", "relmse", "--json", "-"],
                            stdout=subprocess.PIPE, check=False)  # 7 where they differ
    return json.loads(report.stdout)["rows"][0]["relmse"]


def measure(options, name, build, area):
    scene, reference, picture = (options.folder / (name.replace(" ", "_") + end) for end in (".glb", ".ref.exr", ".exr"))
    gltf = Gltf()
    build(gltf)
    gltf.write(scene)
    render(options, scene, reference, area, options.reference, REFERENCE_SEED)
    seconds, errors = ([], []), ([], [])
    for seed in range(options.seeds + 1):
        for way, kernels in enumerate((area, ROOT / "kernels")):
            took = render(options, scene, picture, kernels, options.spp, seed)
            if seed:  # the first one compiles
                seconds[way].append(took)
                errors[way].append(error(options, picture, reference))
    time = statistics.median(seconds[1]) / statistics.median(seconds[0])
    gain = statistics.mean(errors[1]) / statistics.mean(errors[0])
    print(f"| {name} | {gain:.2f} | {time:.2f} | {gain * time:.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--triad", default=str(ROOT / "build/bin/triad"))
    parser.add_argument("--size", default="192x128")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--reference", type=int, default=4096, help="samples per pixel of the references")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/near_lights")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    area = kernels_by_area(options.folder / "kernels")
    print("| scene | relMSE | seconds | both |\n|---|---|---|---|")
    for name, build in SCENES.items():
        measure(options, name, build, area)


if __name__ == "__main__":
    main()
