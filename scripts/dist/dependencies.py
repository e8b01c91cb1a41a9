"""The crates that are linked into the library of a target, as cargo says: no build tools, no tests, no macros."""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@dataclass
class Crate:
    """A crate of the library."""

    name: str
    version: str
    license: str
    authors: list[str]
    repository: str
    description: str
    folder: Path
    checksum: str
    dependencies: list[tuple[str, str]] = field(default_factory=list)

    @property
    def purl(self) -> str:
        """The package URL."""
        return f"pkg:cargo/{self.name}@{self.version}"


def cargo(*arguments: str) -> str:
    """What cargo prints."""
    return subprocess.run(["cargo", *arguments], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


def checksums() -> dict[tuple[str, str], str]:
    """SHA-256 of each crate's file, by name and version, from Cargo.lock."""
    found = {}
    for block in (ROOT / "Cargo.lock").read_text().split("[[package]]")[1:]:
        values = dict(re.findall(r'^(name|version|checksum) = "(.*)"$', block, re.MULTILINE))
        found[values["name"], values["version"]] = values.get("checksum", "")
    return found


def library_crates(target: str) -> list[Crate]:
    """The library itself, and after it every crate that is linked into it, by name."""
    tree = cargo(
        "tree", "--locked", "--edges", "normal,no-proc-macro", "--prefix", "none", "--target", target, "--format", "{p}"
    )
    linked = {(words[0], words[1].removeprefix("v")) for words in map(str.split, tree.splitlines()) if words}
    metadata = json.loads(cargo("metadata", "--locked", "--format-version", "1", "--filter-platform", target))
    packages = {package["id"]: package for package in metadata["packages"]}
    sums = checksums()
    crates = {}
    for node in metadata["resolve"]["nodes"]:
        package = packages[node["id"]]
        key = package["name"], package["version"]
        if key not in linked:
            continue
        wanted = [
            packages[edge["pkg"]] for edge in node["deps"] if any(kind["kind"] is None for kind in edge["dep_kinds"])
        ]
        crates[key] = Crate(
            name=package["name"],
            version=package["version"],
            license=(package["license"] or "").replace("/", " OR "),
            authors=package["authors"],
            repository=package["repository"] or "",
            description=(package["description"] or "").strip(),
            folder=Path(package["manifest_path"]).parent,
            checksum=sums[key],
            dependencies=sorted({(other["name"], other["version"]) for other in wanted} & linked),
        )
    if missing := linked - crates.keys():
        raise SystemExit(f"dependencies.py: cargo metadata knows nothing of {sorted(missing)}")
    own = packages[metadata["resolve"]["root"]]
    first = crates.pop((own["name"], own["version"]))
    return [first, *(crates[key] for key in sorted(crates))]


def rustc() -> tuple[str, Path]:
    """The compiler's version, whose standard library is linked in, and where it is."""
    version = subprocess.run(["rustc", "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout.split()[1]
    sysroot = subprocess.run(["rustc", "--print", "sysroot"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    return version, Path(sysroot)
