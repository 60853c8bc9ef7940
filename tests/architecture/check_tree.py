#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails when the tree breaks a rule of its architecture or style, and says what to do instead.

    check_tree.py ROOT

The rules are data in rules.py; self_test.py proves that each check fires.
"""

import pathlib
import re
import sys

import rules
import source

_INCLUDE = re.compile(r"^[ \t]*#[ \t]*include[ \t]*([<\"])([^>\"]+)[>\"]", re.MULTILINE)
_STANDARD = re.compile(r"^[a-z_0-9]+$")


class File:
    """A file of the tree with the views of it that the checks need."""

    def __init__(self, root, path):
        self.path = path
        self.text = (root / path).read_text(encoding="utf-8", errors="replace")
        self.kinds = source.kinds(path, self.text)
        self.room = room_of(path)
        self.code = self.text
        if "cpp" in self.kinds or "contract" in self.kinds:
            self.code = source.code_only(self.text)
        elif self.kinds & {"cmake", "script"}:
            self.code = source.without_hash_comments(self.text)

    def at(self, position, message):
        return f"{self.path}:{source.line_of(self.text, position)}: {message}"


def room_of(path):
    prefixes = [prefix for prefix in rules.ROOMS if path.startswith(prefix)]
    return rules.ROOMS[max(prefixes, key=len)] if prefixes else None


class Tree:
    def __init__(self, root):
        self.root = root
        paths = source.files(root)
        self.all_paths = set(paths)
        self.files = [File(root, p) for p in paths if self._is_text(p)]
        # Folders that <...> and "..." are looked up in, besides the including file's own.
        self.include_folders = sorted(
            {p[:p.index("/include/") + 9] for p in paths if "/include/" in p}
            | {p[:p.index("/src/") + 5] for p in paths if "/src/" in p} | set(rules.ROOMS))

    @staticmethod
    def _is_text(path):
        return not path.endswith((".json", ".binpb", ".png", ".csv"))

    def resolve(self, file, name, quoted):
        """The path in the tree that an include means, or None."""
        candidates = [f"{folder}{name}" for folder in self.include_folders]
        if quoted:
            candidates.insert(0, (pathlib.PurePosixPath(file.path).parent / name).as_posix())
        for candidate in candidates:
            parts = []
            for part in candidate.split("/"):
                if part == ".." and parts:
                    parts.pop()
                elif part not in (".", ""):
                    parts.append(part)
            if "/".join(parts) in self.all_paths:
                return "/".join(parts)
        return None


def included_room(tree, file, name, quoted):
    """(room, whether the header is private to it), or (None, False) for an outside header."""
    path = tree.resolve(file, name, quoted)
    if path is not None:
        return room_of(path), "/include/" not in path
    if rules.GENERATED.match(name):
        return "idl", False
    parts = name.split("/")
    if parts[0] == "stoss" and len(parts) > 2:
        return rules.ROOM_OF_PUBLIC_FOLDER.get(parts[1], parts[1]), False
    return None, False


def check_includes(tree):
    """Who may know whom, and no clock, thread, stream or die in the engine."""
    for file in tree.files:
        if "cpp" not in file.kinds or file.room is None:
            continue
        rooms, outside = rules.MAY_KNOW[file.room]
        for match in _INCLUDE.finditer(file.code):
            name = match.group(2)
            room, private = included_room(tree, file, name, match.group(1) == '"')
            if room == "tests" and file.room != "tests":
                yield file.at(match.start(), f"includes {name}: nobody knows tests")
            elif room is not None and room != file.room and room not in rooms:
                yield file.at(match.start(), f"includes {name}: {file.room} may not know {room}")
            elif room is not None and room != file.room and private and \
                    room not in rules.MAY_SEE_PRIVATE.get(file.room, ()):
                yield file.at(match.start(), f"includes {name}: a private header of {room}")
            elif room is None and file.room in ("engine", "wide") and \
                    name in rules.ENGINE_BANNED_HEADERS:
                instead = rules.ENGINE_BANNED_HEADERS[name]
                yield file.at(match.start(), f"includes <{name}> in {file.room}: {instead}")
            elif room is None and not _STANDARD.match(name) and \
                    not re.fullmatch(outside, name):
                yield file.at(match.start(), f"includes {name}: {file.room} knows no such library")


def check_raw_dds(tree):
    """Raw DDS only behind the RAII types."""
    for file in tree.files:
        if "cpp" not in file.kinds or file.path.startswith(rules.RAW_DDS_FOLDERS):
            continue
        for match in _INCLUDE.finditer(file.code):
            if match.group(2).startswith("dds/"):
                yield file.at(match.start(), f"includes {match.group(2)}: use <stoss/dds/...>")
        for match in rules.RAW_DDS_CALL.finditer(file.code):
            yield file.at(match.start(), f"raw DDS '{match.group().strip('( ')}': use stoss::dds")


def check_cmake_walls(tree):
    """A room's build may not link what its sources may not include."""
    for file in tree.files:
        banned = rules.CMAKE_BANNED.get(file.room)
        if "cmake" not in file.kinds or banned is None:
            continue
        for match in re.finditer(banned, file.code):
            yield file.at(match.start(), f"{file.room} may not link {match.group()}")


def check_headers(tree):
    """SPDX line first, #pragma once, and the words that numerics owe their reader."""
    for file in tree.files:
        if not file.kinds - {"page"}:
            continue
        first = file.text.split("\n", 2)
        line = first[1] if first[0].startswith("#!") and len(first) > 1 else first[0]
        if not re.fullmatch(r"(//|#) SPDX-License-Identifier: Apache-2\.0", line):
            yield f"{file.path}:1: begin with 'SPDX-License-Identifier: Apache-2.0' in a comment"
        if "header" in file.kinds and "#pragma once" not in file.code:
            yield f"{file.path}:1: a header needs #pragma once"
        if rules.NUMERICS.search(file.path):
            for word in rules.NUMERICS_WORDS:
                if word not in file.text:
                    yield f"{file.path}:1: a file of numerics says '{word}' in its opening"


def check_lines(tree):
    for file in tree.files:
        if not file.kinds & {"cpp", "contract", "script"}:
            continue
        for number, line in enumerate(file.text.split("\n"), 1):
            if len(line) > rules.COLUMNS_MAX:
                yield f"{file.path}:{number}: {len(line)} columns; at most {rules.COLUMNS_MAX}"
            elif line != line.rstrip():
                yield f"{file.path}:{number}: blanks at the end of the line"


def check_functions(tree):
    for file in tree.files:
        if "cpp" not in file.kinds:
            continue
        for first, last in source.functions(file.code):
            if last - first + 1 > rules.FUNCTION_LINES_MAX:
                yield (f"{file.path}:{first}: a function of {last - first + 1} lines; split it, at "
                       f"most {rules.FUNCTION_LINES_MAX}")


def check_words(tree):
    """Banned words, each with its replacement. The rules and their test must name them."""
    for file in tree.files:
        if file.path.startswith("tests/architecture/"):
            continue
        for pattern, instead in rules.BANNED_ANYWHERE:
            for match in pattern.finditer(file.text):
                yield file.at(match.start(), f"'{match.group()}': {instead}")
        for rooms, kinds, pattern, instead in rules.BANNED_IN_CODE:
            if not file.kinds & set(kinds) or (rooms is not None and file.room not in rooms):
                continue
            for match in pattern.finditer(file.code):
                yield file.at(match.start(), f"'{match.group().strip('( ')}': {instead}")


def check_unordered(tree):
    """In the engine, hash tables may be asked but not walked: their order is the library's."""
    declared = re.compile(r"\bunordered_(?:multi)?(?:map|set)\s*<[^;{}()]*>\s*(\w+)\s*[;={]")
    engine = [f for f in tree.files if f.room == "engine" and "cpp" in f.kinds]
    names = {name for file in engine for name in declared.findall(file.code)}
    if not names:
        return
    alternatives = "|".join(sorted(names))
    walked = re.compile(rf":\s*({alternatives})\s*\)|\b({alternatives})\s*\.\s*c?begin\s*\(")
    for file in engine:
        for match in walked.finditer(file.code):
            name = match.group(1) or match.group(2)
            yield file.at(match.start(), f"walks the hash table {name}: walk a sorted copy of its "
                          "keys, or keep them in a vector")


CHECKS = (check_includes, check_raw_dds, check_cmake_walls, check_headers, check_lines,
          check_functions, check_words, check_unordered)


def violations(root):
    tree = Tree(pathlib.Path(root))
    return [message for check in CHECKS for message in check(tree)]


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    found = violations(sys.argv[1])
    for message in found:
        print(message)
    print(f"{len(found)} violations" if found else "the tree keeps its rules")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
