"""How error_for_time.py runs each renderer: one process for one picture, and the user and system time that it takes.

An effort is what a picture is asked for, as options: ("--spp", "64") or ("--error", "0.001").
"""
import functools
import hashlib
import json
import math
import pathlib
import subprocess
import sys
from dataclasses import dataclass

import numpy as np

from cubo_table import picture, processor_seconds
from glb_reader import Glb

HERE = pathlib.Path(__file__).resolve().parent
DEPTH = "16"  # longest path in edges: Mitsuba's max_depth 16, Cycles' 14 bounces


@dataclass
class Rendered:
    picture: np.ndarray  # linear RGB, row 0 at the top
    spp: float  # mean over the picture
    seconds: float  # user and system time of rendering alone
    process_seconds: float  # of the whole process
    version: str


@functools.cache
def digest(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()[:12]


class Triad:
    family = "triad"

    def __init__(self, name, options):
        self.name, self.options, self.adaptive = name, options, name == "triad-error"

    def missing(self):
        return "" if self.options.triad.exists() else f"there is no program {self.options.triad} (--triad names another)"

    def program(self):
        return digest(self.options.triad)

    def efforts(self, scene):
        if self.adaptive:
            return [("--error", f"{scene.error_factor * self.options.error:g}")]
        return [("--spp", str(n)) for n in self.options.spp]

    def warm_up(self, scene, effort, threads):
        """Kernels are compiled for a scene, not for an effort."""
        self.render(scene, ("--error", "1e9") if self.adaptive else ("--spp", "1"), 1, threads)

    def render(self, scene, effort, seed, threads):
        out, report = self.options.folder / "triad.exr", self.options.folder / "triad.json"
        glb = Glb(scene.file)
        lens = next(glb.json["cameras"][node["camera"]] for node, _ in glb.nodes() if "camera" in node)
        # of a camera that is wider than the picture Triad would keep the width
        view = ["--size", f"{self.options.size}x{self.options.size}", "--fov", str(math.degrees(lens["perspective"]["yfov"]))]
        light = (["--env", scene.environment, "--env-strength", str(scene.strength)] if scene.environment
                 else ["--background", "#000000", "--env-strength", "0"])
        seconds = processor_seconds([self.options.triad, "render", scene.file, "-q", "-o", out, "--json", report, *view, *light, *effort,
                                     "--seed", str(seed), "--threads", str(threads), "--max-depth", DEPTH])
        report = json.loads(report.read_text())
        row = report["rows"][0]
        return Rendered(picture(out), row["spp"], row["render_cpu_s"], seconds, f"Triad {report['version']}")


class Child:
    """A renderer that is a Python package, driven by a script of its own. It tells the time of rendering; that of the whole process is
    measured, less the sample with which it warmed up."""

    def __init__(self, name, options):
        self.name, self.options = name, options

    def missing(self):
        asked = f"import importlib.util, sys; sys.exit(importlib.util.find_spec('{self.package}') is None)"
        absent = subprocess.run([self.python(), "-c", asked]).returncode
        return f"{self.python()} has no package {self.package} (pip install {self.wheel})" if absent else ""

    def program(self):
        return ""

    def efforts(self, scene):
        return [("--spp", str(n)) for n in self.options.spp]

    def warm_up(self, scene, effort, threads):
        self.render(scene, ("--spp", "1"), 1, threads)

    def render(self, scene, effort, seed, threads):
        out = self.options.folder / "child.npz"
        out.unlink(missing_ok=True)
        light = ["--environment", scene.environment, "--strength", str(scene.strength)] if scene.environment else []
        seconds = processor_seconds([self.python(), HERE / self.script, scene.file, out, *light, *effort, "--size", str(self.options.size),
                                     "--seed", str(seed), "--threads", str(threads), "--depth", DEPTH, *self.settings[self.name]])
        spp = int(effort[1])
        with np.load(out) as told:
            alone = float(told["seconds"])
            return Rendered(told["picture"].astype(float), spp, alone, seconds - alone / spp, str(told["version"]))


class Mitsuba(Child):
    family, package, wheel, script = "mitsuba", "mitsuba", "mitsuba==3.9.*", "render_mitsuba.py"
    settings = {"mitsuba-multijitter": ["--sampler", "multijitter"], "mitsuba-independent": ["--sampler", "independent"]}

    def python(self):
        return sys.executable

    def warm_up(self, scene, effort, threads):
        """Mitsuba compiles for every number of samples, and keeps what it compiled."""
        self.render(scene, effort, 1, threads)


class Cycles(Child):
    family, package, wheel, script = "cycles", "bpy", "bpy==4.5.*", "render_cycles.py"
    settings = {"cycles": [], "cycles-no-light-tree": ["--light-tree", "off"]}

    def python(self):
        return self.options.blender_python


# The first of a family makes its reference.
RENDERERS = {"triad": Triad, "triad-error": Triad, "mitsuba-multijitter": Mitsuba, "mitsuba-independent": Mitsuba, "cycles": Cycles,
             "cycles-no-light-tree": Cycles}
DESCRIPTIONS = {
    "triad": "Triad, the same samples in every pixel",
    "triad-error": "Triad, --error E: samples where they help, until its own estimate of the error is E",
    "mitsuba-multijitter": "Mitsuba 3, llvm_ad_rgb, sampler multijitter",
    "mitsuba-independent": "Mitsuba 3, llvm_ad_rgb, sampler independent (its default)",
    "cycles": "Blender's Cycles as it comes, with its light tree; without adaptive sampling",
    "cycles-no-light-tree": "Blender's Cycles without the light tree"}
