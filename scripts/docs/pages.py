"""The Markdown pages of this repository: which there are, their headings, links and code."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

FENCE = re.compile(r"^ {0,3}(```+|~~~+)\s*([^\s`]*)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$")
LINK = re.compile(r"(?<!\\)\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
ATTRIBUTE = re.compile(r"(?:src|href)=\"([^\"]+)\"")
IDENTIFIER = re.compile(r"(?:id|name)=\"([^\"]+)\"")
CODE = re.compile(r"(`+)(?:(?!\1).)+?\1")


def tracked(*patterns: str) -> list[Path]:
    """Files that git knows or would add, as paths from the root."""
    command = ["git", "-C", str(ROOT), "ls-files", "--cached", "--others", "--exclude-standard", "-z", "--", *patterns]
    names = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split("\0")
    return [Path(name) for name in sorted(set(names)) if name and (ROOT / name).is_file()]


@dataclass
class Block:
    """Fenced code: its language, its text, the line of the fence, and whether a line `<!-- run -->` stands before it."""

    language: str
    text: str
    line: int
    run: bool


def blocks(text: str) -> Iterator[Block]:
    """The fenced code of a page."""
    fence, language, begin, run, before = "", "", 0, False, ""
    body: list[str] = []
    for number, line in enumerate(text.splitlines(), 1):
        found = FENCE.match(line)
        if fence:
            if found and found[1].startswith(fence) and not line.strip().strip(fence[0]):
                yield Block(language, "\n".join(body) + "\n", begin, run)
                fence = ""
            else:
                body.append(line)
        elif found:
            fence, language, begin, run, body = found[1], found[2], number, before.strip() == "<!-- run -->", []
        before = line
    if fence:
        raise ValueError(f"the code that begins in line {begin} has no end")


def prose(text: str) -> Iterator[tuple[int, str]]:
    """The lines that are not fenced code, numbered."""
    fence = ""
    for number, line in enumerate(text.splitlines(), 1):
        found = FENCE.match(line)
        if fence:
            if found and found[1].startswith(fence) and not line.strip().strip(fence[0]):
                fence = ""
        elif found:
            fence = found[1]
        else:
            yield number, line


def links(text: str) -> Iterator[tuple[int, str]]:
    """Where a page links to, with the line of each link."""
    for number, line in prose(text):
        bare = CODE.sub(lambda code: "`" * len(code[0]), line)
        for pattern in (LINK, ATTRIBUTE):
            for found in pattern.finditer(bare):
                yield number, found[1]


def slug(heading: str) -> str:
    """The anchor of a heading, as GitHub and mdBook make it."""
    plain = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    plain = re.sub(r"[`*]", "", plain)
    return re.sub(r"\s", "-", re.sub(r"[^\w\- ]", "", plain.lower()))


def anchors(text: str) -> set[str]:
    """Every anchor of a page."""
    found: set[str] = set()
    counts: dict[str, int] = {}
    for _, line in prose(text):
        if heading := HEADING.match(line):
            base = slug(heading[1])
            count = counts.get(base, 0)
            counts[base] = count + 1
            found.add(f"{base}-{count}" if count else base)
        found.update(IDENTIFIER.findall(line))
    return found
