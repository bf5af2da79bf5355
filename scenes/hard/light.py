"""Scenes that are hard because of their light."""
import numpy

import shapes
from common import glass, lambert, lamp, metal, place, turned
from glb import Gltf, look_at


def radiance_hdr(path, rgb):
    """A Radiance .hdr, uncompressed: rgb is height x width x 3."""
    rgb = numpy.asarray(rgb, float)
    mantissa, exponent = numpy.frexp(rgb.max(axis=-1))
    scale = numpy.where(mantissa > 0, numpy.ldexp(256.0, -exponent), 0.0)
    bytes_ = numpy.concatenate([numpy.floor(rgb * scale[..., None]), numpy.where(mantissa > 0, exponent + 128, 0)[..., None]],
                               axis=-1).astype(numpy.uint8)
    with open(path, "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % rgb.shape[:2] + bytes_.tobytes())


def dielectrics():
    """Stacks of slabs before a wall of radiance 1, seen at right angles. Glass (1.5) and water (1.333):
    glass alone; water within glass; water on glass, sharing the face; the same with 0.05 of air between; the same
    overlapping by 0.05; air (an empty body) within glass."""
    s = Gltf()
    g, w, air = glass(s, 1.5), glass(s, 1.333), glass(s, 1.0)

    def slab(column, material, near, far, half=1.0):
        place(s, shapes.box((3 * column - half, -half, -far), (3 * column + half, half, -near)), material)

    slab(0, g, 0, 3)
    slab(1, g, 0, 3), slab(1, w, 1, 2, 0.9)
    slab(2, g, 0, 1), slab(2, w, 1, 3)
    slab(3, g, 0, 1), slab(3, w, 1.05, 3)
    slab(4, g, 0, 1.05), slab(4, w, 1, 3)
    slab(5, g, 0, 3), slab(5, air, 1, 2, 0.9)
    place(s, shapes.quad((-2, -2, -4), (19, 0, 0), (0, 4, 0)), lamp(s, 1.0))
    s.node(camera=s.orthographic(9, 1.5), matrix=look_at((7.5, 0, 5), (7.5, 0, 0)))
    s.node(camera=s.perspective(0.35), matrix=look_at((11, 5, 20), (7.5, -0.3, -1)))
    return s


def glass_stack():
    """32 panes before a wall of radiance 1: solid ones on the left, thin walls on the right."""
    s = Gltf()
    solid, thin = glass(s, 1.5), glass(s, 1.5, solid=False)
    panes = shapes.join(*[shapes.box((-1, -1, -i - 0.4), (1, 1, -i)) for i in range(32)])
    walls = shapes.join(*[shapes.quad((-1, -1, -i), (2, 0, 0), (0, 2, 0)) for i in range(32)])
    place(s, panes, solid, translation=(-1.5, 0, 0))
    place(s, walls, thin, translation=(1.5, 0, 0))
    place(s, shapes.quad((-4, -2, -34), (8, 0, 0), (0, 4, 0)), lamp(s, 1.0))
    s.node(camera=s.orthographic(3, 1.5), matrix=look_at((0, 0, 5), (0, 0, 0)))
    return s


def sun_in_a_texel(path):
    """A post on a white floor under a sky of 1024 x 512 texels: one of 1e7, black rows, dim elsewhere."""
    s = Gltf()
    place(s, shapes.quad((-4, 0, 4), (8, 0, 0), (0, 0, -8)), lambert(s, 0.5))
    place(s, shapes.box((-0.2, 0, -0.2), (0.2, 1, 0.2)), lambert(s, 0.0))
    s.node(camera=s.orthographic(2, 2), matrix=look_at((0, 5, 0), (0, 0, 0), (0, 0, -1)))
    s.node(camera=s.perspective(0.6), matrix=look_at((2, 2.5, 4), (0, 0.3, 0)))
    s.write(path + ".glb")
    sky = numpy.full((512, 1024, 3), 0.25)
    sky[::7] = 0
    sky[256:] = 0
    sky[140, 900] = 1e7
    radiance_hdr(path + ".hdr", sky)


def mirrors():
    """Two white mirrors, alpha 1e-4 and 1.1e-3, that show a camera a light each, of 1 mm and of 1 cm."""
    s = Gltf()
    light = lamp(s, 100.0)
    for x, alpha, size, seen in ((-0.5, 1e-4, 1e-3, 0.005), (0.5, 1.1e-3, 1e-2, 0.1)):
        place(s, shapes.quad((x - 0.5, 0, 0.5), (1, 0, 0), (0, 0, -1)), metal(s, float(numpy.sqrt(alpha))))
        place(s, shapes.quad((-size / 2, -size / 2, 0), (size, 0, 0), (0, size, 0)), light,
              matrix=look_at((x, 1, -1), (x, 2, -2), (0, 1, 0)))
        s.node(camera=s.orthographic(seen, seen), matrix=look_at((x, 2, 2), (x, 0, 0)))
    s.node(camera=s.orthographic(1, 0.35), matrix=look_at((0, 2, 2), (0, 0, 0)))
    return s


def ten_thousand_lights():
    """A floor below 5000 points of light and 5000 lit triangles, whose power spans eight decades."""
    s = Gltf()
    random = numpy.random.default_rng(3)
    place(s, shapes.quad((-5, 0, 5), (10, 0, 0), (0, 0, -10)), lambert(s, 0.5))
    for i in range(5000):
        where = random.uniform((-5, 1, -5), (5, 3, 5))
        s.node(light=s.light("point", intensity=float(10 ** random.uniform(-8, 0) * 0.02)), translation=where)
    decades = [lamp(s, 10.0 ** k) for k in range(-4, 4)]
    for material in decades:
        centre = random.uniform((-5, 1, -5), (5, 3, 5), (625, 1, 3))
        corners = centre + random.normal(size=(625, 3, 3)) * 0.002
        place(s, {"positions": corners.reshape(-1, 3), "indices": numpy.arange(1875)}, material)
    s.node(camera=s.orthographic(4, 4), matrix=look_at((0, 0.9, 0), (0, 0, 0), (0, 0, -1)))
    s.node(camera=s.perspective(0.7), matrix=look_at((0, 6, 11), (0, 0.7, 0)))
    return s


def white_boxes():
    """A closed room of albedo 0.99 that glows with radiance 1 everywhere, boxes in it included: 100 is seen everywhere."""
    s = Gltf()
    glowing = lamp(s, 1.0, albedo=0.99)
    place(s, shapes.box((-1, -1, -1), (1, 1, 1)), glowing, matrix=turned((1, 2, 3), 20))
    room = shapes.box((-3, -2, -4), (3, 2, 4), inside=True)
    place(s, room, glowing)
    place(s, shapes.box((-0.3, -0.3, -0.3), (0.3, 0.3, 0.3)), glowing, matrix=turned((2, 1, 3), 50, (1.6, 0.5, 1.5)))
    s.node(camera=s.perspective(0.9), matrix=look_at((0, 0, 3.5), (0, 0, 0)))
    return s


def _single(make):
    return lambda path: make().write(path + ".glb")


SCENES = {f.__name__: _single(f) for f in (dielectrics, glass_stack, mirrors, ten_thousand_lights, white_boxes)} | {
    "sun_in_a_texel": sun_in_a_texel}
