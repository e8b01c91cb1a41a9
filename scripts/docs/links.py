#!/usr/bin/env python3
"""Checks that what the pages and the sources point to is there.

    python3 scripts/docs/links.py

Relative links and anchors of every Markdown page; files of the repository that pages name in code (`tests/...rs`), except in the notebook and the
changelog, which are history; tests that pages of docs/theory name (`a_long_name_of_a_test`); names of pages (`docs/...md`) in sources, scripts and
tests; functions, types and constants of the C header that pages name, in text and in code; every page of docs/ is listed in docs/SUMMARY.md. Prints what is
broken; exit status 1 if anything is.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from urllib.parse import unquote

from pages import ROOT, anchors, links, prose, tracked

#: What names a page: "docs/theory/contact.md", with or without an anchor.
NAMED = re.compile(r"(?<![\w./$-])docs/[\w/-]+\.md(?:#[\w-]+)?")
#: What names a file of the repository in a page's code.
FILE = re.compile(r"`((?:src|tests|examples|examples_c|examples_wasm|benches|scripts|bindings|abi|packaging|include)/[\w/.-]*\w)`")
#: What names a test or another function in a page of the theory.
LONG_NAME = re.compile(r"`([a-z][a-z0-9]*(?:_[a-z0-9]+){3,})`")
#: What names something of the C header; environment variables begin like its constants.
C_NAME = re.compile(r"\b(?:shx|SHX)_\w*[A-Za-z0-9]\b")
VARIABLES = {"SHX_BLESS", "SHX_BUILD_DIR", "SHX_LINKAGE", "SHX_LINKER", "SHX_PROFILE"}
HISTORY = (Path("docs/notebook"), Path("CHANGELOG.md"))
#: Files that name pages.
TEXT = {".rs", ".h", ".c", ".hpp", ".cpp", ".cs", ".py", ".sh", ".toml", ".txt", ".json", ".md", ".mjs", ".ipynb", ".cmake", ".js", ".css", ""}


class Checker:
    """Collects what is broken."""

    def __init__(self) -> None:
        self.broken: list[str] = []
        self.anchors: dict[Path, set[str]] = {}
        self.checked = 0

    def target(self, where: str, path: Path, anchor: str, written: str) -> None:
        """A link from `where` to a file or a folder, and to a heading of it."""
        self.checked += 1
        if not path.is_relative_to(ROOT):
            self.broken.append(f"{where}: {written} leaves the repository")
        elif not path.exists():
            self.broken.append(f"{where}: {written}: there is no {path.relative_to(ROOT)}")
        elif anchor and path.suffix == ".md":
            if path not in self.anchors:
                self.anchors[path] = anchors(path.read_text(encoding="utf-8"))
            if anchor not in self.anchors[path]:
                self.broken.append(f"{where}: {written}: {path.relative_to(ROOT)} has no heading #{anchor}")

    def page(self, page: Path) -> None:
        """The links of a page."""
        text = (ROOT / page).read_text(encoding="utf-8")
        for line, link in links(text):
            if re.match(r"[a-z][a-z+.-]*:", link):
                continue
            name, _, anchor = unquote(link).partition("#")
            path = (ROOT / page).parent / name if name else ROOT / page
            self.target(f"{page}:{line}", path.resolve(), anchor, link)
        if not any(page.is_relative_to(history) for history in HISTORY):
            for line, words in prose(text):
                for found in FILE.finditer(words):
                    self.file(f"{page}:{line}", found[1])

    def claims(self, pages: list[Path]) -> None:
        """The tests that pages name are there: long names in code are words of some source."""
        words: set[str] = set()
        for file in tracked("src", "tests", "include", "bindings", "examples", "benches"):
            if file.suffix in {".rs", ".h", ".py", ".c"}:
                words.update(re.findall(r"\b[a-z][a-z0-9_]+\b", (ROOT / file).read_text(encoding="utf-8")))
        for page in pages:
            for line, text in prose((ROOT / page).read_text(encoding="utf-8")):
                for found in LONG_NAME.finditer(text):
                    self.checked += 1
                    if found[1] not in words:
                        self.broken.append(f"{page}:{line}: no source has {found[1]}")

    def header(self, pages: list[Path]) -> None:
        """The functions, types and constants of the C header that pages name are there."""
        names = set(VARIABLES)
        for file in ("superhelix.h", "superhelix_inline.h"):
            names.update(C_NAME.findall((ROOT / "include" / file).read_text(encoding="utf-8")))
        for page in pages:
            if any(page.is_relative_to(history) for history in HISTORY):
                continue
            for line, text in enumerate((ROOT / page).read_text(encoding="utf-8").splitlines(), 1):
                for name in C_NAME.findall(text):
                    self.checked += 1
                    if name not in names:
                        self.broken.append(f"{page}:{line}: the C header has no {name}")

    def file(self, where: str, name: str) -> None:
        """A file that a page names; a module may go without its ending."""
        self.checked += 1
        if not any((ROOT / (name + ending)).exists() for ending in ("", ".rs")):
            self.broken.append(f"{where}: there is no {name}")

    def names(self, file: Path) -> None:
        """The pages that a source names."""
        try:
            text = (ROOT / file).read_text(encoding="utf-8")
        except UnicodeDecodeError:
            return
        for found in NAMED.finditer(text):
            name, _, anchor = found[0].partition("#")
            self.target(f"{file}:{text.count(chr(10), 0, found.start()) + 1}", ROOT / name, anchor, found[0])

    def summary(self) -> None:
        """The contents of the site are the pages of docs/."""
        contents = ROOT / "docs" / "SUMMARY.md"
        listed = [(contents.parent / link).resolve() for _, link in links(contents.read_text(encoding="utf-8"))]
        there = {(ROOT / page).resolve() for page in tracked("docs/*.md")} - {contents.resolve()}
        self.broken += [f"docs/SUMMARY.md lists {page.relative_to(ROOT)} twice" for page in set(listed) if listed.count(page) > 1]
        self.broken += [f"docs/SUMMARY.md does not list {page.relative_to(ROOT)}" for page in sorted(there - set(listed))]


def main() -> int:
    """The command line."""
    checker = Checker()
    for page in tracked("*.md"):
        checker.page(page)
    for file in tracked():
        if (file.suffix in TEXT and not file.is_relative_to("tests/data") and not file.is_relative_to("docs/figures")) or file.suffix == ".py":
            checker.names(file)
    checker.summary()
    checker.claims(tracked("docs/theory/*.md"))
    checker.header(tracked("*.md"))
    for line in checker.broken:
        print(line, file=sys.stderr)
    print(f"links: {checker.checked} checked, {len(checker.broken)} broken")
    return int(bool(checker.broken))


if __name__ == "__main__":
    sys.exit(main())
