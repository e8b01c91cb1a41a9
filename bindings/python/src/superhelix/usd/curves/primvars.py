"""Data of curves: widths and primvars with their interpolation, and the names that grooming programs give to what a root is."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix.usd._pxr import UsdGeom, UsdWarning, refuse
from superhelix.usd.curves.bases import Evaluator, Integers, Numbers, starts_of, varying_counts

#: Names of primvars, in the order in which they are looked for. Texture coordinates of the root: USD's own; Houdini, Arnold and XGen; the Unreal groom
#: schema; Blender.
ROOT_UV = ("st", "uv", "uvs", "groom_root_uv", "root_uv", "rootUV", "surface_uv_coordinate")
#: The face of the skin on which the root is: Houdini; XGen's caches converted to USD.
SKIN_PRIM = ("skinprim", "xpd:faceIds", "faceId", "face_id")
#: Where on that face the root is: Houdini; XGen's caches converted to USD.
SKIN_UV = ("skinprimuv", "xpd:uvLocations")
#: The number of the strand: Houdini and Arnold; the Unreal groom schema; XGen and Yeti for RenderMan.
STRAND_ID = ("id", "hairid", "hair_id", "groom_id", "curve_id", "id_XP", "fur_id")
#: The group of the strand: the Unreal groom schema first.
GROUP = ("groom_group_name", "groom_group_id", "hair_group", "group_name", "group_id", "group")
#: Material frames that superhelix writes.
FRAME = "superhelix:frame"


@dataclass
class CurveDatum:
    """Values of one attribute: a row per item, and which items those are."""

    name: str
    values: npt.NDArray[Any]
    interpolation: str

    def along(self, evaluator: Evaluator, counts: Integers) -> Numbers:
        """Returns a row for each evaluated point."""
        rows = np.asarray(self.values, dtype=np.float64).reshape(len(self.values), -1)
        if self.interpolation == "vertex":
            return evaluator.vertex(rows)
        if self.interpolation == "varying":
            return evaluator.varying(rows)
        return np.repeat(self.per_curve(evaluator, counts).reshape(len(counts), -1), evaluator.counts, axis=0)

    def per_curve(self, evaluator: Evaluator, counts: Integers) -> npt.NDArray[Any]:
        """Returns a row for each curve: its root's."""
        if self.interpolation == "uniform":
            return self.values
        if self.interpolation == "constant":
            return np.repeat(self.values[:1], len(counts), axis=0)
        if self.interpolation == "varying":
            return self.values[starts_of(varying_counts(evaluator.segments, evaluator.closed))]
        return self.values[starts_of(counts)]


def _array(values: Any) -> npt.NDArray[Any] | None:
    """Values of an attribute as rows; None where there are none."""
    if values is None:
        return None
    try:
        array = np.array(values)
    except (TypeError, ValueError):
        return None
    if array.dtype == object:
        array = np.array([str(item) for item in values])
    array = array.reshape(1) if array.ndim == 0 else array
    return array if len(array) else None


def datum(prim: Any, name: str, values: Any, interpolation: str, evaluator: Evaluator, counts: Integers) -> CurveDatum | None:
    """Values with the interpolation that their number fits: the one that is stated, or, with a warning, the one that the number says."""
    array = _array(values)
    if array is None:
        return None
    sizes = {
        "vertex": evaluator.total,
        "varying": int(varying_counts(evaluator.segments, evaluator.closed).sum()),
        "uniform": len(counts),
        "constant": 1,
    }
    if interpolation not in sizes:
        refuse(prim, f"{name} has interpolation {interpolation!r}; constant, uniform, varying or vertex expected")
    if len(array) == 1 and sizes[interpolation] != 1:
        # One value for all without a word on its interpolation: many programs write widths so.
        interpolation = "constant"
    if len(array) != sizes[interpolation]:
        fits = [other for other, size in sizes.items() if size == len(array)]
        if not fits:
            wanted = ", ".join(f"{size} ({other})" for other, size in sizes.items())
            refuse(prim, f"{name} has {len(array)} values with interpolation {interpolation!r}; expected {wanted}")
        text = f"{prim.GetPath()}: {name} has {len(array)} values, which fits interpolation {fits[0]!r}, not {interpolation!r} as stated: read as {fits[0]!r}"
        warnings.warn(text, UsdWarning, stacklevel=2)
        interpolation = fits[0]
    return CurveDatum(name, array, interpolation)


def primvar(prim: Any, name: str, code: Any, evaluator: Evaluator, counts: Integers) -> CurveDatum | None:
    """A primvar of a prim, with its indices applied; None where it has no value."""
    found = UsdGeom.PrimvarsAPI(prim).GetPrimvar(name)
    if not found or not found.HasValue():
        return None
    values = found.ComputeFlattened(code)
    if values is None and found.IsIndexed():
        indices = np.asarray(found.GetIndices(code))
        refuse(prim, f"primvars:{name}:indices has {indices.max() if len(indices) else 'nothing'}, for {len(found.Get(code) or ())} values")
    return datum(prim, f"primvars:{name}", values, str(found.GetInterpolation()), evaluator, counts)


def first_primvar(prim: Any, names: tuple[str, ...], code: Any, evaluator: Evaluator, counts: Integers) -> CurveDatum | None:
    """The first of these primvars that has a value."""
    for name in names:
        found = primvar(prim, name, code, evaluator, counts)
        if found is not None:
            return found
    return None


def widths(prim: Any, code: Any, evaluator: Evaluator, counts: Integers) -> CurveDatum | None:
    """Widths: primvars:widths before the attribute, as USD has it."""
    found = primvar(prim, "widths", code, evaluator, counts)
    if found is not None:
        return found
    curves = UsdGeom.Curves(prim)
    return datum(prim, "widths", curves.GetWidthsAttr().Get(code), str(curves.GetWidthsInterpolation()), evaluator, counts)
