"""The scenes of one thing on a table."""
import math

import numpy

import forms
import shapes
from common import camera, cove, glass, lamp, panel, put, surface
from glb import Gltf


def knot():
    scene = Gltf()
    t = 2 * math.pi * numpy.arange(220) / 220
    curve = numpy.stack([(2 + numpy.cos(3 * t)) * numpy.cos(2 * t), (2 + numpy.cos(3 * t)) * numpy.sin(2 * t),
                         1.15 * numpy.sin(3 * t)], axis=1)
    body = forms.closed_tube(0.30 * curve, 0.205, 16)
    body = forms.moved(body, turn_y=24)
    body["positions"] = body["positions"] + [0, -body["positions"][:, 1].min(), 0]
    put(scene, body, surface(scene, "terracotta", (0.62, 0.25, 0.13), lambert=True), "knot")
    put(scene, cove(8, 9, -3, 7, 2.5), surface(scene, "paper", (0.76, 0.72, 0.66), lambert=True), "cove")
    camera(scene, (0.2, 1.55, 5.4), (0, 0.98, 0), 27)
    return scene


def metals():
    scene = Gltf()
    kinds = {"gold": (1.0, 0.77, 0.34), "copper": (0.96, 0.64, 0.54), "steel": (0.66, 0.67, 0.69)}
    ball = scene.primitive(**shapes.sphere(0.2, 24, 48))
    for row, (kind, colour) in enumerate(kinds.items()):
        for column in range(6):
            material = surface(scene, f"{kind} {column}", colour, roughness=column / 5 * 0.75, metallic=1.0)
            mesh = scene.mesh(dict(ball, material=material), name=f"{kind} ball {column}")
            scene.node(mesh=mesh, translation=[0.52 * (column - 2.5), 0.2 + 0.30 * row, 0.55 - 0.52 * row])
    stone = surface(scene, "slate", (0.09, 0.095, 0.11), roughness=0.35)
    for row in range(1, 3):
        put(scene, forms.moved(forms.rounded_box((2.6, 0.3 * row, 0.26 if row < 2 else 0.9), 0.02, 3),
                               (0, 0, 0.55 - 0.52 * row if row < 2 else -0.49 - 0.64)), stone, f"step {row}")
    put(scene, cove(9, 9, -4, 6, 1.5), surface(scene, "backdrop", (0.30, 0.31, 0.33), roughness=0.5), "cove")
    panel(scene, "softbox", (8.5, 8.2, 7.8), (-2.4, 3.4, 2.2), (0, 0.3, 0), 2.4, 2.4)
    panel(scene, "strip", (9.0, 10.0, 11.5), (2.9, 2.0, 0.6), (0, 0.4, -0.2), 0.35, 2.6)
    panel(scene, "back light", (5.0, 4.4, 3.6), (0.4, 3.4, -2.6), (0, 0.4, -0.3), 3.2, 0.4)
    camera(scene, (0.0, 1.75, 4.6), (0, 0.52, -0.05), 23.5)
    return scene


def glasses():
    scene = Gltf()
    lift = 0.001  # bodies stand a millimetre above the table: glass needs air under it
    profile = [(0, 0), (0.10, 0.0), (0.165, 0.003), (0.176, 0.012), (0.10, 0.030), (0.028, 0.070), (0.020, 0.16), (0.020, 0.27),
               (0.035, 0.33), (0.13, 0.42), (0.180, 0.55), (0.170, 0.70), (0.145, 0.80), (0.142, 0.803), (0.139, 0.80),
               (0.163, 0.70), (0.172, 0.55), (0.121, 0.43), (0.03, 0.362), (0, 0.358)]
    put(scene, forms.lathe(forms.smooth(profile, 2), 44), glass(scene, "clear glass", (0.93, 0.98, 0.97), 0.4), "goblet",
        translation=[-0.42, lift, -0.05])
    put(scene, shapes.sphere(0.24, 22, 44), glass(scene, "frosted glass", (0.80, 0.92, 1.0), 0.5, roughness=0.38), "frosted ball",
        translation=[0.10, 0.24 + lift, -0.30])
    put(scene, forms.rounded_box((0.17, 0.17, 0.17), 0.03, 5), glass(scene, "amber", (0.98, 0.50, 0.08), 0.22), "amber cube",
        translation=[0.52, 0.17 + lift, 0.10], rotation=[0, math.sin(math.radians(16)), 0, math.cos(math.radians(16))])
    put(scene, shapes.sphere(0.085, 18, 36), glass(scene, "green glass", (0.20, 0.85, 0.45), 0.12), "green marble",
        translation=[0.12, 0.085 + lift, 0.30])
    put(scene, cove(6, 6, -1.8, 5, 1.2), surface(scene, "table", (0.72, 0.66, 0.57), lambert=True), "table")
    panel(scene, "window", (34, 32, 29), (-1.9, 2.3, -0.9), (0, 0.1, 0), 0.7, 0.7)
    panel(scene, "sky panel", (1.1, 1.25, 1.5), (2.6, 2.4, 2.2), (0, 0.2, 0), 2.4, 2.4)
    camera(scene, (0.1, 0.92, 2.55), (0.03, 0.32, 0), 26)
    return scene


def plates():
    """After Veach and Guibas 1995, figure 2: strips of growing width of equal power over plates of growing roughness."""
    scene = Gltf()
    eye, strips = numpy.array([0.0, 1.9, 7.2]), numpy.array([0.0, 2.55, -1.6])
    for i, roughness in enumerate((0.12, 0.24, 0.40, 0.58)):
        z, y = -0.15 + 0.86 * i, 1.12 - 0.25 * i
        centre = numpy.array([0, y, z])
        # Tilted so that its middle mirrors the strips towards the eye.
        half = (eye - centre) / numpy.linalg.norm(eye - centre) + (strips - centre) / numpy.linalg.norm(strips - centre)
        tilt = math.atan2(half[2], half[1])
        put(scene, forms.rounded_box((1.75, 0.02, 0.36), 0.018, 3), surface(scene, f"plate {i}", (0.55, 0.56, 0.58), roughness, 1.0),
            f"plate {i}", translation=centre, rotation=[math.sin(tilt / 2), 0, 0, math.cos(tilt / 2)])
    colours = ((1.0, 0.38, 0.20), (1.0, 0.80, 0.32), (0.40, 0.95, 0.55), (0.32, 0.55, 1.0))
    for i, (colour, radius) in enumerate(zip(colours, (0.012, 0.035, 0.09, 0.2))):
        x = -1.5 + i
        strip = forms.lathe([(0, -0.42), (0.4 * radius, -0.42), (radius, -0.415), (radius, -0.3), (radius, 0.0), (radius, 0.3),
                             (radius, 0.415), (0.4 * radius, 0.42), (0, 0.42)], 24)
        put(scene, strip, lamp(scene, f"strip {i}", [0.9 / radius * c for c in colour]), f"strip {i}",
            translation=strips + [x, 0, 0], rotation=[0, 0, math.sqrt(0.5), math.sqrt(0.5)])
    put(scene, cove(9, 9, -3.2, 7, 1.2), surface(scene, "wall", (0.42, 0.42, 0.43), lambert=True), "cove")
    panel(scene, "ceiling light", (2.2, 2.2, 2.2), (0, 6.5, 3.5), (0, 0, 0), 2.0, 2.0)
    camera(scene, eye, (0, 1.22, 0), 28)
    return scene
