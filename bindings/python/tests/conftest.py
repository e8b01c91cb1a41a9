"""Shared code of the tests: a count of the API's functions called, and scenes."""

from __future__ import annotations

import ctypes
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from superhelix import _capi, _library

CALLED: Counter[str] = Counter()
ROOT = Path(__file__).resolve().parents[3]
GROOMS = ROOT / "tests" / "data" / "grooms"


def counted(name: str, function: Any) -> Any:
    def call(*arguments: Any) -> Any:
        CALLED[name] += 1
        return function(*arguments)

    return call


# The package looks functions up by name when it calls them.
for _name in _capi.SIGNATURES:
    setattr(_library.functions, _name, counted(_name, getattr(_library.functions, _name)))

import superhelix as shx  # noqa: E402

assert ctypes.sizeof(ctypes.c_void_p) == 8


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--all-functions", action="store_true", help="fail unless the tests have called every function of the API")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    # The test that looks at what all the others have called comes last.
    items.sort(key=lambda item: "test_every_function" in item.name)


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(20)


@pytest.fixture
def solver() -> Any:
    with shx.Solver() as made:
        yield made


def hanging(count: int = 4, elements: int = 5, length: float = 0.2, **fields: Any) -> shx.StrandDefs:
    """Strands side by side that leave their roots downwards."""
    roots = shx.frames.frames_along(np.c_[np.arange(count) * 0.01, np.zeros((count, 2))], (0.0, 0.0, -1.0), (1.0, 0.0, 0.0))
    return shx.StrandDefs(count, element_count=elements, length=length, root=roots, **fields)


def mass(length: float = 0.2, radius: float = 50e-6, density: float = 1300.0) -> float:
    return density * np.pi * radius**2 * length


def cube(half: float = 0.5) -> tuple[np.ndarray, np.ndarray]:
    """A closed cube, wound outward."""
    corners = np.array([[x, y, z] for x in (-half, half) for y in (-half, half) for z in (-half, half)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], dtype=np.uint32)


def sphere_mesh(radius: float = 0.1, rings: int = 12, segments: int = 24) -> tuple[np.ndarray, np.ndarray]:
    """A closed sphere, wound outward."""
    points = [[0.0, 0.0, radius]]
    for ring in range(1, rings):
        polar = np.pi * ring / rings
        for segment in range(segments):
            around = 2 * np.pi * segment / segments
            points.append([radius * np.sin(polar) * np.cos(around), radius * np.sin(polar) * np.sin(around), radius * np.cos(polar)])
    points.append([0.0, 0.0, -radius])
    triangles = []
    for segment in range(segments):
        after = (segment + 1) % segments
        triangles.append((0, 1 + segment, 1 + after))
        for ring in range(rings - 2):
            a, b = 1 + ring * segments + segment, 1 + ring * segments + after
            triangles += [(a, a + segments, b + segments), (a, b + segments, b)]
        last = 1 + (rings - 2) * segments
        triangles.append((len(points) - 1, last + after, last + segment))
    return np.array(points), np.array(triangles, dtype=np.uint32)
