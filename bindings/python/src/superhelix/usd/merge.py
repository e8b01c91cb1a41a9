"""Puts the strands of several prims together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix.usd._pxr import UsdError
from superhelix.usd.curves.bases import Integers, Numbers, edges_along
from superhelix.usd.hair import Hair


@dataclass
class Part:
    """The strands of one prim, or of one instance of it. Fields are those of Hair."""

    path: str
    points: Numbers
    counts: Integers
    closed: bool
    arclengths: Numbers | None = None
    velocities: Numbers | None = None
    widths: Numbers | None = None
    frames: Numbers | None = None
    root_uvs: Numbers | None = None
    skin_prims: Integers | None = None
    skin_uvs: Numbers | None = None
    ids: Integers | None = None
    groups: list[str] | None = None
    primvars: dict[str, npt.NDArray[Any]] = field(default_factory=dict)


def _joined(parts: Sequence[Part], arrays: list[npt.NDArray[Any] | None], sizes: list[int], missing: Any) -> npt.NDArray[Any] | None:
    """Rows of all parts; rows of missing for parts that have none."""
    given = [array for array in arrays if array is not None]
    if not given:
        return None
    if len(arrays) == 1:
        return given[0]
    shape = given[0].shape[1:]
    for part, array in zip(parts, arrays):
        if array is not None and array.shape[1:] != shape:
            raise UsdError(part.path, f"a primvar has values of shape {array.shape[1:]} here, and of {shape} in another prim")
    kind = np.result_type(*given) if given[0].dtype.kind in "iufb" else np.dtype(object)
    if kind.kind in "iu" and any(array is None for array in arrays):
        kind = np.dtype(np.int64)
    return np.concatenate([np.full((size, *shape), missing, dtype=kind) if array is None else array.astype(kind) for array, size in zip(arrays, sizes)])


def _rows(arrays: list[Numbers]) -> Numbers:
    return arrays[0] if len(arrays) == 1 else np.concatenate(arrays)


def merged(parts: Sequence[Part], names: Sequence[str]) -> Hair:
    """The strands of all parts, in order."""
    points, strands = [len(part.points) for part in parts], [len(part.counts) for part in parts]
    hair = Hair(_rows([part.points for part in parts]), np.concatenate([part.counts for part in parts]).astype(np.uint32))
    if any(part.arclengths is not None for part in parts):
        for part in parts:
            part.arclengths = edges_along(part.points, part.counts) if part.arclengths is None else part.arclengths
    for name in ("arclengths", "widths", "frames"):
        setattr(hair, name, _joined(parts, [getattr(part, name) for part in parts], points, np.nan))
    hair.velocities = _joined(parts, [part.velocities for part in parts], points, 0.0)
    for name, missing in (("root_uvs", np.nan), ("skin_uvs", np.nan), ("skin_prims", -1), ("ids", -1)):
        setattr(hair, name, _joined(parts, [getattr(part, name) for part in parts], strands, missing))
    hair.prims = [part.path for part in parts]
    hair.prim_of = np.repeat(np.arange(len(parts)), strands)
    hair.curve_of = np.concatenate([np.arange(count) for count in strands])
    hair.closed = np.repeat([part.closed for part in parts], strands)
    names_of = [name for part, count in zip(parts, strands) for name in (part.groups or [part.path] * count)]
    numbers = {name: number for number, name in enumerate(dict.fromkeys(names_of))}
    hair.groups, hair.group_of = list(numbers), np.array([numbers[name] for name in names_of], dtype=np.int64)
    for name in names:
        arrays = [part.primvars.get(name) for part in parts]
        if all(array is None for array in arrays):
            raise UsdError(parts[0].path, f"primvars:{name} has no value here, nor in any other prim")
        long = [array is not None and len(array) == size and len(array) != count for array, size, count in zip(arrays, points, strands)]
        if any(long) and not all(here or array is None for here, array in zip(long, arrays)):
            raise UsdError(parts[long.index(False)].path, f"primvars:{name} has a value for each strand here, and for each point in another prim")
        joined = _joined(parts, arrays, points if any(long) else strands, _missing(arrays))
        assert joined is not None
        hair.primvars[name] = joined
    return hair


def _missing(arrays: list[npt.NDArray[Any] | None]) -> Any:
    kind = next(array.dtype.kind for array in arrays if array is not None)
    return {"f": np.nan, "i": -1, "u": -1, "b": False}.get(kind, "")
