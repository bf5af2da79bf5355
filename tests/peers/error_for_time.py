#!/usr/bin/env python3
"""Error for time of Triad, Mitsuba 3 and Blender's Cycles on the same scenes: a Markdown table, and a plot per scene.

  pip install numpy OpenImageIO mitsuba==3.9.* bpy==4.5.*      (Python 3.11; Mitsuba needs LLVM: DRJIT_LIBLLVM_PATH)
  python tests/peers/error_for_time.py --output error-for-time.md

Renderers take turns, so that a busy machine troubles all alike; every run has seeds of its own. Box filter, paths of at most 16 edges,
each renderer's own roulette, no denoiser, no clamping, caustics on. Each renderer is compared with its own reference, because their
models differ a little; whether the references agree is in the table too. The error is the relMSE, over all pixels and without the
worst .1 % of them. The time is user and system time, of the whole process and of rendering alone.

The folder keeps references and results (results.jsonl): a run that was interrupted goes on where it stopped, and one more renderer or
scene costs its own time alone. A changed program of Triad or a changed scene is measured anew.
"""
import argparse
import itertools
import json
import os
import pathlib
import subprocess
import sys

import numpy as np

sys.dont_write_bytecode = True  # nothing is left in the source

import comparison_errors as errors  # noqa: E402
import comparison_plots as plots  # noqa: E402
import comparison_scenes  # noqa: E402
import comparison_tables as tables  # noqa: E402
from comparison_renderers import DESCRIPTIONS, RENDERERS, digest  # noqa: E402
from glb import png  # noqa: E402

REFERENCE_SEED = 4711


class References:
    """Each is kept as two pictures of half the samples, whose difference is its noise."""

    def __init__(self, options):
        self.options, self.loaded = options, {}

    def of(self, scene, family):
        """Both halves."""
        key = (scene.name, family)
        if key not in self.loaded:
            self.loaded[key] = [self._half(scene, family, half) for half in (0, 1)]
        return self.loaded[key]

    def _half(self, scene, family, half):
        o = self.options
        path = o.folder / "references" / f"{scene.name}-{digest(scene.file)}-{family}-{o.size}-{o.reference}-{half}.npy"
        if not path.exists():
            first = next(name for name, kind in RENDERERS.items() if kind.family == family)
            print(f"reference {scene.name} {family}, half {half + 1} of 2", flush=True)
            rendered = RENDERERS[first](first, o).render(scene, ("--spp", str(o.reference // 2)), REFERENCE_SEED + half, max(o.threads))
            path.parent.mkdir(exist_ok=True)
            np.save(path, rendered.picture.astype(np.float32))
        return np.load(path).astype(float)


class Kept:
    """The rows of results.jsonl, by what was asked."""

    KEY = ("scene", "scene_digest", "renderer", "program", "size", "threads", "effort", "run", "reference_spp")

    def __init__(self, path):
        self.path = path
        lines = path.read_text().splitlines() if path.exists() else []
        self.rows = {self._key(row): row for row in map(json.loads, lines)}

    def _key(self, row):
        return tuple(row[key] for key in self.KEY)

    def get(self, asked):
        return self.rows.get(self._key(asked))

    def add(self, row):
        self.rows[self._key(row)] = row
        with open(self.path, "a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")


def plan(options, scenes, renderers):
    """(what is asked, scene, renderer, effort) of each picture in order: in every run the renderers take turns, another first each time."""
    efforts = range(len(options.spp))
    for run, scene, threads, i in itertools.product(range(options.runs), scenes, options.threads, efforts):
        first = run % len(renderers)
        for renderer in renderers[first:] + renderers[:first]:
            for effort in renderer.efforts(scene)[i : i + 1]:
                yield {"scene": scene.name, "scene_digest": digest(scene.file), "renderer": renderer.name, "program": renderer.program(),
                       "size": options.size, "threads": threads, "effort": " ".join(effort), "run": run,
                       "reference_spp": options.reference, "seed": 100 * (run + 1) + i,
                       "wanted": scene.error_factor * options.error}, scene, renderer, effort


def measure(options, planned, references, kept):
    warm = set()
    for asked, scene, renderer, effort in planned:
        if kept.get(asked):
            continue
        reference = sum(references.of(scene, renderer.family)) / 2
        if (scene, renderer, effort, asked["threads"]) not in warm:  # programs are compiled once and kept
            warm.add((scene, renderer, effort, asked["threads"]))
            renderer.warm_up(scene, effort, asked["threads"])
        rendered = renderer.render(scene, effort, asked["seed"], asked["threads"])
        relmse, trimmed = errors.relmse(rendered.picture, reference, rendered.spp / options.reference)
        kept.add(asked | {"spp": rendered.spp, "relmse": relmse, "relmse_trimmed": trimmed, "seconds": rendered.seconds,
                          "process_seconds": rendered.process_seconds, "version": rendered.version})
        print(f"run {asked['run'] + 1} {scene.name} {renderer.name} {asked['effort']}, {asked['threads']} threads: "
              f"relMSE {relmse:.3g} ({trimmed:.3g} trimmed), {rendered.seconds:.2f} s of {rendered.process_seconds:.2f} s", flush=True)


def write_pictures(folder, references):
    """A PNG per scene: the references side by side, Triad, Mitsuba, Cycles, in one exposure."""
    for scene in dict.fromkeys(scene for scene, _ in references):
        pictures = [sum(halves) / 2 for (of, _), halves in references.items() if of == scene]
        shown = np.clip(np.concatenate(pictures, axis=1) / max(np.quantile(pictures[0], 0.97), 1e-9), 0, 1) ** (1 / 2.2)
        (folder / f"{scene}.png").write_bytes(png(np.rint(255 * shown).astype(np.uint8)))


def write_plots(options, results):
    if plots.missing():
        return print(plots.missing())
    for scene in results.names("scene"):
        for threads in results.names("threads"):
            curves = {renderer: results.curve(scene=scene, threads=threads, renderer=renderer) for renderer in results.names("renderer")}
            title = f"{scene}, {threads} thread{'s' if threads > 1 else ''}"
            plots.draw(options.output.with_name(f"{options.output.stem}-{scene}-{threads}.svg"), title, curves)


def numbers(text):
    return sorted(int(n) for n in text.split(","))


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="print scenes and renderers, and which are missing here")
    parser.add_argument("--scenes", default=",".join(comparison_scenes.DESCRIPTIONS), help="default: all")
    parser.add_argument("--renderers", default=",".join(RENDERERS), help="default: all")
    parser.add_argument("--triad", type=pathlib.Path, default=pathlib.Path("build/bin/triad"),
                        help="the program itself, which must not change meanwhile (default build/bin/triad)")
    parser.add_argument("--blender-python", default=sys.executable, help="an interpreter that has bpy (default: this one)")
    parser.add_argument("--size", type=int, default=256, help="of the square pictures, in pixels (default 256)")
    parser.add_argument("--spp", type=numbers, default=[16, 64, 256], help="samples per pixel (default 16,64,256)")
    parser.add_argument("--error", type=float, default=1e-3,
                        help="relMSE to which times are given, and of Triad's --error; ten times as much with many lights (default 1e-3)")
    parser.add_argument("--reference", type=int, default=2048, help="samples per pixel of the references (default 2048)")
    parser.add_argument("--runs", type=int, default=5, help="default 5")
    parser.add_argument("--threads", type=numbers, default=[2], help="default 2; 1,2 measures both")
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("build/error-for-time"), help="kept references and results")
    parser.add_argument("--output", type=pathlib.Path, help="the Markdown, plots beside it (default: table.md in the folder)")
    options = parser.parse_args()
    for name, known in (("scenes", comparison_scenes.DESCRIPTIONS), ("renderers", RENDERERS)):
        chosen = getattr(options, name).split(",")
        if unknown := set(chosen) - set(known):
            parser.error(f"--{name}: there is no {', '.join(sorted(unknown))}; there are {', '.join(known)}")
        setattr(options, name, [name for name in known if name in chosen])
    options.output = options.output or options.folder / "table.md"
    options.triad, options.folder = options.triad.resolve(), options.folder.resolve()
    return options


def main():
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    options = parse()
    renderers = [RENDERERS[name](name, options) for name in options.renderers]
    if options.list:
        for name in options.scenes:
            print(f"{name}: {' '.join(comparison_scenes.DESCRIPTIONS[name].split())}")
        for renderer in renderers:
            print(f"{renderer.name}: {DESCRIPTIONS[renderer.name]}{'; left out: ' if renderer.missing() else ''}{renderer.missing()}")
        return
    for renderer in renderers:
        if renderer.missing():
            print(f"{renderer.name} is left out: {renderer.missing()}.")
    renderers = [renderer for renderer in renderers if not renderer.missing()]
    if not renderers:
        sys.exit("No renderer is left.")
    options.folder.mkdir(parents=True, exist_ok=True)
    scenes = comparison_scenes.write(options.folder, options.scenes)
    references, kept = References(options), Kept(options.folder / "results.jsonl")
    planned = list(plan(options, scenes, renderers))
    for scene in scenes:
        for family in dict.fromkeys(renderer.family for renderer in renderers):
            references.of(scene, family)
    measure(options, planned, references, kept)
    results = tables.Results([kept.get(asked) | {"wanted": asked["wanted"]} for asked, *_ in planned])
    options.output.write_text(tables.document(options, results, references.loaded), encoding="utf-8")
    write_pictures(options.folder, references.loaded)
    write_plots(options, results)
    print(f"wrote {options.output}")


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as failed:
        sys.exit(f"A renderer failed with exit code {failed.returncode}: {' '.join(map(str, failed.cmd))}")
