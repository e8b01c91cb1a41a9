"""Writes a software bill of materials of the library, CycloneDX 1.6 JSON: every crate that is linked in, and Rust's standard library.

Usage: sbom.py TARGET OUTPUT. The same sources give the same file: its serial number is made from what it lists, its time is
SOURCE_DATE_EPOCH.
"""

from __future__ import annotations

import datetime
import json
import os
import sys
import uuid
from pathlib import Path
from typing import Any

from dependencies import Crate, library_crates, rustc

STANDARD_LIBRARY = "rust-std"


def component(crate: Crate) -> dict[str, Any]:
    """A crate as CycloneDX describes it."""
    entry: dict[str, Any] = {
        "type": "library",
        "bom-ref": crate.purl,
        "name": crate.name,
        "version": crate.version,
        "purl": crate.purl,
        "licenses": [{"expression": crate.license}],
    }
    if crate.description:
        entry["description"] = " ".join(crate.description.split())
    if crate.checksum:
        entry["hashes"] = [{"alg": "SHA-256", "content": crate.checksum}]
    if crate.repository:
        entry["externalReferences"] = [{"type": "vcs", "url": crate.repository}]
    return entry


def bill(target: str) -> dict[str, Any]:
    """The whole document."""
    own, *crates = library_crates(target)
    version, _ = rustc()
    standard = f"{STANDARD_LIBRARY}@{version}"
    components = [component(crate) for crate in crates]
    components.append(
        {
            "type": "library",
            "bom-ref": standard,
            "name": STANDARD_LIBRARY,
            "version": version,
            "description": "Rust's standard library, as the compiler brings it",
            "licenses": [{"expression": "MIT OR Apache-2.0"}],
        }
    )
    edges = [
        {
            "ref": crate.purl,
            "dependsOn": [*(f"pkg:cargo/{name}@{number}" for name, number in crate.dependencies), standard],
        }
        for crate in [own, *crates]
    ]
    moment = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", "0")), datetime.timezone.utc)
    document: dict[str, Any] = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {
            "timestamp": moment.strftime("%Y-%m-%dT%H:%M:%SZ"),
            "component": component(own),
            "properties": [{"name": "superhelix:target", "value": target}],
        },
        "components": components,
        "dependencies": [*edges, {"ref": standard}],
    }
    number = uuid.uuid5(uuid.NAMESPACE_URL, json.dumps(document, sort_keys=True))
    return {**document, "serialNumber": f"urn:uuid:{number}"}


def main() -> None:
    """Writes the file."""
    target, output = sys.argv[1], Path(sys.argv[2])
    document = bill(target)
    output.write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(f"{len(document['components'])} components")


if __name__ == "__main__":
    main()
