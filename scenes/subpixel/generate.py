"""Writes page.glb: print on paper for `triad bench subpixel`. Run it with python3 and numpy.

Strokes stand for type: letters of straight strokes in three sizes, a fan of hairlines, a grid, bars of colour. All lies in
one plane before a lamp, so that nothing but edges is hard."""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here.parent), str(here.parent / "suite")]
import shapes  # noqa: E402
from common import camera, lamp, put, surface  # noqa: E402
from glb import Gltf  # noqa: E402

# Strokes from corner to corner of a cell that is 4 wide and 6 high; y upwards.
LETTERS = {
    "T": [(0, 6, 4, 6), (2, 0, 2, 6)], "R": [(0, 0, 0, 6), (0, 6, 3, 6), (3, 6, 4, 5), (4, 5, 3, 3), (3, 3, 0, 3), (1.5, 3, 4, 0)],
    "I": [(2, 0, 2, 6), (1, 0, 3, 0), (1, 6, 3, 6)], "A": [(0, 0, 2, 6), (2, 6, 4, 0), (0.8, 2.2, 3.2, 2.2)],
    "D": [(0, 0, 0, 6), (0, 6, 2.5, 6), (2.5, 6, 4, 4), (4, 4, 4, 2), (4, 2, 2.5, 0), (2.5, 0, 0, 0)],
    "E": [(0, 0, 0, 6), (0, 6, 4, 6), (0, 3, 3, 3), (0, 0, 4, 0)], "K": [(0, 0, 0, 6), (4, 6, 0, 3), (1, 3.6, 4, 0)],
    "M": [(0, 0, 0, 6), (0, 6, 2, 2), (2, 2, 4, 6), (4, 6, 4, 0)], "S": [(4, 5, 3, 6), (3, 6, 1, 6), (1, 6, 0, 5), (0, 5, 4, 1),
          (4, 1, 3, 0), (3, 0, 1, 0), (1, 0, 0, 1)], "O": [(1, 0, 3, 0), (3, 0, 4, 2), (4, 2, 4, 4), (4, 4, 3, 6), (3, 6, 1, 6),
          (1, 6, 0, 4), (0, 4, 0, 2), (0, 2, 1, 0)], "X": [(0, 0, 4, 6), (0, 6, 4, 0)], "N": [(0, 0, 0, 6), (0, 6, 4, 0), (4, 0, 4, 6)],
}


def stroke(x0, y0, x1, y1, width, z):
    """A rectangle along a line, its ends half a width beyond."""
    along = numpy.array([x1 - x0, y1 - y0])
    along = along / numpy.linalg.norm(along) * width / 2
    across = numpy.array([-along[1], along[0]])
    corner = numpy.array([x0, y0]) - along - across
    side = numpy.array([x1 - x0, y1 - y0]) + 2 * along
    return shapes.quad([*corner, z], [*side, 0], [*(2 * across), 0])


def text(words, x, y, height, weight, z=0.002):
    forms, cell = [], height / 6
    for letter in words:
        if letter != " ":
            forms += [stroke(x + a * cell, y + b * cell, x + c * cell, y + d * cell, weight * height, z)
                      for a, b, c, d in LETTERS[letter]]
        x += 5.6 * cell
    return shapes.join(*forms)


def page():
    """The picture is 96 units wide and 64 high: pixels, at that size."""
    scene = Gltf()
    paper = surface(scene, "paper", (0.86, 0.85, 0.82), lambert=True)
    ink = surface(scene, "ink", (0.02, 0.02, 0.025), lambert=True)
    put(scene, shapes.quad([-60, -44, 0], [120, 0, 0], [0, 88, 0]), paper, "paper")
    put(scene, shapes.join(text("TRIAD", -45, 16, 13, 0.11), text("TRAMS NO", -45, 4, 8, 0.12),
                           text("DARKEST STRIKES", -45, -5, 6, 0.13)), ink, "letters")
    fan = [stroke(20, -30, 20 + 22 * math.cos(a), -30 + 22 * math.sin(a), 0.7, 0.002)
           for a in numpy.linspace(0.1, math.pi / 2 + 0.6, 13)]
    grid = [stroke(-45 + 2.3 * i, -30, -45 + 2.3 * i, -10, 0.6, 0.002) for i in range(12)]
    grid += [stroke(-45, -30 + 2.3 * i, -19, -30 + 2.3 * i, 0.6, 0.002) for i in range(9)]
    put(scene, shapes.join(*fan, *grid), ink, "lines")
    for i, (name, colour) in enumerate([("red", (0.7, 0.03, 0.03)), ("green", (0.03, 0.45, 0.05)), ("blue", (0.04, 0.06, 0.6)),
                                        ("magenta", (0.6, 0.03, 0.45))]):
        bar = stroke(28 + 4.7 * i, 8, 31.5 + 4.7 * i, 27, 1.9, 0.002)
        put(scene, bar, surface(scene, name, colour, lambert=True), name)
    put(scene, shapes.quad([-50, 90, 150], [100, 0, 0], [0, -60, 60]), lamp(scene, "lamp", (14, 14, 14)), "lamp")
    camera(scene, [0.4, 0.3, 160], [0.4, 0.3, 0], 2 * math.degrees(math.atan(32 / 160)), 1.5)
    return scene


if __name__ == "__main__":
    page().write(str(here / "page.glb"))
