# SPDX-License-Identifier: Apache-2.0
"""The four pictures, drawn by gnuplot. Every method has a colour (Okabe and Ito), a marker and a
line of its own: no colour need be seen to tell them apart."""

import subprocess

NAMES = ("work_precision", "error_growth", "horizon", "energy")

# colour, point type, dash type
STYLES = {
    "float": ("#E69F00", 4, "solid"),
    "double": ("#0072B2", 7, "solid"),
    "long-double": ("#009E73", 8, "solid"),
    "double-double": ("#CC79A7", 12, "solid"),
    "float128": ("#000000", 2, "solid"),
    "detect": ("#D55E00", 5, "'-'"),
    "substeps": ("#56B4E9", 9, "'_'"),
    "back-up": ("#666666", 13, "'-.'"),
    "Box2D": ("#000000", 1, "'.'"),
    "Chipmunk": ("#CC79A7", 3, "'.'"),
}
DENSITY_STYLES = (("#E69F00", 4), ("#0072B2", 7), ("#009E73", 8), ("#CC79A7", 12), ("#000000", 2))


def style(method):
    colour, marker, dash = STYLES[method]
    return f"lc rgb '{colour}' lw 1.6 dt {dash} pt {marker} ps 0.7"


def by_method(rows, x, y):
    """Points of every method, in the order of the table; what a logarithm cannot show is left
    out."""
    found = {}
    for row in rows:
        if row[x] is not None and row[y] is not None and row[x] > 0 and row[y] > 0:
            found.setdefault(row["method"], []).append((row["step_s"] or 0, row[x], row[y]))
    return found


def finest(rows, reach):
    """Of every method only the finest of the steps that came as far as any of its steps."""
    ends = {}
    for row in rows:
        key = (row["method"], row["step_s"] or 0)
        ends[key] = max(ends.get(key, 0), row[reach])
    keep = {}
    for (method, step), end in ends.items():
        known = keep.get(method)
        if known is None or (end, -step) > (ends[method, known], -known):
            keep[method] = step
    return [row for row in rows if (row["step_s"] or 0) == keep[row["method"]]]


def script(path, settings, curves):
    """curves: (title, style, with, points)."""
    lines = [f"set terminal svg size 820,520 font 'sans,13' background '#FFFFFF'",
             f"set output '{path}'", "set encoding utf8", "set grid lc rgb '#DDDDDD'",
             "set key outside right noenhanced", *settings]
    plots = []
    for i, (title, look, kind, points) in enumerate(curves):
        lines += [f"$d{i} << EOD", *(f"{x:.4g} {y:.4g}" for x, y in points), "EOD"]
        plots.append(f"$d{i} using 1:2 with {kind} {look} title '{title}'")
    return "\n".join(lines + ["plot " + ", ".join(plots), ""])


def title_of(method, step):
    return f"{method}, {step:.2g} s" if step else method


def log_range(axis, curves):
    index = 0 if axis == "x" else 1
    values = [point[index] for *_, points in curves for point in points]
    room = max(2.0, (max(values) / min(values)) ** 0.04)
    return f"set {axis}range [{min(values) / room:.3g}:{max(values) * room:.3g}]"


def work_precision(rows, path):
    found = by_method(rows, "position_error_rms_m", "cpu_s_per_s")
    curves = [(method, style(method), "linespoints", [point[1:] for point in points])
              for method, points in found.items()]
    return script(path, ["set logscale xy", "set format '%.0e'",
                         log_range("x", curves), log_range("y", curves),
                         "set xlabel 'rms error of position after 2 s (m)'",
                         "set ylabel 'CPU time for a simulated second (s)'"], curves)


def error_growth(rows, path):
    found = by_method(finest(rows, "time_s"), "time_s", "position_error_rms_m")
    curves = [(title_of(method, points[0][0]), style(method), "linespoints",
               [point[1:] for point in points]) for method, points in found.items()]
    return script(path, ["set logscale y", "set format y '%.0e'", log_range("y", curves),
                         "set xlabel 'simulated time (s)'",
                         "set ylabel 'rms error of position (m)'"], curves)


def horizon(rows, path):
    curves = []
    densities = sorted({row["area_fraction"] for row in rows})
    for (colour, marker), density in zip(DENSITY_STYLES, densities):
        points = [(row["digits"], row["collisions_per_disk"]) for row in rows
                  if row["area_fraction"] == density]
        curves.append((f"area fraction {density:g}", f"lc rgb '{colour}' lw 1.6 pt {marker} ps 0.9",
                       "linespoints", points))
    return script(path, ["set xrange [0:36]", "set yrange [0:*]",
                         "set xlabel 'decimal digits of the arithmetic'",
                         "set ylabel 'horizon: right collisions a disk'"], curves)


def energy(rows, path):
    found = by_method(finest(rows, "collisions"), "collisions", "energy_error")
    curves = [(title_of(method, points[0][0]), style(method), "points",
               [point[1:] for point in points]) for method, points in found.items()]
    first, last = 1e3, 1e5
    for name, power, level in (("slope 1/2", 0.5, 1e-24), ("slope 1", 1, 1e-24)):
        curves.append((name, f"lc rgb '#999999' lw 1 dt {'1' if power == 0.5 else '2'}", "lines",
                       [(x, level * (x / first) ** power) for x in (first, last)]))
    return script(path, ["set logscale xy", "set format '%.0e'",
                         log_range("x", curves), log_range("y", curves),
                         "set xlabel 'collisions'", "set ylabel 'relative error of energy'"],
                  curves)


def draw(tables, out):
    """Writes the pictures into the folder `out`."""
    for name in NAMES:
        text = globals()[name](tables[name], out / f"{name}.svg")
        subprocess.run(["gnuplot", "-"], input=text, text=True, check=True)
