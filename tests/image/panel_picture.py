#!/usr/bin/env python3
"""Makes docs/images/triad-on-a-panel.jpg: a crop of the built-in scene on magnified RGB stripes, by whole pixels and by triad, and
below each what an eye sees of it from afar (a Gaussian of 0.42 pixels in linear light, the optics of an eye at 45 pixels per degree).

    python3 tests/image/panel_picture.py build/bin/triad OUT.jpg      # needs oiiotool and numpy; a minute
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ZOOM, CROP, SIGMA = 12, "384,262,56,42", 0.42
GAP = 12


def decoded(v):
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def encoded(v):
    v = np.clip(v, 0, 1)
    return np.where(v <= 0.0031308, v * 12.92, 1.055 * v ** (1 / 2.4) - 0.055)


def blurred(a, sigma):
    reach = int(4 * sigma)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    kernel /= kernel.sum()
    for axis in (0, 1):
        a = np.apply_along_axis(lambda x: np.convolve(np.pad(x, reach, mode="edge"), kernel, "valid"), axis, a)
    return a


def read(path):
    """sRGB values in [0, 1]."""
    ppm = path.with_suffix(".ppm")
    subprocess.run(["oiiotool", path, "--ch", "R,G,B", "-d", "uint8", "-o", ppm], check=True)
    _, size, _, _ = ppm.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    return np.frombuffer(ppm.read_bytes()[-3 * width * height:], np.uint8).reshape(height, width, 3) / 255


def main(triad, out):
    def run(*words):
        subprocess.run([triad, *map(str, words)], check=True, stdout=subprocess.DEVNULL)

    with tempfile.TemporaryDirectory() as folder:
        at = pathlib.Path(folder)
        run("render", "-q", "--size", "640x360", "--spp", 144, "--bins", "3x3", "--film", at / "a.triadfilm")
        run("resolve", "-q", at / "a.triadfilm", "--reconstruct", "ssaa:3", "-o", at / "pixels.png")
        run("resolve", "-q", at / "a.triadfilm", "--panel", "rgb", "-o", at / "triad.png")
        shown = []
        for name in ("pixels", "triad"):
            run("panel", "rgb", "-q", "--picture", at / f"{name}.png", "--crop", CROP, "--zoom", ZOOM, "-o", at / f"{name}-on.png")
            shown.append(decoded(read(at / f"{name}-on.png")))
        seen = [blurred(s, SIGMA * ZOOM) for s in shown]
        # A third of a panel's area shines in each colour: what is seen is made as bright as it would be there.
        white = np.percentile(seen[0], 99.9)
        gap = np.ones((shown[0].shape[0], GAP, 3))
        rows = [np.hstack([encoded(1.6 * shown[0]), gap, encoded(1.6 * shown[1])]),
                np.hstack([encoded(seen[0] / white), gap, encoded(seen[1] / white)])]
        sheet = np.vstack([rows[0], np.ones((GAP, rows[0].shape[1], 3)), rows[1]])
        ppm = at / "sheet.ppm"
        ppm.write_bytes(b"P6\n%d %d\n255\n" % (sheet.shape[1], sheet.shape[0]) + (255 * sheet + 0.5).astype(np.uint8).tobytes())
        subprocess.run(["oiiotool", ppm, "--compression", "jpeg:92", "-o", out], check=True)


main(*sys.argv[1:])
