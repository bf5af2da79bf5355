#!/usr/bin/env python3
"""Writes one small scene per material: ./generate.py FOLDER [NAME...]. Needs python3-numpy. All are the same ball (or panel) over
the same ground, below the same lamp; only the material differs. README.md says what each is; tests/peers/material_agreement.py
renders them with Triad and with Cycles."""
import math
import pathlib
import sys

import numpy

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "suite")]

import shapes  # noqa: E402
from common import camera, panel, put, surface  # noqa: E402
from glb import Gltf  # noqa: E402

EYE, TARGET, FOV = (0.35, 1.25, 3.6), (0.0, 0.55, 0.0), 28.0
SKY = HERE.parent / "suite/sky.hdr"


def stage():
    scene = Gltf()
    put(scene, shapes.quad((-4, 0, 3), (8, 0, 0), (0, 0, -8)), surface(scene, "ground", (0.5, 0.45, 0.4), lambert=True), "ground")
    panel(scene, "lamp", (12, 12, 12), (-1.7, 2.6, 1.3), (0, 0.5, 0), 1.1, 1.1)
    camera(scene, EYE, TARGET, FOV, 1)
    return scene


def pbr(colour=(1, 1, 1), roughness=0.0, metallic=0.0, **more):
    return {"baseColorFactor": [*colour, *((1,) if len(colour) == 3 else ())], "roughnessFactor": roughness, "metallicFactor": metallic, **more}


def ball(pbr_members, extensions=None, **members):
    """A stage with a ball of that material."""
    scene = stage()
    if extensions:
        members["extensions"] = {f"KHR_materials_{key}": value for key, value in extensions.items()}
    material = scene.material("sample", pbrMetallicRoughness=pbr_members, **members)
    put(scene, stretched_uvs(shapes.sphere(0.6, 48, 96)) if "anisotropy" in (extensions or {}) else shapes.sphere(0.6, 48, 96),
        material, "ball", translation=[0, 0.62, 0])
    return scene


def stretched_uvs(form):
    """Tangents along the latitudes, and texture coordinates that ask for the same tangents."""
    rings, segments = 48, 96
    theta = numpy.pi * numpy.arange(rings + 1) / rings
    phi = 2 * numpy.pi * numpy.arange(segments + 1) / segments
    t, p = (a.ravel() for a in numpy.meshgrid(theta, phi, indexing="ij"))
    normals = numpy.stack([numpy.sin(t) * numpy.cos(p), numpy.cos(t), -numpy.sin(t) * numpy.sin(p)], axis=-1)
    tangents = numpy.stack([-numpy.sin(p), 0 * p, -numpy.cos(p), 0 * p + 1], axis=-1)
    a = (numpy.arange(rings)[:, None] * (segments + 1) + numpy.arange(segments)).ravel()
    b = a + segments + 1
    return {"positions": 0.6 * normals, "normals": normals, "tangents": tangents,
            "uvs": numpy.stack([p / (2 * numpy.pi), t / numpy.pi], axis=-1),
            "indices": numpy.concatenate([numpy.stack([a, b, b + 1], axis=1), numpy.stack([a, b + 1, a + 1], axis=1)])}


def standing():
    """A panel that faces the camera, leaning back."""
    return shapes.quad((-0.7, 0.02, 0.25), (1.4, 0, 0), (0, 1.15, -0.55))


def board(make_pbr, **members):
    """A stage with a panel; make_pbr(scene) gives its material."""
    scene = stage()
    extra = members.pop("extra", lambda scene: {})(scene)
    material = scene.material("sample", pbrMetallicRoughness=make_pbr(scene), **members, **extra)
    put(scene, standing(), material, "panel")
    return scene


def checks(scene):
    """Eight by eight squares of smooth colours."""
    y, x = numpy.mgrid[0:64, 0:64] // 8
    pixels = numpy.stack([40 + 25 * x, 220 - 20 * y, 90 + 60 * ((x + y) % 2)], axis=-1).astype(numpy.uint8)
    return scene.texture(pixels, magFilter=9729, minFilter=9729)


def waves(scene):
    """Smooth bumps of up to 20 degrees."""
    y, x = (numpy.mgrid[0:128, 0:128] + 0.5) / 128
    sx, sy = (0.36 * numpy.cos(2 * numpy.pi * 3 * a) for a in (x, y))
    n = numpy.stack([sx, sy, numpy.ones_like(sx)], axis=-1)
    n /= numpy.linalg.norm(n, axis=-1, keepdims=True)
    return scene.texture(numpy.rint(127.5 + 127.5 * n).astype(numpy.uint8), magFilter=9729, minFilter=9729)


def transformed(scene):
    return pbr(roughness=1, baseColorTexture={"index": checks(scene), "extensions": {
        "KHR_texture_transform": {"offset": [0.15, 0.3], "rotation": 0.5, "scale": [1.5, 0.8]}}})


LAMBERT = {"KHR_materials_specular": {"specularFactor": 0.0}}
GLASS, BODY = {"transmission": {"transmissionFactor": 1}}, {"thicknessFactor": 1}
AMBER = {"thicknessFactor": 1, "attenuationColor": [0.9, 0.5, 0.15], "attenuationDistance": 0.6}
SCENES = {
    "rough-metal": lambda: ball(pbr((1.0, 0.77, 0.34), 0.5, 1)),
    "smooth-metal": lambda: ball(pbr((0.66, 0.67, 0.69), 0.15, 1)),
    "plastic": lambda: ball(pbr((0.5, 0.06, 0.05), 0.3)),
    "thin-glass": lambda: ball(pbr((0.9, 0.95, 1)), GLASS),
    "thin-rough-.2": lambda: ball(pbr(roughness=0.2), GLASS),
    "thin-rough-.5": lambda: ball(pbr(roughness=0.5), GLASS),
    "volume": lambda: ball(pbr(), GLASS | {"volume": AMBER}),
    "volume-rough": lambda: ball(pbr(roughness=0.3), GLASS | {"volume": AMBER}),
    "ior": lambda: ball(pbr(), GLASS | {"volume": BODY, "ior": {"ior": 1.8}}),
    "specular": lambda: ball(pbr((0.05, 0.1, 0.3), 0.25), {"specular": {"specularFactor": 0.5, "specularColorFactor": [1, 0.6, 0.3]}}),
    "clearcoat": lambda: ball(pbr((0.6, 0.2, 0.1), 0.6, 1), {"clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.1}}),
    "sheen": lambda: ball(pbr((0.3, 0.05, 0.1), 1), {"sheen": {"sheenColorFactor": [0.6, 0.6, 0.6], "sheenRoughnessFactor": 0.5},
                                                     "specular": {"specularFactor": 0.0}}),
    "anisotropy": lambda: ball(pbr((0.9, 0.9, 0.9), 0.3, 1), {"anisotropy": {"anisotropyStrength": 0.7}}),
    "emissive-strength": lambda: ball(pbr((0, 0, 0), 1), {"emissive_strength": {"emissiveStrength": 4},
                                      "specular": {"specularFactor": 0.0}}, emissiveFactor=[1, 0.4, 0.1], doubleSided=True),
    "texture-transform": lambda: board(transformed, extensions=LAMBERT),
    "alpha-blend": lambda: board(lambda scene: pbr((0.2, 0.5, 0.3, 0.5), 1), alphaMode="BLEND", doubleSided=True, extensions=LAMBERT),
    "normal-map": lambda: board(lambda scene: pbr((0.8, 0.7, 0.6), 0.4, 1),
                                extra=lambda scene: {"normalTexture": {"index": waves(scene)}}),
}


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or SCENES:
        SCENES[name]().write(folder / f"{name}.glb")


if __name__ == "__main__":
    main()
