"""Forms of the suite's scenes, as scenes/shapes.py gives them: dictionaries for Gltf.primitive(**form)."""
import math

import numpy

import shapes


def grid(positions, normals=None, closed_u=False, closed_v=False):
    """Triangles between rows (u) and columns (v) of an array of points rows x columns x 3. The front is where
    d/dv x d/du points. Closed: the last row or column is joined to the first."""
    rows, columns = positions.shape[:2]
    a = numpy.arange(rows - (not closed_u))[:, None]
    b = numpy.arange(columns - (not closed_v))[None]
    below, right = (a + 1) % rows, (b + 1) % columns
    corners = [(a * columns + b).ravel(), (a * columns + right).ravel(), (below * columns + right).ravel(),
               (below * columns + b).ravel()]
    form = {"positions": positions.reshape(-1, 3),
            "indices": numpy.concatenate([numpy.stack([corners[0], corners[1], corners[2]], axis=1),
                                          numpy.stack([corners[0], corners[2], corners[3]], axis=1)])}
    if normals is not None:
        form["normals"] = normals.reshape(-1, 3)
    return form


def _unit(vectors):
    return vectors / numpy.linalg.norm(vectors, axis=-1, keepdims=True)


def lathe(profile, segments=48):
    """The surface of revolution about y of a smooth profile: n points (radius, height), from below to above on the outside. One
    that begins and ends on the axis makes a closed body."""
    profile = numpy.asarray(profile, float)
    tangent = numpy.gradient(profile, axis=0)
    outward = _unit(numpy.stack([tangent[:, 1], -tangent[:, 0]], axis=1))
    phi = 2 * math.pi * numpy.arange(segments) / segments

    def turned(points):
        return numpy.stack([points[:, :1] * numpy.cos(phi), numpy.broadcast_to(points[:, 1:], (len(points), segments)),
                            -points[:, :1] * numpy.sin(phi)], axis=-1)

    return without_slivers(grid(turned(profile), turned(outward), closed_v=True))


def smooth(points, steps):
    """A Catmull-Rom curve through the points, with so many steps between two of them; radii stay above 0."""
    points = numpy.asarray(points, float)
    padded = numpy.concatenate([2 * points[:1] - points[1:2], points, 2 * points[-1:] - points[-2:-1]])
    t = (numpy.arange(steps) / steps)[:, None]
    parts = []
    for a, b, c, d in zip(padded, padded[1:], padded[2:], padded[3:]):
        parts.append(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3))
    return numpy.maximum(numpy.concatenate(parts + [points[-1:]]), [0, -math.inf])


def closed_tube(curve, radius, around=16):
    """A tube around a closed curve (n x 3, the last point is not the first), without twist at its seam."""
    tangent = _unit(numpy.roll(curve, -1, axis=0) - numpy.roll(curve, 1, axis=0))
    frame = numpy.cross(tangent[0], numpy.eye(3)[numpy.argmin(numpy.abs(tangent[0]))])
    frames = []
    for t in tangent:  # carried along: what is across the curve stays so
        frame = frame - t * (frame @ t)
        frame /= numpy.linalg.norm(frame)
        frames.append(frame)
    x = numpy.array(frames)
    y = numpy.cross(tangent, x)
    end = frames[-1] - tangent[0] * (frames[-1] @ tangent[0])
    twist = math.atan2(end @ y[0], end @ x[0])
    phi = (2 * math.pi * numpy.arange(around) / around)[None] - (twist * numpy.arange(len(curve)) / len(curve))[:, None]
    normals = numpy.cos(phi)[..., None] * x[:, None] + numpy.sin(phi)[..., None] * y[:, None]
    return grid(curve[:, None] + radius * normals, normals, closed_u=True, closed_v=True)


def rounded_box(half, radius, steps=4):
    """A closed box of these half sizes about the origin, edges and corners rounded: a sphere whose octants are moved apart."""
    half = numpy.asarray(half, float)
    quarter = numpy.linspace(0, math.pi / 2, steps + 1)
    theta = numpy.concatenate([math.pi - quarter, math.pi / 2 - quarter])  # the middle twice: a band of the box's height
    phi = numpy.concatenate([k * math.pi / 2 + quarter for k in range(4)])
    upper, quadrant = numpy.repeat([-1, 1], steps + 1), numpy.repeat(numpy.arange(4), steps + 1)
    normals = numpy.stack([numpy.sin(theta)[:, None] * numpy.cos(phi), numpy.broadcast_to(
        numpy.cos(theta)[:, None], (len(theta), len(phi))), -numpy.sin(theta)[:, None] * numpy.sin(phi)], axis=-1)
    sign = numpy.empty_like(normals)
    sign[..., 0] = numpy.array([1, -1, -1, 1])[quadrant]
    sign[..., 1] = upper[:, None]
    sign[..., 2] = numpy.array([-1, -1, 1, 1])[quadrant]
    form = grid(radius * normals + sign * (half - radius), normals, closed_v=True)
    columns = len(phi)
    bottom = numpy.array([0, steps + 1, 2 * (steps + 1), 3 * (steps + 1)])
    lid = (len(theta) - 1) * columns + bottom
    caps = [[lid[0], lid[1], lid[2]], [lid[0], lid[2], lid[3]], [bottom[0], bottom[2], bottom[1]],
            [bottom[0], bottom[3], bottom[2]]]
    form["indices"] = numpy.concatenate([form["indices"], caps])
    return without_slivers(form)


def without_slivers(form):
    """The same form without triangles that have no area."""
    a, b, c = (form["positions"][form["indices"][:, k]] for k in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    return dict(form, indices=form["indices"][area > 1e-12])


def prism(outline, bottom, top, hole=None):
    """Upright walls and a lid over a convex outline (n x 2: x, z, counter-clockwise seen from above), flat-shaded. hole: an
    outline of as many points inside; the prism is then a ring with inner walls."""
    outline = numpy.asarray(outline, float)
    n = len(outline)

    def at(ring, y):
        return numpy.stack([ring[:, 0], numpy.full(n, y), ring[:, 1]], axis=1)

    here, there = numpy.arange(n), (numpy.arange(n) + 1) % n

    def strip(a, b):
        return {"positions": numpy.concatenate([a, b]),
                "indices": numpy.concatenate([numpy.stack([here, there, n + there], axis=1),
                                              numpy.stack([here, n + there, n + here], axis=1)])}

    walls = strip(at(outline, bottom), at(outline, top))
    if hole is None:
        lid = {"positions": at(outline, top),
               "indices": numpy.stack([numpy.zeros(n - 2, int), here[1:-1], here[2:]], axis=1)}
        return shapes.join(walls, lid)
    hole = numpy.asarray(hole, float)
    return shapes.join(walls, strip(at(outline, top), at(hole, top)), strip(at(hole, top), at(hole, bottom)),
                       strip(at(hole, bottom), at(outline, bottom)))


def circle(radius, n=48):
    """Counter-clockwise seen from above (from +y): x, z."""
    phi = 2 * math.pi * numpy.arange(n) / n
    return numpy.stack([radius * numpy.cos(phi), -radius * numpy.sin(phi)], axis=1)


def icosahedron(radius=1.0):
    g = (1 + math.sqrt(5)) / 2
    points = numpy.array([[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g],
                          [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]])
    faces = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6],
             [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7],
             [9, 8, 1]]
    return {"positions": radius * points / math.sqrt(1 + g * g), "indices": numpy.array(faces)}


def moved(form, offset=(0, 0, 0), turn_y=0.0, scale=1.0):
    """Scaled, turned about y by degrees, then moved."""
    c, s = math.cos(math.radians(turn_y)), math.sin(math.radians(turn_y))
    turn = numpy.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    out = dict(form, positions=scale * form["positions"] @ turn.T + numpy.asarray(offset, float))
    if "normals" in form:
        out["normals"] = form["normals"] @ turn.T
    return out
