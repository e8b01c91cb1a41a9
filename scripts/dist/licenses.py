"""Writes the licence texts of every crate in the library, each text once, and those of Rust's standard library.

Usage: licenses.py TARGET FOLDER. FOLDER gets third_party.txt and rust_standard_library.html. A crate whose licence is not known
here, or has no text, stops the release.
"""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

from dependencies import ROOT, Crate, library_crates, rustc

LICENSE_FILE = re.compile(r"(LICEN[CS]E|COPYING|COPYRIGHT|NOTICE|UNLICENSE)", re.IGNORECASE)

# What each licence's text says and no other does.
MARKS = {
    "MIT": "permission is hereby granted, free of charge",
    "Apache-2.0": "apache license",
    "Zlib": "this software is provided 'as-is'",
    "BSD-2-Clause": "redistributions of source code must retain",
    "BSD-3-Clause": "neither the name",
    "Unlicense": "released into the public domain",
    "Unicode-3.0": "unicode license v3",
    "ISC": "permission to use, copy, modify, and/or distribute",
}

MIT = """MIT License

Copyright (c) {holder}

Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation files \
(the "Software"), to deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge, \
publish, distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do \
so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF \
MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE \
FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION \
WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
"""


def plain(text: str) -> str:
    """The text on one line in small letters, with plain quotes."""
    text = re.sub(r"[‘’`]", "'", text)
    return re.sub(r"[\s#*/]+", " ", text).lower()


def texts_of(crate: Crate) -> list[str]:
    """The licence texts that apply to a crate: those it ships, and that of its licence where it ships none."""
    files = sorted(path for path in crate.folder.iterdir() if path.is_file() and LICENSE_FILE.match(path.name))
    texts = [path.read_text(encoding="utf-8", errors="replace").strip() + "\n" for path in files]
    # Each part of an AND is needed, of an OR one is enough.
    for part in crate.license.replace("(", " ").replace(")", " ").split(" AND "):
        alternatives = part.split(" OR ")
        names = [name.strip() for name in alternatives]
        if any(MARKS[name] in plain(text) for name in names if name in MARKS for text in texts):
            continue
        if "MIT" in names:
            holder = ", ".join(re.sub(r"\s*<.*>", "", author) for author in crate.authors)
            texts.append(MIT.format(holder=holder or f"the authors of {crate.name}, {crate.repository}"))
        elif "Apache-2.0" in names:
            texts.append((ROOT / "LICENSE-APACHE").read_text().strip() + "\n")
        else:
            raise SystemExit(f"licenses.py: {crate.name} {crate.version} is under '{part}' and ships no text of it")
    return texts


def main() -> None:
    """Writes the files."""
    target, folder = sys.argv[1], Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    crates = library_crates(target)[1:]
    users: dict[str, list[Crate]] = {}
    for crate in crates:
        for text in texts_of(crate):
            users.setdefault(text, []).append(crate)
    with (folder / "third_party.txt").open("w", encoding="utf-8") as output:
        output.write("The library contains code of these crates, under the licences that follow. The standard library of Rust has\n")
        output.write("a file of its own, rust_standard_library.html.\n\n")
        for crate in crates:
            output.write(f"{crate.name} {crate.version}: {crate.license}\n")
        for text, owners in users.items():
            output.write("\n" + "=" * 100 + "\n")
            output.write(", ".join(f"{crate.name} {crate.version}" for crate in owners) + "\n")
            output.write("=" * 100 + f"\n\n{text}")
    _, sysroot = rustc()
    notices = sysroot / "share/doc/rust/COPYRIGHT-library.html"
    if not notices.exists():
        raise SystemExit(f"licenses.py: the notices of Rust's standard library are missing: {notices}")
    shutil.copyfile(notices, folder / "rust_standard_library.html")
    print(f"{len(crates)} crates, {len(users)} licence texts")


if __name__ == "__main__":
    main()
