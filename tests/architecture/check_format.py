#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails when clang-format would change a C++ file of the tree.

    check_format.py ROOT

Other versions of clang-format lay out differently; without version 14 the test counts as skipped
(exit status 77).
"""

import pathlib
import re
import shutil
import subprocess
import sys

import source

SKIPPED = 77
VERSION = 14


def clang_format():
    """The path of clang-format 14, or None."""
    for name in (f"clang-format-{VERSION}", "clang-format"):
        path = shutil.which(name)
        if path is None:
            continue
        said = subprocess.run([path, "--version"], capture_output=True, text=True, check=True)
        if re.search(rf"version {VERSION}\.", said.stdout):
            return path
    return None


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    root = pathlib.Path(sys.argv[1])
    program = clang_format()
    if program is None:
        print(f"clang-format {VERSION} is not installed")
        return SKIPPED
    paths = [p for p in source.files(root) if p.endswith((".hpp", ".cpp", ".h", ".cc"))]
    command = [program, "--dry-run", "-Werror", "--ferror-limit=1", *paths]
    result = subprocess.run(command, cwd=root, stderr=subprocess.PIPE, text=True, check=False)
    wrong = sorted(set(re.findall(r"^(.+?):\d+:\d+: error", result.stderr, re.MULTILINE)))
    for path in wrong:
        print(f"{path}: run clang-format -i on it")
    if result.returncode != 0 and not wrong:
        print(result.stderr)
    return 1 if result.returncode != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
