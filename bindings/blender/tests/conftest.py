"""Finds the package; leaves the tests of Blender out where there is no bpy."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]

HAS_BLENDER = importlib.util.find_spec("bpy") is not None
collect_ignore_glob = [] if HAS_BLENDER else ["test_blender_*.py"]

if HAS_BLENDER:
    import bpy

    import superhelix_hair

    superhelix_hair.register()

    @pytest.hookimpl(trylast=True)
    def pytest_unconfigure(config: pytest.Config) -> None:
        # Blender 4.x hangs when Python ends after a handler has run.
        if bpy.app.version < (5, 0):
            import os

            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(int(getattr(config, "exit_code", 1)))

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
        session.config.exit_code = int(exitstatus)
else:
    # The core needs the folder's modules only.
    import types

    package = types.ModuleType("superhelix_hair")
    package.__path__ = [str(HERE.parent / "superhelix_hair")]
    sys.modules["superhelix_hair"] = package
