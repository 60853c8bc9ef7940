#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does a plain world's event loop call anything of an effect?

    check_plain_loop.py OBJECT

OBJECT holds the event loops of a plain world and of one with effects, with no function inlined and
with debug information.
From each loop's entry, `advance_to`, every function that can be reached by calls is taken. None of
the plain world's may be one that an effect's file defines; of the other world's some must be, else
this check sees nothing. A function that does nothing but return is no call: inlined, it is gone.

Exit status: 0 as it should be; 1 not; 77 a tool is missing.
"""
import re
import shutil
import subprocess
import sys

# The files of effects. What they define is theirs; what they include is not.
EFFECT_FILES = [
    "basic_world_rest.hpp",
    "basic_world_switch.hpp",
    "basic_world_thermostat.hpp",
    "basic_world_zones.hpp",
    "contact_law/restitution.hpp",
    "contact_law/rough.hpp",
    "contact_time/accelerated.hpp",
    "contact_time/accelerated_disk_disk.hpp",
    "contact_time/accelerated_disk_wall.hpp",
    "contact_law/growing.hpp",
    "contact_time/curved_rim_crossing.hpp",
    "contact_time/drag.hpp",
    "contact_time/drag_clock.hpp",
    "contact_time/drag_curve.hpp",
    "contact_time/drag_face.hpp",
    "contact_time/gap_curve.hpp",
    "contact_time/gap_search.hpp",
    "contact_time/growing.hpp",
    "contact_time/rim_crossing.hpp",
    "elementary.hpp",
    "motion_law/accelerated.hpp",
    "motion_law/drag.hpp",
    "motion_law/floor_friction.hpp",
    "motion_law/growth.hpp",
    "motion_law/rest.hpp",
    "motion_law/thermostat.hpp",
    "periodic.hpp",
    "philox.hpp",
    "sight_frames.hpp",
    "zone_passages.hpp",
]
SECTION = re.compile(r"^Relocation section '\.rela\.text(?:\.unlikely|\.hot)?\.(_Z[^']+)'")
CALL = re.compile(r"R_\S+\s+\S+\s+(_Z[^\s+-]+)")
EMPTY_SIZE = 6  # bytes; with no call in it, a function of that size only returns a constant


def defined_in(object_file):
    """mangled name -> the engine's source file that defines it, from the debug information"""
    text = subprocess.run(["nm", "--line-numbers", "--defined-only", object_file], check=True,
                          capture_output=True, text=True).stdout
    files = {}
    for line in text.splitlines():
        symbol, _, place = line.partition("\t")
        if "/engine/src/" in place:
            files[symbol.split()[-1]] = place.rsplit("/engine/src/", 1)[1].rsplit(":", 1)[0]
    return files


def functions_of(object_file):
    """mangled name -> (names it refers to, whether it does anything)"""
    sizes = subprocess.run(["nm", "--print-size", "--defined-only", object_file], check=True,
                           capture_output=True, text=True).stdout
    functions = {}
    for line in sizes.splitlines():
        fields = line.split()
        if len(fields) == 4 and fields[2] in "TtWw":
            functions[fields[3]] = [set(), int(fields[1], 16) > EMPTY_SIZE]
    relocations = subprocess.run(["readelf", "--relocs", "--wide", object_file], check=True,
                                 capture_output=True, text=True).stdout
    name = None
    for line in relocations.splitlines():
        if line.startswith("Relocation section"):
            match = SECTION.match(line)
            name = match.group(1) if match and match.group(1) in functions else None
        elif name and (match := CALL.search(line)):
            functions[name][0].add(match.group(1))
            functions[name][1] = True
    return functions


def demangled(names):
    text = subprocess.run(["c++filt"], input="\n".join(names), check=True, capture_output=True,
                          text=True).stdout
    return dict(zip(names, text.splitlines()))


def reached_from(entry, functions):
    seen, waiting = {entry}, [entry]
    while waiting:
        for name in functions[waiting.pop()][0]:
            if name in functions and name not in seen:
                seen.add(name)
                waiting.append(name)
    return seen


def effects_reached(laws, functions, readable, files):
    entries = [n for n in functions
               if f"{laws}>::advance_to(" in readable[n] and "clone" not in readable[n]]
    if len(entries) != 1:
        sys.exit(f"the loop of {laws} is not in the object, or more than once: {entries}")
    reached = reached_from(entries[0], functions)
    print(f"{laws}: {len(reached)} functions in the loop")
    return {f"{readable[n]}, of {files[n]}" for n in reached
            if functions[n][1] and files.get(n) in EFFECT_FILES}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    if not all(shutil.which(tool) for tool in ("nm", "readelf", "c++filt")):
        print("needs nm, readelf and c++filt")
        return 77
    functions = functions_of(sys.argv[1])
    readable = demangled(list(functions))
    files = defined_in(sys.argv[1])
    plain = effects_reached("PlainLaws", functions, readable, files)
    curved = effects_reached("AcceleratedLaws", functions, readable, files)
    for name in sorted(plain):
        print(f"a plain world's event loop calls {name}")
    if not plain and len(curved) < 10:
        print("the other world's loop calls too little of the effects: this check sees nothing")
        return 1
    print(f"{len(curved)} functions of effects in the other world's loop")
    return 1 if plain else 0


if __name__ == "__main__":
    sys.exit(main())
