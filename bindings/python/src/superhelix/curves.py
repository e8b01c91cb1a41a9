"""Groom files and caches: curves read and written."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterator
from types import TracebackType
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import Output, address, as_rows, column, float_type, input_rows, whole
from superhelix._handle import Handle, Owner, made
from superhelix._library import functions
from superhelix._record import initialize
from superhelix.enums import CurveAttribute, UpAxis
from superhelix.errors import check

Path = str | os.PathLike[str]


def _path(path: Path) -> bytes:
    return os.fsencode(path)


class Units(NamedTuple):
    """Metres per file unit (0: unknown), and the up axis."""

    metres: float
    up_axis: UpAxis


class Curves(Owner):
    """Strands of a groom file: polylines, root first, in file units. Immutable."""

    __slots__ = ()

    def __init__(self, path: Path) -> None:
        """Reads Cem Yuksel's .hair, TressFX .tfx, Wavefront .obj with lines, USD as text (.usda) and Alembic (.abc) at their first time sample, .data,
        .ply with the points of strands, .npy or .npz. docs/reference/files.md says what of each.
        """
        name = _path(path)
        self._open = made(functions.shx_curves_destroy, lambda out: functions.shx_curves_read(name, out))

    @classmethod
    def _from(cls, handle: Handle) -> Curves:
        curves = cls.__new__(cls)
        curves._open = handle
        return curves

    def _counts(self) -> tuple[int, int]:
        strands, points = ctypes.c_size_t(), ctypes.c_size_t()
        check(functions.shx_curves_count(self._handle, ctypes.byref(strands), ctypes.byref(points)))
        return strands.value, points.value

    @property
    def strand_count(self) -> int:
        """Number of strands."""
        return self._counts()[0]

    @property
    def point_count(self) -> int:
        """Number of points of all strands."""
        return self._counts()[1]

    def __len__(self) -> int:
        return self.strand_count

    def point_counts(self) -> npt.NDArray[np.uint32]:
        """Returns the number of points of each strand."""
        counts = np.empty(self.strand_count, dtype=np.uint32)
        check(functions.shx_curves_point_counts(self._handle, address(counts), len(counts)))
        return counts

    def points(
        self,
        scale: float = 1.0,
        first_strand: int = 0,
        strand_count: int | None = None,
        *,
        dtype: npt.DTypeLike = np.float32,
        out: npt.NDArray[Any] | None = None,
    ) -> npt.NDArray[Any]:
        """Returns the points of strands, strand by strand, times scale (metres per file unit)."""
        counts = self.point_counts()
        first = whole("first_strand", first_strand, 0, 2**63)
        number = max(len(counts) - first, 0) if strand_count is None else whole("strand_count", strand_count, 0, 2**63)
        total = int(counts[first : first + number].sum())
        if out is None:
            out = np.empty((total, 3), dtype=float_type("dtype", dtype))
        output = Output("out", out, (3,), total)
        check(functions.shx_curves_points(self._handle, first, number, scale, ctypes.byref(output.view)))
        return out

    def attribute(self, attribute: CurveAttribute) -> npt.NDArray[np.float32] | None:
        """Returns an attribute of the file, one row or number per point or strand; None if the file does not have it."""
        which, count = whole("attribute", attribute), ctypes.c_size_t()
        check(functions.shx_curves_attribute(self._handle, which, None, 0, ctypes.byref(count)))
        if count.value == 0:
            return None
        numbers = np.empty(count.value, dtype=np.float32)
        check(functions.shx_curves_attribute(self._handle, which, address(numbers), len(numbers), ctypes.byref(count)))
        width = {CurveAttribute.COLOR: 3, CurveAttribute.VELOCITY: 3, CurveAttribute.STRAND_UV: 2}.get(CurveAttribute(which), 1)
        return numbers if width == 1 else numbers.reshape(-1, width)

    def units(self) -> Units:
        """Returns metres per file unit and the up axis, as the file states them."""
        metres, up = ctypes.c_double(), ctypes.c_uint32()
        check(functions.shx_curves_units(self._handle, ctypes.byref(metres), ctypes.byref(up)))
        return Units(metres.value, UpAxis(up.value))

    def __repr__(self) -> str:
        return "Curves(closed)" if self.closed else f"Curves({self.strand_count} strands, {self.point_count} points)"


def _counts_of(points: npt.NDArray[Any], point_counts: npt.ArrayLike | None) -> npt.NDArray[np.uint32]:
    if point_counts is not None:
        return column("point_counts", point_counts, np.uint32)
    if points.ndim != 3:
        raise ValueError(f"points: shape {points.shape}; (strands, points, 3) expected, or give point_counts")
    return np.full(points.shape[0], points.shape[1], dtype=np.uint32)


class CurveData:
    """Curves to write: points (file units, (strands, points, 3), or strand by strand (points, 3) with point_counts) and attributes: one row or
    number per point, strand_... per strand.
    """

    __slots__ = ("_c", "_kept")

    def __init__(
        self,
        points: npt.ArrayLike,
        point_counts: npt.ArrayLike | None = None,
        *,
        velocities: npt.ArrayLike | None = None,
        thickness: npt.ArrayLike | None = None,
        transparency: npt.ArrayLike | None = None,
        colors: npt.ArrayLike | None = None,
        pinned: npt.ArrayLike | None = None,
        strand_thickness: npt.ArrayLike | None = None,
        strand_uvs: npt.ArrayLike | None = None,
        up_axis: UpAxis = UpAxis.UNKNOWN,
        metres_per_unit: float = 0.0,
        tfx_version: int = 0,
    ) -> None:
        rows = as_rows("points", points)
        counts = _counts_of(rows, point_counts)
        total, strands = int(counts.sum()), len(counts)
        self._c = _capi.shx_curve_data()
        initialize(self._c)
        self._kept: list[Any] = [counts, input_rows("points", rows, (3, 4), total)]
        self._c.points, self._c.strand_count, self._c.point_counts = self._kept[1], strands, address(counts)
        self._c.up_axis, self._c.metres_per_unit = whole("up_axis", up_axis), metres_per_unit
        self._c.tfx_version = whole("tfx_version", tfx_version)
        if velocities is not None:
            self._kept.append(input_rows("velocities", velocities, (3, 4), total))
            self._c.velocities = self._kept[-1]
        self._put("thickness", thickness, np.float32, total, 1)
        self._put("transparency", transparency, np.float32, total, 1)
        self._put("colors", colors, np.float32, total, 3)
        self._put("pinned", pinned, np.uint8, total, 1)
        self._put("strand_thickness", strand_thickness, np.float32, strands, 1)
        self._put("strand_uvs", strand_uvs, np.float32, strands, 2)

    def _put(self, name: str, values: npt.ArrayLike | None, kind: type[Any], count: int, width: int) -> None:
        if values is not None:
            self._kept.append(column(name, values, kind, count, width))
            setattr(self._c, name, address(self._kept[-1]))


def write_curves(path: Path, data: CurveData | npt.ArrayLike, point_counts: npt.ArrayLike | None = None) -> None:
    """Writes curves to a .hair, .tfx, .obj or .usda file: CurveData with all attributes that the format can store, or points alone."""
    if isinstance(data, CurveData):
        check(functions.shx_curve_data_write(_path(path), ctypes.byref(data._c)))
        return
    rows = as_rows("points", data)
    counts = _counts_of(rows, point_counts)
    view = input_rows("points", rows, (3, 4), int(counts.sum()))
    check(functions.shx_curves_write_points(_path(path), ctypes.byref(view), address(counts), len(counts)))


class CurveCache(Owner):
    """Curves over time, from a .usda file with time samples. Immutable."""

    __slots__ = ()

    def __init__(self, path: Path) -> None:
        name = _path(path)
        self._open = made(functions.shx_curve_cache_destroy, lambda out: functions.shx_curve_cache_read(name, out))

    def times(self) -> npt.NDArray[np.float64]:
        """Returns the times of the frames, s, ascending."""
        count = ctypes.c_size_t()
        check(functions.shx_curve_cache_times(self._handle, None, 0, ctypes.byref(count)))
        times = np.empty(count.value)
        check(functions.shx_curve_cache_times(self._handle, address(times), len(times), ctypes.byref(count)))
        return times

    def sample(self, time: float) -> Curves:
        """Returns the curves at a time, s, linear between frames and constant outside."""
        handle = self._handle
        return Curves._from(made(functions.shx_curves_destroy, lambda out: functions.shx_curve_cache_sample(handle, time, out)))

    def __iter__(self) -> Iterator[tuple[float, Curves]]:
        for time in self.times().tolist():
            yield time, self.sample(time)


class CurveCacheWriter(Owner):
    """Writes a cache, a .usda file, which appears when the writer is closed. As a context manager it abandons the file if the block raises."""

    __slots__ = ("frame_count",)
    frame_count: int

    def __init__(self, path: Path, first: CurveData, frames_per_second: float) -> None:
        """first: point counts and attributes that do not change over time. If it has velocities, frames have velocities too."""
        name = _path(path)

        def create(out: Any) -> int:
            return functions.shx_curve_cache_writer_create(name, ctypes.byref(first._c), frames_per_second, out)

        self._open = made(functions.shx_curve_cache_writer_abandon, create)
        self.frame_count = 0

    def write(self, time: float, points: npt.ArrayLike, velocities: npt.ArrayLike | None = None) -> None:
        """Writes a frame: its time, s, later than the previous one, the points of all strands, and their velocities if the first had velocities."""
        view = input_rows("points", points)
        speeds = None if velocities is None else input_rows("velocities", velocities)
        check(functions.shx_curve_cache_writer_write(self._handle, time, ctypes.byref(view), None if speeds is None else ctypes.byref(speeds)))
        self.frame_count += 1

    def close(self) -> None:
        """Finishes the cache and moves the file into place. Raises if no frame was written."""
        handle = self._open
        if handle is not None:
            self._open = None
            result = functions.shx_curve_cache_writer_finish(handle)
            # The writer is freed whether that goes well or not.
            handle.forget()
            check(result)

    def abandon(self) -> None:
        """Abandons the cache and deletes what was written."""
        self._open = None

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is None:
            self.close()
        else:
            self.abandon()
