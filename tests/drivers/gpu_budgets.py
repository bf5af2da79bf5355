"""What kernels may take: gpu_budgets.json against what the compilers say.

The file's rows: "kernels" (patterns of names, or of PROGRAM:NAME), "options" (names of option sets as patterns, or OPTION=VALUE; all of them must
hold), "target", "goal" (where they shall end) and "limit" (what is enforced; it may only go down; null until
--lower has measured it). A kernel answers to the first row that fits it. Of `width` a limit is the least, of the rest the
most. "crashes" lists the programs that a compiler is known to crash on, with target and option sets."""
import fnmatch
import json
import pathlib
import re

PATH = pathlib.Path(__file__).with_suffix(".json")
FIGURES = ("registers", "stack", "spills", "width")
# What the host says to GPUs beside the options of features.h.
SHAPE = {"DISPLAY_LANES": 1, "DENOISE_LANES": 1, "DISPLAY_ROWS": 4, "TRIAD_BVH4": 1, "TRIAD_INLINED": 1}


def feature_names(kernels):
    return re.findall(r"^#ifndef (TRIAD_\w+) /\*", (kernels / "features.h").read_text(), flags=re.M)


def exceeds(figure, value, limit):
    return value < limit if figure == "width" else value > limit


def worst(figure, values):
    return (min if figure == "width" else max)(values)


class Budgets:
    def __init__(self):
        data = json.loads(PATH.read_text())
        self.rows, self.crashes = data["rows"], data["crashes"]
        for row in self.rows:
            row["measured"] = {}

    def row_of(self, target, program, kernel, name, macros):
        def holds(word):
            option, is_value, value = word.partition("=")
            if is_value:
                return str(macros.get("TRIAD_" + option, 1)) == value
            return fnmatch.fnmatchcase(name, word)

        def fits(pattern):
            return fnmatch.fnmatchcase(f"{program}:{kernel}" if ":" in pattern else kernel, pattern)

        for row in self.rows:
            if (row["target"] == target and any(map(fits, row["kernels"].split()))
                    and all(map(holds, row["options"].split()))):
                return row
        return None

    def check(self, work, sets, whole):
        """Sentences about what is wrong; fills "measured" of each row. `whole`: all programs were compiled."""
        failures, crashed = [], set()
        for job in work:
            result, target = job["result"], job["target"].name
            of = f"{job['program']} for {target} with the options of {', '.join(job['sets'])}"
            if "error" in result:
                failures.append(f"{of}: {result['error']}")
            if "crash" in result:
                crashed |= {(job["program"], target, name) for name in job["sets"]}
            # As a CPU has them, kernels need only compile.
            for name in [n for n in job["sets"] if n != "alone"]:
                for kernel, figures in result.get("kernels", {}).items():
                    failures += self.compare(self.row_of(target, job["program"], kernel, name, sets[name]), f"{kernel} of {of}", figures)
        compiled = {(job["program"], job["target"].name, name) for job in work for name in job["sets"]}
        known = {(c["program"], c["target"], name) for c in self.crashes for name in sets
                 if any(fnmatch.fnmatchcase(name, p) for p in c["options"].split())}
        if not whole:
            known &= compiled
        ran = {target for _, target, _ in compiled}
        for one in sorted(crashed - known):
            failures.append("The compiler crashes on {} for {} with the options of {}.".format(*one))
        for one in sorted(k for k in known - crashed if k[1] in ran):
            failures.append("The compiler no longer crashes on {} for {} with the options of {}: remove that from {}.".format(*one, PATH.name))
        return list(dict.fromkeys(failures))

    @staticmethod
    def compare(row, of, figures):
        if row is None:
            return
        for figure, limit in row["limit"].items():
            value = figures[figure]
            row["measured"][figure] = worst(figure, [value, row["measured"].get(figure, value)])
            if limit is not None and exceeds(figure, value, limit):
                yield f"{of}: {figure} {value}, and its limit is {limit} (the row of {row['kernels']}, {row['options']} in {PATH.name})"

    def lower(self):
        """Limits become what was measured, or the goal where that is met, if that is less; none rises."""
        for row in self.rows:
            for figure, value in row["measured"].items():
                value = worst(figure, [value, row["goal"].get(figure, value)])
                if row["limit"][figure] is None or exceeds(figure, row["limit"][figure], value):
                    row["limit"][figure] = value
        self.save()

    def save(self):
        rows = [{k: v for k, v in row.items() if k != "measured"} for row in self.rows]
        text = [f'  "{key}": [\n' + ",\n".join("    " + json.dumps(one) for one in many) + "\n  ]"
                for key, many in (("rows", rows), ("crashes", self.crashes))]
        PATH.write_text("{\n" + ",\n".join(text) + "\n}\n")
