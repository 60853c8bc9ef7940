# SPDX-License-Identifier: Apache-2.0
"""The runs of the study: scenes, how long each goes, and the figures as tables."""

import csv
import dataclasses
import json
import math
import pathlib
import random
import statistics
import subprocess
import sys

SCENES = pathlib.Path(__file__).resolve().parent.parent.parent / "clients/scenes"

DISKS = 100
EXACT = ("float", "double", "long-double", "double-double", "float128")
STEPPED = ("detect", "substeps", "back-up", "Box2D", "Chipmunk")
MAIN_GAS = "gas-0.20"

# A gas starts on a lattice; after this long (s, speeds of about 1 m/s, diameters of 1 m) it does
# not remember.
SETTLE_S = 20


@dataclasses.dataclass(frozen=True)
class Run:
    scene: str
    until_s: float = 0  # 0: up to the horizon of double
    budget_s: float = 15
    samples: int = 32
    steps: str = "0"  # 0: steps that suit the scene


@dataclasses.dataclass(frozen=True)
class Plan:
    comparisons: tuple
    growth: Run
    energy: Run
    densities: tuple  # for the horizons
    seeds: int
    horizon_budget_s: float


QUICK = Plan(
    comparisons=(Run("gas-0.02"), Run("gas-0.05"), Run(MAIN_GAS), Run("gas-0.50"), Run("gas-0.65"),
                 Run("bullets"), Run("pi-3"), Run("box", until_s=100000), Run("pool-break")),
    growth=Run(MAIN_GAS, until_s=36, budget_s=60, samples=72,
               steps="0.0625,0.015625,0.00390625,0.0009765625,0.000244140625"),
    energy=Run(MAIN_GAS, until_s=1000, budget_s=40, samples=64, steps="0.015625"),
    densities=("0.02", "0.05", "0.20", "0.50", "0.65"),
    seeds=6,
    horizon_budget_s=24)

SMOKE = Plan(comparisons=(Run("pi-1", budget_s=0.5), Run("box", until_s=100, budget_s=0.5)),
             growth=Run(MAIN_GAS, until_s=4, budget_s=1, samples=8, steps="0.0625,0.015625"),
             energy=Run(MAIN_GAS, until_s=20, budget_s=1, samples=8, steps="0.015625"),
             densities=("0.20",), seeds=1, horizon_budget_s=1)


def longer(plan, factor):
    """The plan with more time for every run."""
    def more(run):
        return dataclasses.replace(run, budget_s=run.budget_s * factor)
    return dataclasses.replace(plan, comparisons=tuple(more(r) for r in plan.comparisons),
                               growth=more(plan.growth), energy=more(plan.energy),
                               seeds=plan.seeds * 2)


# Scenes -------------------------------------------------------------------------------------------


def scene_json(disks, size):
    width, height = size
    corners = [(0, 0), (width, 0), (width, height), (0, height)]
    walls = [{"id": str(len(disks) + 1 + i),
              "start": dict(zip("xy", corners[i])), "end": dict(zip("xy", corners[(i + 1) % 4]))}
             for i in range(4)]
    return json.dumps({"disks": disks, "walls": walls})


def gas(fraction, seed, stoss, path):
    """100 equal disks of diameter 1 in a square box, settled."""
    generator = random.Random(seed)
    side = math.sqrt(DISKS * math.pi / 4 / float(fraction))
    disks = [{"id": str(i + 1), "radius": 0.5,
              "position": {"x": (i % 10 + 0.5) * side / 10, "y": (i // 10 + 0.5) * side / 10},
              "velocity": {"x": generator.gauss(0, 1), "y": generator.gauss(0, 1)}}
             for i in range(DISKS)]
    path.write_text(scene_json(disks, (side, side)))
    lines = subprocess.run([stoss, "simulate", path, "--until", str(SETTLE_S), "--states", "-"],
                           check=True, capture_output=True, text=True).stdout.splitlines()
    for disk, line in zip(disks, lines):
        state = json.loads(line)
        disk["position"], disk["velocity"] = state["position"], state["velocity"]
    path.write_text(scene_json(disks, (side, side)))


def scene(name, work, stoss, seed=1):
    """The file of a scene, made when it is one of the study's own."""
    if name.startswith("gas-"):
        path = work / f"{name}-{seed}.json"
        if not path.exists():
            gas(name[4:], seed, stoss, path)
        return path
    if name == "box":
        path = work / "box.json"
        # Numbers without a common measure: no two walls are met in one instant.
        disk = {"id": "1", "radius": 0.5, "position": {"x": 3.1415, "y": 4.2718},
                "velocity": {"x": 1.1037, "y": 0.7213}}
        path.write_text(scene_json([disk], (10, 8)))
        return path
    return SCENES / f"{name}.json"


# Runs ---------------------------------------------------------------------------------------------


def measured(run, build, work, seed=1):
    """The rows that study_scene writes, numbers as floats, with the study's name of the scene."""
    path = scene(run.scene, work, build / "bin/stoss", seed)
    out = work / "rows.csv"
    command = [build / "tests/study_scene", path, out, run.until_s, run.budget_s, run.samples,
               run.steps]
    print(f"study: {run.scene}, seed {seed}", file=sys.stderr, flush=True)
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    with out.open() as file:
        rows = [{key: value_of(key, text) for key, text in row.items()}
                for row in csv.DictReader(file)]
    for row in rows:
        row["scene"] = run.scene
    return rows


def value_of(key, text):
    if text == "" or key in ("scene", "method", "reference"):
        return text or None
    return float(text)


def last_of_each(rows):
    """The last row of every method and step: the figures of the whole run."""
    last = {}
    for row in rows:
        last[row["method"], row["step_s"]] = row
    return list(last.values())


def error_at(rows, method_row, part):
    """The error of position after a part of the run, or None."""
    end = max(row["time_s"] for row in rows)
    for row in rows:
        if (row["method"], row["step_s"]) == (method_row["method"], method_row["step_s"]) and \
                row["time_s"] >= part * end * (1 - 1e-9):
            return row["position_error_rms_m"]
    return None


METHOD_COLUMNS = ("scene", "method", "step_s", "substeps", "reached_s", "collisions", "cpu_s_per_s",
                  "cpu_s_per_collision", "cpu_ratio", "first_wrong_s", "right_collisions_per_disk",
                  "missed", "deepest_overlap", "energy_error")


def methods_of(rows):
    table = []
    for row in last_of_each(rows):
        entry = {key: row[key] for key in METHOD_COLUMNS}
        for name, part in (("eighth", 1 / 8), ("half", 1 / 2), ("end", 1)):
            entry[f"position_error_{name}_m"] = error_at(rows, row, part)
        table.append(entry)
    return table


def horizons(plan, build, work):
    """Mean and deviation over the seeds, for every density and arithmetic."""
    table = []
    for density in plan.densities:
        found = {}
        for seed in range(1, plan.seeds + 1):
            run = Run(f"gas-{density}", until_s=0.5, budget_s=plan.horizon_budget_s, samples=1,
                      steps="0.5")
            for row in measured(run, build, work, seed):
                if row["horizon_s"] is not None:
                    found.setdefault(row["method"], []).append(row)
        for method, rows in found.items():
            table.append(horizon_of(density, method, rows))
    return table


def horizon_of(density, method, rows):
    collisions = [row["horizon_collisions_per_disk"] for row in rows]
    seconds = [row["horizon_s"] for row in rows]
    return {"area_fraction": float(density), "method": method, "digits": rows[0]["digits"],
            "seeds": len(rows),
            "collisions_per_disk": statistics.mean(collisions),
            "deviation": statistics.stdev(collisions) if len(collisions) > 1 else 0,
            "horizon_s": statistics.mean(seconds),
            "at_least": max(row["horizon_at_least"] for row in rows)}


def curves(rows, *columns):
    return [{key: row[key] for key in ("method", "step_s") + columns} for row in rows]


WORK_TIME_S = 2


def work_and_precision(rows):
    """Cost and error of every method after two seconds, 2.5 collisions a disk."""
    times = sorted({row["time_s"] for row in rows})
    time_s = min(times, key=lambda t: abs(t - WORK_TIME_S))
    return curves([row for row in rows if row["time_s"] == time_s], "time_s", "cpu_s_per_s",
                  "cpu_ratio", "position_error_rms_m")


def run(plan, build, work):
    """All runs of a plan, as tables by name."""
    growth = measured(plan.growth, build, work)
    methods = []
    for one in plan.comparisons:
        methods += methods_of(measured(one, build, work))
    energy = measured(plan.energy, build, work)
    return {"costs": methods_of(growth),
            "methods": methods,
            "work_precision": work_and_precision(growth),
            "error_growth": curves(growth, "time_s", "position_error_rms_m"),
            "horizon": horizons(plan, build, work),
            "energy": curves(energy, "collisions", "energy_error")}


def write_csv(path, rows):
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({key: f"{value:.4g}" if isinstance(value, float) else value
                             for key, value in row.items()})
