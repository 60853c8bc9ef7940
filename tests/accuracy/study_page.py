# SPDX-License-Identifier: Apache-2.0
"""The tables of engine/ACCURACY.md. They stand between <!-- study: NAME --> and <!-- end -->; the
words around them are written by people and hold no figure that a run could change."""

import pathlib
import platform
import re
import statistics

import study_runs


def number(value, digits=2):
    if value is None:
        return "–"
    return "0" if value == 0 else f"{value:.{digits}g}"


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def step_text(row):
    return "" if row["step_s"] is None else f", {number(row['step_s'], 3)} s"


def machine(_):
    model = platform.machine()
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text()
        model = re.search(r"model name\s*:\s*(.*)", text).group(1)
    except (OSError, AttributeError):
        pass
    return f"Measured on {model}, {platform.system()}; CPU time of the thread, best of three."


def costs(tables):
    """Every arithmetic beside double, in the main gas and over all scenes."""
    everywhere = {}
    for row in tables["methods"]:
        if row["cpu_ratio"] is not None:
            everywhere.setdefault(row["method"], []).append(row["cpu_ratio"])
    rows = []
    for row in tables["costs"]:
        if row["method"] in study_runs.EXACT:
            others = everywhere.get(row["method"], [row["cpu_ratio"]])
            rows.append([row["method"], number(1e6 * row["cpu_s_per_collision"], 3),
                         number(row["cpu_ratio"], 3),
                         f"{min(others):.2f} to {max(others):.2f}, "
                         f"median {statistics.median(others):.2f}"])
    return table(["arithmetic", "µs a collision", "ratio to double", "ratio in the other scenes"],
                 rows)


def horizons(tables):
    densities = sorted({row["area_fraction"] for row in tables["horizon"]})
    rows = []
    for method in study_runs.EXACT:
        found = {row["area_fraction"]: row for row in tables["horizon"] if row["method"] == method}
        if not found:
            continue
        cells = [f"{'≥ ' if found[d]['at_least'] else ''}{found[d]['collisions_per_disk']:.1f} ± "
                 f"{found[d]['deviation']:.1f}" for d in densities]
        rows.append([method, f"{next(iter(found.values()))['digits']:.1f}", *cells])
    return table(["arithmetic", "digits", *(f"area fraction {d:g}" for d in densities)], rows)


def promise(tables):
    """The two figures that the study has to show."""
    lines = []
    for method, least in (("double", 16), ("float128", 39)):
        for row in tables["horizon"]:
            if row["area_fraction"] == 0.2 and row["method"] == method:
                mean = row["collisions_per_disk"]
                verdict = "reached" if mean >= least else "not reached"
                lines.append(f"- {method}: {mean:.1f} right collisions a disk; the aim of {least} "
                             f"is {verdict}")
    return "\n".join(lines)


def digit_price(tables):
    """Digits that a collision costs, from the widest arithmetic and double."""
    rows = []
    for density in sorted({row["area_fraction"] for row in tables["horizon"]}):
        found = {row["method"]: row for row in tables["horizon"]
                 if row["area_fraction"] == density}
        if "double" in found and "float128" in found:
            low, high = found["double"], found["float128"]
            price = (high["digits"] - low["digits"]) / (
                high["collisions_per_disk"] - low["collisions_per_disk"])
            rows.append([f"{density:g}", f"{price:.2f}"])
    return table(["area fraction", "decimal digits that a collision a disk costs"], rows)


def best_stepped(rows, method):
    """The finest step that came to the end, else the one that came farthest."""
    mine = [row for row in rows if row["method"] == method]
    return max(mine, key=lambda row: (row["reached_s"], -row["step_s"])) if mine else None


def scenes(tables):
    parts = []
    names = list(dict.fromkeys(row["scene"] for row in tables["methods"]))
    for name in names:
        rows = [row for row in tables["methods"] if row["scene"] == name]
        shown = [row for row in rows if row["method"] in study_runs.EXACT]
        shown += [row for row in (best_stepped(rows, m) for m in study_runs.STEPPED) if row]
        end = max(row["reached_s"] for row in rows)
        cells = [[row["method"] + step_text(row), number(row["cpu_ratio"], 3),
                  number(row["position_error_eighth_m"]), number(row["position_error_half_m"]),
                  number(row["first_wrong_s"], 3) if row["first_wrong_s"] else "none",
                  number(row["right_collisions_per_disk"], 3),
                  "–" if row["missed"] is None else f"{row['missed']:.0f}",
                  number(row["deepest_overlap"]), number(row["energy_error"])] for row in shown]
        parts.append(f"**{name}**, T = {number(end, 4)} s\n\n" + table(
            ["method", "time, ratio to double", "error at T/8, m", "error at T/2, m",
             "first wrong, s", "right collisions a disk", "missed", "deepest overlap",
             "energy error"], cells))
    return "\n\n".join(parts)


def work(tables):
    """What the other methods need for how little, in the main gas."""
    rows = []
    for row in sorted(tables["work_precision"], key=lambda r: -(r["position_error_rms_m"] or 0)):
        if row["position_error_rms_m"] is not None:
            rows.append([row["method"] + step_text(row), number(row["position_error_rms_m"]),
                         number(row["cpu_ratio"], 3)])
    return table(["method", "rms error after 2 s, m", "time, ratio to double"], rows)


def energies(tables):
    """The error of energy at the end of the long run, and what a collision adds to it."""
    last = {}
    for row in tables["energy"]:
        if row["energy_error"] is not None:
            last[row["method"]] = row
    rows = [[row["method"] + step_text(row), f"{row['collisions']:.0f}",
             number(row["energy_error"]), number(row["energy_error"] / row["collisions"])]
            for row in last.values() if row["collisions"] > 0]
    return table(["method", "collisions", "relative error of energy", "for each collision"], rows)


BLOCKS = {"machine": machine, "costs": costs, "horizons": horizons, "promise": promise,
          "energies": energies, "digits": digit_price,
          "scenes": scenes, "work": work}


def with_figures(page, tables):
    """The page with every block made anew. Raises KeyError for a block that is not known."""
    def block(match):
        return f"<!-- study: {match.group(1)} -->\n{BLOCKS[match.group(1)](tables)}\n<!-- end -->"
    return re.sub(r"<!-- study: (\w+) -->\n.*?<!-- end -->", block, page, flags=re.DOTALL)
