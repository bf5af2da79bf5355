"""Procedural textures and skies of the suite's scenes."""
import math

import numpy

SUN = ((0.62, 0.52, 0.58), (6.8e4, 6.1e4, 5.0e4), 0.265)  # direction, radiance, angular radius in degrees


def srgb(linear):
    """uint8 of linear values."""
    linear = numpy.clip(linear, 0, 1)
    encoded = numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return numpy.rint(255 * encoded).astype(numpy.uint8)


def noise(shape, cells, seed):
    """Smooth periodic value noise in [0, 1]: rows x columns, with cells of it (rows, columns) in the picture."""
    values = numpy.random.default_rng(seed).random(cells)
    axes = []
    for n, m in zip(shape, cells):
        x = (numpy.arange(n) + 0.5) * m / n
        whole = numpy.floor(x).astype(int)
        f = x - whole
        axes.append((whole % m, (whole + 1) % m, f * f * (3 - 2 * f)))
    (r0, r1, v), (c0, c1, u) = axes
    v, u = v[:, None], u[None]
    return ((values[numpy.ix_(r0, c0)] * (1 - u) + values[numpy.ix_(r0, c1)] * u) * (1 - v)
            + (values[numpy.ix_(r1, c0)] * (1 - u) + values[numpy.ix_(r1, c1)] * u) * v)


def _coarse(texels):
    """In steps of 4, which halves the file and cannot be seen in anything with grain; 128 stays 128."""
    return (texels & 0xFC).astype(numpy.uint8)


def normals_of(height, scale):
    """The normal map (uint8) of a periodic height, in texels; y points up, as glTF has it."""
    dx = scale * (numpy.roll(height, -1, axis=1) - numpy.roll(height, 1, axis=1)) / 2
    dy = -scale * (numpy.roll(height, -1, axis=0) - numpy.roll(height, 1, axis=0)) / 2
    normal = numpy.stack([-dx, -dy, numpy.ones_like(height)], axis=-1)
    normal /= numpy.linalg.norm(normal, axis=-1, keepdims=True)
    return _coarse(numpy.rint(127.5 * (normal + 1)).astype(numpy.uint8))


def _slabs(side, rows, columns, gap, stagger, seed):
    """Slabs with joints: height in [0, 1] (0 in the joint) and a random number per slab."""
    y, x = (numpy.indices((side, side)) + 0.5) / side
    row = numpy.floor(y * rows).astype(int)
    x = x + stagger * (row % 2) / columns
    column = numpy.floor(x * columns).astype(int) % columns
    fx, fy = (x * columns) % 1 / columns, (y * rows) % 1 / rows
    edge = numpy.minimum(numpy.minimum(fx, 1 / columns - fx), numpy.minimum(fy, 1 / rows - fy))
    which = numpy.random.default_rng(seed).random((rows, columns))[row, column]
    return numpy.clip((edge - gap) / (1.5 * gap), 0, 1), which


def bricks(side=96):
    """Base colour and normal map of a wall of 4 x 8 bricks."""
    height, which = _slabs(side, 8, 4, 0.007, 0.5, 3)
    grain = noise((side, side), (40, 40), 4)
    brick = (0.55 + 0.5 * which)[..., None] * numpy.array([0.33, 0.125, 0.080]) * (0.75 + 0.5 * grain[..., None])
    mortar = numpy.array([0.34, 0.31, 0.27]) * (0.85 + 0.3 * grain[..., None])
    colour = mortar + (brick - mortar) * height[..., None]
    return _coarse(srgb(colour)), normals_of(height + 0.25 * grain * height, 3.0)


def paving(side=96):
    """Base colour and normal map of square stones, 6 x 6."""
    height, which = _slabs(side, 6, 6, 0.010, 0.5, 8)
    grain = noise((side, side), (32, 32), 9)
    stone = (0.20 + 0.16 * which)[..., None] * numpy.array([1.0, 0.97, 0.92]) * (0.8 + 0.4 * grain[..., None])
    joint = numpy.array([0.07, 0.08, 0.045]) * (0.7 + 0.6 * grain[..., None])
    colour = joint + (stone - joint) * height[..., None]
    return _coarse(srgb(colour)), normals_of(height + 0.35 * grain * height, 3.5)


def leaf(side=64):
    """Base colour with alpha: one pointed leaf, its stalk below."""
    y, x = (numpy.indices((side, side)) + 0.5) / side
    along = 1 - y  # 0 at the stalk, 1 at the tip
    across = numpy.abs(x - 0.5)
    width = 0.42 * numpy.sin(math.pi * numpy.clip(along, 0, 1) ** 0.75) ** 0.8
    inside = numpy.clip((width - across) * side / 2 + 0.5, 0, 1)
    stalk = numpy.clip((0.02 - across) * side / 2 + 0.5, 0, 1) * (along < 0.3)
    vein = numpy.clip(1 - across / 0.018, 0, 1)
    side_vein = numpy.clip(1 - numpy.abs(((along - 0.9 * across) * 9) % 1 - 0.5) / 0.12, 0, 1) * (across > 0.015)
    light = 0.55 * numpy.maximum(vein, 0.5 * side_vein)
    colour = numpy.array([0.075, 0.21, 0.030]) * (0.75 + 0.5 * noise((side, side), (8, 8), 21))[..., None]
    colour = colour + (numpy.array([0.30, 0.42, 0.12]) - colour) * light[..., None]
    alpha = numpy.rint(255 * numpy.maximum(inside, stalk)).astype(numpy.uint8)
    return numpy.concatenate([srgb(colour), alpha[..., None]], axis=-1)


def tiles(side=64):
    """Base colour of two by two floor tiles, pale and dark, with joints."""
    y, x = (numpy.indices((side, side)) + 0.5) / side
    dark = (numpy.floor(2 * x) + numpy.floor(2 * y)) % 2
    cloud = 0.85 + 0.3 * noise((side, side), (8, 8), 51)
    colour = numpy.where(dark[..., None] > 0, [0.16, 0.13, 0.11], [0.58, 0.53, 0.44]) * cloud[..., None]
    edge = numpy.minimum(numpy.minimum(2 * x % 1, 1 - 2 * x % 1), numpy.minimum(2 * y % 1, 1 - 2 * y % 1))
    return srgb(numpy.where(edge[..., None] < 0.02, 0.10, colour))


def sky(width=128, height=64, sun=None):
    """Radiance of a clear sky above pale ground. sun: (direction, radiance, angular radius in degrees), spread over the
    texels that it covers, so that the picture's irradiance is the sun's."""
    v, u = (numpy.indices((height, width)) + 0.5) / numpy.array([height, width])[:, None, None]
    theta, phi = math.pi * v, 2 * math.pi * (u - 0.5)
    direction = numpy.stack([numpy.sin(theta) * numpy.cos(phi), numpy.cos(theta), numpy.sin(theta) * numpy.sin(phi)], axis=-1)
    up = direction[..., 1]
    zenith, horizon, ground = (numpy.array(c) for c in ([0.17, 0.36, 0.80], [0.95, 0.98, 1.02], [0.62, 0.56, 0.47]))
    h = numpy.clip(up, 0, 1)[..., None] ** 0.45
    radiance = horizon + (zenith - horizon) * h
    warm = numpy.clip(direction @ numpy.array([0.8, 0.25, 0.55]) / 1.0, 0, 1)[..., None] ** 4
    radiance = radiance + warm * numpy.array([0.55, 0.42, 0.26])
    radiance = numpy.where(up[..., None] < 0, ground, radiance)
    if sun:
        towards, sun_radiance, radius = sun
        towards = numpy.asarray(towards, float) / numpy.linalg.norm(towards)
        nearest = numpy.unravel_index(numpy.argmax(direction @ towards), up.shape)
        texel = 2 * math.pi / width * (math.cos(math.pi * nearest[0] / height) - math.cos(math.pi * (nearest[0] + 1) / height))
        disc = 2 * math.pi * (1 - math.cos(math.radians(radius)))
        radiance[nearest] = numpy.asarray(sun_radiance) * disc / texel
    return radiance


def hdr(radiance):
    """The bytes of a Radiance .hdr file, not run-length coded."""
    height, width = radiance.shape[:2]
    brightest = radiance.max(axis=-1)
    mantissa, exponent = numpy.frexp(brightest)
    scale = numpy.where(brightest > 1e-32, mantissa * 256 / numpy.maximum(brightest, 1e-32), 0)
    rgbe = numpy.concatenate([numpy.clip(radiance * scale[..., None], 0, 255), (exponent + 128)[..., None]], axis=-1)
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + rgbe.astype(numpy.uint8).tobytes()
