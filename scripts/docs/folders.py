#!/usr/bin/env python3
"""What each folder of src holds: a list in the comment of its module, a line a file, made of the first sentence of each file.

    python3 scripts/docs/folders.py            writes the lists
    python3 scripts/docs/folders.py --check    fails where one is old, or a file says nothing

The list stands at the end of the `//!` comment of `mod.rs` (or of `folder.rs`, `main.rs`), after the line "Files:". That of `lib.rs`, whose comment is
the front page of the crate's documentation, is a comment of its own below it.
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

from pages import ROOT, tracked

SOURCE = Path("src")
BEGIN = "//! Files:"
WIDTH = 150


def owner(folder: Path) -> Path:
    """The file whose comment speaks for a folder."""
    for name in (folder / "mod.rs", folder.with_suffix(".rs"), folder / "lib.rs", folder / "main.rs"):
        if (ROOT / name).exists() and name != SOURCE.with_suffix(".rs"):
            return name
    raise FileNotFoundError(f"no module speaks for {folder}")


def comment(file: Path) -> str:
    """The `//!` comment of a file, without the list of files, as one line a paragraph."""
    lines = []
    for line in (ROOT / file).read_text(encoding="utf-8").splitlines():
        if not line.startswith("//!") or line == BEGIN:
            break
        lines.append(line[3:].strip())
    return "\n".join(lines).strip()


def sentence(file: Path) -> str:
    """What a file is: the first sentence of its comment, shortened at a colon or a semicolon where it is long."""
    paragraph = " ".join(comment(file).split("\n\n")[0].split("\n"))
    if not paragraph:
        raise ValueError(f"{file} begins with no comment that says what it is")
    first = re.split(r"(?<=[.?!])(?<!et al\.)(?<!e\.g\.)(?<!i\.e\.)\s+(?=[A-Z])", paragraph)[0]
    first = re.sub(r"\[(`[^`]*`)\](\([^)]*\))?", r"\1", first)
    first = re.sub(r"\s*\((?:`docs/|docs/|see `?docs/)[^)]*\)", "", first)
    if len(first) > WIDTH:
        for mark in ("; ", ": ", ", "):
            cut = first.rfind(mark, 30, WIDTH)
            if cut > 0 and first.count("(", 0, cut) == first.count(")", 0, cut) and first.count("`", 0, cut) % 2 == 0:
                first = first[:cut]
                break
    return first.rstrip(".:;,") + "."


def entries(folder: Path, files: list[Path]) -> list[str]:
    """The lines of a folder's list."""
    speaker = owner(folder)
    lines = []
    for file in sorted(files):
        if file.parent == folder and file != speaker and file.name not in ("mod.rs", "lib.rs", "main.rs"):
            lines.append(f"//! - `{file.name}`: {sentence(file)}")
    for below in sorted({file.parent for file in files if file.parent.parent == folder}):
        if owner(below).parent == below and below != folder / "bin":
            lines.append(f"//! - `{below.name}/`: {sentence(owner(below))}")
    return lines


def listed(speaker: Path, lines: list[str]) -> str:
    """A file with its list."""
    text = (ROOT / speaker).read_text(encoding="utf-8").split("\n")
    end = next(index for index, line in enumerate(text) if not line.startswith("//!"))
    head = text[:end]
    if BEGIN in head:
        head = head[: head.index(BEGIN)]
    while head and head[-1] == "//!":
        head.pop()
    if speaker.name == "lib.rs":
        rest = text[end:]
        while rest and (not rest[0] or rest[0].startswith("// ") or rest[0] == "//"):
            rest.pop(0)
        own = [line.replace("//!", "//", 1) for line in (BEGIN, "//!", *lines)]
        return "\n".join([*head, "", *own, "", *rest])
    return "\n".join([*head, "//!", BEGIN, "//!", *lines, *text[end:]])


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="What each folder of src holds.")
    parser.add_argument("--check", action="store_true", help="write nothing, fail where a list is old")
    arguments = parser.parse_args()
    files = tracked("src/*.rs")
    old = []
    for folder in sorted({file.parent for file in files} - {SOURCE / "bin"}):
        speaker = owner(folder)
        text = listed(speaker, entries(folder, files))
        if text != (ROOT / speaker).read_text(encoding="utf-8"):
            old.append(speaker)
            if not arguments.check:
                (ROOT / speaker).write_text(text, encoding="utf-8")
    if arguments.check:
        for speaker in old:
            print(f"{speaker}: its list of files is old: run python3 scripts/docs/folders.py", file=sys.stderr)
        return int(bool(old))
    print(f"folders: {len(old)} lists written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
