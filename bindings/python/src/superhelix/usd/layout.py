"""How strands lie in a layer: one BasisCurves prim for each group, and what of it changes over time."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix._buffers import column
from superhelix.usd._pxr import Gf, Sdf, UsdGeom, Vt
from superhelix.usd.curves.bases import Integers, Numbers, points_of
from superhelix.usd.curves.primvars import FRAME

BASES = ("linear", "catmullRom")
FRAME_ATTRIBUTE = f"primvars:{FRAME}"
#: Attributes that frames have, and their types.
VARYING = {
    "points": Sdf.ValueTypeNames.Point3fArray,
    "extent": Sdf.ValueTypeNames.Float3Array,
    "velocities": Sdf.ValueTypeNames.Vector3fArray,
    "widths": Sdf.ValueTypeNames.FloatArray,
    FRAME_ATTRIBUTE: Sdf.ValueTypeNames.QuatfArray,
}


def vectors(rows: npt.NDArray[Any]) -> Any:
    """Rows of three numbers as an array of USD."""
    return Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(rows, dtype=np.float32))


def floats(values: npt.NDArray[Any]) -> Any:
    """Numbers as an array of USD."""
    return Vt.FloatArray.FromNumpy(np.ascontiguousarray(values, dtype=np.float32))


def quaternions(rows: npt.NDArray[Any]) -> Any:
    """Quaternions x, y, z, w as an array of USD, whose memory has them in that order."""
    return Vt.QuatfArray.FromBuffer(np.ascontiguousarray(rows, dtype=np.float32))


def prim_name(name: str) -> str:
    """A name as USD allows it."""
    cleaned = re.sub(r"\W", "_", name.strip("/"), flags=re.ASCII) or "strands"
    return cleaned if not cleaned[0].isdigit() else f"_{cleaned}"


@dataclass
class Group:
    """The strands of one prim: their indices, and those of their points."""

    name: str
    path: str
    strands: Integers
    points: Integers
    counts: Integers


@dataclass
class Layout:
    """What the strands of a file are, and what of them does not change."""

    groups: list[Group]
    total: int
    basis: str
    scale: float
    named: bool

    def rows(self, name: str, values: Any, width: int) -> Numbers:
        """Rows for all points, finite, as float64 or float32."""
        array = np.asarray(values)
        array = array.reshape(-1, width) if array.size == self.total * width and array.shape[-1:] == ((width,) if width > 1 else array.shape[-1:]) else array
        if array.shape != (self.total, width) or array.dtype.kind not in "fiu":
            raise ValueError(f"{name}: shape {np.asarray(values).shape}; a row of {width} for each of {self.total} points expected")
        good = np.isfinite(array).all(axis=1)
        if not good.all():
            raise ValueError(f"{name}: row {int(np.argmin(good))} is {array[np.argmin(good)].tolist()}; finite numbers expected")
        return array


def groups_of(names: Sequence[str] | None, counts: Integers, root: str) -> list[Group]:
    """The groups of strands, in the order in which they appear."""
    if names is None:
        names = ["strands"] * len(counts)
    if len(names) != len(counts):
        raise ValueError(f"groups: {len(names)} names; one for each of {len(counts)} strands expected")
    labels = {name: number for number, name in enumerate(dict.fromkeys(names))}
    which = np.array([labels[name] for name in names], dtype=np.int64)
    taken, made = set[str](), list[Group]()
    for name, number in labels.items():
        strands = np.flatnonzero(which == number)
        short = base = prim_name(name)
        again = 1
        while short in taken:
            again += 1
            short = f"{base}_{again}"
        taken.add(short)
        made.append(Group(name, f"{root}/{short}", strands, points_of(strands, counts), counts[strands]))
    return made


def strand_primvars(values: Mapping[str, Any], count: int) -> dict[str, tuple[Any, npt.NDArray[Any]]]:
    """Types and values of data per strand."""
    kinds = {"root_uvs": ("st", 2), "skin_uvs": ("skinprimuv", 2), "skin_prims": ("skinprim", 1), "ids": ("id", 1)}
    made: dict[str, tuple[Any, npt.NDArray[Any]]] = {}
    for key, given in values.items():
        if given is None:
            continue
        name, width = kinds.get(key, (key, 1))
        if key in kinds and width == 1:
            whole = column(key, given, np.int64, count)
            small = len(whole) == 0 or (whole.min() >= -(2**31) and whole.max() < 2**31)
            made[name] = (Sdf.ValueTypeNames.IntArray, whole.astype(np.int32)) if small else (Sdf.ValueTypeNames.Int64Array, whole)
            continue
        if key in kinds:
            made[name] = (Sdf.ValueTypeNames.TexCoord2fArray, column(key, given, np.float64, count, 2).astype(np.float32))
            continue
        array = np.asarray(given)
        if array.shape[:1] != (count,) or array.ndim > 2 or (array.ndim == 2 and array.shape[1] != 3):
            raise ValueError(f"primvars[{key!r}]: shape {array.shape}; ({count},) or ({count}, 3) expected")
        if array.dtype.kind in "iub":
            made[name] = (Sdf.ValueTypeNames.IntArray, array.astype(np.int32))
        elif array.dtype.kind == "f":
            made[name] = (Sdf.ValueTypeNames.FloatArray if array.ndim == 1 else Sdf.ValueTypeNames.Float3Array, array.astype(np.float32))
        elif array.dtype.kind in "UO":
            made[name] = (Sdf.ValueTypeNames.StringArray, array.astype(str))
        else:
            raise TypeError(f"primvars[{key!r}]: {array.dtype}; numbers or strings expected")
    return made


def as_usd(values: npt.NDArray[Any]) -> Any:
    """An array per strand as an array of USD."""
    if values.dtype.kind == "U":
        return Vt.StringArray(values.tolist())
    kinds = {("f", 1): Vt.FloatArray, ("f", 2): Vt.Vec2fArray if values.shape[-1] == 2 else Vt.Vec3fArray, ("i", 1): Vt.IntArray}
    kind = Vt.Int64Array if values.dtype == np.int64 else kinds[values.dtype.kind, values.ndim]
    return kind.FromNumpy(np.ascontiguousarray(values))


def define(stage: Any, group: Group, layout: Layout, data: Mapping[str, tuple[Any, npt.NDArray[Any]]]) -> Any:
    """Makes the prim of a group, with everything that does not change."""
    curves = UsdGeom.BasisCurves.Define(stage, group.path)
    curves.CreateTypeAttr(UsdGeom.Tokens.linear if layout.basis == "linear" else UsdGeom.Tokens.cubic)
    if layout.basis != "linear":
        curves.CreateBasisAttr(layout.basis)
    curves.CreateWrapAttr(UsdGeom.Tokens.nonperiodic if layout.basis == "linear" else UsdGeom.Tokens.pinned)
    curves.CreateCurveVertexCountsAttr(Vt.IntArray.FromNumpy(group.counts.astype(np.int32)))
    primvars = UsdGeom.PrimvarsAPI(curves)
    for name, (kind, values) in data.items():
        primvars.CreatePrimvar(name, kind, UsdGeom.Tokens.uniform).Set(as_usd(values[group.strands]))
    if layout.named:
        primvars.CreatePrimvar("groom_group_name", Sdf.ValueTypeNames.StringArray, UsdGeom.Tokens.constant).Set(Vt.StringArray([group.name]))
    return curves


def extent(points: npt.NDArray[Any], widths: npt.NDArray[Any] | float) -> Any:
    """The box of points and their widths."""
    half = 0.5 * float(np.max(widths)) if np.size(widths) else 0.0
    low, high = points.min(axis=0).astype(np.float64) - half, points.max(axis=0).astype(np.float64) + half
    return Vt.Vec3fArray([Gf.Vec3f(*low.tolist()), Gf.Vec3f(*high.tolist())])
