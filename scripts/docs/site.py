#!/usr/bin/env python3
"""Builds the site from the pages, by mdBook, and checks its links.

    python3 scripts/docs/site.py MDBOOK [OUT]

The pages are staged in build/docs-source first: links out of docs/ go to copies in files/, equations (```math) become MathML, which browsers draw without
a script, and the C header becomes pages (scripts/docs/header.py). OUT is build/docs where nothing is said.
"""

from __future__ import annotations

import html.parser
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

from header import Reference
from pages import ATTRIBUTE, ROOT, prose, tracked

STAGE = ROOT / "build" / "docs-source"
#: The pages of the site that are no files of docs/.
OTHERS = {Path("README.md"): Path("README.md"), Path("CHANGELOG.md"): Path("changelog.md")}
HEADER = Path("reference/c")


class Stage:
    """The pages as mdBook gets them."""

    def __init__(self) -> None:
        self.places = {page: page.relative_to("docs") for page in tracked("docs/*.md")} | OTHERS
        self.copied: set[Path] = set()

    def link(self, page: Path, place: Path, target: str) -> str | None:
        """Where a link of a page goes on the site; None where the site has nothing there."""
        if re.match(r"[a-z][a-z+.-]*:", target) or target.startswith("#"):
            return target
        name, mark, anchor = target.partition("#")
        path = Path(os.path.normpath(page.parent / unquote(name)))
        if path == Path("include/superhelix.h") and page == Path("docs/reference/README.md"):
            to = HEADER / "README.md"
        elif path in self.places:
            to = self.places[path]
        elif (ROOT / path).is_dir():
            if path.is_relative_to("docs") and (readme := self.places.get(path / "README.md")):
                to = readme
            else:
                return None
        elif not (ROOT / path).is_file():
            return target  # found broken when the site is checked
        else:
            to = path.relative_to("docs") if path.is_relative_to("docs") else Path("files") / path
            # mdBook does not copy Markdown that is no page.
            to = to.with_name(to.name.replace(".", "_") + ".txt") if to.suffix in (".md", ".h") else to
            self.copy(path, to)
        # mdBook makes index.html of README.md, but not in links.
        to = to.with_name("index.md") if to.name == "README.md" else to
        return os.path.relpath(to, place.parent) + mark + anchor

    def copy(self, path: Path, to: Path) -> None:
        """A file beside the pages."""
        if to not in self.copied:
            self.copied.add(to)
            (STAGE / to).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / path, STAGE / to)

    def text(self, page: Path, place: Path, text: str) -> str:
        """A page with its links and equations as the site has them."""
        code = {number for number, _ in prose(text)}
        lines = []
        for number, line in enumerate(text.splitlines(), 1):
            if number in code:
                line = re.sub(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)", lambda found: self.rewritten(found, page, place), line)
                line = ATTRIBUTE.sub(lambda found: found[0].replace(found[1], self.link(page, place, found[1]) or ""), line)
            lines.append(line)
        return re.sub(r"^```math\n(.*?)^```$", lambda found: equation(found[1]), "\n".join(lines) + "\n", flags=re.M | re.S)

    def rewritten(self, found: re.Match[str], page: Path, place: Path) -> str:
        """One link of Markdown; an image may stand in its text."""
        text = re.sub(r"!\[([^\]]*)\]\(([^)\s]+)\)", lambda image: f"![{image[1]}]({self.link(page, place, image[2])})", found[1])
        target = self.link(page, place, found[2])
        return text if target is None else f"{'!' if found[0].startswith('!') else ''}[{text}]({target})"

    def write(self) -> None:
        """All of it."""
        shutil.rmtree(STAGE, ignore_errors=True)
        STAGE.mkdir(parents=True)
        for page, place in self.places.items():
            text = (ROOT / page).read_text(encoding="utf-8")
            contents = place == Path("SUMMARY.md")
            text = summary(text, Reference().write(STAGE / HEADER)) if contents else self.text(page, place, text)
            (STAGE / place).parent.mkdir(parents=True, exist_ok=True)
            (STAGE / place).write_text(text, encoding="utf-8")
        for page in (STAGE / HEADER).iterdir():
            page.write_text(page.read_text(encoding="utf-8").replace("../../include/superhelix.h", "../../files/include/superhelix_h.txt"), encoding="utf-8")
        self.copy(Path("include/superhelix.h"), Path("files/include/superhelix_h.txt"))
        shutil.copyfile(ROOT / "docs" / "site.css", STAGE / "site.css")
        book = (ROOT / "docs" / "book.toml").read_text(encoding="utf-8")
        (STAGE / "book.toml").write_text(book.replace('build-dir = "../build/docs"', 'build-dir = "book"'), encoding="utf-8")


def equation(source: str) -> str:
    """An equation as MathML."""
    from latex2mathml.converter import convert

    return f'<p class="equation">{convert(" ".join(source.split()), display="block")}</p>\n'


def breakable(site: Path) -> None:
    """Long names in tables may break behind an underscore, a slash or a colon."""

    def code(found: re.Match[str]) -> str:
        return f"<code{found[1]}>" + re.sub(r"(?<=[a-z])(_|::|/)(?=[a-z])", r"\1<wbr>", found[2], flags=re.I) + "</code>"

    for file in site.rglob("*.html"):
        text = file.read_text(encoding="utf-8")
        file.write_text(re.sub(r"<td>.*?</td>", lambda cell: re.sub(r"<code([^>]*)>([^<]*)</code>", code, cell[0]), text, flags=re.S), encoding="utf-8")


def summary(text: str, sections: list[tuple[str, str]]) -> str:
    """The contents with the pages that are made here."""
    first = "[superhelix](README.md)\n"
    listed = "".join(f"    - [{title}]({HEADER / name})\n" for title, name in sections)
    text = re.sub(r"^# .*\n", lambda found: f"{found[0]}\n{first}", text, count=1)
    anchor = "- [Reference](reference/README.md)\n"
    if anchor not in text:
        raise ValueError("docs/SUMMARY.md has no line for reference/README.md")
    return text.replace(anchor, f"{anchor}  - [The C interface]({HEADER / 'README.md'})\n{listed}") + "\n[Changelog](changelog.md)\n"


class Links(html.parser.HTMLParser):
    """Links and anchors of a page of the site."""

    def __init__(self) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """A tag."""
        for name, value in attrs:
            if value and name in ("href", "src"):
                self.links.append(value)
            elif value and name in ("id", "name"):
                self.anchors.add(value)


def broken(site: Path) -> tuple[int, list[str]]:
    """How many links the site has, and those that lead nowhere."""
    pages: dict[Path, Links] = {}
    for file in sorted(site.rglob("*.html")):
        pages[file] = Links()
        pages[file].feed(file.read_text(encoding="utf-8"))
    count, found = 0, []
    for file, page in pages.items():
        # The page of all pages repeats their links, and the error page is served from anywhere.
        if file.name in ("print.html", "404.html", "toc.html"):
            continue
        for link in page.links:
            if re.match(r"[a-z][a-z+.-]*:", link) or link in ("#", "/"):
                continue
            count += 1
            name, _, anchor = unquote(link).partition("#")
            target = (file.parent / name.partition("?")[0]).resolve() if name else file
            target = target / "index.html" if target.is_dir() else target
            if not target.exists():
                found.append(f"{file.relative_to(site)}: {link}: there is no such file")
            elif anchor and target in pages and anchor not in pages[target].anchors:
                found.append(f"{file.relative_to(site)}: {link}: there is no such anchor")
    return count, found


def main() -> int:
    """The command line."""
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    out = Path(sys.argv[2] if len(sys.argv) == 3 else ROOT / "build" / "docs").resolve()
    Stage().write()
    made = subprocess.run([sys.argv[1], "build", str(STAGE)], capture_output=True, text=True)
    print(made.stderr, file=sys.stderr, end="")
    if made.returncode or re.search(r"\b(WARN|ERROR)\b", made.stderr):
        print("site.py: mdBook complains", file=sys.stderr)
        return 1
    shutil.rmtree(out, ignore_errors=True)
    shutil.move(STAGE / "book", out)
    breakable(out)
    count, found = broken(out)
    for line in found:
        print(line, file=sys.stderr)
    print(f"{out}/index.html: {len(list(out.rglob('*.html')))} pages, {count} links, {len(found)} broken")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
