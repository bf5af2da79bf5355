#!/usr/bin/env python3
"""Every program of kernels/ through the compilers of real GPUs, against the limits of gpu_budgets.json.

gpu_compilers.sh calls this with the compilers that it has unpacked. Ends with 1 and sentences when a compiler crashed that
did not before (or no longer does), refused a program, or a kernel takes more than its limit."""
import argparse
import concurrent.futures
import functools
import hashlib
import json
import pathlib
import shlex
import subprocess
import sys
import tempfile

import gpu_budgets
import gpu_report
import gpu_targets

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Of CPUs: GPUs follow paths by path/wave_stages.cl. They need only compile.
FOR_CPUS = {"path/wave.cl", "path/wave_full.cl"}
# GPUs choose these only when asked to: the loop over whole paths, and the recorder of --pixel. They are half of the compilers'
# time, so that without --long they are compiled with nothing and with everything.
SELDOM = {"path/mega.cl", "path/mega_full.cl", "path/record.cl", "path/record_full.cl"}
JOBS = 2  # compilers at once: the larger ones take a gigabyte


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--ptxas", required=True)
    parser.add_argument("--intel", required=True, help="folder with Intel's unpacked packages")
    parser.add_argument("--long", action="store_true", help="more targets")
    parser.add_argument("--kernels", default=ROOT / "kernels", type=pathlib.Path)
    parser.add_argument("--program", default=ROOT / "build/bin/triad", help="triad, asked for the options of the suite's scenes")
    parser.add_argument("--output", default=ROOT / "build/gpu_compilers", type=pathlib.Path,
                        help="folder for gpu-compilers.md, .csv and the cache of results")
    parser.add_argument("--publish", action="store_true", help="write the table to docs/measurements/ too")
    parser.add_argument("--lower", action="store_true", help="lower the limits to what was measured, where that is less")
    parser.add_argument("--target", action="append", help="this one only; several allowed")
    parser.add_argument("--match", default="", help="programs whose path holds this")
    parser.add_argument("--without", default="", metavar="SET", help="leave out this set of options (all: the largest programs)")
    return parser.parse_args()


def option_sets(program, kernels):
    """Name -> macros. `alone` gives none: kernels as a CPU has them; the rest have the shape of a GPU."""
    names = gpu_budgets.feature_names(kernels)
    sets = {"alone": {}, "all": dict(gpu_budgets.SHAPE), "none": {**gpu_budgets.SHAPE, **dict.fromkeys(names, 0)}}
    scenes = subprocess.run([program, "bench", "--list"], check=True, text=True, capture_output=True).stdout
    with tempfile.TemporaryDirectory() as folder:
        for line in scenes.splitlines():
            name, _, options = line.partition(": ")
            told = subprocess.run([program, "render", *shlex.split(options), "--crop", "0,0,16,9", "--spp", "1", "-q", "--json", "-",
                                   "-o", f"{folder}/picture.png"], check=True, text=True, capture_output=True).stdout
            left_out = {"TRIAD_" + words.upper().replace(" ", "_") for words in json.loads(told)["rows"][0]["left_out"]}
            if left_out - set(names):
                sys.exit(f"{name}: triad render left out {left_out - set(names)}, which kernels/features.h does not have")
            sets[name] = {**gpu_budgets.SHAPE, **{n: int(n not in left_out) for n in names}}
    return sets


def text_key(kernels, sets, item):
    """Hash of all that decides the result, and the macros."""
    target, program, name = item
    defines = [f"-D{macro}={value}" for macro, value in sets[name].items()]
    text = target.preprocess(kernels, program, defines)
    return hashlib.sha256(f"{gpu_targets.identity(target)}\0{text}".encode()).hexdigest(), defines


def sets_of(program, sets, long):
    """Names of the sets that the program is compiled with."""
    if program in FOR_CPUS:
        return ["alone"]
    return [name for name in sets if long or program not in SELDOM or name in ("none", "all")]


def jobs(targets, programs, sets, kernels, pool, long):
    """One per target and text that its preprocessor makes; sets whose texts are equal share it."""
    items = [(t, p, n) for t in targets for p in programs for n in sets_of(p, sets, long)]
    found = {}
    for (target, program, name), (key, defines) in zip(items, pool.map(functools.partial(text_key, kernels, sets), items)):
        job = found.setdefault((target.name, program, key), {"target": target, "program": program, "key": key,
                                                             "defines": defines, "sets": []})
        job["sets"].append(name)
    return list(found.values())


def compile_job(kernels, cache, job):
    """The job's result: {"kernels", "seconds"} or {"crash" or "error": what the compiler said}."""
    kept = cache / f"{job['key']}.json"
    if kept.exists():
        return json.loads(kept.read_text())
    with tempfile.TemporaryDirectory() as folder:
        try:
            found, seconds = gpu_targets.timed(job["target"], kernels, job["program"], job["defines"], folder)
            result = {"kernels": found, "seconds": round(seconds, 1)}
        except gpu_targets.Failure as failure:
            result = {"crash" if failure.crashed else "error": str(failure)}
    aside = kept.with_suffix(".new")
    aside.write_text(json.dumps(result))
    aside.rename(kept)
    return result


def main():
    args = arguments()
    cache = args.output / "cache"
    cache.mkdir(parents=True, exist_ok=True)
    programs = sorted(str(path.relative_to(args.kernels)) for path in args.kernels.rglob("*.cl") if args.match in str(path))
    with tempfile.TemporaryDirectory() as folder:
        targets = [t for t in gpu_targets.targets(args.ptxas, args.intel, args.long) if t.name in (args.target or [t.name])]
        unknown = [t for t in targets if not gpu_targets.knows(t, folder)]
    for target in unknown:
        print(f"{target.name} is not known to {target.version}: left out")
        targets.remove(target)
    if not targets or not programs:
        sys.exit("gpu_compilers.py: no such target or program")
    sets = option_sets(args.program, args.kernels)
    sets.pop(args.without, None)
    kernels = str(args.kernels)
    with concurrent.futures.ProcessPoolExecutor(JOBS) as pool:
        # Limits and tables are made of everything.
        everything = args.long or args.lower or args.publish
        work = jobs(targets, programs, sets, kernels, pool, everything)
        # The longest first: with all options.
        work.sort(key=lambda job: "all" not in job["sets"])
        for job, result in zip(work, pool.map(functools.partial(compile_job, kernels, cache), work)):
            job["result"] = result
    work.sort(key=lambda job: (targets.index(job["target"]), job["program"], list(sets).index(job["sets"][0])))

    budgets = gpu_budgets.Budgets()
    failures = budgets.check(work, sets, whole=everything and not args.match and not args.without)
    if args.lower:
        budgets.lower()
    report = gpu_report.Report(work, sets, budgets, targets)
    report.write(args.output)
    if args.publish:
        report.write(ROOT / "docs/measurements")
    print(report.summary())
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
