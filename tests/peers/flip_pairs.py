#!/usr/bin/env python3
"""FLIP of Triad beside that of its authors' package on ten pairs of pictures: ./flip_pairs.py TRIAD. Exit 1 above a
difference of 1e-3. Needs numpy, OpenImageIO and flip-evaluator (pip)."""
import json
import pathlib
import subprocess
import sys
import tempfile

import flip_evaluator
import numpy
import OpenImageIO

IMAGES = pathlib.Path(__file__).resolve().parents[2] / "docs/images"
LIMIT = 1e-3


def read(path):
    return numpy.ascontiguousarray(OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.FLOAT)[..., :3])


def write(path, pixels):
    image = OpenImageIO.ImageBuf(OpenImageIO.ImageSpec(pixels.shape[1], pixels.shape[0], 3, OpenImageIO.UINT8))
    image.set_pixels(OpenImageIO.ROI.All, numpy.ascontiguousarray(numpy.clip(pixels, 0, 1), numpy.float32))
    image.write(str(path))


def middle(name, size=160):
    picture = read(IMAGES / name)
    y, x = ((n - min(n, size)) // 2 for n in picture.shape[:2])
    return picture[y:y + size, x:x + size]


def blurred(a):
    p = numpy.pad(a, ((1, 1), (1, 1), (0, 0)), mode="edge")
    return sum(p[i:i + a.shape[0], j:j + a.shape[1]] for i in range(3) for j in range(3)) / 9


def pairs():
    """(name, reference, picture)."""
    random = numpy.random.default_rng(7)
    a = middle("spectral/cubo.png")
    yield "noise", a, a + random.normal(0, .05, a.shape)
    a = middle("spectral/figure.png")
    yield "blur", a, blurred(a)
    a = middle("spectral/spheres.png")
    yield "moved by a pixel", a, numpy.roll(a, 1, 1)
    a = middle("spectral/bust.png")
    yield "red for blue", a, a[..., ::-1]
    a = middle("spectral/prism.png")
    yield "white dots", a, numpy.where(random.random(a.shape[:2])[..., None] < .01, 1, a)
    a = middle("spectral/water_glass.png", 101)
    yield "darker", a, a ** 1.2
    a = middle("subpixel-type.png", 133)
    yield "without colour", a, a.mean(2, keepdims=True) + 0 * a
    yield "two renderers", middle("spectral/cubo_beside.png", 200), middle("spectral/cubo_luxcore.png", 200)
    yield "chance", random.random((61, 97, 3)), random.random((61, 97, 3))
    yield "black and white", numpy.zeros((17, 13, 3)), numpy.ones((17, 13, 3))


def main():
    worst = 0
    with tempfile.TemporaryDirectory() as name:
        a, b = (pathlib.Path(name) / f for f in ("a.png", "b.png"))
        for what, reference, picture in pairs():
            write(a, reference)
            write(b, picture)
            theirs = flip_evaluator.evaluate(read(a), read(b), "LDR", applyMagma=False)[1]
            out = subprocess.run([sys.argv[1], "compare", b, a, "--metric", "flip", "-q", "--json", "-"], check=True, stdout=subprocess.PIPE)
            ours = json.loads(out.stdout)["rows"][0]["flip"]
            worst = max(worst, abs(ours - theirs))
            print(f"{what:20} {theirs:.6f} {ours:.6f}")
    print(f"largest difference {worst:.1e}")
    return worst > LIMIT


sys.exit(main())
