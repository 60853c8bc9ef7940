# SPDX-License-Identifier: Apache-2.0
"""The runs of the bench, and on what they were made."""

import dataclasses
import datetime
import json
import os
import pathlib
import platform
import re
import shlex
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

# All engines and the daemon get their memory as deploy/run has the daemon get it: in large pages.
ENVIRONMENT = {**os.environ, "GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"}


@dataclasses.dataclass(frozen=True)
class Plan:
    build: pathlib.Path
    rounds: int
    quick: bool
    large: bool
    only: str  # an expression, or empty


def output_of(*command, folder=ROOT):
    """What a command prints, or an empty text when it cannot."""
    try:
        return subprocess.run(command, cwd=folder, check=True, capture_output=True,
                              text=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


# On what it was measured ------------------------------------------------------------------------


def processor():
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text()
        return re.search(r"model name\s*:\s*(.*)", text).group(1)
    except (OSError, AttributeError):
        return platform.machine()


def engine_flags(build):
    """How the engine's double world was compiled: compiler and flags, without paths."""
    commands = json.loads((build / "compile_commands.json").read_text())
    for entry in commands:
        if entry["file"].endswith("engine/src/world_double.cpp"):
            words = shlex.split(entry["command"])
            compiler = next(word for word in words if "++" in pathlib.Path(word).name)
            flags = [word for word in words
                     if word.startswith(("-O", "-m", "-f", "-std", "-g", "-D")) and "/" not in word]
            return compiler, " ".join(flags)
    return "c++", ""


def has_large_pages():
    """Does the system give pages of 2 MB to whoever asks for them?"""
    try:
        text = pathlib.Path("/sys/kernel/mm/transparent_hugepage/enabled").read_text()
    except OSError:
        return False
    return "[never]" not in text


def circumstances(plan):
    compiler, flags = engine_flags(plan.build)
    changed = output_of("git", "status", "--porcelain", "--untracked-files=no", "--", "engine")
    return {"processor": processor(), "cores": os.cpu_count(), "system": platform.system(),
            "compiler": output_of(compiler, "--version").split("\n")[0], "flags": flags,
            "commit": output_of("git", "rev-parse", "--short=12", "HEAD"),
            "engine_changed_since": bool(changed),
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
            "large_pages": has_large_pages(), "rounds": plan.rounds, "quick": plan.quick,
            "load_before": os.getloadavg()[0]}


# Runs -------------------------------------------------------------------------------------------


def benchmarks_of(program, options):
    names = subprocess.run([program, *options, "--benchmark_list_tests"], check=True,
                           capture_output=True, text=True).stdout.splitlines()
    return [name for name in names if name]


def measured(program, options, name):
    """The one row that a benchmark writes."""
    literal = re.sub(r"([.+*?()\[\]{}^$|\\])", r"\\\1", name)  # as POSIX spells it
    with tempfile.NamedTemporaryFile("r", suffix=".json") as out:  # other engines print, too
        command = [program, *options, f"--benchmark_filter=^{literal}$",
                   f"--benchmark_out={out.name}", "--benchmark_out_format=json"]
        subprocess.run(command, check=True, capture_output=True, env=ENVIRONMENT)
        row = json.load(out)["benchmarks"][0]
    if row.get("error_occurred"):
        raise subprocess.CalledProcessError(1, command, row.get("error_message"))
    return row


NOT_FIGURES = {"family_index", "per_family_instance_index", "repetitions", "repetition_index",
               "threads", "iterations"}


def medians(rows):
    """The median of every figure over the rounds."""
    figures = [key for key, value in rows[0].items()
               if isinstance(value, (int, float)) and key not in NOT_FIGURES]
    return {key: statistics.median(row[key] for row in rows if key in row) for key in figures}


def rounds_of(plan, program, options=()):
    """Every benchmark of a program by name, with its rows of all rounds. A round does all of them
    once, so that what else the machine does falls on all."""
    path = plan.build / "bin" / program
    names = [name for name in benchmarks_of(path, options) if re.search(plan.only, name)]
    found = {name: [] for name in names}
    for turn in range(plan.rounds):
        for name in names:
            print(f"bench: round {turn + 1}: {name}", file=sys.stderr, flush=True)
            found[name].append(measured(path, options, name))
    return found


def world_row(name, rows):
    """scene/engine/disks[/area percent or kind]/... as a row of the table."""
    scene, engine, disks, *rest = name.split("/")
    row = {"scene": scene, "engine": engine, "disks": int(disks)}
    if rest and rest[0].isdigit():
        row["area_fraction"] = int(rest[0]) / 100
    elif rest and not rest[0].startswith("iterations"):
        row["kind"] = rest[0]
    figures = medians(rows)
    time = figures.pop("real_time")
    row["ns"] = time * {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}[rows[0]["time_unit"]]
    figures.pop("cpu_time")
    if len(rows) > 1 and "ns_per_collision" in rows[0]:
        costs = [r["ns_per_collision"] for r in rows]
        row["spread"] = (max(costs) - min(costs)) / statistics.median(costs)
    return {**figures, **row}


def daemon(plan):
    """What publishing costs beside raw DDS, by publish_bench. Nothing where it is not built."""
    program = plan.build / "tests/publish_bench"
    if not program.exists() or not re.search(plan.only, "daemon"):
        return {}
    print("bench: publish_bench", file=sys.stderr, flush=True)
    before = os.getloadavg()[0]
    with tempfile.NamedTemporaryFile("r", suffix=".json") as out:
        subprocess.run([program, "--seconds", "2" if plan.quick else "6", "--pace", "15",
                        "--rounds", str(plan.rounds), "--json", out.name],
                       check=True, capture_output=True, env=ENVIRONMENT)
        return {**json.load(out), "load_before": before, "load_after": os.getloadavg()[0]}


def run(plan):
    """All of it, as it is written to the results file."""
    results = circumstances(plan)
    options = [flag for flag, on in (("--quick", plan.quick), ("--large", plan.large)) if on]
    worlds = rounds_of(plan, "engine_bench", options)
    worlds.update(rounds_of(plan, "load_bench", options[:1] if plan.quick else []))
    results["worlds"] = [world_row(name, rows) for name, rows in worlds.items()]
    for program in ("kernel_bench", "queue_bench"):
        found = rounds_of(plan, program)
        results[program] = {name: medians(rows)["cpu_time"] for name, rows in found.items()}
    results["daemon"] = daemon(plan)
    results["load_after"] = os.getloadavg()[0]
    return results
