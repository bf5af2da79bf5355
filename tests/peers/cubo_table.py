#!/usr/bin/env python3
"""Error of every method on scenes/spectral/cubo.glb for its time, for docs/photons.md: ./cubo_table.py TRIAD FOLDER [MINUTES] [SIZE].

One run, one method after the other, each until Triad's own estimate of relMSE is 1e-3 or for so many minutes of two cores (default
10: 20 minutes of processor time). Times are processor time over two: what two cores need that nothing else uses. FOLDER gets the
pictures and table.json, row by row. Needs numpy and OpenImageIO (pip); with pyluxcore LuxCore is a row too.

The error is against two pictures A and B of `photons` with other seeds: the mean of (x - A)(x - B) / (r^2 + .01), r their mean. The noise
of A and B has mean 0 in the product, so that they need not be finer than what they judge."""
import json
import pathlib
import resource
import subprocess
import sys

import numpy
import OpenImageIO

ROOT = pathlib.Path(__file__).resolve().parents[2]
CUBO = ROOT / "scenes/spectral/cubo.glb"
TARGET = 1e-3
MAP = ["--integrator", "photon-map", "--photons", "20000000"]
METHODS = {
    "photons": ["--integrator", "photons"],
    "path": ["--integrator", "path"],
    "light": ["--integrator", "light"],
    "photon-map, final gather": [*MAP, "--spectral", "classic"],
    "photon-map, without": [*MAP, "--spectral", "classic", "--final-gather", "off"],
}


def picture(path):
    return OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.FLOAT)[..., :3].astype(float)


def processor_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


class Table:
    def __init__(self, triad, folder, minutes, size):
        self.triad, self.folder, self.limit, self.size = triad, folder, 120 * minutes, size
        self.folder.mkdir(parents=True, exist_ok=True)
        self.rows = []

    def render(self, name, arguments, *more):
        out, report = self.folder / f"{name}.exr", self.folder / f"{name}.json"
        seconds = processor_seconds([self.triad, "render", CUBO, "--size", self.size, "--roulette", "0.2", "--adaptive", "off", *arguments,
                                     *more, "-q", "-o", out, "--json", report])
        return picture(out), seconds, json.loads(report.read_text())["rows"][0]

    def samples_within_limit(self, name, arguments):
        """From two short runs: all but the samples costs the same in both."""
        few, many = 2, 8
        if arguments[:4] != MAP:  # compiles
            self.render("trial", arguments, "--spp", "1")
        a, b = (self.render("trial", arguments, "--spp", str(n))[1] for n in (few, many))
        each = max(b - a, 1e-3) / (many - few)
        return max(1, int((self.limit - a) / each) + few)

    def error(self, x):
        r = (self.references[0] + self.references[1]) / 2
        return float(((x - self.references[0]) * (x - self.references[1]) / (r * r + .01)).mean())

    def add(self, row):
        self.rows.append(row)
        (self.folder / "table.json").write_text(json.dumps(self.rows, indent=1))
        print(row, flush=True)

    def triad_rows(self):
        self.references = [self.render(f"reference-{seed}", METHODS["photons"], "--seed", str(seed), "--error", str(4 * TARGET))[0]
                           for seed in (101, 102)]
        for name, arguments in METHODS.items():
            spp = self.samples_within_limit(name, arguments)
            # the estimate does not see what a map's photons scattered by chance
            until = [] if arguments[:4] == MAP else ["--error", str(TARGET)]
            x, seconds, row = self.render(name, arguments, "--spp", str(spp), *until)
            self.add({"method": name, "minutes": seconds / 120, "spp": row["spp"], "noise": row["relmse"], "error": self.error(x),
                      "photon_s": row["photon_s"], "mean": x.mean((0, 1)).tolist()})

    def luxcore_row(self):
        """Two pictures of half the time each: their difference is the noise."""
        halves, empty = [], self.folder / "no-drivers"
        empty.mkdir(exist_ok=True)
        for seed in (1, 2):
            out = self.folder / f"luxcore-{seed}"
            # LuxCore crashes where an OpenCL driver with another LLVM is loaded: it is to find none
            done = subprocess.run(["env", f"OCL_ICD_VENDORS={empty}", sys.executable, ROOT / "tests/peers/luxcore_cubo.py", str(self.limit / 4), f"{out}.png", self.size, f"{out}.npy",
                                   str(seed)], stdout=subprocess.PIPE, text=True)
            if done.returncode:
                return print("LuxCore does not run here")
            halves.append(numpy.load(f"{out}.npy").astype(float))
        x = sum(halves) / 2
        r = (self.references[0] + self.references[1]) / 2
        noise = float(((halves[0] - halves[1]) ** 2 / 4 / (r * r + .01)).mean())
        return self.add({"method": "LuxCore", "minutes": self.limit / 120, "noise": noise, "error": self.error(x), "mean": x.mean((0, 1)).tolist()})


def main():
    table = Table(sys.argv[1], pathlib.Path(sys.argv[2]), float(sys.argv[3]) if len(sys.argv) > 3 else 10,
                  sys.argv[4] if len(sys.argv) > 4 else "640x480")
    table.triad_rows()
    table.luxcore_row()


if __name__ == "__main__":
    main()
