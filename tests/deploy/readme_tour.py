#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the README's tour as it is printed, against a daemon in a domain of its own.

    readme_tour.py SOURCE_DIR BIN_DIR

Every line of the tour must succeed. Commands that run until they are interrupted get two seconds
and an interrupt, and must have printed something.
"""

import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import time

DOMAIN = "101"
WORLD = f"tour-{os.getpid()}"
ENDLESS = ("collisions", "top", "states")


def tour(readme):
    """The command lines of the shell blocks of the section `A minute with it`."""
    section = readme.split("\n## A minute with it\n", 1)[1].split("\n## ", 1)[0]
    lines = "\n".join(re.findall(r"```sh\n(.*?)```", section, re.DOTALL)).splitlines()
    words = [shlex.split(line, comments=True) for line in lines]
    return [w for w in words if w and w[0] in ("stossd", "stoss")]


def run(command):
    """Runs a command of the tour and returns whether it did as promised."""
    endless = command[1] in ENDLESS
    print("$", *command, flush=True)
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        output, _ = process.communicate(timeout=2 if endless else 30)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=10)
        if not endless:
            print(output, "did not end by itself")
            return False
        print(output[:2000])
        return output != ""
    print(output[:2000])
    return process.returncode == 0


def main():
    source, programs = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
    os.chdir(source)
    os.environ["PATH"] = f"{programs}:{os.environ['PATH']}"
    place = ["--world", WORLD, "--domain", DOMAIN]
    commands = tour((source / "README.md").read_text(encoding="utf-8"))
    daemons = [c for c in commands if c[0] == "stossd"]
    verbs = [c for c in commands if c[0] == "stoss"]
    if len(daemons) != 1 or len(verbs) < 5:
        print(f"the README's tour has {len(daemons)} daemons and {len(verbs)} commands")
        return 1

    daemon = subprocess.Popen(daemons[0] + place, stderr=subprocess.DEVNULL)
    try:
        status = ["stoss", "status", *place, "--timeout", "1"]
        deadline = time.monotonic() + 20
        while subprocess.run(status, capture_output=True, check=False).returncode != 0:
            if daemon.poll() is not None or time.monotonic() > deadline:
                print("the daemon does not answer")
                return 1
        failed = [c for c in verbs if not run(c if c[1] == "simulate" else c + place)]
    finally:
        daemon.terminate()
        ended = daemon.wait(timeout=10)
    for command in failed:
        print("failed:", *command)
    return 1 if failed or ended != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
