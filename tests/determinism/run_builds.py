#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds the engine in many ways and fails unless every build gives the pinned digests.

    run_builds.py --source ROOT --work DIR [--include DIR]... [--jobs N] [--list]

Compilers g++ and clang++, each without optimisation and with -O3, on x86-64 each for the
baseline and
with fused multiply-adds (x86-64-v3, where the processor has it). Programs are kept in DIR and built
anew when a source, a flag or a compiler changes.
"""

import argparse
import concurrent.futures
import hashlib
import json
import pathlib
import platform
import shutil
import subprocess
import sys

# As the engine's own CMakeLists.txt has them.
FLAGS = ["-std=c++20", "-ffp-contract=off", "-DEIGEN_DONT_VECTORIZE", "-DNDEBUG", "-w",
         "-DSTOSS_WHOLE_ENGINE"]
V3 = {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe"}
MISSING = 77  # ctest: skipped


def compilers():
    """The name and path of each kind of compiler that is there."""
    for kind, names in (("g++", ["g++"]), ("clang++", ["clang++", "clang++-14"])):
        path = next((shutil.which(name) for name in names if shutil.which(name)), None)
        if path:
            yield kind, path


def architectures():
    """Flags per instruction set that this machine can run."""
    if platform.machine() not in ("x86_64", "AMD64"):
        return {"native": []}
    known = {"x86-64": ["-march=x86-64"]}
    info = pathlib.Path("/proc/cpuinfo")
    words = set(info.read_text(encoding="utf-8").split()) if info.exists() else set()
    if V3 <= words:
        known["x86-64-v3"] = ["-march=x86-64-v3"]
    return known


def variants():
    for kind, path in compilers():
        for level in ("-O0", "-O3"):
            for name, flags in architectures().items():
                yield f"{kind}{level}-{name}", path, [level, *flags]


def digest_of_sources(source):
    digest = hashlib.sha256()
    folders = ["engine/include", "engine/src", "tests/determinism", "tests/support"]
    for folder in folders:
        for path in sorted((source / folder).rglob("*")):
            if path.suffix in (".hpp", ".cpp"):
                digest.update(path.read_bytes())
    return digest


def build(variant, source, work, includes, sources):
    """Returns the program, or raises CalledProcessError."""
    name, compiler, flags = variant
    program = work / name
    command = [compiler, *FLAGS, *flags]
    for folder in ("engine/include", "engine/src", "tests"):
        command += ["-I", str(source / folder)]
    for folder in includes:
        command += ["-isystem", folder]
    command += [str(source / "tests/determinism/scene_hash.cpp"), "-o", str(program)]
    key = sources.copy()
    key.update(subprocess.check_output([compiler, "--version"]))
    key.update("\0".join(command).encode())
    stamp = program.with_suffix(program.suffix + ".key")
    if program.exists() and stamp.exists() and stamp.read_text() == key.hexdigest():
        return program
    stamp.unlink(missing_ok=True)
    subprocess.run(command, check=True, capture_output=True, text=True)
    stamp.write_text(key.hexdigest())
    return program


def digests(program, table, scenes):
    output = subprocess.run([str(program), str(table), str(scenes)], check=True,
                            capture_output=True, text=True).stdout
    return {row["scene"]: row for row in json.loads(output)}


def differences(name, found, pinned):
    for scene, row in pinned.items():
        for key, value in row.items():
            if found[scene].get(key) != value:
                yield f"{name}: {scene}: {key} is {found[scene].get(key)}, not {value}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--include", action="append", default=[])
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--list", action="store_true", help="print the builds and exit")
    arguments = parser.parse_args()
    chosen = list(variants())
    if arguments.list:
        print("\n".join(name for name, _, _ in chosen))
        return 0
    if len({name.split("-O")[0] for name, _, _ in chosen}) < 2:
        print("skipped: only one compiler is installed; install g++ and clang")
        return MISSING

    arguments.work.mkdir(parents=True, exist_ok=True)
    table = arguments.source / "tests/determinism/hashes.json"
    scenes = arguments.source / "clients/scenes"
    pinned = {row["scene"]: row for row in json.loads(table.read_text(encoding="utf-8"))}
    sources = digest_of_sources(arguments.source)

    def check(variant):
        try:
            program = build(variant, arguments.source, arguments.work, arguments.include, sources)
            return list(differences(variant[0], digests(program, table, scenes), pinned))
        except subprocess.CalledProcessError as error:
            return [f"{variant[0]}: {' '.join(map(str, error.cmd))}\n{error.stderr}"]

    failures = []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for variant, wrong in zip(chosen, pool.map(check, chosen)):
            print(f"{variant[0]}: {'differs' if wrong else 'the same'}", flush=True)
            failures += wrong
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
