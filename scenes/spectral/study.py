#!/usr/bin/env python3
"""Measures what wavelengths cost and draws the plots of docs/spectral.md: ./study.py TRIAD [FOLDER]. Needs python3-numpy and python3-openimageio.

Every scheme renders every scene with 4, 16, 64 ... samples per pixel and once with many, which is its reference. Errors are
relMSE (mean square of a pixel's channels over that of the reference + .01; the worst pixel of a thousand is
left out), of luminance and of what differs from grey. Time is processor time per sample: other programs do not count."""
import json
import math
import pathlib
import resource
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent))

from glb import png  # noqa: E402

SCENES = [("cornell", "cornell/cornell.gltf", []), ("spheres", "spectral/spheres.glb", []),
          ("figure", "spectral/figure.glb", []), ("prism", "spectral/prism_seen.glb", ["--fov", "9"])]
SCHEMES = ["off", "auto", "full", "classic"]
COLOURS = {"off": "#7f7f7f", "auto": "#0072b2", "full": "#009e73", "classic": "#d55e00"}  # Okabe and Ito
SAMPLES, REFERENCE, SEEDS = [4, 16, 64, 256], 4096, 3
LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])


def render(triad, folder, scene, options, spp, seed, size="48x36"):
    """The picture, and the processor time that it took."""
    out = folder / "picture.exr"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([triad, "render", str(HERE.parent / scene), "--size", size, "--spp", str(spp), "--seed", str(seed), "-q",
                    "-o", str(out), *options], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    picture = OpenImageIO.ImageBuf(str(out)).get_pixels(OpenImageIO.FLOAT).astype(float)
    return picture, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def errors(picture, reference):
    """relMSE of all, of luminance, and of colour: what is left of each channel when its luminance is taken away."""
    scale = numpy.mean(reference ** 2, axis=2) + 0.01
    d = picture - reference
    grey = (d @ LUMINANCE)[..., None]
    squares = numpy.stack([numpy.mean(e ** 2, axis=2) / scale for e in (d, grey + 0 * d, d - grey)], axis=-1).reshape(-1, 3)
    kept = numpy.argsort(squares[:, 0])[:math.ceil(0.999 * len(squares))]
    return [float(x) for x in squares[kept].mean(axis=0)]


def tiles(picture, size=6):
    """Means of squares of pixels."""
    height, width = picture.shape[0] // size, picture.shape[1] // size
    return picture[:height * size, :width * size].reshape(height, size, width, size, 3).mean(axis=(1, 3))


def measure(triad):
    """[scene][scheme]: errors by samples and seconds per sample; of classic, how far its reference is from that of auto by tiles, and
    (control) how far another of auto is."""
    results = {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for scene, path, options in SCENES:
            references, results[scene] = {}, {}
            for scheme in SCHEMES:
                use = [*options, "--spectral", scheme, "--integrator", "path"]
                references[scheme], slow = render(triad, folder, path, use, REFERENCE, 1000)
                rows, quick = [], 0.0
                for spp in SAMPLES:
                    found = [render(triad, folder, path, use, spp, seed) for seed in range(1, SEEDS + 1)]
                    rows.append([spp, *numpy.mean([errors(p, references[scheme]) for p, _ in found], axis=0)])
                    quick = numpy.median([t for _, t in found])
                entry = {"errors": rows, "seconds": (slow - quick) / (REFERENCE - SAMPLES[-1])}
                if scheme == "classic":
                    again, _ = render(triad, folder, path, [*options, "--spectral", "auto", "--integrator", "path"], REFERENCE, 2000)
                    entry["bias"] = errors(tiles(references["classic"]), tiles(references["auto"]))[0]
                    entry["control"] = errors(tiles(again), tiles(references["auto"]))[0]
                results[scene][scheme] = entry
                print(scene, scheme, json.dumps(entry), flush=True)
    return results


class Svg:
    def __init__(self, width, height):
        self.items = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
                      'font-family="sans-serif" font-size="12" fill="#222">',
                      f'<rect width="{width}" height="{height}" fill="#fff"/>']

    def text(self, x, y, words, anchor="middle", size=12, colour="#222", turn=None):
        turned = f' transform="rotate({turn} {x:.1f} {y:.1f})"' if turn else ""
        self.items.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" fill="{colour}"{turned}>{words}</text>')

    def line(self, points, colour, width=1.0, dash=None):
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        places = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.items.append(f'<polyline points="{places}" fill="none" stroke="{colour}" stroke-width="{width}"{dashed}/>')

    def dot(self, x, y, colour):
        self.items.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>')

    def bar(self, x, y, width, height, colour):
        self.items.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" fill="{colour}"/>')

    def key(self, x, y, names):
        for name in names:
            self.bar(x, y - 9, 10, 10, COLOURS[name])
            self.text(x + 14, y, name, "start")
            x += 78

    def write(self, path):
        path.write_text("\n".join([*self.items, "</svg>"]) + "\n")


class LogAxis:
    """Places of values from low to high, powers of ten, between two coordinates."""
    def __init__(self, low, high, a, b):
        self.low, self.high, self.a, self.b = math.log10(low), math.log10(high), a, b

    def at(self, value):
        share = (math.log10(max(value, 1e-30)) - self.low) / (self.high - self.low)
        return self.a + min(max(share, 0), 1) * (self.b - self.a)


def samples_to_reach(rows, column, error):
    """Samples at which the error falls to `error`, by straight lines through the logarithms; beyond the last row by its slope."""
    x, y = numpy.log([r[0] for r in rows]), numpy.log([r[column] for r in rows])
    i = next((k for k in range(1, len(y)) if y[k] <= math.log(error)), len(y) - 1)
    return math.exp(x[i] + (math.log(error) - y[i]) * (x[i] - x[i - 1]) / (y[i] - y[i - 1]))


def draw_cost(results, path):
    """Time to the error that off has after its second-last number of samples, over off's."""
    scenes = [s for s, _, _ in SCENES if s != "prism"]
    svg, top, bottom = Svg(640, 300), 40, 250
    axis = LogAxis(0.5, 20, bottom, top)
    for value in (0.5, 1, 2, 5, 10, 20):
        svg.line([(50, axis.at(value)), (620, axis.at(value))], "#222" if value == 1 else "#ddd")
        svg.text(44, axis.at(value) + 4, f"{value:g}", "end")
    for s, scene in enumerate(scenes):
        off = results[scene]["off"]
        goal = off["errors"][-2][1]
        for k, scheme in enumerate(SCHEMES):
            entry = results[scene][scheme]
            samples = samples_to_reach(entry["errors"], 1, goal) / off["errors"][-2][0]
            cost = samples * entry["seconds"] / off["seconds"]
            x = 70 + 190 * s + 42 * k
            svg.bar(x, min(axis.at(cost), axis.at(1)), 34, abs(axis.at(cost) - axis.at(1)) + 1, COLOURS[scheme])
            svg.text(x + 17, min(axis.at(cost), axis.at(1)) - 5, f"{cost:.2g}")
        svg.text(70 + 190 * s + 80, bottom + 22, scene)
    svg.text(50, 22, "processor time to the error of RGB (off = 1)", "start", 13)
    svg.key(310, 288, SCHEMES)
    svg.write(path)


def draw_colour_noise(results, path):
    """Error of colour over samples, per scene; grey: that of off."""
    svg = Svg(760, 300)
    y, x = LogAxis(1e-5, 100, 250, 40), None
    for s, (scene, _, _) in enumerate(SCENES):
        left = 56 + 178 * s
        x = LogAxis(SAMPLES[0], SAMPLES[-1], left + 8, left + 150)
        for decade in range(-5, 3):
            at = y.at(10.0 ** decade)
            svg.line([(left, at), (left + 158, at)], "#ddd")
            if s == 0:
                svg.text(left - 5, at + 4, f"{10.0 ** decade:g}", "end", 11)
        for spp in SAMPLES:
            svg.text(x.at(spp), 266, spp, size=11)
        for scheme in SCHEMES:
            rows = results[scene][scheme]["errors"]
            if scheme == "off" and scene == "prism":
                continue
            points = [(x.at(r[0]), y.at(r[3])) for r in rows]
            svg.line(points, COLOURS[scheme], 1.8, "5 3" if scheme == "off" else None)
            for p in points:
                svg.dot(*p, COLOURS[scheme])
        svg.text(left + 79, 34, scene)
    svg.text(56, 16, "error of colour (relMSE without that of luminance) over samples per pixel", "start", 13)
    svg.key(430, 292, SCHEMES)
    svg.write(path)


def draw_classic(results, path):
    """Per scene: noise at the last number of samples, and how far the converged picture of classic is from auto's."""
    svg, top, bottom = Svg(760, 300), 46, 250
    axis = LogAxis(1e-6, 10, bottom, top)
    for decade in range(-6, 2):
        at = axis.at(10.0 ** decade)
        svg.line([(56, at), (740, at)], "#ddd")
        svg.text(50, at + 4, f"{10.0 ** decade:g}", "end")
    bars = [("noise of auto", "auto", lambda e: e["errors"][-1][1], "#0072b2"), ("noise of classic", "classic", lambda e: e["errors"][-1][1], "#d55e00"),
            ("bias of classic", "classic", lambda e: e["bias"], "#cc79a7"), ("auto against auto", "classic", lambda e: e["control"], "#bbbbbb")]
    for s, (scene, _, _) in enumerate(SCENES):
        for k, (_, scheme, value, colour) in enumerate(bars):
            v, left = value(results[scene][scheme]), 70 + 172 * s + 39 * k
            svg.bar(left, axis.at(v), 30, bottom - axis.at(v), colour)
            svg.text(left + 15, axis.at(v) - 5, f"{v:.1g}", size=11)
        svg.text(70 + 172 * s + 74, bottom + 20, scene)
    svg.text(56, 22, f"relMSE of pixels at {SAMPLES[-1]} samples (noise), and of means of 36 pixels at {REFERENCE} (bias, and its control)", "start", 13)
    for k, (words, _, _, colour) in enumerate(bars):
        svg.bar(150 + 150 * k, 281, 10, 10, colour)
        svg.text(164 + 150 * k, 290, words, "start")
    svg.write(path)


def cubo(w):
    return 1.4 + 50 / (w - 230)


def cubo_sellmeier(w):
    l2 = (w * 1e-3) ** 2
    return math.sqrt(1 + sum(b * l2 / (l2 - c) for b, c in
                             ((0.940608, 0.061544), (0.220931, 0.061271), (-30.611816, -262.595686))))


def draw_cubo(path):
    """Deviation by a prism of 60 degrees at its minimum for the d line, by both formulas, and their difference."""
    incidence = math.asin(cubo(587.5618) / 2)

    def deviation(n):
        return math.degrees(incidence + math.asin(n * math.sin(math.radians(60) - math.asin(math.sin(incidence) / n)))) - 60

    svg = Svg(680, 300)
    waves = [400 + 4 * i for i in range(96)]
    x = lambda w: 56 + (w - 380) / 400 * 560  # noqa: E731
    y = lambda d: 250 - (d - 36) / 24 * 210  # noqa: E731
    z = lambda d: 145 - d / 0.3 * 105  # noqa: E731
    for degrees in range(36, 61, 6):
        svg.line([(56, y(degrees)), (616, y(degrees))], "#ddd")
        svg.text(50, y(degrees) + 4, degrees, "end")
    for d in (-0.3, -0.15, 0, 0.15, 0.3):
        svg.text(620, z(d) + 4, f"{d:g}", "start", 11, COLOURS["classic"])
    for w in range(400, 781, 60):
        svg.text(x(w), 268, w)
    svg.line([(x(w), y(deviation(cubo(w)))) for w in waves], COLOURS["auto"], 2)
    svg.line([(x(w), y(deviation(cubo_sellmeier(w)))) for w in waves], "#000", 1, "5 4")
    svg.line([(x(w), z(deviation(cubo_sellmeier(w)) - deviation(cubo(w)))) for w in waves], COLOURS["classic"], 1.5)
    svg.text(56, 22, "deviation in degrees over the wavelength in nm: cubo (blue), cubo-sellmeier (dashed)", "start", 13)
    svg.text(616, 290, "difference (red, right scale)", "end", 12, COLOURS["classic"])
    svg.write(path)


def draw_cubo_pictures(triad, folder, path):
    """The box with a prism of either, and eight times the difference around grey. Of seven seeds the median of each pixel: what
    paths seldom find is left out, in both alike."""
    with tempfile.TemporaryDirectory() as name:
        pictures = [numpy.median([render(triad, pathlib.Path(name), "spectral/cubo.glb",
                                         ["--integrator", "photons", "--glass", f"prism={glass}"], 48, seed, "240x180")[0]
                                  for seed in range(1, 8)], axis=0) for glass in ("cubo", "cubo-sellmeier")]
    apart = numpy.abs(pictures[1] - pictures[0]) @ LUMINANCE / (pictures[0] @ LUMINANCE)
    pictures.append(0.214 + 8 * (pictures[1] - pictures[0]))
    strip = numpy.clip(numpy.concatenate(pictures, axis=1), 0, 1)
    encoded = numpy.where(strip <= 0.0031308, 12.92 * strip, 1.055 * numpy.maximum(strip, 1e-9) ** (1 / 2.4) - 0.055)
    path.write_bytes(png(numpy.rint(255 * encoded).astype(numpy.uint8)))
    print("cubo against cubo-sellmeier: median and 99th percentile of the difference of pixels over their luminance:",
          numpy.percentile(apart, [50, 99]), flush=True)


def main():
    triad = sys.argv[1]
    folder = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else HERE.parents[1] / "docs/images/spectral"
    folder.mkdir(parents=True, exist_ok=True)
    draw_cubo(folder / "cubo_formulas.svg")
    draw_cubo_pictures(triad, folder, folder / "cubo_formulas.png")
    results = measure(triad)
    draw_cost(results, folder / "cost.svg")
    draw_colour_noise(results, folder / "colour_noise.svg")
    draw_classic(results, folder / "classic.svg")


main()
