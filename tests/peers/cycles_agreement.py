#!/usr/bin/env python3
"""Renders glTF files with Triad and with Blender's Cycles, from the same camera in the same light, and compares the
means of tiles of 16 x 16 pixels.

  pip install bpy==4.5.*            (Python 3.11)
  python tests/peers/cycles_agreement.py --triad build/bin/triad --assets ../shared/assets --out agreement

Each renderer renders twice, with two seeds: the mean is compared, half the difference is its noise. The difference of a
tile is |Triad - Cycles| in R, G or B, whichever is largest, over the tile's mean in Cycles plus 1 % of the picture's. Writes OUT/agreement.json and, per
case, a PNG with Triad, Cycles and the difference (red: Triad is brighter, blue: darker; full at 10 %). Exit 1 when a
case has more tiles beyond 2 % than its entry in CASES explains.
"""
import argparse
import functools
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import cycles_scene

TILE = 16
LIMIT = 0.02
ENVIRONMENT = "env/venice_sunset_256.hdr"


class Case:
    """direction: from the scene's centre to the eye; zoom: 1 lets its bounding sphere fill the picture; explained: share
    of the tiles that may differ by more than 2 %, for the reasons in docs/agreement.md."""

    def __init__(self, name, path, direction, zoom=1.0, environment=ENVIRONMENT, spp=512, explained=0.0):
        self.name, self.path, self.direction, self.zoom = name, path, direction, zoom
        self.environment, self.spp, self.explained = environment, spp, explained


CASES = [
    Case("NormalTangentTest", "textures/NormalTangentTest/NormalTangentTest.gltf", (0.3, 0.2, 1), 1.3, explained=0.2),
    Case("FlightHelmet", "scenes/FlightHelmet/FlightHelmet.gltf", (0.4, 0.2, 1), 1.3, explained=0.3),
    Case("AlphaBlendModeTest", "textures/AlphaBlendModeTest-glb/AlphaBlendModeTest.glb", (0.2, 0.3, 1), 1.2),
    Case("AttenuationTest", "ext-materials/AttenuationTest/AttenuationTest.gltf", (0.1, 0.1, 1), 1.3),
    Case("GlassVaseFlowers", "scenes/GlassVaseFlowers/GlassVaseFlowers.gltf", (0.2, 0.4, 1), 1.3, explained=0.15),
    Case("TransmissionTest", "ext-materials/TransmissionTest-glb/TransmissionTest.glb", (0.0, 0.3, 1), 1.3, explained=0.15),
    Case("Lights", "ext-lights/nanogl_Lights/Lights.glb", (0.5, 0.6, 1), 0.9, None, explained=0.2),
    Case("CornellBox", "scenes/bevy_CornellBox/CornellBox.glb", (0, 0, 1), 1.3, None, explained=0.6),
    Case("VertexColorTest", "core/VertexColorTest-glb/VertexColorTest.glb", (0.2, 0.2, 1), 1.2, explained=0.05),
    Case("EmissiveStrengthTest", "ext-materials/EmissiveStrengthTest/EmissiveStrengthTest.gltf", (0.2, 0.2, 1), 1.2, None, explained=0.2),
    Case("TextureTransformTest", "textures/TextureTransformTest/TextureTransformTest.gltf", (0.1, 0.2, 1), 1.3),
    Case("Suzanne", "scenes/Suzanne/Suzanne.gltf", (0.4, 0.2, 1), 1.3),
]
FOV = 40.0


def view(case, centre, radius):
    direction = np.array(case.direction, float)
    distance = radius / math.sin(math.radians(FOV / 2)) / case.zoom
    return np.array(centre) + direction / np.linalg.norm(direction) * distance


def render_triad(options, path, environment, eye, target, spp, seed):
    with tempfile.TemporaryDirectory() as folder:
        picture = os.path.join(folder, "triad.exr")
        command = [options.triad, "render", path, "-o", picture, "--size", f"{options.size}x{options.size}", "-q"]
        command += ["--spp", str(spp), "--seed", str(seed), "--fov", str(FOV), "--threads", str(options.threads)]
        command += ["--look-at=" + ",".join(repr(float(x)) for x in (*eye, *target))]
        command += ["--env", environment] if environment else ["--background", "#000000", "--env-strength", "0"]
        subprocess.run(command, check=True)
        return cycles_scene.read_image(picture)


def without_coat(path, folder):
    """A copy of the asset whose materials have KHR_materials_specular factor 0: Lambert's law below metal and glass,
    the same in both renderers."""
    copied = shutil.copytree(os.path.dirname(path), os.path.join(folder, "asset"))
    path = os.path.join(copied, os.path.basename(path))
    gltf = cycles_scene.read_gltf_json(path)
    for material in gltf.get("materials", []):
        material.setdefault("extensions", {})["KHR_materials_specular"] = {"specularFactor": 0.0}
    gltf["extensionsUsed"] = sorted({*gltf.get("extensionsUsed", []), "KHR_materials_specular"})
    text = json.dumps(gltf).encode()
    with open(path, "rb") as f:
        old = f.read()
    if old[:4] == b"glTF":
        rest = old[20 + struct.unpack("<I", old[12:16])[0] :]
        text += b" " * (-len(text) % 4)
        text = struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest
    with open(path, "wb") as f:
        f.write(text)
    return path


def tiles(image):
    n = image.shape[0] // TILE
    return image[: n * TILE, : n * TILE].reshape(n, TILE, n, TILE, 3).mean((1, 3))


def compare(triad, cycles):
    """triad, cycles: two pictures each. Returns the numbers of a row of the table and the map of signed differences."""
    a, b = (tiles(np.mean(pair, 0)) for pair in (triad, cycles))
    floor = b.mean(-1, keepdims=True) + 0.01 * b.mean()
    signed = (a - b) / floor
    noise = [np.abs(tiles(pair[0]) - tiles(pair[1])) / 2 / floor for pair in (triad, cycles)]
    worst = np.take_along_axis(signed, np.abs(signed).argmax(-1)[..., None], -1)[..., 0]
    size = np.abs(worst)
    row = {
        "tiles": size.size,
        "within": float((size <= LIMIT).mean()),
        "median": float(np.median(size)),
        "p95": float(np.quantile(size, 0.95)),
        "largest": float(size.max()),
        "mean_ratio": float(a.mean() / b.mean()),
        "noise_triad": float(np.sqrt((noise[0] ** 2).mean())),
        "noise_cycles": float(np.sqrt((noise[1] ** 2).mean())),
    }
    return row, worst


def encode(linear, exposure):
    x = np.clip(linear * exposure, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def write_picture(path, triad, cycles, signed):
    a, b = np.mean(triad, 0), np.mean(cycles, 0)
    exposure = 0.5 / max(np.quantile(b.mean(-1), 0.8), 1e-6)
    d = np.kron(np.clip(signed / 0.1, -1, 1), np.ones((TILE, TILE)))
    heat = np.stack([1 - np.maximum(-d, 0), 1 - np.abs(d), 1 - np.maximum(d, 0)], -1)
    pad = np.ones((a.shape[0], a.shape[1], 3))
    pad[: d.shape[0], : d.shape[1]] = heat
    cycles_scene.write_png(path, np.concatenate([encode(a, exposure), encode(b, exposure), pad], 1))


def run(case, options):
    path = os.path.abspath(os.path.join(options.assets, case.path))
    with tempfile.TemporaryDirectory() as folder:
        return run_file(case, without_coat(path, folder) if options.without_coat else path, options)


def run_file(case, path, options):
    environment = os.path.abspath(os.path.join(options.assets, case.environment)) if case.environment else None
    scene = cycles_scene.CyclesScene(path, environment, options.size, options.threads)
    centre, radius = scene.bounds()
    eye = view(case, centre, radius)
    scene.look_at(eye, centre, FOV)
    spp = max(1, int(case.spp * options.spp_scale))
    times = [time.time()]
    cycles = [scene.render(spp, seed) for seed in (1, 2)]
    times.append(time.time())
    triad = [render_triad(options, path, environment, eye, centre, spp, seed) for seed in (1, 2)]
    times.append(time.time())
    row, signed = compare(triad, cycles)
    row.update(name=case.name, spp=2 * spp, seconds_cycles=times[1] - times[0], seconds_triad=times[2] - times[1])
    row["explained"] = case.explained
    row["pass"] = 1 - row["within"] <= case.explained + 1e-9
    write_picture(os.path.join(options.out, case.name + ".png"), triad, cycles, signed)
    if options.keep:
        np.savez(os.path.join(options.out, case.name + ".npz"), triad=triad, cycles=cycles, signed=signed)
    return row


def report(rows, path):
    """Prints a line for each as it comes, and writes them as JSON. What the program ends with."""
    kept = []
    print("| scene | tiles within 2 % | median | 95 % | largest | mean Triad / Cycles | noise Triad | noise Cycles |")
    print("|---|---|---|---|---|---|---|---|")
    for r in rows:
        kept.append(r)
        print(f"| {r['name']} | {100 * r['within']:.1f} % | {100 * r['median']:.2f} % | {100 * r['p95']:.2f} % "
              f"| {100 * r['largest']:.1f} % | {r['mean_ratio']:.4f} | {100 * r['noise_triad']:.2f} % "
              f"| {100 * r['noise_cycles']:.2f} % |", flush=True)
    with open(path, "w") as f:
        json.dump({"schema": "triad.agreement/1", "rows": kept}, f, indent=1)
    return 0 if all(r["pass"] for r in kept) else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", help="names; default all")
    parser.add_argument("--triad", default="build/bin/triad")
    parser.add_argument("--assets", default=os.environ.get("TRIAD_TEST_ASSETS", "../shared/assets"))
    parser.add_argument("--out", default="agreement")
    parser.add_argument("--size", type=int, default=192)
    parser.add_argument("--spp-scale", type=float, default=1.0)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--without-coat", action="store_true", help="control: dielectrics are Lambert's in both")
    parser.add_argument("--macroscopic-walls", action="store_true",
                        help="control: rough thin walls in Cycles reflect as their macroscopic normal does")
    parser.add_argument("--keep", action="store_true", help="also write the pictures as .npz")
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    if options.macroscopic_walls:
        cycles_scene.thin_walls = functools.partial(cycles_scene.thin_walls, macroscopic=True)
    known = {case.name for case in CASES}
    if unknown := set(options.cases) - known:
        parser.error(f"unknown case {sorted(unknown)}; there are {sorted(known)}")
    wanted = [case for case in CASES if not options.cases or case.name in options.cases]
    return report((run(case, options) for case in wanted), os.path.join(options.out, "agreement.json"))


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    os._exit(code)  # bpy does not always survive its own clean-up
