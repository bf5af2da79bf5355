#!/usr/bin/env python3
"""Writes the scenes about wavelengths: ./generate.py [FOLDER]. Needs python3-numpy. What it writes is kept beside it."""
import math
import pathlib
import sys

import numpy

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "suite")]

import forms  # noqa: E402
import shapes  # noqa: E402
from common import cove, lamp, panel, put, surface  # noqa: E402
from glb import Gltf, look_at  # noqa: E402


def glass(scene, name, kind, roughness=0.0, tint=(1, 1, 1), distance=1.0, priority=None):
    """A body of a glass of the catalogue (docs/spectral.md)."""
    triad = {"glass": kind} | ({"priority": priority} if priority else {})
    return scene.material(name, pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": roughness},
                          extensions={"KHR_materials_transmission": {"transmissionFactor": 1},
                                      "KHR_materials_volume": {"thicknessFactor": 1, "attenuationColor": list(tint),
                                                               "attenuationDistance": distance}}, extras={"triad": triad})


def eye(scene, at, target, degrees, name="camera", aspect=16 / 9, up=(0, 1, 0)):
    scene.node(camera=scene.perspective(math.radians(degrees), aspect, name=name), matrix=look_at(at, target, up), name=name)


def bar(corners, length):
    """A closed bar along z over a polygon (x, y), counter-clockwise seen from +z."""
    n, z = len(corners), length / 2
    sides = [shapes.quad([*a, z], [0, 0, -length], [b[0] - a[0], b[1] - a[1], 0]) for a, b in zip(corners, corners[1:] + corners[:1])]
    fan = numpy.array([[0, i, i + 1] for i in range(1, n - 1)])
    points = numpy.array(corners)
    ends = [{"positions": numpy.column_stack([points, numpy.full(n, z)]), "indices": fan, "uvs": numpy.zeros((n, 2))},
            {"positions": numpy.column_stack([points, numpy.full(n, -z)]), "indices": fan[:, ::-1], "uvs": numpy.zeros((n, 2))}]
    return shapes.join(*sides, *ends)


def triangle(side=1.0):
    h = side * math.sqrt(3) / 2
    return [(-side / 2, -h / 3), (side / 2, -h / 3), (0, 2 * h / 3)]


def prism(lamp_height=0.06):
    """Newton's: a small far lamp behind a slit, an equilateral prism of SF10 at minimum deviation for the d line, a screen."""
    scene = Gltf()
    angle = math.radians(59.5659 / 2)
    into, out = numpy.array([math.cos(angle), math.sin(angle), 0]), numpy.array([math.cos(angle), -math.sin(angle), 0])
    entry, leave = numpy.array([-0.25, 0.1443, 0]), numpy.array([0.25, 0.1443, 0])
    black, white = surface(scene, "black", (0, 0, 0), lambert=True), surface(scene, "screen", (0.9, 0.9, 0.9), lambert=True)
    put(scene, bar(triangle(), 1.2), glass(scene, "prism", "SF10"), "prism")

    def across(at, direction, low, high, width):
        """A rectangle across a direction, from low to high beside it; its front looks along it."""
        side = numpy.array([-direction[1], direction[0], 0])
        return shapes.quad(at + low * side - [0, 0, width / 2], side * (high - low), numpy.array([0, 0, width]))

    slit, card = entry - into, entry - 6 * into
    for name, low, high in (("above the slit", 0.01, 9), ("below the slit", -9, -0.01)):
        put(scene, across(slit, -into, low, high, 24), black, name)
    put(scene, across(card, into, -lamp_height, lamp_height, 3), lamp(scene, "lamp", (20, 20, 20)), "lamp")
    put(scene, across(leave + 3 * out, -out, -0.7, 0.7, 2), white, "screen")
    eye(scene, leave + 1.5 * out, leave, 14, "eye", up=(-out[1], out[0], 0))
    eye(scene, leave + 0.9 * out + [0, 1.4, 2.0], leave + 2.9 * out, 34, "screen")
    return scene


def prism_seen():
    """The same with a lamp that shines in all directions through the slit: who looks into the prism sees its spectrum."""
    return prism(lamp_height=2.0)


def lines():
    """Bunsen's chart: five small lamps in five lanes between black walls, each with a slit of its own before one prism."""
    scene = Gltf()
    angle = math.radians(59.5659 / 2)
    into, out = numpy.array([math.cos(angle), math.sin(angle), 0]), numpy.array([math.cos(angle), -math.sin(angle), 0])
    up, across = numpy.array([-into[1], into[0], 0]), numpy.array([-out[1], out[0], 0])
    side, lane, opening, half_slit = 0.3, 0.26, 0.13, 0.004
    entry, leave = numpy.array([-side / 4, 0, 0]), numpy.array([side / 4, 0, 0])
    slit, card, z = entry - 0.5 * into, entry - 6 * into, numpy.array([0, 0, 1])
    black, white = surface(scene, "black", (0, 0, 0), lambert=True), surface(scene, "screen", (0.9, 0.9, 0.9), lambert=True)
    height = side * math.sqrt(3) / 2
    put(scene, bar([(x, y - height / 6) for x, y in triangle(side)], 1.4), glass(scene, "prism", "SF10"), "prism")
    lamps = [("black body", {"blackbody": 3000}, 60),
             ("mercury", {"lines": [[404.66, 1.8], [435.83, 4], [546.07, 5], [576.96, 1.2], [579.07, 1.2]]}, 20),
             ("sodium", {"lines": [[588.995, 2], [589.592, 1]]}, 5),
             ("hydrogen", {"lines": [[410.17, 0.6], [434.05, 1], [486.13, 2], [656.28, 5]]}, 12),
             ("laser", {"laser": 532}, 5)]
    put(scene, shapes.quad(slit + half_slit * up - 2 * z, 4 * z, 3 * up), black, "above the slits")
    put(scene, shapes.quad(slit - half_slit * up - 2 * z, 4 * z, -9 * up), black, "below the slits")
    edges = [-2.0]
    for k, (name, spectrum, strength) in enumerate(lamps):
        middle = lane * (2 - k)
        extras = {"triad": {"spectrum": spectrum}}
        if k == 0:  # a filament; the others are points
            material = scene.material(name, pbrMetallicRoughness={"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                                      emissiveFactor=[1, 1, 1], extensions={"KHR_materials_emissive_strength": {"emissiveStrength": strength / 0.0001}},
                                      extras=extras)
            put(scene, shapes.quad(card - 0.005 * up + (middle - 0.005) * z, 0.01 * up, 0.01 * z), material, name)
        else:
            light = scene.light("point", name=name, intensity=strength, extras=extras)
            scene.node(light=light, translation=list(card + middle * z), name=name)
        edges += [middle - opening / 2, middle + opening / 2]
    edges = sorted(edges + [2.0])
    for a, b in zip(edges[::2], edges[1::2]):
        put(scene, shapes.quad(slit - 2 * half_slit * up + a * z, (b - a) * z, 4 * half_slit * up), black, "between the slits")
    for k in range(6):
        put(scene, shapes.quad(slit - 2 * up + lane * (k - 2.5) * z, 4 * up, -6.5 * into), black, "wall")
    centre = leave + 3 * out
    put(scene, shapes.quad(centre - 0.7 * across - z, 2 * z, 1.4 * across), white, "screen")
    eye(scene, leave + 1.2 * out - 0.08 * across, centre - 0.08 * across, 41, "screen", aspect=0.4, up=z)
    return scene


def cubo():
    """A box with a prism inside and a small lamp: caustics of all colours on the walls."""
    scene = Gltf()
    wall = surface(scene, "wall", (0.75, 0.75, 0.75), lambert=True)
    put(scene, shapes.flipped(shapes.box((-1, 0, -1), (1, 2, 1))), wall, "box")
    turned = [(x * math.cos(0.3) - y * math.sin(0.3), x * math.sin(0.3) + y * math.cos(0.3) + 0.85) for x, y in triangle(0.8)]
    put(scene, bar(turned, 0.9), glass(scene, "prism", "cubo"), "prism", rotation=[0, math.sin(0.2), 0, math.cos(0.2)])
    put(scene, shapes.quad((-0.12, 1.995, -0.12), (0.24, 0, 0), (0, 0, 0.24)), lamp(scene, "lamp", (30, 30, 30)), "lamp")
    eye(scene, (0, 1.0, 0.98), (0, 0.85, -1), 75, aspect=4 / 3)
    return scene


def figure():
    """A knot of heavy flint and a cut diamond on a table."""
    scene = Gltf()
    t = 2 * math.pi * numpy.arange(240) / 240
    curve = numpy.stack([(2 + numpy.cos(3 * t)) * numpy.cos(2 * t), (2 + numpy.cos(3 * t)) * numpy.sin(2 * t),
                         1.15 * numpy.sin(3 * t)], axis=1)
    body = forms.moved(forms.closed_tube(0.26 * curve, 0.16, 24), turn_y=28)
    body["positions"] = body["positions"] + [-0.55, 0.002 - body["positions"][:, 1].min(), 0]
    put(scene, body, glass(scene, "flint", "SF6"), "knot")
    put(scene, forms.moved(gem(), (0.95, 0.002, 0.3), turn_y=12, scale=0.42), glass(scene, "diamond", "diamond"), "gem")
    put(scene, cove(8, 9, -3, 7, 2.5), surface(scene, "slate", (0.18, 0.18, 0.2), roughness=0.5), "cove")
    for k in range(5):
        panel(scene, f"strip {k}", (22, 22, 22), (-3 + 1.4 * k, 3.6, 1.6 - 0.5 * k), (0, 0.5, 0), 0.12, 1.6)
    panel(scene, "back", (2.5, 2.6, 2.8), (0.2, 3.0, -2.6), (0, 0.8, 0), 4.0, 0.8)
    eye(scene, (0.2, 1.5, 4.6), (0.1, 0.72, 0), 27)
    return scene


def gem():
    """A brilliant in few facets, culet down, of radius 1, standing on its point's side: table, crown, pavilion."""
    def ring(n, radius, height, turn=0.0):
        phi = 2 * math.pi * (numpy.arange(n) + turn) / n
        return numpy.stack([radius * numpy.cos(phi), numpy.full(n, height), -radius * numpy.sin(phi)], axis=1)

    points = numpy.concatenate([ring(8, 0.55, 1.22), ring(16, 1.0, 0.90), ring(16, 1.0, 0.86), [[0, 0, 0]]])
    faces = [[0, i, i + 1] for i in range(1, 7)]  # the table
    for i in range(8):
        j, a, b, c = (i + 1) % 8, 8 + 2 * i, 8 + 2 * i + 1, 8 + (2 * i + 2) % 16
        faces += [[i, a, b], [i, b, j], [j, b, c]]
    for i in range(16):
        a, b = 8 + i, 8 + (i + 1) % 16
        faces += [[a, a + 16, b + 16], [a, b + 16, b], [a + 16, 40, b + 16]]
    return {"positions": points[numpy.array(faces).ravel()], "indices": numpy.arange(3 * len(faces)).reshape(-1, 3)}


def owl(rings=120, segments=240):
    """A body in polar form about its middle: breast and head, plumage, eyes, beak, ears; flat below."""
    theta, phi = numpy.meshgrid(math.pi * (numpy.arange(rings + 1) / rings), 2 * math.pi * numpy.arange(segments) / segments, indexing="ij")
    d = numpy.stack([numpy.sin(theta) * numpy.sin(phi), numpy.cos(theta), numpy.sin(theta) * numpy.cos(phi)], axis=2)

    def reach(centre, radius):
        """How far a ball around the middle reaches in every direction."""
        along = d @ numpy.array(centre)
        return along + numpy.sqrt(along ** 2 + radius ** 2 - numpy.dot(centre, centre))

    def bump(direction, width, ring=0.0):
        direction = numpy.array(direction) / numpy.linalg.norm(direction)
        return numpy.exp(-((numpy.arccos(numpy.clip(d @ direction, -1, 1)) - ring) / width) ** 2)

    r = numpy.log(numpy.exp(14 * reach((0, -0.30, 0), 0.78)) + numpy.exp(14 * reach((0, 0.42, 0.08), 0.62))) / 14
    feathers = numpy.abs(numpy.sin(11 * theta)) * (0.5 + 0.5 * numpy.cos(15 * phi + math.pi * numpy.floor(11 * theta / math.pi)))
    r += 0.045 * feathers * numpy.clip((theta - 1.5) / 0.2, 0, 1) * numpy.clip((2.7 - theta) / 0.2, 0, 1)
    r += 0.20 * bump((0, 0.30, 1), 0.10) + 0.06 * bump((0, 0.62, 0.9), 0.12)
    for side in (-1, 1):
        r += 0.07 * bump((0.34 * side, 0.50, 0.9), 0.05, ring=0.24) + 0.06 * bump((0.34 * side, 0.50, 0.9), 0.11)
        r += 0.32 * bump((0.48 * side, 1.15, 0.15), 0.13)
    r = numpy.minimum(r, 0.98 / numpy.maximum(-d[..., 1], 1e-9))
    return forms.without_slivers(forms.grid((d * r[..., None])[:, ::-1], closed_v=True))


def bust():
    """An owl of heavy flint, 57,000 triangles, before a window."""
    scene = Gltf()
    body = owl()
    body["positions"] = body["positions"] + [0, 0.985, 0]
    put(scene, forms.moved(body, turn_y=-24), glass(scene, "flint", "SF11", tint=(0.95, 0.9, 0.75), distance=1.5), "owl")
    put(scene, cove(8, 9, -3, 7, 2.5), surface(scene, "slate", (0.22, 0.22, 0.25), roughness=0.5), "cove")
    for k in range(3):
        panel(scene, f"pane {k}", (30, 30, 30), (-3.2 + 0.8 * k, 3.2, -0.2 - 0.6 * k), (0, 0.9, 0), 0.5, 1.8)
    panel(scene, "lamp", (7, 6.7, 6), (2.6, 3.4, 2.2), (0, 0.9, 0), 1.6, 1.6)
    eye(scene, (0.3, 1.5, 5.4), (0, 0.95, 0), 28, aspect=1)
    return scene


def water_glass():
    """A tumbler of N-BK7 with water in it that reaches a little into the glass: the glass has priority."""
    scene = Gltf()
    outside = [(0, 0), (0.30, 0.0), (0.315, 0.015), (0.33, 0.45), (0.345, 0.9), (0.34, 0.915), (0.325, 0.9), (0.312, 0.45),
               (0.298, 0.10), (0.26, 0.075), (0, 0.07)]
    put(scene, forms.lathe(forms.smooth(outside, 3), 96), glass(scene, "glass", "N-BK7", priority=2), "tumbler", translation=[0, 0.002, 0])
    water = [(0, 0.0725), (0.15, 0.0735), (0.255, 0.076), (0.297, 0.11), (0.3135, 0.45), (0.318, 0.62), (0.315, 0.632), (0.15, 0.6301), (0, 0.63)]
    water = [(r + (0.004 if 0.1 < y < 0.62 else 0), y - (0.004 if y < 0.1 else 0)) for r, y in water]
    put(scene, forms.lathe(forms.smooth(water, 3), 96), glass(scene, "water", "water", tint=(0.9, 0.96, 0.98), priority=1), "water",
        translation=[0, 0.002, 0])
    put(scene, cove(6, 7, -2.5, 5, 2), surface(scene, "table", (0.6, 0.55, 0.5), roughness=0.6), "cove")
    panel(scene, "window", (14, 14.5, 15), (-2.6, 2.4, -0.6), (0, 0.3, 0), 1.0, 1.4)
    panel(scene, "lamp", (160, 150, 140), (1.6, 3.0, -1.9), (0, 0.3, 0), 0.22, 0.22)
    eye(scene, (0.25, 1.15, 2.6), (0, 0.42, 0), 25, aspect=4 / 3)
    return scene


def droplet():
    """Descartes' flask: a ball of water before a screen, lit by a sun of three degrees through a window in it. The bow is on the
    screen, 42 degrees around the window's middle."""
    scene = Gltf()
    put(scene, shapes.sphere(1.0, 72, 144), glass(scene, "water", "water"), "drop")
    paper = surface(scene, "screen", (0.9, 0.9, 0.9), lambert=True)
    for x0, y0, w, h in ((-6, -6, 5, 12), (1, -6, 5, 12), (-1, -6, 2, 5), (-1, 1, 2, 5)):
        put(scene, shapes.quad((x0, y0, 3), (0, h, 0), (w, 0, 0)), paper, "screen")
    panel(scene, "sun", (3000, 3000, 3000), (0, 0, 300), (0, 0, 0), 15.7, 15.7)
    eye(scene, (3.5, 0.5, -6), (-0.2, 0, 3), 52, aspect=4 / 3)
    return scene


def spheres():
    """Every material at six roughnesses."""
    scene = Gltf()
    ball = scene.primitive(**shapes.sphere(0.21, 32, 64))
    rows = [("lambert", lambda r: dict(colour=(0.6, 0.25, 0.15), lambert=True, roughness=r)),
            ("coated", lambda r: dict(colour=(0.15, 0.35, 0.6), roughness=r)),
            ("metal", lambda r: dict(colour=(1.0, 0.77, 0.34), metallic=1.0, roughness=r))]
    for row in range(5):
        for column in range(6):
            r = column / 5
            if row < 3:
                name, members = rows[row]
                material = surface(scene, f"{name} {column}", **members(r))
            elif row == 3:
                material = scene.material(f"wall {column}", pbrMetallicRoughness={"metallicFactor": 0, "roughnessFactor": r},
                                          extensions={"KHR_materials_transmission": {"transmissionFactor": 1}})
            else:
                material = glass(scene, f"flint {column}", "SF10", roughness=r)
            scene.node(mesh=scene.mesh(dict(ball, material=material)), translation=[0.5 * (column - 2.5), 0.25 + 0.46 * (4 - row), -0.2])
    put(scene, cove(9, 9, -1.6, 6, 1.5), surface(scene, "backdrop", (0.4, 0.4, 0.42), roughness=0.6), "cove")
    panel(scene, "softbox", (8, 8, 8), (-2.6, 3.6, 3.0), (0, 1.0, 0), 2.0, 2.0)
    panel(scene, "strip", (12, 12, 12), (3.0, 2.4, 1.4), (0, 1.0, -0.2), 0.3, 2.6)
    eye(scene, (0, 1.5, 7.2), (0, 1.15, -0.2), 22, aspect=4 / 3)
    return scene


SCENES = {"prism": prism, "prism_seen": prism_seen, "lines": lines, "cubo": cubo, "figure": figure, "bust": bust, "water_glass": water_glass, "droplet": droplet, "spheres": spheres}


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    for name, make in SCENES.items():
        make().write(folder / f"{name}.glb")


main()
