"""The tables of gpu_compilers.py: gpu-compilers.md and .csv."""
import csv
import datetime
import os
import pathlib
import platform
import subprocess
import sys

from gpu_budgets import FIGURES

ROOT = pathlib.Path(__file__).resolve().parents[2]
WIDTHS = {"s": "warps of 64", "g": "waves", "i": "SIMD"}


def commit():
    told = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty", "--exclude=*"], text=True, capture_output=True)
    return told.stdout.strip() or "unknown"


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.partition(": ")[2].strip() for line in file if line.startswith("model name")]
    return f"{names[0] if names else platform.machine()}, {os.cpu_count()} threads"


def table(heads, rows):
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def figures_text(figures):
    return ", ".join(f"{name} {'not yet' if value is None else value}" for name, value in figures.items()) or "none"


class Report:
    def __init__(self, work, sets, budgets, targets):
        self.work, self.sets, self.budgets, self.targets = work, sets, budgets, targets

    def names(self, names):
        """Of option sets; `suite` is all of its scenes."""
        suite = list(self.sets)[3:]
        if len(names) == len(self.sets):
            return "any"
        rest = [n for n in self.sets if n in names and not (n in suite and set(suite) <= set(names))]
        return ", ".join(rest + ["suite"] * (set(suite) <= set(names)))

    def rows(self, target):
        """(program, kernel, options, registers, stack, spills, width, seconds) or what went wrong; option sets of which a kernel
        takes the same share a row."""
        found = {}
        for job in self.work:
            if job["target"] is not target:
                continue
            result = job["result"]
            lines = [(kernel, *(f[name] for name in FIGURES)) for kernel, f in result.get("kernels", {}).items()]
            if "kernels" not in result:
                why = "the compiler crashes: " + result["crash"] if "crash" in result else "error"
                lines = [(why.splitlines()[0], *[""] * len(FIGURES))]
            for line in lines:
                row = found.setdefault((job["program"], *line), {"sets": [], "seconds": []})
                row["sets"] += job["sets"]
                row["seconds"].append(result.get("seconds", ""))
        for (program, kernel, *figures), row in found.items():
            yield [program, kernel, self.names(row["sets"]), *figures, max(row["seconds"])]

    def markdown(self):
        parts = ["# What kernels take on GPUs", f"{datetime.date.today()}, commit {commit()}, {machine()}: "
                 f"`{' '.join(['tests/drivers/gpu_compilers.sh', *self.options()])}`.",
                 "Registers, bytes of stack (private memory) per work-item, spills (bytes of spill stores; on Intel the "
                 "compiler's count) and the processor's seconds for the program (the longest of the row). `alone` gives a "
                 "kernel no options: it has a CPU's shape. [Testing](../testing.md) says how it is measured.",
                 "## Limits", "What the worst kernel of a row takes, what is enforced, and the goal.",
                 table(["target", "kernels", "options", "measured", "limit", "goal"],
                       [[r["target"], r["kernels"].replace("*", "\\*"), r["options"].replace("*", "\\*"),
                         figures_text(r["measured"]), figures_text(r["limit"]), figures_text(r["goal"])]
                        for r in self.budgets.rows if r["measured"]])]
        for target in self.targets:
            heads = ["program", "kernel", "options", "registers", "stack", "spills", WIDTHS.get(target.name[0], "SIMD"), "s"]
            parts += [f"## {target.name}", target.version + ".", table(heads, self.rows(target))]
        return "\n\n".join(parts) + "\n"

    @staticmethod
    def options():
        """Of the command, without those that the shell script adds."""
        return [a for a in sys.argv[5:] if not a.startswith("/")]

    def write(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "gpu-compilers.md").write_text(self.markdown())
        with open(folder / "gpu-compilers.csv", "w", newline="", encoding="utf-8") as file:
            out = csv.writer(file, lineterminator="\n")
            out.writerow(["target", "program", "kernel", "options", *FIGURES, "seconds"])
            for target in self.targets:
                out.writerows([target.name, *row] for row in self.rows(target))

    def summary(self):
        results = [job["result"] for job in self.work]
        kernels = sum(len(r.get("kernels", {})) for r in results)
        seconds = sum(r.get("seconds", 0) for r in results)
        crashes = sum("crash" in r for r in results)
        return f"{len(results)} programs, {kernels} kernels, {crashes} crashes, {seconds:.0f} s of compilers"
