# SPDX-License-Identifier: Apache-2.0
"""Reads the tree: its files and their kinds, C++ without its comments, and its functions."""

import os
import pathlib
import re

TOP_FILES = ("CMakeLists.txt", "CMakePresets.json", "README.md", "CHANGELOG.md")
TOP_FOLDERS = ("engine", "idl", "service", "clients", "tests", "deploy", ".ci")
SKIPPED_FOLDERS = {"build", "__pycache__", "node_modules"}

_TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<d>[^(\s]*)\(.*?\)(?P=d)"'
    r'|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\'', re.DOTALL)


def files(root):
    """Paths, relative to the root and with forward slashes, of every file that is ours."""
    found = [root / name for name in TOP_FILES if (root / name).is_file()]
    for top in TOP_FOLDERS:
        for folder, folders, names in os.walk(root / top):
            folders[:] = sorted(f for f in folders if f not in SKIPPED_FOLDERS)
            found += [pathlib.Path(folder) / name for name in sorted(names)]
    return [path.relative_to(root).as_posix() for path in found]


def kinds(path, text):
    """The kinds of a file: header (also cpp), cpp, contract, cmake, script, page."""
    name, suffix = path.rsplit("/", 1)[-1], pathlib.PurePosixPath(path).suffix
    if suffix in (".hpp", ".h"):
        return {"header", "cpp"}
    if suffix in (".cpp", ".cc", ".c", ".inl"):
        return {"cpp"}
    if suffix in (".idl", ".proto"):
        return {"contract"}
    if suffix == ".cmake" or name == "CMakeLists.txt":
        return {"cmake"}
    if suffix in (".py", ".sh") or text.startswith("#!"):
        return {"script"}
    return {"page"} if suffix == ".md" else set()


def _blank(match):
    return re.sub(r"[^\n]", " ", match.group())


def code_only(text):
    """C++ with comments and literals blanked; lines and columns stay. Includes are kept."""
    includes = re.compile(r"^[ \t]*#[ \t]*include[^\n]*", re.MULTILINE)
    kept = {m.start(): m.group() for m in includes.finditer(text)}
    blanked = _TOKEN.sub(_blank, text)
    for start, line in kept.items():
        if blanked[start:start + len(line)].strip():  # not inside a comment
            line = re.sub(r"//.*|/\*.*", _blank, line)
            blanked = blanked[:start] + line + blanked[start + len(line):]
    return blanked


def without_hash_comments(text):
    return re.sub(r"(^|[ \t])#[^\n]*", _blank, text, flags=re.MULTILINE)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


_SCOPE = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b")
_LEAD = re.compile(r"\s*((public|private|protected)\s*:\s*)*")
_TEMPLATE_HEAD = re.compile(r"^\s*template\s*<")
_CONTROL = re.compile(r"^\s*(if|for|while|switch|do|else|try|catch|return)\b")


def _strip_template(head):
    """A head without its template<...> and attributes, where `class` means something else."""
    if not _TEMPLATE_HEAD.match(head):
        return head
    depth = 0
    for i, c in enumerate(head):
        depth += (c == "<") - (c == ">" and head[i - 1] != "-")
        if c == ">" and depth == 0:
            return _strip_template(head[i + 1:])
    return head


def _opens(head, before):
    """What a brace opens: scope, function or other. `before` is the character before it."""
    head = _strip_template(head)
    if _CONTROL.match(head):
        return "other"
    if _SCOPE.search(head) and "(" not in _SCOPE.split(head)[-1]:
        return "scope"
    # A function's body is set off by a space; an initialiser is not, or follows an =.
    if ")" in head and before.isspace() and not head.rstrip().endswith(("=", ",", "(")):
        return "function"
    return "other"


def functions(code):
    """(first line, last line) of every function at namespace or class scope, of code_only text."""
    code = re.sub(r"^[ \t]*#[^\n]*(\\\n[^\n]*)*", _blank, code, flags=re.MULTILINE)
    stack, found, head_start = [], [], 0
    for match in re.finditer(r"[{};]", code):
        i, c = match.start(), match.group()
        if c == "{":
            inside = bool(stack) and stack[-1][0] != "scope"
            kind = "other" if inside else _opens(code[head_start:i], code[i - 1:i])
            stack.append((kind, head_start))
            head_start = i + 1
        elif c == "}" and stack:
            kind, start = stack.pop()
            if kind == "function":
                first = start + _LEAD.match(code[start:]).end()
                found.append((line_of(code, first), line_of(code, i)))
            # An initialiser's braces do not end the declaration that they stand in.
            head_start = start if kind == "other" else i + 1
        elif c == ";":
            head_start = i + 1
    return found
