#!/usr/bin/env python3
"""LuxCore's picture of scenes/spectral/cubo.glb, for docs/spectral.md: ./luxcore_cubo.py SECONDS OUT.png [SIZE [OUT.npy [SEED]]].
SECONDS of two cores: half of the processor time. Needs pyluxcore, numpy.

Its glass takes Cauchy's two terms: index and dispersion (n_F - n_C) of "cubo" at the d line. Paths from the camera and from the
lights ("hybridbackforward"), one wavelength per path after dispersion, as it comes."""
import math
import os
import pathlib
import struct
import sys
import tempfile
import time

import numpy
import pyluxcore

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scenes"))

from glb import png  # noqa: E402
from glb_reader import Glb  # noqa: E402


def write_ply(path, points, triangles):
    with open(path, "wb") as f:
        f.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
                f"element face {len(triangles)}\nproperty list uchar uint vertex_indices\nend_header\n".encode())
        f.write(points.astype("<f4").tobytes())
        for t in triangles:
            f.write(struct.pack("<B3I", 3, *t))


def build(folder, aspect):
    glb = Glb(ROOT / "scenes/spectral/cubo.glb")
    scene, properties = pyluxcore.Scene(), pyluxcore.Properties()

    def put(name, value):
        properties.Set(pyluxcore.Property(name, value))

    n_d = 1.4 + 50 / (587.5618 - 230)
    spread = 50 / (486.1327 - 230) - 50 / (656.2725 - 230)
    for i, (node, m) in enumerate(glb.nodes()):
        if "camera" in node:
            eye = m[:3, 3]
            put("scene.camera.lookat.orig", eye.tolist())
            put("scene.camera.lookat.target", (eye - m[:3, 2]).tolist())
            put("scene.camera.up", m[:3, 1].tolist())
            put("scene.camera.fieldofview", math.degrees(glb.json["cameras"][node["camera"]]["perspective"]["yfov"]))
            put("scene.camera.screenwindow", [-aspect, aspect, -1., 1.])
            put("scene.camera.autovolume.enable", False)
        if "mesh" not in node:
            continue
        for primitive in glb.json["meshes"][node["mesh"]]["primitives"]:
            points = glb.array(primitive["attributes"]["POSITION"]) @ m[:3, :3].T + m[:3, 3]
            material = glb.json["materials"][primitive["material"]]
            write_ply(folder / f"{i}.ply", points, glb.array(primitive["indices"]).reshape(-1, 3))
            key = f"scene.materials.m{i}"
            if "KHR_materials_transmission" in material.get("extensions", {}):
                put(key + ".type", "glass")
                put(key + ".kr", [1., 1., 1.])
                put(key + ".kt", [1., 1., 1.])
                put(key + ".interiorior", n_d)
                put(key + ".cauchyb", spread / (1 / .4861327 ** 2 - 1 / .6562725 ** 2))
            else:
                put(key + ".type", "matte")
                put(key + ".kd", material["pbrMetallicRoughness"]["baseColorFactor"][:3])
                strength = material.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1.)
                if any(material.get("emissiveFactor", ())):
                    put(key + ".emission", [strength * e for e in material["emissiveFactor"]])
            put(f"scene.shapes.s{i}.type", "mesh")
            put(f"scene.shapes.s{i}.ply", str(folder / f"{i}.ply"))
            put(f"scene.objects.o{i}.shape", f"s{i}")
            put(f"scene.objects.o{i}.material", f"m{i}")
    scene.Parse(properties)
    return scene


def main():
    seconds, out = float(sys.argv[1]), pathlib.Path(sys.argv[2])
    width, height = (int(x) for x in (sys.argv[3] if len(sys.argv) > 3 else "400x300").split("x"))
    pyluxcore.Init(lambda message: None)
    with tempfile.TemporaryDirectory() as name:
        scene = build(pathlib.Path(name), width / height)
        properties = pyluxcore.Properties()
        for key, value in {"renderengine.type": "PATHCPU", "film.width": width, "film.height": height, "sampler.type": "SOBOL",
                           "sampler.sobol.adaptive.strength": 0.0, "film.filter.type": "NONE", "path.pathdepth.total": 64,
                           "path.pathdepth.diffuse": 64, "path.pathdepth.glossy": 64, "path.pathdepth.specular": 64,
                           "renderengine.seed": int(sys.argv[5]) if len(sys.argv) > 5 else 1, "path.hybridbackforward.enable": 1, "path.hybridbackforward.partition": 0.5,
                           "film.imagepipelines.0.0.type": "NOP", "film.outputs.0.type": "RGB", "film.outputs.0.filename": "x.exr"}.items():
            properties.Set(pyluxcore.Property(key, value))
        session = pyluxcore.RenderSession(pyluxcore.RenderConfig(properties, scene))
        session.Start()
        begin = time.process_time()
        while time.process_time() - begin < 2 * seconds:
            time.sleep(0.5)
            session.UpdateStats()
        samples = session.GetStats().Get("stats.renderengine.pass").GetFloat()
        session.Stop()
        picture = numpy.zeros((height, width, 3), numpy.float32)
        session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, picture, 0, False)
    picture = picture[::-1]
    if len(sys.argv) > 4:
        numpy.save(sys.argv[4], picture)
    linear = numpy.clip(picture, 0, 1)
    encoded = numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * numpy.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)
    out.write_bytes(png(numpy.rint(255 * encoded).astype(numpy.uint8)))
    print(f"{out}: {samples:.0f} samples per pixel in {seconds:.0f} s, mean {picture.mean(axis=(0, 1))}")
    sys.stdout.flush()
    os._exit(0)  # LuxCore's threads do not always end


main()
