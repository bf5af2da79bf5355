"""Scenes that are hard because of their numbers: coordinates, scales, sizes."""
import numpy

import shapes
from common import glass, lambert, lamp, metal, place, sun, turned
from glb import Gltf, look_at

GRID = 1 / 16  # of the still life's coordinates: what float resolves at 1e6


def still_life(scale=1.0, vertices_at=(0, 0, 0), nodes_at=(0, 0, 0)):
    """A scene with everything, of size 20, on a grid of 1/16, so that it survives a move by 1e6 without loss."""
    s = Gltf()
    at = numpy.add(vertices_at, nodes_at) * scale

    def put(shape, material):
        positions = numpy.round(shape["positions"] / GRID) * GRID + vertices_at
        place(s, dict(shape, positions=positions * scale), material, translation=numpy.multiply(nodes_at, scale))

    checks = numpy.full((2, 2, 3), 230, numpy.uint8)
    checks[0, 0] = checks[1, 1] = (90, 60, 40)
    floor = s.material(pbrMetallicRoughness={"baseColorTexture": {"index": s.texture(checks, magFilter=9728)},
                                             "metallicFactor": 0.0, "roughnessFactor": 0.6})
    leaf = s.material(pbrMetallicRoughness={"baseColorFactor": [0.3, 0.6, 0.2, 0.6], "metallicFactor": 0.0},
                      alphaMode="BLEND", doubleSided=True)
    put(shapes.quad((-10, 0, 10), (20, 0, 0), (0, 0, -20)), floor)
    put(shapes.sphere(3, 24, 48, (-4, 3, 0)), glass(s, 1.5, True, (0.9, 0.6, 0.5), 4.0 * scale))
    put(shapes.sphere(2.5, 24, 48, (4, 2.5, -2)), metal(s, 0.3, (0.9, 0.7, 0.4)))
    put(shapes.box((-1, 0, 3), (1, 4, 4)), lambert(s, (0.2, 0.3, 0.7)))
    put(shapes.quad((4, 0, 4), (4, 0, -2), (0, 5, 0)), leaf)
    put(shapes.quad((-2, 14, -2), (4, 0, 0), (0, 0, 4)), lamp(s, (9, 8, 7)))
    s.node(light=s.light("point", intensity=60.0 * scale**2), translation=numpy.array([8, 8, 8]) * scale + at)
    spot = look_at((-8, 12, 6), (-4, 0, 2))
    spot[:3, 3] = spot[:3, 3] * scale + at
    s.node(light=s.light("spot", intensity=400.0 * scale**2, range=30.0 * scale, color=[0.6, 0.8, 1.0],
                         spot={"outerConeAngle": 0.4, "innerConeAngle": 0.2}), matrix=spot)
    sun(s, (1, -2, -1), 0.4)
    eye = look_at((3, 9, 24), (0, 3, 0))
    eye[:3, 3] = eye[:3, 3] * scale + at
    s.node(camera=s.perspective(0.6), matrix=eye)
    return s


def kilometres_and_millimetres():
    """A box of 1 mm on a plane of 10 km with hills of a kilometre, seen from 10 mm; all of it turned, so that no plane
    is a plane of the coordinates."""
    s = Gltf()
    turn = turned((1, 2, 3), 30)
    place(s, shapes.quad((-5000, 0, 5000), (10000, 0, 0), (0, 0, -10000)), lambert(s, 0.5), matrix=turn)
    place(s, shapes.box((-0.0005, 0, -0.0005), (0.0005, 0.001, 0.0005)), lambert(s, (0.8, 0.2, 0.1)), matrix=turn)
    hill = {"positions": numpy.array([[-900, 0, 700], [900, 0, 700], [900, 0, -700], [-900, 0, -700], [100, 900, 0]]),
            "indices": numpy.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])}
    for x, z in ((-2500, -3500), (-300, -4200), (2200, -3300)):
        place(s, hill, lambert(s, (0.3, 0.5, 0.3)), matrix=turn @ turned((0, 1, 0), x, (x, 0, z)))
    sun(s, (-2, -2, -1), numpy.pi, turn)
    eye = turn @ look_at((0.002, 0.004, 0.009), (-0.0002, 0.0015, 0))
    s.node(camera=s.perspective(0.6, znear=1e-4), matrix=eye)
    return s


def hair_far_away():
    """A thousand hairs, 0.1 mm thick and 1 m long, 100 m away from a camera that stands on the same floor."""
    s = Gltf()
    random = numpy.random.default_rng(1)
    hairs = []
    for i in range(1000):
        x = (i + 0.5) / 1000 - 0.5
        lean = random.uniform(-2e-4, 2e-4)  # less than the distance between two: none hides another
        z = random.uniform(-0.05, 0.05)
        hairs.append(shapes.cylinder((x - lean, 0.5, z), (x + lean, 1.5, z), 5e-5, 6))
    turn = turned((0, 1, 0), 30)
    hair = shapes.join(*hairs)
    place(s, {key: hair[key] for key in ("positions", "indices")}, lambert(s, 0.0, name="hair"), matrix=turn)
    place(s, shapes.quad((-2, 0, -1), (4, 0, 0), (0, 3, 0)), lamp(s, 1.0), matrix=turn)
    place(s, shapes.quad((-60, 0, 110), (120, 0, 0), (0, 0, -120)), lambert(s, 0.4), matrix=turn)
    s.node(camera=s.perspective(0.005), matrix=turn @ look_at((0, 1, 100), (0, 1, 0)))
    return s


def _single(make):
    return lambda path: make().write(path + ".glb")


SCENES = {
    "still_life": _single(still_life),
    "still_life_vertices_at_1e6": _single(lambda: still_life(vertices_at=(1e6, -1e6, 1e6))),
    "still_life_nodes_at_1e6": _single(lambda: still_life(nodes_at=(1e6, -1e6, 1e6))),
    "still_life_of_1e-6": _single(lambda: still_life(scale=1e-6)),
    "kilometres_and_millimetres": _single(kilometres_and_millimetres),
    "hair_far_away": _single(hair_far_away),
} | {f"still_life_2^{k}": _single(lambda k=k: still_life(scale=2.0**k)) for k in range(-20, 21)}
