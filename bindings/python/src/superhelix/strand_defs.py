"""Definitions of many strands at once."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import address, column, frame_rows, whole
from superhelix._library import functions
from superhelix._record import dtype_of
from superhelix.enums import Dofs
from superhelix.errors import check
from superhelix.records import HairStrandTable, Material

if TYPE_CHECKING:
    from superhelix.fit import Fit

_MATERIAL = ("radius", "density", "youngs_modulus", "poisson_ratio", "internal_friction", "viscosity", "air_drag")
_PLAIN = ("length", *_MATERIAL, "dofs", "user_data", "root_velocity", "root_angular_velocity")
_ROWS = {"natural_curvatures": 3, "initial_curvatures": 3, "initial_rates": 3, "element_lengths": 1}


class StrandDefs:
    """Definitions of strands. Every keyword is a value for all strands, or an array with a value for each; what is left out has the library's
    default (see the table in docs/reference/python.md).

    element_count: helical elements, 1 to 100000; taken from the arrays where they say it. length: m. radius: semi-axes of the section along
    n1 and n2, m, two numbers. density: kg/m^3. youngs_modulus: Pa. poisson_ratio. internal_friction: kg m^3/s. viscosity: s. air_drag:
    kg/(m s). material: a Material, in place of those seven. dofs: which curvatures may change. root: frames of the follicles (origin in m and
    quaternion x, y, z, w: see superhelix.frames). user_data: a number of yours. root_velocity: m/s. root_angular_velocity: rad/s.

    Rows for the elements, (twist, curvature about n1, curvature about n2) each: natural_curvatures and initial_curvatures, rad/m,
    initial_rates, rad/(m s); and element_lengths, m, a number each. Of shape (elements, 3) they are for all strands alike, of shape
    (strands, elements, 3) for each; where strands differ in their number of elements, the rows of all strands one after the other.

    data is the structured array of all definitions: its columns may be changed before the strands are added.
    """

    __slots__ = ("_counts", "_kept", "data")

    def __init__(
        self,
        count: int = 1,
        *,
        element_count: npt.ArrayLike | None = None,
        length: npt.ArrayLike | None = None,
        radius: npt.ArrayLike | None = None,
        density: npt.ArrayLike | None = None,
        youngs_modulus: npt.ArrayLike | None = None,
        poisson_ratio: npt.ArrayLike | None = None,
        internal_friction: npt.ArrayLike | None = None,
        viscosity: npt.ArrayLike | None = None,
        air_drag: npt.ArrayLike | None = None,
        material: Material | HairStrandTable | None = None,
        dofs: Dofs | npt.ArrayLike | None = None,
        root: Any = None,
        user_data: npt.ArrayLike | None = None,
        root_velocity: npt.ArrayLike | None = None,
        root_angular_velocity: npt.ArrayLike | None = None,
        natural_curvatures: npt.ArrayLike | None = None,
        initial_curvatures: npt.ArrayLike | None = None,
        initial_rates: npt.ArrayLike | None = None,
        element_lengths: npt.ArrayLike | None = None,
    ) -> None:
        count = whole("count", count, 0, 2**40)
        first = _capi.shx_strand_def()
        check(functions.shx_strand_def_init(ctypes.byref(first), ctypes.sizeof(first)))
        self.data: npt.NDArray[Any] = np.empty(count, dtype=dtype_of(_capi.shx_strand_def))
        self.data[:] = np.frombuffer(bytes(first), dtype=self.data.dtype, count=1)
        self._kept: dict[str, npt.NDArray[Any]] = {}
        if material is not None:
            self.set_material(material)
        given = {
            "length": length,
            "radius": radius,
            "density": density,
            "youngs_modulus": youngs_modulus,
            "poisson_ratio": poisson_ratio,
            "internal_friction": internal_friction,
            "viscosity": viscosity,
            "air_drag": air_drag,
            "dofs": dofs,
            "user_data": user_data,
            "root_velocity": root_velocity,
            "root_angular_velocity": root_angular_velocity,
        }
        for name, value in given.items():
            if value is not None:
                self._put(name, value)
        if root is not None:
            self._put_root(frame_rows("root", root))
        rows = {
            "natural_curvatures": natural_curvatures,
            "initial_curvatures": initial_curvatures,
            "initial_rates": initial_rates,
            "element_lengths": element_lengths,
        }
        arrays = {name: np.asarray(value) for name, value in rows.items() if value is not None}
        self._count_elements(element_count, arrays)
        for name, array in arrays.items():
            self._put_rows(name, array)
        #: How many rows there are for each strand: more must not be read.
        self._counts: npt.NDArray[np.uint32] = self.data["element_count"].copy()

    @classmethod
    def from_fit(cls, fit: Fit, *, material: Material | HairStrandTable | None = None, **fields: Any) -> StrandDefs:
        """Definitions of strands that were fitted to curves, whose root, length, elements and natural curvatures they have. Every curve must
        have been fitted: fit.select(fit.fitted) leaves the others out. Other fields as in StrandDefs.
        """
        defs = cls(len(fit), material=material, **fields)
        start, size = address(defs.data), defs.data.dtype.itemsize
        lengths, curvatures = address(fit.element_lengths), address(fit.curvatures)
        # The radius that a material states is wanted, not the one that the file's widths say.
        radius = defs.data["radius"].copy()
        for place in range(len(fit)):
            row = place * fit.element_lengths.shape[1]
            check(
                functions.shx_strand_def_set_fit(
                    start + place * size,
                    address(fit.strands.data) + place * fit.strands.data.strides[0],
                    lengths + row * 8,
                    curvatures + row * 24,
                )
            )
        if material is not None or "radius" in fields:
            defs.data["radius"] = radius
        defs._kept["fit lengths"], defs._kept["fit curvatures"] = fit.element_lengths, fit.curvatures
        defs._counts = defs.data["element_count"].copy()
        return defs

    def set_material(self, material: Material | HairStrandTable) -> None:
        """Gives the strands a section and a material: one for all, or those of a table with a row for each."""
        for name in _MATERIAL:
            self._put(name, getattr(material, name))

    def _put(self, name: str, value: Any) -> None:
        target = self.data[name]
        array = np.asarray(value)
        if array.dtype.kind not in "iufb" or (target.dtype.kind == "u" and array.dtype.kind == "f"):
            raise TypeError(f"{name}: {array.dtype}; numbers of {target.dtype} expected")
        if target.dtype.kind == "u" and array.size and (array.min() < 0 or int(array.max()) > np.iinfo(target.dtype).max):
            raise ValueError(f"{name}: {array.min()} to {array.max()}; 0 to {np.iinfo(target.dtype).max} expected")
        try:
            target[...] = array
        except ValueError:
            raise ValueError(f"{name}: shape {array.shape}; {target.shape[1:] or 'a number'} or {target.shape} expected") from None

    def _put_root(self, frames: npt.NDArray[np.float64]) -> None:
        rows = frames.reshape(-1, 7)
        if len(rows) not in (1, len(self.data)):
            raise ValueError(f"root: {len(rows)} frames; 1 or {len(self.data)} expected")
        self.data["root"]["origin"] = rows[:, :3]
        self.data["root"]["rotation"] = rows[:, 3:]

    def _count_elements(self, given: npt.ArrayLike | None, arrays: dict[str, npt.NDArray[Any]]) -> None:
        """Sets element_count: as given, or as the arrays' shapes say."""
        if given is not None:
            self._put("element_count", given)
            return
        for name, array in arrays.items():
            shape = array.shape[:-1] if _ROWS[name] == 3 else array.shape
            if len(shape) in (1, 2):
                self._put("element_count", shape[-1])
                return

    def _put_rows(self, name: str, array: npt.NDArray[Any]) -> None:
        """Points the definitions to rows for their elements."""
        width = _ROWS[name]
        shape = array.shape[:-1] if width == 3 else array.shape
        if width == 3 and (array.ndim < 2 or array.shape[-1] != 3):
            raise ValueError(f"{name}: shape {array.shape}; (..., 3) expected")
        rows = column(name, array, np.float64, width=width)
        counts = self.data["element_count"].astype(np.int64)
        total, strands = int(counts.sum()), len(counts)
        alike = strands > 0 and bool((counts == counts[0]).all())
        if len(shape) == 1 and alike and shape[0] == counts[0]:
            places = np.zeros(strands, dtype=np.int64)
        elif (len(shape) == 1 and shape[0] == total) or (len(shape) == 2 and alike and shape == (strands, counts[0])):
            places = np.concatenate([[0], np.cumsum(counts)[:-1]]) if strands else np.zeros(0, dtype=np.int64)
        else:
            expected = f"({counts[0]} elements) or ({strands} strands, {counts[0]} elements)" if alike else f"{total} rows in all"
            raise ValueError(f"{name}: shape {array.shape}; {expected} expected")
        self._kept[name] = rows
        self.data[name] = (address(rows) + places * (8 * width)).astype(np.uint64)

    def __len__(self) -> int:
        return len(self.data)

    def __getitem__(self, index: slice | npt.NDArray[Any] | list[int]) -> StrandDefs:
        """Some of the definitions."""
        other = StrandDefs(0)
        other.data, other._kept, other._counts = self.data[index], self._kept, self._counts[index]
        return other

    def __repr__(self) -> str:
        return f"StrandDefs({len(self)})"

    def _ready(self, count: int | None = None) -> npt.NDArray[Any]:
        """The definitions as functions take them; count: how many there must be."""
        if count is not None and len(self.data) != count:
            raise ValueError(f"strand: {len(self.data)} definitions; {count} expected")
        if self._kept and not np.array_equal(self.data["element_count"], self._counts):
            raise ValueError("element_count: changed after rows for the elements were given; create the definitions anew")
        return np.ascontiguousarray(self.data)
