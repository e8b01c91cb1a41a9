"""Finds the shared library, loads it, and checks that it is the one this package was generated for."""

from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path

from superhelix import _capi

#: Names a shared library to load in place of the bundled one.
VARIABLE = "SUPERHELIX_LIBRARY"


def library_name() -> str:
    """The file name of the library that the wheel bundles."""
    if sys.platform == "win32":
        return "superhelix.dll"
    return "libsuperhelix.dylib" if sys.platform == "darwin" else "libsuperhelix.so"


def library_path() -> Path:
    """The library to load: SUPERHELIX_LIBRARY if set, else the one beside this file."""
    chosen = os.environ.get(VARIABLE)
    path = Path(chosen) if chosen else Path(__file__).resolve().parent / library_name()
    if not path.exists():
        why = f"{VARIABLE} names {path}, which does not exist" if chosen else f"{path} is missing: install the package, or set {VARIABLE}"
        raise ImportError(f"superhelix: no shared library: {why}")
    return path


def version_text(version: int) -> str:
    """0x00010000 as "0.1.0"."""
    return f"{version >> 24}.{version >> 16 & 255}.{version >> 8 & 255}"


def check_version(found: int, found_abi: int, where: str) -> None:
    """Raises ImportError where a library cannot serve this package."""
    if found_abi != _capi.SHX_ABI_VERSION:
        raise ImportError(f"superhelix: {where} has ABI version {found_abi}, but this package needs {_capi.SHX_ABI_VERSION}")
    if found < _capi.SHX_VERSION:
        raise ImportError(f"superhelix: {where} is version {version_text(found)}, but this package needs {version_text(_capi.SHX_VERSION)} or later")


def load() -> _capi.Functions:
    """The library's functions."""
    path = library_path()
    try:
        library = ctypes.CDLL(str(path.resolve()))
        abi, version = library.shx_abi_version, library.shx_version
        abi.restype = version.restype = ctypes.c_uint32
        abi.argtypes = version.argtypes = []
    except (OSError, AttributeError) as error:
        raise ImportError(f"superhelix: {path} cannot be loaded: {error}") from error
    # Before the functions are bound: an older library may lack some.
    check_version(int(version()), int(abi()), str(path))
    return _capi.Functions(library)


functions = load()


def version() -> str:
    """The version of the library that runs, such as "0.1.0"."""
    return version_text(functions.shx_version())


def abi_version() -> int:
    """The binary interface of the library that runs. It is the one that this package was generated for."""
    return functions.shx_abi_version()


def build_info() -> str:
    """One line for bug reports: name, version, machine, system, checks."""
    return functions.shx_build_info().decode()
