#!/usr/bin/env python3
"""Tells which functions of the C API each binding calls: the table of docs/reference/bindings.md.

    python3 bindings/coverage.py            write docs/reference/bindings.md
    python3 bindings/coverage.py --check    fail if docs/reference/bindings.md is not what the bindings say, or a binding misses a function

A binding is a line of LANGUAGES. Its hand-written layer is scanned, not the generated low-level one: what counts is what a user reaches.
A binding that is not there yet is left out of the table.
"""

from __future__ import annotations

import argparse
import ast
import json
import re
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

BINDINGS = Path(__file__).resolve().parent
ROOT = BINDINGS.parent
PAGE = ROOT / "docs" / "reference" / "bindings.md"

#: For each function of the API, from where in a binding it is called.
Calls = dict[str, list[str]]


@dataclass(frozen=True)
class Language:
    """A binding: its name, its guide, the files that users' calls go through, and how these are scanned."""

    name: str
    guide: str
    files: tuple[str, ...]
    scan: Callable[[Iterable[Path]], Calls]


def python_calls(paths: Iterable[Path]) -> Calls:
    """Uses of functions.shx_..., by the class and function they are in. Initializers are called by name, for each generated record."""
    calls: Calls = {}

    def visit(node: ast.AST, names: tuple[str, ...]) -> None:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names = (*names, node.name)
        if isinstance(node, ast.Attribute) and node.attr.startswith("shx_") and isinstance(node.value, ast.Name) and node.value.id == "functions":
            calls.setdefault(node.attr, []).append(public_name(names))
        # Record classes and initialize(_capi.shx_x()) call the structure's initializer.
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "_capi":
            calls.setdefault(f"{node.attr}_init", []).append(public_name(names))
        for child in ast.iter_child_nodes(node):
            visit(child, names)

    for path in paths:
        visit(ast.parse(path.read_text(encoding="utf-8")), ())
    return calls


#: Parts of Python's Solver, which users know by that name alone.
PARTS = {"SolverBase", "Strands", "Shapes", "Posing", "Sampling", "Bodies", "Contact", "Constraints", "Styling", "Stepping"}


def public_name(names: tuple[str, ...]) -> str:
    """The Python expression for a function of the binding."""
    outer = ["Solver" if name in PARTS else name for name in names]
    shown: list[str] = []
    for name in outer:
        if shown and not shown[-1][0].isupper():
            # A function within a function.
            break
        shown.append(name)
    if len(shown) == 2 and shown[1].startswith("_"):
        return shown[0]
    return ".".join(shown)


#: How a class, and a function that users call, begin in C++ and in C#.
CPP = (
    re.compile(r"^(?:class|struct) (\w+)"),
    re.compile(r"^(?:  )?(?:explicit |inline |static |const )*(?:[\w:]+(?:<.*>)?[ &*]+)?(\w+)\((?:[^;]*$|.*\{)"),
)
CSHARP = (
    re.compile(r"^  (?:public |internal )?(?:sealed |static |unsafe |partial )*(?:class|struct) (\w+)"),
    re.compile(r"^    (?:public|protected)[\w ]* [\w.<>\[\]?]+ (\w+)(?:\(|$| \{)|^    public (\w+)\("),
)


def code_calls(paths: Iterable[Path], patterns: tuple[re.Pattern[str], re.Pattern[str]]) -> Calls:
    """Functions named in code, comments and strings left out, by the class and function that they are in."""
    outer, inner = patterns
    calls: Calls = {}
    for path in paths:
        text = path.read_text(encoding="utf-8")
        text = re.sub(r"//[^\n]*|\"(?:\\.|[^\"\\\n])*\"", " ", text)
        kind = name = ""
        for line in text.splitlines():
            if match := outer.match(line):
                kind, name = re.sub(r"^solver_(?!def)\w+", "solver", match[1]), ""
            elif line.startswith(("inline ", "}")):
                kind = ""
            if match := inner.match(line):
                name = next(group for group in match.groups() if group)
            for function in re.findall(r"\bshx_\w+", line):
                place = kind if name in ("", kind) else f"{kind}.{name}".lstrip(".")
                calls.setdefault(function, []).append(place.replace(".", "::") if patterns is CPP else place)
    return calls


def cpp_calls(paths: Iterable[Path]) -> Calls:
    """Functions that the C++ headers call."""
    return code_calls(paths, CPP)


def csharp_calls(paths: Iterable[Path]) -> Calls:
    """Functions that the C# sources call."""
    return code_calls(paths, CSHARP)


LANGUAGES = (
    Language("Python", "python.md", ("python/src/superhelix/*.py", "python/src/superhelix/solver/*.py"), python_calls),
    Language("C++", "cpp.md", ("cpp/include/**/*.hpp",), cpp_calls),
    Language("C#", "csharp.md", ("csharp/com.superhelix.hair/Runtime/**/*.cs",), csharp_calls),
)

#: Generated files: they name everything, but users do not call them.
GENERATED = ("_capi.py", "Native.cs", "NativeMethods.cs")


def files_of(language: Language) -> list[Path]:
    """A binding's hand-written files."""
    found = [path for pattern in language.files for path in sorted(BINDINGS.glob(pattern))]
    return [path for path in found if path.name not in GENERATED and not {"obj", "bin", "tests", "test"} & set(path.parts)]


def page(functions: list[dict[str, str]], tables: dict[str, Calls]) -> str:
    """docs/reference/bindings.md."""
    languages = [language for language in LANGUAGES if language.name in tables]
    guides = ", ".join(f"[{language.name}]({language.guide})" if (PAGE.parent / language.guide).exists() else language.name for language in languages)
    lines = [
        "# Bindings",
        "",
        f"Every function of the C API ([superhelix.h](../../include/superhelix.h)) and how each language reaches it: {guides}.",
        "Written by `python3 bindings/coverage.py`, which reads `bindings/api.json` (the header's description, from which bindings are generated)",
        "and scans each binding's hand-written layer. The tests fail where the table is old or a cell is empty.",
        "",
    ]
    header = "| C | " + " | ".join(language.name for language in languages) + " |"
    for section in dict.fromkeys(function["section"] for function in functions):
        lines += [f"## {section}", "", header, "|" + "---|" * (len(languages) + 1)]
        for function in functions:
            if function["section"] == section:
                cells = [cell(tables[language.name].get(function["name"], [])) for language in languages]
                lines.append(f"| `{function['name']}` | " + " | ".join(cells) + " |")
        lines.append("")
    for language in languages:
        reached = sum(function["name"] in tables[language.name] for function in functions)
        lines.append(f"{language.name}: {reached} of {len(functions)} functions.")
    return "\n".join(lines) + "\n"


def cell(places: list[str]) -> str:
    """At most two places from which a function is called."""
    unique = [place for place in dict.fromkeys(places) if place]
    public = [place for place in unique if not place.startswith("_") and "._" not in place] or unique
    return ", ".join(f"`{place}`" for place in public[:2]) if public else "**missing**"


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="Tells which functions of the C API each binding calls.")
    parser.add_argument("--check", action="store_true", help="write nothing, fail if the page is old or a binding misses a function")
    arguments = parser.parse_args()
    functions = json.loads((BINDINGS / "api.json").read_text(encoding="utf-8"))["functions"]
    known = {function["name"] for function in functions}
    tables: dict[str, Calls] = {}
    for language in LANGUAGES:
        if paths := files_of(language):
            tables[language.name] = {name: places for name, places in language.scan(paths).items() if name in known}
    text = page(functions, tables)
    if not arguments.check:
        PAGE.write_text(text, encoding="utf-8")
        return 0
    failed = False
    for name, calls in tables.items():
        if missing := sorted(known - set(calls)):
            print(f"{name} does not reach {', '.join(missing)}", file=sys.stderr)
            failed = True
    if not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
        print("docs/reference/bindings.md is old: run python3 bindings/coverage.py", file=sys.stderr)
        failed = True
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
