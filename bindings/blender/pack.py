#!/usr/bin/env python3
"""Packs the extension: manifest, package and the wheel of bindings/python in one .zip, which Blender installs from disk.

Usage: pack.py [--wheel WHEEL] [--out FOLDER]. Without a wheel, pip builds one from bindings/python, and cargo the library in it unless
SUPERHELIX_LIBRARY names one that is built. Each platform needs its own .zip.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
#: What Blender calls the platforms of wheels.
PLATFORMS = (
    (r"manylinux.*_x86_64$|linux_x86_64$", "linux-x64"),
    (r"manylinux.*_aarch64$|linux_aarch64$", "linux-arm64"),
    (r"macosx.*_arm64$", "macos-arm64"),
    (r"macosx.*_x86_64$", "macos-x64"),
    (r"win_amd64$", "windows-x64"),
    (r"win_arm64$", "windows-arm64"),
)


def platform_of(wheel: str) -> str:
    """Blender's name of a wheel's platform."""
    tag = wheel.removesuffix(".whl").rsplit("-", 1)[-1]
    for pattern, name in PLATFORMS:
        if re.search(pattern, tag):
            return name
    raise SystemExit(f"pack.py: {wheel}: Blender does not run on {tag}")


def build_wheel(folder: Path) -> Path:
    """The wheel of bindings/python."""
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(folder), str(HERE.parent / "python")]
    if subprocess.run(command, check=False).returncode:
        raise SystemExit("pack.py: the wheel could not be built: pip's messages are above")
    return next(folder.glob("superhelix-*.whl"))


def manifest_for(wheel: Path) -> str:
    """The manifest with the wheel and its platform. The version is the wheel's."""
    text = (HERE / "blender_manifest.toml").read_text(encoding="utf-8")
    stated, version = re.search(r'^version = "(.*)"$', text, re.MULTILINE), wheel.name.split("-")[1]
    if stated is None or stated[1] != version:
        raise SystemExit(f"pack.py: blender_manifest.toml states version {stated and stated[1]}, and the wheel is {version}")
    if text.count("wheels = []\n") != 1:
        raise SystemExit("pack.py: blender_manifest.toml has no line `wheels = []`")
    return text.replace("wheels = []\n", f'wheels = ["./wheels/{wheel.name}"]\nplatforms = ["{platform_of(wheel.name)}"]\n')


def pack(wheel: Path, out: Path) -> Path:
    """Writes the .zip. The same files give the same bytes."""
    out.mkdir(parents=True, exist_ok=True)
    manifest = manifest_for(wheel)
    target = out / f"superhelix_hair-{wheel.name.split('-')[1]}-{platform_of(wheel.name)}.zip"
    package = HERE / "superhelix_hair"
    entries = {"blender_manifest.toml": manifest.encode(), f"wheels/{wheel.name}": wheel.read_bytes()}
    entries |= {str(path.relative_to(package)): path.read_bytes() for path in sorted(package.rglob("*.py"))}
    entries |= {name: (ROOT / name).read_bytes() for name in ("LICENSE-MIT", "LICENSE-APACHE")}
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:
        for name, data in entries.items():
            archive.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)
    return target


def main() -> None:
    """Packs, and prints the .zip's path."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--wheel", type=Path, help="a wheel that is built already")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "blender", help="folder of the .zip (default: out/blender)")
    given = parser.parse_args()
    if given.wheel is not None and not given.wheel.is_file():
        raise SystemExit(f"pack.py: --wheel {given.wheel}: no such file")
    with tempfile.TemporaryDirectory() as folder:
        print(pack(given.wheel or build_wheel(Path(folder)), given.out))


if __name__ == "__main__":
    main()
