"""The Markdown that error_for_time.py writes, from its kept rows and references."""
import statistics

import numpy as np

import comparison_errors as errors


class Results:
    """Kept rows, by scene, threads, renderer and effort."""

    def __init__(self, rows):
        self.rows = rows

    def where(self, **wanted):
        return [row for row in self.rows if all(row[key] == value for key, value in wanted.items())]

    def names(self, key):
        return list(dict.fromkeys(row[key] for row in self.rows))

    def seconds_to(self, measure, whole_process, **wanted):
        """CPU seconds of each run to the error that is wanted of the scene."""
        rows = self.where(**wanted)
        setup = statistics.median(row["process_seconds"] - row["seconds"] for row in rows) if whole_process else 0.0
        runs = sorted({row["run"] for row in rows})
        curves = [[(row["seconds"], row[measure]) for row in rows if row["run"] == run] for run in runs]
        return [setup + errors.seconds_to(rows[0]["wanted"], curve) for curve in curves]

    def curve(self, **wanted):
        """Points (seconds of rendering, relMSE): medians over the runs."""
        rows = self.where(**wanted)
        return sorted((statistics.median(row["seconds"] for row in rows if row["effort"] == effort),
                       statistics.median(row["relmse"] for row in rows if row["effort"] == effort))
                      for effort in dict.fromkeys(row["effort"] for row in rows))


def table(head, rows):
    return "\n".join([f"| {' | '.join(head)} |", "|" + "---|" * len(head), *(f"| {' | '.join(row)} |" for row in rows)]) + "\n"


def spread(values, places=3):
    """The median, with the least and the greatest where there are several."""
    text = f"**{statistics.median(values):.{places}g}**"
    return text + (f" ({min(values):.{places}g} to {max(values):.{places}g})" if len(values) > 1 else "")


def times(results, threads, measure, whole_process):
    """CPU seconds to the error; with triad-error, what it took and the error that it then had."""
    renderers = results.names("renderer")

    def cell(scene, renderer):
        wanted = {"scene": scene, "threads": threads, "renderer": renderer}
        rows = results.where(**wanted)
        if not rows:
            return "-"
        if renderer == "triad-error":
            return (spread([row["process_seconds" if whole_process else "seconds"] for row in rows]) + ", error "
                    + spread([row[measure] for row in rows], 2))
        return spread(results.seconds_to(measure, whole_process, **wanted))

    wanted = {row["scene"]: f"{row['wanted']:g}" for row in results.rows}
    return table(["scene", "relMSE", *renderers],
                 [[scene, wanted[scene], *(cell(scene, renderer) for renderer in renderers)] for scene in wanted])


def measured(results, threads):
    rows = []
    for scene in results.names("scene"):
        for renderer in results.names("renderer"):
            of_renderer = results.where(scene=scene, threads=threads, renderer=renderer)
            for effort in dict.fromkeys(row["effort"] for row in of_renderer):
                same = [row for row in of_renderer if row["effort"] == effort]
                median = {key: statistics.median(row[key] for row in same)
                          for key in ("spp", "relmse", "relmse_trimmed", "seconds", "process_seconds")}
                rows.append([scene, renderer, effort, f"{median['spp']:.4g}", f"{median['relmse']:.3g}", f"{median['relmse_trimmed']:.3g}",
                             f"{median['seconds']:.3g}", f"{median['process_seconds']:.3g}", str(len(same))])
    return table(["scene", "renderer", "asked for", "samples per pixel", "relMSE", "without worst .1 %", "CPU s rendering", "CPU s process",
                  "runs"], rows)


def noise(halves):
    """Root mean square of the relative noise of a block of the two halves' mean."""
    a, b = (errors.blocks(half) for half in halves)
    middle = (a + b) / 2
    return float(np.sqrt(np.mean(((a - b) / 2 / (middle + 0.01 * middle.mean())) ** 2)))


def means(references):
    """references: (scene, family) -> two halves. Every family is compared with the scene's first."""
    rows = []
    for scene in dict.fromkeys(scene for scene, _ in references):
        families = {family: halves for (of, family), halves in references.items() if of == scene}
        first, *others = families
        for family in others:
            ratio, blocks = errors.difference(sum(families[family]) / 2, sum(families[first]) / 2)
            size = np.abs(blocks)
            beyond = np.argwhere(size > errors.LIMIT)
            worst = sorted(beyond.tolist(), key=lambda at: -size[tuple(at)])[:6]
            named = ", ".join(f"{row}/{column} {100 * blocks[row, column]:+.1f} %" for row, column in worst)
            both = np.hypot(noise(families[family]), noise(families[first]))
            rows.append([scene, f"{family} / {first}", f"{ratio:.4f}", f"{len(beyond)} of {blocks.size}", f"{100 * np.median(size):.2f} %",
                         f"{100 * both:.2f} %", named or "none"])
    return table(["scene", "compared", "ratio of the means", "blocks beyond 2 %", "median block", "noise of a block",
                  "the worst, row/column"], rows)


def document(options, results, references):
    versions = ", ".join(dict.fromkeys(row["version"] for row in results.rows))
    parts = [f"""# Error for time

{versions}; pictures of {options.size} x {options.size} pixels, runs: {options.runs}, references of {options.reference} samples per pixel.
Median over the runs, with the least and the greatest. CPU seconds are user and system time of all threads. relMSE is the mean of
(x - r)^2 / (r^2 + .01) over pixels and channels; r is the renderer's own reference. Times are read from each run's curve of error over
time; beyond what was measured the error is taken to fall as 1 / time. `triad-error` asked for the error: what it took, and the error
that it then really had.
"""]
    for threads in results.names("threads"):
        said = f"on {threads} thread{'s' if threads > 1 else ''}"
        for measure, pixels in (("relmse", "all pixels"), ("relmse_trimmed", "without the worst .1 % of the pixels")):
            for whole, what in ((False, "rendering alone"), (True, "the whole process")):
                parts.append(f"## CPU seconds to a relMSE, {pixels}, {what}, {said}\n\n"
                             + times(results, threads, measure, whole))
        parts.append(f"## As measured {said}\n\n" + measured(results, threads))
    parts.append(f"""## Do the references agree?

Means of the picture and of its blocks of 16 x 16 pixels, relative to the first renderer's. The noise of a block is that of both
references, from their halves.

{means(references)}""")
    return "\n".join(parts)
