"""Plots of error over time as SVG, drawn by gnuplot (Debian: gnuplot-nox)."""
import shutil
import subprocess

# colour (Okabe and Ito 2008), gnuplot's marker
PENS = {"triad": ("#0072b2", 7), "triad-error": ("#56b4e9", 6), "mitsuba-multijitter": ("#d55e00", 5),
        "mitsuba-independent": ("#e69f00", 4), "cycles": ("#009e73", 9), "cycles-no-light-tree": ("#cc79a7", 8)}


def missing():
    return "" if shutil.which("gnuplot") else "gnuplot is not installed (Debian: gnuplot-nox): there are no plots."


def draw(path, title, curves):
    """curves: renderer -> points (seconds, error), in the order of their seconds."""
    data = "".join(f"${i} << EOD\n" + "".join(f"{seconds:.6g} {error:.6g}\n" for seconds, error in points) + "EOD\n"
                   for i, points in enumerate(curves.values())).replace("$", "$curve")
    lines = ", ".join(f"$curve{i} with linespoints lw 2 lc rgb '{PENS[name][0]}' pt {PENS[name][1]} title '{name}'"
                      for i, name in enumerate(curves))
    script = f"""set terminal svg size 560,540 dynamic font 'sans-serif,14' background '#ffffff' noenhanced
set output '{path}'
set title '{title}'
set logscale xy 10
set format xy '%g'
set xlabel 'CPU seconds of rendering'
set ylabel 'relMSE'
set grid lc rgb '#888888' lw 0.5
set key below
{data}plot {lines}
"""
    subprocess.run(["gnuplot"], input=script, text=True, check=True)
