"""Arrays in and out, without copies.

Bulk data goes through strided views: an array of float32 or float64 whose last axis (3, 4 or, for frames, 7 numbers) is contiguous is read
or written in place, whatever lies between its items. Lists and tuples are converted to float64. Small arrays (curvatures, arclengths) are
converted where they have another type or layout.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix.records import Frame

ScalarT = TypeVar("ScalarT", bound=np.generic)

#: Format by type and numbers of an item.
FORMATS = {
    (np.dtype(np.float32), 3): _capi.SHX_FORMAT_F32X3,
    (np.dtype(np.float32), 4): _capi.SHX_FORMAT_F32X4,
    (np.dtype(np.float64), 3): _capi.SHX_FORMAT_F64X3,
    (np.dtype(np.float64), 4): _capi.SHX_FORMAT_F64X4,
    (np.dtype(np.float64), 7): _capi.SHX_FORMAT_FRAME,
}

FRAME_TYPE = np.dtype([("origin", np.float64, 3), ("rotation", np.float64, 4)])

#: Points, directions: anything that numpy makes rows of numbers of.
ArrayLike = npt.ArrayLike

#: Frames: rows of seven numbers (origin, quaternion x y z w), a Frame, or a list of them.
FramesLike = "npt.ArrayLike | Frame | Sequence[Frame]"

#: An array that a function writes into.
OutArray = npt.NDArray[Any]


def address(array: npt.NDArray[Any]) -> int:
    """Where an array's first item is."""
    return int(array.__array_interface__["data"][0])


def _rows(name: str, array: npt.NDArray[Any], widths: Sequence[int]) -> tuple[int, int, int]:
    """The numbers of an item, bytes from one item to the next, and how many items an array has."""
    if array.ndim < 2 or array.shape[-1] not in widths:
        raise ValueError(f"{name}: shape {array.shape}; (..., {' or '.join(map(str, widths))}) expected")
    if array.dtype not in (np.float32, np.float64) or not array.dtype.isnative:
        raise TypeError(f"{name}: an array of {array.dtype}; float32 or float64 expected (name.astype converts)".replace("name.", f"{name}."))
    if (array.dtype, array.shape[-1]) not in FORMATS:
        raise TypeError(f"{name}: rows of {array.shape[-1]} {array.dtype}; float64 expected")
    item = array.dtype.itemsize * array.shape[-1]
    count = array.size // array.shape[-1]
    if count and array.strides[-1] != array.dtype.itemsize:
        raise ValueError(f"{name}: the numbers of an item are not contiguous (strides {array.strides}); np.ascontiguousarray makes them so")
    # All axes but the last must be one axis of evenly spaced items. An axis of length 1 may have any stride.
    axes = [(length, stride) for length, stride in zip(array.shape[:-1], array.strides[:-1]) if length != 1]
    for (_, outer), (length, inner) in pairwise(axes):
        if outer != length * inner and count:
            raise ValueError(f"{name}: items are not evenly spaced (strides {array.strides}); np.ascontiguousarray makes them so")
    stride = axes[-1][1] if axes and count else item
    if stride < item:
        raise ValueError(f"{name}: items overlap or run backwards (strides {array.strides}); np.ascontiguousarray makes a copy that does not")
    return array.shape[-1], stride, count


def as_rows(name: str, values: ArrayLike, width: int | None = None) -> npt.NDArray[Any]:
    """An array unchanged; anything else as float64. A single item becomes one row."""
    if isinstance(values, np.ndarray):
        array = values
    else:
        try:
            array = np.array(values, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise TypeError(f"{name}: not rows of numbers: {error}") from None
        if array.size == 0 and width is not None:
            array = array.reshape(0, width)
    return array.reshape(1, -1) if array.ndim == 1 and array.size else array


def input_rows(name: str, values: ArrayLike, widths: Sequence[int] = (3, 4), count: int | None = None) -> Any:
    """A shx_input of what a function was given. It keeps the array alive."""
    array = as_rows(name, values, widths[0])
    width, stride, found = _rows(name, array, widths)
    if count is not None and found != count:
        raise ValueError(f"{name}: {found} items; {count} expected")
    view = _capi.shx_input(address(array), stride, found, FORMATS[array.dtype, width], 0)
    view.kept = array
    return view


def frame_rows(name: str, values: Any) -> npt.NDArray[np.float64]:
    """Frames as rows of seven float64."""
    if isinstance(values, Frame):
        values = [[*values.origin, *values.rotation]]
    elif isinstance(values, (list, tuple)) and values and all(isinstance(value, Frame) for value in values):
        values = [[*value.origin, *value.rotation] for value in values]
    array = as_rows(name, values, 7)
    if array.shape[-1] != 7 or array.ndim < 2:
        raise ValueError(f"{name}: shape {array.shape}; (..., 7) expected: origin and quaternion x, y, z, w")
    if array.dtype != np.float64:
        raise TypeError(f"{name}: an array of {array.dtype}; float64 expected")
    return array


def input_frames(name: str, values: Any, count: int | None = None) -> Any:
    """A shx_input of frames; one frame for all is repeated without a copy where count says how many are needed."""
    return input_rows(name, frame_rows(name, values), (7,), count)


def no_input() -> Any:
    """A shx_input of nothing."""
    return _capi.shx_input()


class Output:
    """A shx_output and the array behind it."""

    __slots__ = ("array", "view")

    def __init__(self, name: str, array: OutArray, widths: Sequence[int], count: int) -> None:
        if not isinstance(array, np.ndarray):
            raise TypeError(f"{name}: {type(array).__name__}; a numpy array expected")
        if not array.flags.writeable:
            raise ValueError(f"{name}: the array is read-only")
        width, stride, found = _rows(name, array, widths)
        if found < count:
            raise ValueError(f"{name}: room for {found} items; {count} expected")
        self.array = array
        self.view = _capi.shx_output(address(array), stride, found, FORMATS[array.dtype, width], 0)


def column(name: str, values: ArrayLike, kind: type[ScalarT], count: int | None = None, width: int = 1) -> npt.NDArray[ScalarT]:
    """Numbers as a contiguous array of a type: count items, each of width numbers."""
    try:
        found = np.asarray(values)
        if found.dtype == object or (found.size and not np.can_cast(found.dtype, kind, "same_kind") and found.dtype.kind not in "iub"):
            raise TypeError(f"{found.dtype}")
        if found.dtype.kind in "iu" and np.dtype(kind).kind in "iu" and found.size:
            limits = np.iinfo(np.dtype(kind))
            if found.min() < limits.min or found.max() > limits.max:
                raise TypeError(f"a number outside {limits.min} to {limits.max}")
        array = np.ascontiguousarray(found, dtype=kind)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{name}: numbers of {np.dtype(kind)} expected: {error}") from None
    shape = (-1,) if width == 1 else (-1, width)
    if width != 1 and (array.size % width or (array.ndim and array.shape[-1] != width)):
        raise ValueError(f"{name}: shape {array.shape}; (..., {width}) expected")
    array = array.reshape(shape)
    if count is not None and len(array) != count:
        raise ValueError(f"{name}: {len(array)} {'rows' if width > 1 else 'numbers'}; {count} expected")
    return array


def vector(name: str, values: ArrayLike) -> npt.NDArray[np.float64]:
    """Three numbers."""
    array = column(name, values, np.float64)
    if array.shape != (3,):
        raise ValueError(f"{name}: {len(array)} numbers; 3 expected")
    return array


def float_type(name: str, dtype: npt.DTypeLike) -> np.dtype[Any]:
    """float32 or float64."""
    found = np.dtype(dtype)
    if found not in (np.float32, np.float64):
        raise TypeError(f"{name}: {found}; float32 or float64 expected")
    return found


def whole(name: str, value: int, least: int = 0, most: int = 2**32 - 1) -> int:
    """A whole number that fits what C takes: ctypes would wrap it."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name}: {value!r}; a whole number expected")
    if not least <= value <= most:
        raise ValueError(f"{name}: {value}; {least} to {most} expected")
    return int(value)
