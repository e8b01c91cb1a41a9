#!/usr/bin/env python3
"""Makes a Unity package file of the binding and native libraries: what the Package Manager installs by "Add package from tarball".

python3 bindings/csharp/pack.py OUTPUT.tgz --linux build/lib/libsuperhelix.so [--windows superhelix.dll] [--macos libsuperhelix.dylib]
"""

from __future__ import annotations

import argparse
import io
import sys
import tarfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from generate import PACKAGE, guid, meta  # noqa: E402

# Where each platform's library goes, and how Unity names the platform: editor's system, player, processor.
PLATFORMS = {
    "linux": ("Plugins/Linux/x86_64/libsuperhelix.so", "Linux", "Linux64"),
    "windows": ("Plugins/Windows/x86_64/superhelix.dll", "Windows", "Win64"),
    "macos": ("Plugins/macOS/libsuperhelix.dylib", "OSX", "OSXUniversal"),
}


def plugin_meta(path: Path, editor: str, player: str) -> str:
    """A .meta file that puts a library into the editor of one system and into its players, and nowhere else."""
    processor = "AnyCPU" if editor == "OSX" else "x86_64"
    text = f"fileFormatVersion: 2\nguid: {guid(path)}\nPluginImporter:\n  serializedVersion: 2\n  isPreloaded: 0\n  platformData:\n"
    text += "  - first:\n      Any: \n    second:\n      enabled: 0\n      settings: {}\n"
    text += f"  - first:\n      Editor: Editor\n    second:\n      enabled: 1\n      settings:\n        CPU: {processor}\n        OS: {editor}\n"
    text += f"  - first:\n      Standalone: {player}\n    second:\n      enabled: 1\n      settings:\n        CPU: {processor}\n"
    return text


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("output", type=Path)
    for platform in PLATFORMS:
        parser.add_argument(f"--{platform}", type=Path)
    arguments = parser.parse_args()
    libraries = {platform: getattr(arguments, platform) for platform in PLATFORMS if getattr(arguments, platform)}
    if not libraries:
        sys.exit("pack.py: no library is given: the package could not do anything")

    files = {path.relative_to(PACKAGE).as_posix(): path.read_bytes() for path in sorted(PACKAGE.rglob("*")) if path.is_file()}
    for platform, library in libraries.items():
        place, editor, player = PLATFORMS[platform]
        files[place] = library.read_bytes()
        files[place + ".meta"] = plugin_meta(PACKAGE / place, editor, player).encode()
        for folder in Path(place).parents:
            if folder.as_posix() not in (".", "Plugins"):
                text = f"fileFormatVersion: 2\nguid: {guid(PACKAGE / folder)}\n" + meta(PACKAGE / "Runtime").split("\n", 2)[2]
                files[folder.as_posix() + ".meta"] = text.encode()
    root = HERE.parent.parent
    for licence in ("LICENSE-MIT", "LICENSE-APACHE"):
        files[f"{licence}.md"] = (root / licence).read_bytes()
        files[f"{licence}.md.meta"] = meta(PACKAGE / f"{licence}.md").encode()

    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    with tarfile.open(arguments.output, "w:gz") as archive:
        for name, content in sorted(files.items()):
            info = tarfile.TarInfo(f"package/{name}")
            info.size = len(content)
            info.mode = 0o644
            archive.addfile(info, io.BytesIO(content))


if __name__ == "__main__":
    main()
