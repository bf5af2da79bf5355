"""Shapes for scenes: each returns {"positions", "indices" [, "normals", "uvs"]} in doubles, for Gltf.primitive(**shape).
Triangles are counter-clockwise seen from the front."""
import math

import numpy


def quad(corner, u, v):
    """A parallelogram whose front is where u x v points."""
    corner, u, v = (numpy.asarray(x, float) for x in (corner, u, v))
    return {"positions": numpy.stack([corner, corner + u, corner + u + v, corner + v]),
            "indices": numpy.array([[0, 1, 2], [0, 2, 3]]),
            "uvs": numpy.array([[0.0, 1], [1, 1], [1, 0], [0, 0]])}


def box(lo=(-0.5, -0.5, -0.5), hi=(0.5, 0.5, 0.5), inside=False):
    """Six faces with corners of their own; inside: the fronts look inwards."""
    lo, hi = numpy.asarray(lo, float), numpy.asarray(hi, float)
    faces = []
    for axis in range(3):
        u, v = numpy.zeros(3), numpy.zeros(3)
        u[(axis + 1) % 3] = (hi - lo)[(axis + 1) % 3]
        v[(axis + 2) % 3] = (hi - lo)[(axis + 2) % 3]
        far = lo.copy()
        far[axis] = hi[axis]
        faces += [quad(lo, v, u), quad(far, u, v)]
    shape = join(*faces)
    return flipped(shape) if inside else shape


def sphere(radius=1.0, rings=32, segments=64, centre=(0, 0, 0)):
    """Latitudes and longitudes about y, closed: vertices are shared, also across the seam; with normals."""
    theta = numpy.pi * numpy.arange(1, rings) / rings
    phi = 2 * numpy.pi * numpy.arange(segments) / segments
    ring = numpy.stack([numpy.sin(theta)[:, None] * numpy.cos(phi), numpy.broadcast_to(
        numpy.cos(theta)[:, None], (rings - 1, segments)), -numpy.sin(theta)[:, None] * numpy.sin(phi)], axis=-1)
    normals = numpy.concatenate([[[0.0, 1, 0]], ring.reshape(-1, 3), [[0.0, -1, 0]]])
    here = numpy.arange(segments)
    there = (here + 1) % segments
    start = 1 + segments * numpy.arange(rings - 1)
    south = len(normals) - 1
    triangles = [numpy.stack([numpy.zeros_like(here), 1 + here, 1 + there], axis=1)]
    for a, b in zip(start, start[1:]):
        triangles += [numpy.stack([a + here, b + here, b + there], axis=1),
                      numpy.stack([a + here, b + there, a + there], axis=1)]
    triangles.append(numpy.stack([start[-1] + here, numpy.full_like(here, south), start[-1] + there], axis=1))
    return {"positions": numpy.asarray(centre, float) + radius * normals, "normals": normals,
            "indices": numpy.concatenate(triangles)}


def cylinder(a, b, radius, segments=8):
    """An open tube from a to b, with normals."""
    a, b = numpy.asarray(a, float), numpy.asarray(b, float)
    axis = (b - a) / numpy.linalg.norm(b - a)
    x = numpy.cross(axis, numpy.eye(3)[numpy.argmin(numpy.abs(axis))])
    x /= numpy.linalg.norm(x)
    y = numpy.cross(axis, x)
    phi = 2 * math.pi * numpy.arange(segments) / segments
    normals = numpy.cos(phi)[:, None] * x + numpy.sin(phi)[:, None] * y
    here = numpy.arange(segments)
    there = (here + 1) % segments
    return {"positions": numpy.concatenate([a + radius * normals, b + radius * normals]),
            "normals": numpy.concatenate([normals, normals]),
            "indices": numpy.concatenate([numpy.stack([here, there, there + segments], axis=1),
                                          numpy.stack([here, there + segments, here + segments], axis=1)])}


def height_field(height, lo=(-1.0, -1.0), hi=(1.0, 1.0)):
    """height: rows (z) x columns (x) of y; the front is above."""
    height = numpy.asarray(height, float)
    rows, columns = height.shape
    z, x = numpy.meshgrid(numpy.linspace(lo[1], hi[1], rows), numpy.linspace(lo[0], hi[0], columns), indexing="ij")
    a = (numpy.arange(rows - 1)[:, None] * columns + numpy.arange(columns - 1)).ravel()
    return {"positions": numpy.stack([x, height, z], axis=-1).reshape(-1, 3),
            "indices": numpy.concatenate([numpy.stack([a, a + columns, a + columns + 1], axis=1),
                                          numpy.stack([a, a + columns + 1, a + 1], axis=1)])}


def flipped(shape):
    """The same shape with its front turned inwards."""
    out = dict(shape, indices=shape["indices"][:, ::-1])
    if "normals" in shape:
        out["normals"] = -shape["normals"]
    return out


def join(*parts):
    """One shape of several that have the same attributes."""
    counts = numpy.cumsum([0] + [len(p["positions"]) for p in parts])
    out = {key: numpy.concatenate([p[key] for p in parts]) for key in parts[0] if key != "indices"}
    out["indices"] = numpy.concatenate([p["indices"] + start for p, start in zip(parts, counts)])
    return out
