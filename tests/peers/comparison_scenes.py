"""The scenes of error_for_time.py: five that are written here, and two of scenes/suite.

All hold only what every renderer can express, so that their pictures can be compared: Lambert's law, rough metal, clear glass, lamps that
shine from their front, point lights, an environment. `write` makes the files that every renderer reads.
"""
import math
import pathlib
import sys
from dataclasses import dataclass

import numpy as np

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
sys.path[:0] = [str(SCENES), str(SCENES / "suite")]

import shapes  # noqa: E402
from common import camera, glass, lamp, plain, put, surface  # noqa: E402
from glb import Gltf  # noqa: E402

METAL = (0.96, 0.94, 0.90)
LAMP_COLOURS = ((1.0, 0.72, 0.45), (1.0, 0.9, 0.75), (0.8, 0.9, 1.0), (1.0, 0.55, 0.5))


@dataclass(frozen=True)
class Scene:
    name: str
    file: pathlib.Path
    environment: pathlib.Path | None = None
    strength: float = 1.0  # of the environment
    error_factor: float = 1.0  # times --error is where this scene's times are read: 1e-3 would take hours without a light tree


def cornell():
    """An open box with two blocks and one lamp (the measures and colours of Mitsuba's cornell_box): 36 triangles."""
    scene = Gltf()
    white, green, red = (surface(scene, name, colour, lambert=True) for name, colour in (
        ("white", (0.885809, 0.698859, 0.666422)), ("green", (0.105421, 0.37798, 0.076425)), ("red", (0.570068, 0.0430135, 0.0443706))))
    x, y, z = 2 * np.eye(3)
    for name, corner, u, v, material in (("floor", (-1, -1, -1), z, x, white), ("ceiling", (-1, 1, -1), x, z, white),
                                         ("back", (-1, -1, -1), x, y, white), ("right", (1, -1, -1), z, y, green),
                                         ("left", (-1, -1, -1), y, z, red)):
        put(scene, plain(shapes.quad(corner, u, v)), material, name)
    block = plain(shapes.box((-1, -1, -1), (1, 1, 1)))
    put(scene, block, white, "low block", matrix=[[0.286891, 0, -0.0877115, 0.335], [0, 0.3, 0, -0.7],
                                                  [0.0877115, 0, 0.286891, 0.38], [0, 0, 0, 1]])
    put(scene, block, white, "high block", matrix=[[0.28491, 0, 0.0939491, -0.33], [0, 0.61, 0, -0.4],
                                                   [-0.0939491, 0, 0.28491, -0.28], [0, 0, 0, 1]])
    put(scene, plain(shapes.quad((-0.23, 0.99, -0.18), 0.23 * x, 0.19 * z)), lamp(scene, "lamp", (18.387, 13.9873, 6.75357)), "lamp")
    camera(scene, (0, 0, 3.9), (0, 0, 0), 39.3077, 1)
    return scene


def lumpy(radius, rings, segments, height, seed):
    """A closed body of 2 segments (rings - 1) flat triangles: a sphere whose radius waves by about `height` of it."""
    ball = shapes.sphere(1, rings, segments)
    random = np.random.default_rng(seed)
    waves = np.ones(len(ball["positions"]))
    for _ in range(24):
        wave = random.normal(size=3) * random.uniform(4, 18)
        waves += height / 5 * np.sin(ball["positions"] @ wave + random.uniform(0, 2 * math.pi))
    return {"positions": radius * waves[:, None] * ball["positions"], "indices": ball["indices"]}


def mid():
    """A closed room with three bodies of rough surface, one of them metal, and a ball of glass: 190,000 triangles."""
    scene = Gltf()
    put(scene, plain(shapes.box((-2, 0, -2.6), (2, 3, 2), inside=True)), surface(scene, "wall", (0.7, 0.68, 0.62), lambert=True), "room")
    put(scene, lumpy(0.462, 133, 264, 0.3, 5), surface(scene, "clay", (0.6, 0.45, 0.3), lambert=True), "clay body",
        translation=[0.05, 0.55, -0.25])
    put(scene, lumpy(0.5, 101, 200, 0.25, 1), surface(scene, "metal", METAL, 0.2, 1.0), "metal body",
        translation=[-1.05, 0.62, -0.55])
    put(scene, lumpy(0.5, 101, 200, 0.25, 2), surface(scene, "blue", (0.2, 0.35, 0.65), lambert=True), "blue body",
        translation=[1.15, 0.62, -0.75])
    put(scene, lumpy(0.34, 101, 200, 0, 0), glass(scene, "glass"), "glass ball", translation=[0.62, 0.36, 0.62])
    put(scene, plain(shapes.quad((-0.5, 2.98, -0.4), (1, 0, 0), (0, 0, 1))), lamp(scene, "lamp", (12, 11, 9.5)), "lamp")
    camera(scene, (0, 1.35, 1.95), (0.05, 0.62, -0.5), 65, 1)
    return scene


def env():
    """Two bodies on a plane, clay and metal, lit by an environment alone: 139,000 triangles."""
    scene = Gltf()
    put(scene, plain(shapes.quad((-8, 0, 8), (16, 0, 0), (0, 0, -16))), surface(scene, "floor", (0.5, 0.5, 0.5), lambert=True), "floor")
    put(scene, lumpy(0.42, 133, 264, 0.3, 5), surface(scene, "clay", (0.65, 0.5, 0.35), lambert=True), "clay body",
        translation=[-0.55, 0.5, 0])
    put(scene, lumpy(0.42, 133, 264, 0.3, 6), surface(scene, "metal", METAL, 0.2, 1.0), "metal body",
        translation=[0.6, 0.5, -0.35])
    camera(scene, (0.2, 1.3, 3.0), (0, 0.45, -0.1), 45, 1)
    return scene


def pillars(scene, random):
    """A plane of 40 m with 100 pillars, every third of metal, and a slanted plate of metal. The camera looks along the plane, from below
    the lamps and down just so far that none of them is in the picture: what is compared is their light, not how dots are drawn."""
    kinds = [surface(scene, "metal", METAL, 0.3, 1.0), surface(scene, "stone", (0.55, 0.52, 0.48), lambert=True),
             surface(scene, "brick", (0.5, 0.22, 0.15), lambert=True)]
    put(scene, plain(shapes.quad((-20, 0, 20), (40, 0, 0), (0, 0, -40))), surface(scene, "ground", (0.5, 0.5, 0.5), lambert=True), "ground")
    put(scene, plain(shapes.box((-0.8, -0.05, -0.6), (0.8, 0.05, 0.6))), kinds[0], "plate", translation=[-1.1, 0.7, 12],
        rotation=[math.sin(math.pi / 8), 0, 0, math.cos(math.pi / 8)])
    for i in range(100):
        x, z, width, height = random.uniform((-17, -19, 0.25, 0.5), (17, 12, 0.6, 2.8))
        half_turn = random.uniform(0, math.pi / 4)
        put(scene, plain(shapes.box((-width, 0, -width), (width, height, width))), kinds[i % 3], f"pillar {i}",
            translation=[x + math.copysign(0.8, x), 0, z], rotation=[0, math.sin(half_turn), 0, math.cos(half_turn)])
    camera(scene, (0, 3.5, 19), (0, 0, 8), 34, 1)


def above(random, count):
    """Places between 4.5 and 6 m above the plane."""
    return random.uniform((-20, 4.5, -20), (20, 6, 20), (count, 3))


def ten_thousand():
    """10,000 small triangles that emit downwards, of eight radiances from 20 to 400, above a plane with pillars."""
    scene, random = Gltf(), np.random.default_rng(11)
    pillars(scene, random)
    for i, radiance in enumerate(np.geomspace(20, 400, 8)):
        centres = above(random, 625)[:, None]
        side = random.uniform(0.03, 0.08, (625, 1, 1))
        corners = centres + side * np.array([(-0.5, 0, -0.5), (0.5, 0, -0.5), (0.5, 0, 0.5), (-0.5, 0, 0.5)])
        faces = 4 * np.arange(625)[:, None, None] + np.array([(0, 1, 2), (0, 2, 3)])
        put(scene, {"positions": corners.reshape(-1, 3), "indices": faces.reshape(-1, 3)},
            lamp(scene, f"lamps {i}", [radiance * c for c in LAMP_COLOURS[i % 4]]), f"lamps {i}")
    return scene


def thousand_points():
    """1000 point lights, of .1 to 2 candela, above a plane with pillars."""
    scene, random = Gltf(), np.random.default_rng(12)
    pillars(scene, random)
    for i, place in enumerate(above(random, 1000)):
        intensity = 2 * 20 ** random.uniform(-1, 0)
        scene.node(light=scene.light("point", name=f"light {i}", color=list(LAMP_COLOURS[i % 4]), intensity=intensity),
                   translation=place, name=f"light {i}")
    return scene


SKY = SCENES / "suite/sky.hdr"
MANY_LIGHTS = ("ten_thousand", "thousand_points")
GENERATED = {f.__name__: f for f in (cornell, mid, env, ten_thousand, thousand_points)}
DESCRIPTIONS = {name: make.__doc__ for name, make in GENERATED.items()} | {
    "plates": "scenes/suite/plates.glb: lamps of four sizes mirrored in plates of four roughnesses.",
    "knot": "scenes/suite/knot.glb under its sky, not turned: smooth diffuse light."}


def write(folder, names):
    """The scenes of these names, those that are made here as .glb files in the folder."""
    scenes = []
    for name in names:
        file = folder / f"{name}.glb" if name in GENERATED else SCENES / f"suite/{name}.glb"
        if name in GENERATED:
            GENERATED[name]().write(file)
        scenes.append(Scene(name, file, SKY if name in ("env", "knot") else None, 1.7 if name == "knot" else 1.0,
                            10.0 if name in MANY_LIGHTS else 1.0))
    return scenes
