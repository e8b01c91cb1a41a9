#!/usr/bin/env python3
"""Runs the code of the pages that says it can run, and holds the guide to its form.

A line `<!-- run -->` directly before fenced code makes it run:

    c       a whole program: compiled as C99, every warning an error, against the library under test, and run
    cpp     the same, as C++17
    python  run with the package `superhelix`
    rust    compiled and run as a documentation test of the crate
    csharp  a whole program, or the statements of one: compiled by mcs against the binding, and run by mono
    json    a scene file: saved as scene.json and run
    sh      run by bash, the command `superhelix` in the path

The code of a page runs in the page's order, in one scratch directory. `GROOMS` is the folder of the tests' grooms. Each page of the guide
(docs/guide) must have at least one piece of code that runs, or say `<!-- run by SCRIPT -->` where its code needs a host program that a
script brings along, and at most 1500 words. scripts/test_docs.sh calls this.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from pages import ROOT, Block, blocks, tracked

GUIDE = Path("docs/guide")
WORDS = 1500
SECONDS = 300
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]


@dataclass
class Tools:
    """What code is compiled and run with."""

    library: Path
    headers: Path
    binary: Path
    python: str
    target: Path
    csharp: Path | None = None

    def environment(self) -> dict[str, str]:
        """The environment of everything that runs."""
        environment = dict(os.environ)
        environment["PATH"] = f"{self.binary.parent}{os.pathsep}{environment['PATH']}"
        environment["GROOMS"] = str(ROOT / "tests" / "data" / "grooms")
        environment["SUPERHELIX_LIBRARY"] = str(self.library / "libsuperhelix.so")
        environment["SUPERHELIX_BINARY"] = str(self.binary)
        environment["LD_LIBRARY_PATH"] = str(self.library)
        environment["PYTHONPATH"] = str(ROOT / "bindings" / "python" / "src")
        environment["PYTHONDONTWRITEBYTECODE"] = "1"
        environment["MPLBACKEND"] = "agg"
        return environment

    def commands(self, block: Block, name: str) -> list[list[str]]:
        """What to do with a block that was saved as `name` in the scratch directory; more than one command are done in order."""
        linked = ["-L", str(self.library), "-lsuperhelix", f"-Wl,-rpath,{self.library}", "-lm", "-pthread"]
        match block.language:
            case "c":
                compiler = [os.environ.get("CC", "cc"), "-std=c99", *WARNINGS, "-I", str(self.headers)]
                return [[*compiler, name, "-o", f"{name}.out", *linked], [f"./{name}.out"]]
            case "cpp":
                include = ["-I", str(ROOT / "bindings" / "cpp" / "include"), "-I", str(self.headers)]
                return [[os.environ.get("CXX", "c++"), "-std=c++17", *WARNINGS, *include, name, "-o", f"{name}.out", *linked], [f"./{name}.out"]]
            case "sh":
                return [["bash", "-euo", "pipefail", name]]
            case "python":
                return [[self.python, name]]
            case "json":
                return [["superhelix", "run", name, "--out", "result.json"]]
            case "rust":
                found = ["-L", f"dependency={self.target / 'deps'}", "--extern", f"superhelix={self.target / 'libsuperhelix.rlib'}"]
                return [["rustdoc", "--test", "--edition", "2024", *found, name]]
            case "csharp":
                if self.csharp is None:
                    return []
                compiler = ["mcs", "-unsafe", "-langversion:7.2", f"-r:{self.csharp}", f"-out:{name}.exe", name]
                return [["cp", str(self.csharp), "."], compiler, ["mono", "--debug", f"{name}.exe"]]
            case _:
                raise ValueError(f"'{block.language}' is no language that can run: c, cpp, csharp, json, python, rust, sh")


@dataclass
class Page:
    """The result of a page."""

    path: Path
    failures: list[str] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=dict)
    seconds: float = 0.0

    def run(self, tools: Tools) -> Page:
        """Runs what can run, and checks the form of a page of the guide."""
        started = time.monotonic()
        text = (ROOT / self.path).read_text(encoding="utf-8")
        runnable = [block for block in blocks(text) if block.run]
        if self.path.parent == GUIDE:
            words = len(text.split())
            if words > WORDS:
                self.failures.append(f"{self.path}: {words} words, {WORDS} at most")
            # Code for a program that is not here at every test names the script that tests it.
            elsewhere = re.search(r"<!-- run by (\S+) -->", text)
            if not runnable and not (elsewhere and (ROOT / elsewhere[1]).is_file()):
                self.failures.append(f"{self.path}: no code with a line `<!-- run -->` before it")
        if text.count("\n<!-- run -->\n") + text.startswith("<!-- run -->\n") != len(runnable):
            self.failures.append(f"{self.path}: a line `<!-- run -->` that does not stand directly before fenced code")
        with tempfile.TemporaryDirectory() as scratch:
            for block in runnable:
                self.block(block, tools, Path(scratch))
                if self.failures:
                    break
        self.seconds = time.monotonic() - started
        return self

    def block(self, block: Block, tools: Tools, scratch: Path) -> None:
        """One piece of code."""
        where = f"{self.path}:{block.line}"
        suffix = {"python": "py", "csharp": "cs", "rust": "md"}.get(block.language, block.language)
        name = "scene.json" if block.language == "json" else f"line_{block.line}.{suffix}"
        body = block.text
        if block.language == "rust":
            body = f"```\n{body}```\n"
        elif block.language == "csharp" and "static void Main" not in body:
            body = f"using System;\nusing Superhelix;\ninternal static class Page {{ private static void Main() {{\n{body}}} }}\n"
        try:
            commands = tools.commands(block, name)
        except ValueError as error:
            self.failures.append(f"{where}: {error}")
            return
        if not commands:
            return
        (scratch / name).write_text(body, encoding="utf-8")
        for command in commands:
            try:
                done = subprocess.run(command, cwd=scratch, env=tools.environment(), capture_output=True, text=True, timeout=SECONDS, stdin=subprocess.DEVNULL)
            except subprocess.TimeoutExpired:
                self.failures.append(f"{where}: {command[0]} did not end within {SECONDS} s")
                return
            if done.returncode:
                self.failures.append(f"{where}: {' '.join(command)}: exit status {done.returncode}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
                return
        self.counts[block.language] = self.counts.get(block.language, 0) + 1


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="Runs the code of the pages that says it can run.")
    parser.add_argument("--library", required=True, type=Path, help="folder of libsuperhelix.so")
    parser.add_argument("--headers", required=True, type=Path, help="folder of superhelix.h")
    parser.add_argument("--binary", required=True, type=Path, help="the program superhelix")
    parser.add_argument("--python", default=sys.executable, help="a Python with numpy")
    parser.add_argument("--target", required=True, type=Path, help="cargo's folder with libsuperhelix.rlib and deps/")
    parser.add_argument("--csharp", type=Path, help="the C# binding as an assembly; without it C# is not run")
    parser.add_argument("pages", nargs="*", type=Path, help="only these pages")
    arguments = parser.parse_args()
    csharp = arguments.csharp.resolve() if arguments.csharp and shutil.which("mono") else None
    tools = Tools(arguments.library.resolve(), arguments.headers.resolve(), arguments.binary.resolve(), arguments.python, arguments.target.resolve(), csharp)
    for path in (tools.library / "libsuperhelix.so", tools.headers / "superhelix.h", tools.binary, tools.target / "libsuperhelix.rlib"):
        if not path.exists():
            parser.error(f"there is no {path}")
    chosen = [path.resolve().relative_to(ROOT) for path in arguments.pages] or tracked("docs/*.md", "*.md")
    guide = [path for path in chosen if path.parent == GUIDE]
    if not arguments.pages and not guide:
        parser.error("docs/guide has no page")
    with ThreadPoolExecutor(max_workers=2) as pool:
        done = list(pool.map(lambda path: Page(path).run(tools), sorted(set(chosen))))
    failures = [failure for page in done for failure in page.failures]
    total: dict[str, int] = {}
    for page in done:
        for language, count in page.counts.items():
            total[language] = total.get(language, 0) + count
        if page.counts:
            print(f"{page.path}: {', '.join(f'{count} {language}' for language, count in sorted(page.counts.items()))}, {page.seconds:.1f} s")
    for failure in failures:
        print(failure, file=sys.stderr)
    print(f"snippets: {sum(total.values())} ran ({', '.join(f'{count} {name}' for name, count in sorted(total.items()))}), {len(failures)} failures")
    return int(bool(failures))


if __name__ == "__main__":
    sys.exit(main())
