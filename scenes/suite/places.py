"""The scenes of a place."""
import math

import numpy

import forms
import pictures
import shapes
from common import camera, lamp, plain, put, surface
from glb import Gltf, look_at


def lamps():
    """A small square in the evening: strings of bulbs, windows, lanterns, and wet ground to mirror them."""
    scene = Gltf()
    random = numpy.random.default_rng(7)
    bulb = scene.primitive(**forms.icosahedron(0.035))
    kinds = [scene.mesh(dict(bulb, material=lamp(scene, f"bulb {i}", radiance)), name=f"bulb {i}") for i, radiance in
             enumerate(((46, 24, 8), (50, 31, 13), (42, 17, 5), (30, 34, 30), (44, 9, 7)))]
    for string in range(8):
        a, b = numpy.array([-3.0, 3.3, 1.6 - 1.05 * string]), numpy.array([3.0, 3.5, 0.9 - 1.0 * string])
        for t in (numpy.arange(25) + 0.5) / 25:
            at = a + (b - a) * t - [0, 3.4 * 0.9 * t * (1 - t), 0]
            kind = kinds[random.choice(5, p=(0.35, 0.35, 0.2, 0.06, 0.04))]
            scene.node(mesh=kind, translation=numpy.round(at, 3))
    plaster = [surface(scene, f"plaster {i}", c, 0.9) for i, c in enumerate(((0.36, 0.27, 0.20), (0.22, 0.25, 0.30), (0.42, 0.36, 0.27)))]
    frame = surface(scene, "frame", (0.05, 0.04, 0.035), 0.5)
    lit = [lamp(scene, f"window {i}", r) for i, r in enumerate(((3.4, 2.1, 0.9), (1.4, 0.9, 0.45), (0.35, 0.55, 0.9)))]
    pane = scene.primitive(**plain(shapes.quad((0, -0.42, -0.27), (0, 0.84, 0), (0, 0, 0.54))))
    sill = scene.primitive(**plain(shapes.box((-0.05, -0.5, -0.33), (0.03, -0.42, 0.33))))
    bar = scene.primitive(**plain(shapes.box((-0.02, -0.42, -0.02), (0.03, 0.42, 0.02))))
    for side in (-1, 1):
        for house in range(3):
            near, far = 3.4 - 4.2 * house, 3.4 - 4.2 * (house + 1) + 0.25
            height = (5.0, 6.4, 5.6)[(house + (side > 0)) % 3]
            left, right = sorted((side * 3.2, side * 6))
            put(scene, plain(shapes.box((left, 0, far), (right, height, near))), plaster[(house + (side > 0)) % 3], "house")
            for floor in range(3):
                for window in range(3):
                    z = near - 0.75 - 1.25 * window
                    light = random.choice(4, p=(0.3, 0.2, 0.1, 0.4))
                    glow = lit[light] if light < 3 else frame
                    mesh = scene.mesh(dict(pane, material=glow), dict(sill, material=frame), dict(bar, material=frame))
                    turn = {} if side < 0 else {"rotation": [0, 1, 0, 0]}
                    scene.node(mesh=mesh, translation=[side * 3.17, 1.35 + 1.6 * floor, z], **turn)
    put(scene, plain(shapes.box((-3.4, 0, -11.2), (3.4, 5.2, -9.6))), plaster[1], "end of the square")
    clock = forms.moved(forms.prism(forms.circle(0.5, 40), 0, 0.05), (0, 0, 0))
    put(scene, clock, lamp(scene, "clock", (2.2, 2.1, 1.7)), "clock", translation=[0, 3.9, -9.6],
        rotation=[math.sqrt(0.5), 0, 0, math.sqrt(0.5)])
    put(scene, plain(shapes.quad((-3.4, 0, 6), (6.8, 0, 0), (0, 0, -17))), surface(scene, "wet paving", (0.10, 0.10, 0.105), 0.16), "ground")
    wood = surface(scene, "wood", (0.20, 0.11, 0.06), 0.6)
    cloth = [surface(scene, f"cloth {i}", c, 0.95) for i, c in enumerate(((0.55, 0.10, 0.08), (0.60, 0.55, 0.45)))]
    top, leg = scene.primitive(**forms.prism(forms.circle(0.42, 24), 0.72, 0.75)), scene.primitive(**plain(shapes.cylinder((0, 0, 0), (0, 0.72, 0), 0.03)))
    shade = scene.primitive(**forms.lathe([(1.05, 1.95), (0.7, 2.12), (0.35, 2.26), (0.01, 2.4)], 12))
    pole = scene.primitive(**plain(shapes.cylinder((0, 0.72, 0), (0, 2.4, 0), 0.02)))
    candle = scene.primitive(**forms.moved(forms.icosahedron(0.045), (0.12, 0.82, 0.1)))
    flame = lamp(scene, "candle", (40, 21, 7))
    for i, (x, z) in enumerate(((-2.1, 0.2), (-1.9, -2.6), (2.0, -0.9), (2.2, -3.6), (-2.2, -5.6), (1.9, -6.6))):
        parts = [dict(top, material=wood), dict(leg, material=frame), dict(candle, material=flame)]
        if i in (1, 2, 4):
            parts += [dict(shade, material=cloth[i % 2]), dict(pole, material=wood)]
        scene.node(mesh=scene.mesh(*parts, name="table"), translation=[x, 0, z])
    camera(scene, (0.35, 1.65, 4.9), (-0.1, 1.72, -2), 44)
    return scene


def garden():
    """A wall of bricks, paving, ivy and a pot: textures, normal maps and cut-out leaves in the sun."""
    scene = Gltf()
    random = numpy.random.default_rng(12)
    repeat = {"magFilter": 9729, "minFilter": 9729, "wrapS": 10497, "wrapT": 10497}

    def textured(name, maps, roughness, **members):
        colour, normal = maps
        return scene.material(name, pbrMetallicRoughness={"baseColorTexture": {"index": scene.texture(colour, **repeat)},
                                                          "metallicFactor": 0, "roughnessFactor": roughness},
                              normalTexture={"index": scene.texture(normal, **repeat)}, **members)

    def tiled(form, u, v):
        return dict(form, uvs=form["uvs"] * [u, v])

    put(scene, tiled(shapes.quad((-4, 0, 0), (8, 0, 0), (0, 4, 0)), 5, 2.5), textured("bricks", pictures.bricks(), 0.85), "wall")
    put(scene, tiled(shapes.quad((-4, 0, 5), (8, 0, 0), (0, 0, -5)), 4, 2.5), textured("paving", pictures.paving(), 0.7), "ground")
    stone = surface(scene, "sandstone", (0.52, 0.45, 0.34), 0.9)
    put(scene, plain(shapes.box((-4, 2.55, -0.1), (4, 2.72, 0.22))), stone, "coping")
    pot = [(0, 0), (0.20, 0), (0.215, 0.015), (0.27, 0.40), (0.275, 0.42), (0.325, 0.43), (0.335, 0.45), (0.335, 0.51), (0.325, 0.53),
           (0.29, 0.53), (0.28, 0.51), (0.27, 0.46), (0.12, 0.45), (0, 0.45)]
    put(scene, forms.lathe(forms.smooth(pot, 2), 40), surface(scene, "terracotta", (0.50, 0.20, 0.10), 0.8), "pot",
        translation=[0.75, 0, 0.9])

    leaf = scene.material("leaf", pbrMetallicRoughness={"baseColorTexture": {"index": scene.texture(pictures.leaf())},
                                                        "metallicFactor": 0, "roughnessFactor": 0.55},
                          alphaMode="MASK", alphaCutoff=0.5, doubleSided=True)

    def leaves(stems):
        """One folded quad per (foot, direction of the tip, up side, length)."""
        positions, uvs, indices = [], [], []
        for foot, tip, up, length in stems:
            tip = tip / numpy.linalg.norm(tip)
            side = numpy.cross(tip, up)
            side /= numpy.linalg.norm(side)
            over = numpy.cross(side, tip)
            start = 4 * len(positions)
            fold = 0.10 * length * over
            positions.append([foot - 0.42 * length * side + fold, foot + 0.42 * length * side + fold,
                              foot + length * tip + 0.42 * length * side - fold, foot + length * tip - 0.42 * length * side - fold])
            uvs += [[0, 1], [1, 1], [1, 0], [0, 0]]
            indices += [[start, start + 1, start + 2], [start, start + 2, start + 3]]
        return {"positions": numpy.concatenate(positions), "uvs": numpy.array(uvs, float), "indices": numpy.array(indices)}

    ivy = []
    for _ in range(400):  # hanging from the coping on the left, thinner downwards and to the right
        x, drop = -2.6 + 2.5 * random.random() ** 1.4, 2.0 * random.random() ** 1.3
        if drop > 1.9 * (0.55 + 0.45 * math.sin(3.1 * x + 1.0)) * (1 - 0.25 * (x + 2.6)):
            continue
        foot = numpy.array([x, 2.62 - drop, 0.05 + 0.09 * random.random() + (0.16 if drop < 0.15 else 0)])
        tip = numpy.array([0.7 * (random.random() - 0.5), -1.0, 0.25 + 0.5 * random.random()])
        ivy.append((foot, tip, numpy.array([0.5 * (random.random() - 0.5), 0.35, 1.0]), 0.13 + 0.09 * random.random()))
    bush = []
    centre = numpy.array([0.75, 0.95, 0.9])
    for _ in range(200):
        out = random.normal(size=3) * [1, 0.9, 1]
        out /= numpy.linalg.norm(out)
        if out[1] < -0.75:
            continue
        foot = centre + out * (0.16 + 0.24 * random.random()) * [1, 1.15, 1]
        bush.append((foot, out + [0, 0.25, 0], numpy.array([0, 1.0, 0]) + 0.5 * random.normal(size=3), 0.17 + 0.09 * random.random()))
    put(scene, leaves(ivy), leaf, "ivy")
    put(scene, leaves(bush), leaf, "bush")
    stem = surface(scene, "bark", (0.13, 0.08, 0.045), 0.9)
    put(scene, plain(shapes.cylinder((0.75, 0.44, 0.9), (0.75, 0.95, 0.9), 0.022, 10)), stem, "stem")
    can = surface(scene, "zinc", (0.62, 0.64, 0.66), 0.32, 1.0)
    body = [(0, 0), (0.17, 0), (0.18, 0.01), (0.165, 0.33), (0.160, 0.34), (0.150, 0.335), (0.145, 0.30), (0.14, 0.06), (0, 0.05)]
    put(scene, forms.lathe(forms.smooth(body, 2), 40), can, "pail", translation=[-0.30, 0, 0.75])
    scene.node(light=scene.light("directional", name="sun", color=[1.0, 0.90, 0.74], intensity=9.0),
               matrix=look_at((-2.2, 2.9, 2.6), (0, 0, 0)), name="sun")
    camera(scene, (-0.1, 1.5, 5.9), (-0.3, 1.12, 0), 31)
    return scene


def rotunda():
    """A ring of columns around a polished ball; the sun is one texel of the panorama."""
    scene = Gltf()
    marble = surface(scene, "marble", (0.70, 0.68, 0.63), 0.55)
    for step in range(3):
        put(scene, forms.prism(forms.circle(3.7 - 0.3 * step, 72), 0.16 * step, 0.16 * (step + 1)), marble, f"step {step}")
    profile = [(0.27, 0.0), (0.27, 0.07), (0.25, 0.10), (0.215, 0.13), (0.20, 0.2), (0.195, 0.9), (0.185, 1.8), (0.17, 2.5),
               (0.185, 2.56), (0.215, 2.62), (0.24, 2.68), (0.24, 2.76)]
    column = scene.mesh(scene.primitive(**forms.lathe(forms.smooth(profile, 2), 28), material=marble), name="column")
    block = scene.mesh(scene.primitive(**plain(shapes.box((-0.29, 0, -0.29), (0.29, 0.09, 0.29))), material=marble), name="block")
    for k in range(10):
        angle = 2 * math.pi * (k + 0.5) / 10 + math.pi / 2
        if k in (9, 0):
            angle += 0.10 if k == 0 else -0.10  # a wider gate towards the camera
        x, z = 2.55 * math.cos(angle), 2.55 * math.sin(angle)
        turn = {"rotation": [0, math.sin(-angle / 2), 0, math.cos(-angle / 2)]}
        scene.node(mesh=block, translation=[x, 0.48, z], **turn)
        scene.node(mesh=column, translation=[x, 0.57, z])
        scene.node(mesh=block, translation=[x, 3.33, z], **turn)
    put(scene, forms.prism(forms.circle(2.90, 72), 3.42, 3.80, hole=forms.circle(2.22, 72)), marble, "ring")
    put(scene, forms.prism(forms.circle(3.05, 72), 3.80, 3.92, hole=forms.circle(2.10, 72)), marble, "cornice")
    put(scene, forms.prism(forms.circle(0.5, 40), 0.48, 0.86), surface(scene, "porphyry", (0.23, 0.075, 0.065), 0.3), "pedestal")
    put(scene, shapes.sphere(0.52, 24, 48), surface(scene, "bronze", (0.93, 0.72, 0.42), 0.12, 1.0), "ball",
        translation=[0, 0.86 + 0.515, 0])
    put(scene, plain(shapes.quad((-2000, 0, 2000), (4000, 0, 0), (0, 0, -4000))), surface(scene, "sand", (0.50, 0.42, 0.30), lambert=True), "ground")
    camera(scene, (0.9, 2.05, 10.2), (0, 2.02, 0), 29)
    return scene


def corridor():
    """A long corridor with deep windows on one side: what lights the rest comes by many reflections."""
    scene = Gltf()
    plaster = surface(scene, "plaster", (0.74, 0.69, 0.60), lambert=True)
    bays, length, wide, high, deep = 5, 3.0, 2.4, 3.2, 0.55
    end = -bays * length
    low, top, open_from, open_to = 0.95, 2.45, 0.95, 2.05
    tiles = scene.texture(pictures.tiles(), magFilter=9729, wrapS=10497, wrapT=10497)
    floor = scene.material("tiles", pbrMetallicRoughness={"baseColorTexture": {"index": tiles}, "metallicFactor": 0, "roughnessFactor": 0.3})
    ground = shapes.quad((-wide / 2, 0, 1.0), (wide, 0, 0), (0, 0, end - 1.0))
    put(scene, dict(ground, uvs=ground["uvs"] * [2, 2 * (1.0 - end) / wide]), floor, "floor")
    walls = [shapes.box((-wide / 2 - 0.2, 0, end), (-wide / 2, high, 1.0)), shapes.box((-wide / 2 - 0.2, high, end), (wide / 2 + deep, high + 0.2, 1.0)),
             shapes.box((-wide / 2 - 0.2, 0, 1.0), (wide / 2 + deep, high, 1.2)), shapes.box((wide / 2, 0, end), (wide / 2 + deep, low, 1.0)),
             shapes.box((wide / 2, top, end), (wide / 2 + deep, high, 1.0)), shapes.box((wide / 2, low, -open_from), (wide / 2 + deep, top, 1.0))]
    for bay in range(bays):
        start = -bay * length
        stop = -length * (bay + 1) - open_from if bay + 1 < bays else end
        walls.append(shapes.box((wide / 2, low, stop), (wide / 2 + deep, top, start - open_to)))
    half = 0.55
    walls += [shapes.box((-wide / 2 - 0.2, 0, end - 0.3), (-half, high, end)), shapes.box((half, 0, end - 0.3), (wide / 2 + deep, high, end)),
              shapes.box((-half, 2.3, end - 0.3), (half, high, end))]
    for wall in walls:
        put(scene, plain(wall), plaster, "wall")
    oak = surface(scene, "oak", (0.24, 0.135, 0.07), 0.45)
    bars, panels = [], []
    for bay in range(bays):
        z = -bay * length
        mid, x = (open_from + open_to) / 2, wide / 2 + 0.42
        bars += [shapes.box((x, low, z - mid - 0.02), (x + 0.04, top, z - mid + 0.02)),
                 shapes.box((x, 1.9, z - open_to), (x + 0.04, 1.94, z - open_from)),
                 shapes.box((wide / 2 - 0.05, low - 0.05, z - open_to - 0.08), (wide / 2 + 0.1, low, z - open_from + 0.08))]
        if bay % 2 == 0:  # a door in the left wall
            panels += [shapes.box((-wide / 2 - 0.01, 0, z - 2.05), (-wide / 2 + 0.025, 2.12, z - 1.05)),
                       shapes.box((-wide / 2 - 0.01, 0, z - 2.15), (-wide / 2 + 0.05, 2.22, z - 2.05)),
                       shapes.box((-wide / 2 - 0.01, 0, z - 1.05), (-wide / 2 + 0.05, 2.22, z - 0.95)),
                       shapes.box((-wide / 2 - 0.01, 2.12, z - 2.05), (-wide / 2 + 0.05, 2.22, z - 1.05))]
    put(scene, plain(shapes.join(*bars, *panels)), oak, "joinery")
    skirting = [shapes.box((-wide / 2, 0, end), (-wide / 2 + 0.02, 0.14, 1.0)), shapes.box((wide / 2 - 0.02, 0, end), (wide / 2, 0.14, 1.0))]
    put(scene, plain(shapes.join(*skirting)), oak, "skirting")
    seat = [shapes.box((0.62, 0.40, -4.6), (1.02, 0.46, -3.4)), shapes.box((0.66, 0, -4.5), (0.72, 0.40, -4.44)), shapes.box((0.66, 0, -3.56), (0.72, 0.40, -3.5)),
            shapes.box((0.92, 0, -4.5), (0.98, 0.40, -4.44)), shapes.box((0.92, 0, -3.56), (0.98, 0.40, -3.5))]
    put(scene, plain(shapes.join(*seat)), oak, "bench")
    vase = [(0, 0), (0.07, 0), (0.085, 0.02), (0.14, 0.20), (0.12, 0.33), (0.055, 0.42), (0.06, 0.47), (0.052, 0.465), (0.045, 0.42), (0, 0.36)]
    put(scene, forms.lathe(forms.smooth(vase, 2), 32), surface(scene, "faience", (0.06, 0.16, 0.36), 0.12), "vase",
        translation=[0.82, 0.46, -3.75])
    put(scene, plain(shapes.quad((-40, -0.6, 40), (80, 0, 0), (0, 0, -80))), surface(scene, "yard", (0.42, 0.38, 0.31), lambert=True), "yard")
    camera(scene, (-0.35, 1.6, 0.7), (-0.1, 1.42, -6), 50)
    return scene
