"""Builds the wheel: Python files, and the shared library beside them. The wheel serves every Python 3.10+ of a platform.

The library is compiled by cargo, in the repository that this folder is part of, unless SUPERHELIX_LIBRARY names one that is built already.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def library_name() -> str:
    """The file name of a shared library here."""
    if sys.platform == "win32":
        return "superhelix.dll"
    return "libsuperhelix.dylib" if sys.platform == "darwin" else "libsuperhelix.so"


def crate_version() -> str:
    """The version of the Rust crate, which is that of the package."""
    manifest = ROOT / "Cargo.toml"
    if not manifest.exists():
        raise SystemExit(f"superhelix: {manifest} is missing: install from the repository's bindings/python")
    found = re.search(r'^version = "(.*)"$', manifest.read_text(encoding="utf-8"), re.MULTILINE)
    if found is None:
        raise SystemExit(f"superhelix: {manifest} states no version")
    return found[1]


def built_library() -> Path:
    """The shared library: the one that SUPERHELIX_LIBRARY names, or one that cargo compiles now."""
    named = os.environ.get("SUPERHELIX_LIBRARY")
    if named:
        path = Path(named).resolve()
        if not path.exists():
            raise SystemExit(f"superhelix: SUPERHELIX_LIBRARY names {named}, which does not exist")
        return path
    if shutil.which("cargo") is None:
        raise SystemExit("superhelix: cargo is missing: install Rust from https://rustup.rs, or let SUPERHELIX_LIBRARY name a built library")
    profile = os.environ.get("SUPERHELIX_PROFILE", "release")
    command = ["cargo", "rustc", "--locked", "--lib", "--profile", profile, "--crate-type", "cdylib"]
    print("superhelix:", " ".join(command), flush=True)
    if subprocess.run(command, cwd=ROOT, check=False).returncode:
        raise SystemExit("superhelix: the library could not be compiled: cargo's messages are above")
    target = Path(os.environ.get("CARGO_TARGET_DIR", "target"))
    return ROOT / target / ("debug" if profile == "dev" else profile) / library_name()


def platform_tag(library: Path) -> str:
    """The wheel's platform: on Linux with glibc manylinux, by the newest glibc symbol that the library wants."""
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    if not platform.startswith("linux_"):
        return platform
    versions = re.findall(rb"GLIBC_(\d+)\.(\d+)", library.read_bytes())
    if not versions:
        return platform
    major, minor = max((int(major), int(minor)) for major, minor in versions)
    return f"manylinux_{major}_{minor}_{platform.removeprefix('linux_')}"


class BuildWithLibrary(build_py):
    """Puts the shared library and the licences beside the Python files."""

    def run(self) -> None:
        """Runs the command."""
        super().run()
        folder = HERE / "src" / "superhelix" if self.editable_mode else Path(self.build_lib) / "superhelix"
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(built_library(), folder / library_name())
        if not self.editable_mode:
            for licence in ("LICENSE-MIT", "LICENSE-APACHE"):
                shutil.copyfile(ROOT / licence, folder / licence)


class PlatformWheel(bdist_wheel):
    """A wheel for any Python 3, and one platform."""

    def finalize_options(self) -> None:
        """Says that the wheel is not pure."""
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self) -> tuple[str, str, str]:
        """The wheel's tag."""
        found = list(Path(self.bdist_dir).glob(f"superhelix/{library_name()}")) or list(HERE.glob(f"build/lib*/superhelix/{library_name()}"))
        platform = platform_tag(found[0]) if found else sysconfig.get_platform().replace("-", "_").replace(".", "_")
        return "py3", "none", platform


class WithLibrary(Distribution):
    """A distribution that has compiled parts."""

    def has_ext_modules(self) -> bool:
        """Whether it has."""
        return True


setup(version=crate_version(), distclass=WithLibrary, cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel})
