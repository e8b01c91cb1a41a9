#!/usr/bin/env python3
"""Holds the binary interface to a baseline: abi/baseline.txt, a table of it, and abi/baseline/, the header that it was made from and the
examples of that time.

    python3 abi/abi.py check [--header FILE]     fail on a change that breaks programs compiled against the baseline, unless SHX_ABI_VERSION
                                                 is another; list additions
    python3 abi/abi.py abidiff                   the same question to libabigail, from what the C compiler makes of both headers
    python3 abi/abi.py program                   print a C program that uses all of the baseline, to be compiled against the baseline's header
    python3 abi/abi.py baseline                  make the present header the baseline; refused where it breaks the last and does not say so
"""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from compare import Changes, compare
from description import ROOT, Description, of_header, of_text, to_text

HEADER = ROOT / "include" / "superhelix.h"
EXPORTS = ROOT / "include" / "exports.txt"
BASELINE = ROOT / "abi" / "baseline.txt"
BASELINE_HEADER = ROOT / "abi" / "baseline" / "superhelix.h"
# Programs that are kept with the header that they were written for, to be run with later libraries.
PROGRAMS = ["check.h", "hello.c", "curls.c", "errors.c", "comb.c", "render.c"]

# What libabigail's abidiff says by its exit status.
ABIDIFF_ERROR = 1 | 2
ABIDIFF_CHANGE = 4
ABIDIFF_INCOMPATIBLE = 8


def baseline() -> Description:
    """The committed table; its header must say the same."""
    described = of_text(BASELINE.read_text(encoding="utf-8"))
    if described != of_header(BASELINE_HEADER):
        sys.exit(f"{BASELINE.relative_to(ROOT)} is not what {BASELINE_HEADER.relative_to(ROOT)} says: write both with `make abi-baseline`")
    return described


def is_announced(old: Description, new: Description) -> bool:
    """Whether the header says that older programs do not fit any more."""
    return new.abi_version > old.abi_version


def tell(old: Description, changes: Changes) -> None:
    """Lists the changes."""
    for change in changes.breaks:
        print(f"  breaks: {change}")
    for change in changes.additions:
        print(f"  adds:   {change}")
    if not changes.breaks and not changes.additions:
        print(f"  nothing changed since the baseline ({old.version})")


def check(header: Path, exports: Path) -> int:
    """The table against a header, and the header's functions against what the library exports."""
    old, new = baseline(), of_header(header)
    changes = compare(old, new)
    tell(old, changes)
    exported = set(exports.read_text(encoding="utf-8").split())
    if missing := sorted(set(new.functions) ^ exported):
        print(f"abi: the header and {exports.name} differ in {', '.join(missing)}")
        return 1
    if not changes.breaks:
        print(f"abi: programs compiled against {old.version} run with this header's library")
        return 0
    if is_announced(old, new):
        print(f"abi: breaks, and SHX_ABI_VERSION says so ({old.abi_version} to {new.abi_version}); next: `make abi-baseline`")
        return 0
    print("abi: breaks that nobody announced. Take them back, or raise SHX_ABI_VERSION in src/capi/base/version.rs and tell of them in CHANGELOG.md")
    return 1


def stub_library(header: Path, folder: Path, name: str) -> Path:
    """A library of empty functions as the header declares them, with debug information: all that abidiff looks at."""
    described = of_header(header)
    lines = ['#include "superhelix.h"']
    for function, signature in described.functions.items():
        returns, types = signature.split(" (", 1)
        parameters = types.removesuffix(")").split(", ")
        named = ["void"] if parameters == ["void"] else [declare(each, f"p{k}") for k, each in enumerate(parameters)]
        body = "" if returns == "void" else f"static {returns.removeprefix('const ') if '*' not in returns else returns} r; return r;"
        lines.append(f"{returns} {function}({', '.join(named)}) {{ {body} }}")
    source, library = folder / f"{name}.c", folder / f"lib{name}.so"
    source.write_text("\n".join(lines) + "\n", encoding="utf-8")
    compiler = shlex.split(os.environ.get("CC", "cc"))
    flags = ["-std=c99", "-g", "-fno-eliminate-unused-debug-types", "-shared", "-fPIC", "-w", "-Wl,-soname,libsuperhelix.so"]
    subprocess.run([*compiler, *flags, "-I", str(header.parent), str(source), "-o", str(library)], check=True)
    return library


def declare(type_: str, name: str) -> str:
    """A parameter of that type."""
    base, bracket, length = type_.partition("[")
    return f"{base} {name}{bracket}{length}"


def abidiff(header: Path) -> int:
    """libabigail's opinion, which knows nothing of our parser. Structures that state their size may grow."""
    if shutil.which("abidiff") is None:
        sys.exit("abi: abidiff is not there: apt-get install abigail-tools")
    old, new = baseline(), of_header(header)
    changes = compare(old, new)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        before = stub_library(BASELINE_HEADER, folder, "before")
        after = stub_library(header, folder, "after")
        # Of those that have grown only: the rule would hide other changes of the structures that it is for.
        suppressed = [
            f"[suppress_type]\ntype_kind = struct\nname = {struct}\nhas_data_member_inserted_at = end\nhas_size_change = yes\n"
            for struct, of in old.structs.items()
            if of.versioned and struct in new.structs and new.structs[struct].size > of.size
        ]
        rules = folder / "grown.ini"
        rules.write_text("\n".join(suppressed), encoding="utf-8")
        command = ["abidiff", "--no-added-syms", "--suppressions", str(rules), str(before), str(after)]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
    sys.stdout.write(result.stdout)
    sys.stderr.write(result.stderr)
    if result.returncode & ABIDIFF_ERROR:
        print(f"abi: abidiff failed ({result.returncode})")
        return 1
    if not result.returncode:
        print("abi: abidiff finds no change but additions")
        return 0
    if is_announced(old, new):
        print("abi: abidiff finds changes, and SHX_ABI_VERSION announces a break")
        return 0
    # It has no word for fields in reserved bytes and for members of constants' ranges: then the table decides.
    if not result.returncode & ABIDIFF_INCOMPATIBLE and not changes.breaks and any("reserved" in each for each in changes.additions):
        print("abi: what abidiff finds are fields in reserved bytes")
        return 0
    print("abi: abidiff finds a change that older programs do not survive")
    return 1


def program(old: Description) -> str:
    """Uses every function's address and every structure's init function, as a program compiled against the baseline would."""
    lines = [
        "/* Written by abi/abi.py. */",
        "#include <stdio.h>",
        "#include <string.h>",
        '#include "superhelix.h"',
        "",
        "typedef void (*any_function)(void);",
        "int main(void) {",
        "  int failed = 0;",
        "  const any_function functions[] = {",
        *(f"    (any_function)&{function}," for function in old.functions),
        "  };",
        "  for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) failed += functions[i] == NULL;",
    ]
    checked = 0
    for name, struct in old.structs.items():
        if not struct.versioned or old.functions.get(f"{name}_init") != f"shx_result ({name} *, size_t)":
            continue
        checked += 1
        lines += [
            f"  {{ /* {name} */",
            f"    struct {{ {name} known; unsigned char after[64]; }} room;",
            "    memset(&room, 0xee, sizeof room);",
            f"    const shx_result result = {name}_init(&room.known, sizeof room.known);",
            "    int bad = result != SHX_OK || room.known.struct_size != sizeof room.known;",
            "    for (int i = 0; i < 64; i++) bad |= room.after[i] != 0xee;",
            f'    if (bad) printf("{name}: result %d, struct_size %u\\n", (int)result, (unsigned)room.known.struct_size);',
            "    failed += bad;",
            "  }",
        ]
    lines += [
        f'  printf("{len(old.functions)} functions, {checked} structures of {old.version}: %d wrong\\n", failed);',
        "  return failed != 0;",
        "}",
    ]
    return "\n".join(lines) + "\n"


def make_baseline() -> int:
    """The present header becomes what later ones are held to."""
    new = of_header(HEADER)
    if BASELINE.exists():
        old = of_text(BASELINE.read_text(encoding="utf-8"))
        changes = compare(old, new)
        tell(old, changes)
        if changes.breaks and not is_announced(old, new) and not os.environ.get("ABI_FORCE"):
            print("abi: not written: breaks that nobody announced. Raise SHX_ABI_VERSION; ABI_FORCE=1 for an interface that was never released")
            return 1
    BASELINE_HEADER.parent.mkdir(exist_ok=True)
    shutil.copyfile(HEADER, BASELINE_HEADER)
    for name in PROGRAMS:
        shutil.copyfile(ROOT / "examples_c" / name, BASELINE_HEADER.parent / name)
    BASELINE.write_text(to_text(new), encoding="utf-8")
    print(f"abi: the baseline is {new.version}")
    return 0


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("command", choices=["check", "abidiff", "program", "baseline"])
    parser.add_argument("--header", type=Path, default=HEADER)
    parser.add_argument("--exports", type=Path, default=EXPORTS)
    arguments = parser.parse_args()
    if arguments.command == "baseline":
        return make_baseline()
    if arguments.command == "program":
        sys.stdout.write(program(baseline()))
        return 0
    if arguments.command == "abidiff":
        return abidiff(arguments.header)
    return check(arguments.header, arguments.exports)


if __name__ == "__main__":
    sys.exit(main())
