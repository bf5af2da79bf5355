"""Scenes that are hard because of their geometry."""
import numpy

import shapes
from common import lambert, lamp, place, rotation, sun, turned
from glb import Gltf, look_at


def slivers():
    """A double cone of 2 x 500,000 triangles, each 1.3e-5 wide and 1.4 long, around a black ball."""
    s = Gltf()
    n = 500_000
    phi = 2 * numpy.pi * numpy.arange(n) / n
    positions = numpy.concatenate([[[0, 1, 0], [0, -1, 0]],
                                   numpy.stack([numpy.cos(phi), numpy.zeros(n), -numpy.sin(phi)], axis=1)])
    here = 2 + numpy.arange(n)
    there = 2 + (numpy.arange(n) + 1) % n
    top, bottom = numpy.zeros(n, int), numpy.ones(n, int)
    place(s, {"positions": positions, "indices": numpy.concatenate(
        [numpy.stack([top, here, there], axis=1), numpy.stack([bottom, there, here], axis=1)])}, lambert(s, 1.0))
    place(s, shapes.sphere(0.4, 16, 32), lambert(s, 0.0))
    sun(s, (-1, -1.5, -1), numpy.pi)
    s.node(camera=s.perspective(0.6), matrix=look_at((1.5, 2, 3.5), (0, 0, 0)))
    return s


def coplanar():
    """Nine grey squares in one plane, turned, each doubled in another way, or not at all; before a black wall. The first
    row: alone; twice in a mesh, once with other first corners; front and back. The second: cut along the other diagonal;
    with a larger square in its plane; in 4 x 4 cells and one. The third, placements of shared meshes: twice in one
    place; turned by quarters, as 4 placements; two meshes that are equal, one mirrored."""
    s = Gltf()
    grey = lambert(s, 0.5)
    unit = shapes.quad((-0.5, -0.5, 0), (1, 0, 0), (0, 1, 0))

    def mesh(*parts):
        return s.mesh(*[s.primitive(p["positions"], p["indices"], material=grey) for p in parts])

    def flipped_diagonal(shape):
        return dict(shape, indices=numpy.array([[1, 2, 3], [1, 3, 0]]))

    cells = numpy.stack(numpy.meshgrid(numpy.linspace(-0.5, 0.5, 5), numpy.linspace(-0.5, 0.5, 5)), axis=-1)
    a = (numpy.arange(4)[:, None] * 5 + numpy.arange(4)).ravel()
    grid = {"positions": numpy.concatenate([cells.reshape(-1, 2), numpy.zeros((25, 1))], axis=1),
            "indices": numpy.concatenate([numpy.stack([a, a + 1, a + 6], axis=1), numpy.stack([a, a + 6, a + 5], axis=1)])}
    shared = mesh(unit)
    turn = turned((3, 1, 2), 40, (10, 20, -5))
    quarter = [turned((0, 0, 1), 90 * k) for k in range(4)]
    mirror = numpy.diag([-1.0, 1, 1, 1])
    ways = [
        [(mesh(unit), None)],
        [(mesh(unit, dict(unit, indices=numpy.array([[1, 2, 0], [3, 0, 2]]))), None)],
        [(mesh(unit, shapes.flipped(unit)), None)],
        [(mesh(unit, flipped_diagonal(unit)), None)],
        [(mesh(unit, dict(unit, positions=1.1 * unit["positions"])), None)],
        [(mesh(grid, unit), None)],
        [(shared, None), (shared, None)],
        [(shared, m) for m in quarter],
        [(mesh(unit), None), (mesh(unit), mirror)],
    ]
    for i, way in enumerate(ways):
        to = turn @ turned((0, 0, 1), 0, (1.25 * (i % 3 - 1), 1.25 * (1 - i // 3), 0))
        for used, own in way:
            s.node(mesh=used, matrix=to if own is None else to @ own)
    place(s, shapes.quad((-4, -4, -2), (8, 0, 0), (0, 8, 0)), lambert(s, 0.0), matrix=turn)
    sun(s, (-1, -2, -3), numpy.pi, turn)
    s.node(camera=s.orthographic(2, 2), matrix=turn @ look_at((0, 0, 5), (0, 0, 0)))
    return s


def twins():
    """Red squares and exactly coincident green ones that come later: in the mesh, as placements, with the winding
    turned. Only red is seen, from the front and from behind."""
    s = Gltf()
    red, green = lambert(s, (0.8, 0, 0)), lambert(s, (0, 0.8, 0))
    unit = shapes.quad((-0.5, -0.5, 0), (1, 0, 0), (0, 1, 0))
    turn = turned((3, 1, 2), 40, (10, 20, -5))

    def at(x):
        return turn @ turned((0, 1, 0), 0, (x, 0, 0))

    s.node(mesh=s.mesh(s.primitive(**unit, material=red), s.primitive(**unit, material=green)), matrix=at(-1.25))
    first, second = s.mesh(s.primitive(**unit, material=red)), s.mesh(s.primitive(**unit, material=green))
    s.node(mesh=first, matrix=at(0))
    s.node(mesh=second, matrix=at(0))
    s.node(mesh=s.mesh(s.primitive(**unit, material=red), s.primitive(**shapes.flipped(unit), material=green)),
           matrix=at(1.25))
    sun(s, (-1, -2, -3), numpy.pi, turn)
    sun(s, (-1, -2, 3), numpy.pi, turn)
    s.node(camera=s.orthographic(2, 1), matrix=turn @ look_at((0, 0, 5), (0, 0, 0)))
    s.node(camera=s.orthographic(2, 1), matrix=turn @ look_at((0, 0, -5), (0, 0, 0)))
    return s


def closed_rooms():
    """Rooms under a sun of 1e6 lux, with a camera in each: a box, a tetrahedron, a wedge of 1 degree, a ball of 12 x 6
    faces with smooth normals, and a box with walls of 1000 triangles each, all turned."""
    s = Gltf()
    tetrahedron = {"positions": numpy.array([[1, 1, 1], [-1, -1, 1], [-1, 1, -1], [1, -1, -1]]) * 0.8,
                   "indices": numpy.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])}
    t = numpy.tan(numpy.radians(0.5))
    wedge = {"positions": numpy.array([[-1, 0, z] for z in (-1, 1)] + [[1, y * 2 * t, z] for y in (-1, 1) for z in (-1, 1)]),
             "indices": numpy.array([[0, 2, 3], [0, 3, 1], [0, 1, 5], [0, 5, 4], [2, 4, 5], [2, 5, 3], [0, 4, 2], [1, 3, 5]])}
    fine = 22
    side = shapes.height_field(numpy.ones((fine + 1, fine + 1)))
    walls = [dict(side, positions=side["positions"] @ rotation(axis, angle).T)
             for axis, angle in (((1, 0, 0), 0), ((1, 0, 0), 90), ((1, 0, 0), 180), ((1, 0, 0), 270),
                                 ((0, 0, 1), 90), ((0, 0, 1), 270))]
    fine_box = shapes.join(*walls)
    fine_box["positions"] = numpy.round(fine_box["positions"] * 44) / 44  # edges of two walls meet to the bit
    rooms = [(shapes.box((-1, -1, -1), (1, 1, 1)), (0, 0, 0)), (tetrahedron, (0, 0, 0)), (wedge, (0.9, 0, 0)),
             (shapes.sphere(1, 6, 12), (0, 0, 0)), (fine_box, (0, 0, 0))]
    white = lambert(s, 0.9)
    place(s, shapes.quad((-3, -3, 3), (18, 0, 0), (0, 0, -6)), white)
    for i, (room, eye) in enumerate(rooms):
        turn = turned((1, i + 1, 2), 50, (3 * i, 0, 0))
        place(s, room, white, matrix=turn)
        s.node(camera=s.perspective(1.8, znear=1e-4), matrix=turn @ look_at(eye, numpy.add(eye, (-1, 0, 0.2))))
    sun(s, (-0.3, -1, -0.5), 1e6)
    s.node(camera=s.perspective(0.6), matrix=look_at((6, 7, 16), (6, -0.5, 0)))
    return s


def terminator():
    """Balls of 12 x 6 and 48 x 24 faces with smooth normals and a flat one, lit from above, a little
    from behind."""
    s = Gltf()
    white = lambert(s, 0.8)
    place(s, shapes.sphere(1, 6, 12), white, translation=(-2.2, 0, 0))
    place(s, shapes.sphere(1, 24, 48), white)
    flat = shapes.sphere(1, 6, 12)
    del flat["normals"]
    place(s, flat, white, translation=(2.2, 0, 0))
    sun(s, (-0.5, -1, 0.1), numpy.pi)
    s.node(camera=s.orthographic(3.4, 1.2), matrix=look_at((0, 0, 5), (0, 0, 0)))
    return s


def hundred_million():
    """1024 placements of one rock of 100,352 triangles: 102.8 million, turned and scaled at random."""
    s = Gltf()
    random = numpy.random.default_rng(7)
    ball = shapes.sphere(1, 225, 224)  # 224 * 2 * 224 triangles
    p = ball["positions"]
    bumps = sum(a * numpy.sin(p @ random.normal(size=3) * f + random.uniform(0, 6)) for f, a in
                ((2, 0.15), (3, 0.1), (5, 0.06), (9, 0.04), (17, 0.02), (33, 0.01), (70, 0.005)))
    rock = s.mesh(s.primitive(p * (1 + bumps[:, None]) * (1, 0.6, 1), ball["indices"], material=lambert(s, (0.6, 0.5, 0.4))))
    for i in range(32):
        for k in range(32):
            turn = turned(random.normal(size=3), random.uniform(0, 360), (1.6 * (i - 15.5), 0, 1.6 * (k - 15.5)))
            turn[:3, :3] *= random.uniform(0.4, 0.9)
            s.node(mesh=rock, matrix=turn)
    place(s, shapes.quad((-40, -0.4, 40), (80, 0, 0), (0, 0, -80)), lambert(s, (0.3, 0.4, 0.2)))
    sun(s, (-1, -1, -0.4), numpy.pi)
    s.node(camera=s.perspective(0.6), matrix=look_at((0, 9, 34), (0, -1, 0)))
    return s


def horizon():
    """A plane of 2,000 km that is a plane of no coordinates, a post of 1 m and its shadow of 100 m, seen from 1 m."""
    s = Gltf()
    turn = turned((1, 2, 3), 25)
    place(s, shapes.quad((-1e6, 0, 1e6), (2e6, 0, 0), (0, 0, -2e6)), lambert(s, 0.5), matrix=turn)
    place(s, shapes.box((-0.5, 0, -30.1), (0.5, 1, -29.9)), lambert(s, 0.0), matrix=turn)
    sun(s, (0.6, -0.01, 0.8), 100 * numpy.pi, turn)
    s.node(camera=s.perspective(0.3), matrix=turn @ look_at((0, 1, 0), (0, 0.98, -1)))
    return s


def _single(make):
    return lambda path: make().write(path + ".glb")


SCENES = {f.__name__: _single(f) for f in (slivers, coplanar, twins, closed_rooms, terminator, hundred_million, horizon)}
