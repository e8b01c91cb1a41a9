"""From curves to strands: fitting, splines, sag-free natural shapes."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import Output, address, as_rows, column, frame_rows, input_frames, input_rows, vector, whole
from superhelix._callbacks import Failures, ParallelFor, attach, parallel_for_callback
from superhelix._library import functions
from superhelix._record import initialize
from superhelix.enums import SplineEnds, SplineKind
from superhelix.errors import check, error_of
from superhelix.records import FitOptions, FittedStrandTable, PolylineFit
from superhelix.strand_defs import StrandDefs

Numbers = npt.NDArray[np.float64]


class PolylineStrand(NamedTuple):
    """Strand fitted to one polyline: root, length and errors, lengths (m) and curvatures (rad/m) of its elements."""

    fit: PolylineFit
    element_lengths: Numbers
    curvatures: Numbers


class Fit:
    """Strands fitted to curves. strands: a table with a row per curve; element_lengths (strands, elements), m; curvatures (strands, elements, 3),
    rad/m. Strand i has strands.element_count[i] elements; the rest of its rows is 0.
    """

    __slots__ = ("curvatures", "element_lengths", "strands")

    def __init__(self, strands: FittedStrandTable, element_lengths: Numbers, curvatures: Numbers) -> None:
        self.strands = strands
        self.element_lengths = element_lengths
        self.curvatures = curvatures

    @property
    def fitted(self) -> npt.NDArray[np.bool_]:
        """Which curves were fitted. Curves without length or with non-finite numbers are not."""
        return np.asarray(self.strands.result == _capi.SHX_OK)

    def select(self, which: slice | npt.NDArray[Any] | list[int]) -> Fit:
        """Selects strands: fit.select(fit.fitted) drops curves that were not fitted."""
        return Fit(
            FittedStrandTable(np.ascontiguousarray(self.strands.data[which])),
            np.ascontiguousarray(self.element_lengths[which]),
            np.ascontiguousarray(self.curvatures[which]),
        )

    def __len__(self) -> int:
        return len(self.strands)

    def __repr__(self) -> str:
        return f"Fit({len(self)} strands)"


def fit_polyline(polyline: npt.ArrayLike, element_count: int) -> PolylineStrand:
    """Fits a strand of element_count elements to one polyline (m, root first, one row per point)."""
    view = input_rows("polyline", polyline)
    count = whole("element_count", element_count)
    fit = PolylineFit()
    # No more memory than a valid count needs: an invalid one is refused before anything is written.
    room = min(count, 100_000)
    lengths, curvatures = np.zeros(room), np.zeros((room, 3))
    check(functions.shx_fit_polyline(ctypes.byref(view), count, ctypes.byref(fit._c), address(lengths), address(curvatures), room))
    return PolylineStrand(fit, lengths, curvatures)


def _frames_or_directions(name: str, values: Any, count: int) -> Any:
    rows = as_rows(name, values, 3) if not hasattr(values, "rotation") else frame_rows(name, values)
    return input_frames(name, rows, count) if rows.shape[-1] == 7 else input_rows(name, rows, (3, 4), count)


def fit_strands(
    points: npt.ArrayLike,
    point_counts: npt.ArrayLike | None = None,
    options: FitOptions | None = None,
    *,
    arclengths: npt.ArrayLike | None = None,
    widths: npt.ArrayLike | None = None,
    frames: Any = None,
    roots: Any = None,
    parallel_for: ParallelFor | None = None,
) -> Fit:
    """Fits a strand to each of many curves. points: m, root first, (curves, points, 3), or curve by curve (points, 3) with point_counts.
    arclengths: arclength of each point, m, for curves that are longer than their polylines. widths: width of the hair at each point, m.
    frames: a material frame at each point (rows of seven, or quaternions). roots: a root frame or a root direction for each curve.
    """
    rows = as_rows("points", points)
    if point_counts is None:
        if rows.ndim != 3:
            raise ValueError(f"points: shape {rows.shape}; (curves, points, 3) expected, or give point_counts")
        counts = np.full(rows.shape[0], rows.shape[1], dtype=np.uint32)
    else:
        counts = column("point_counts", point_counts, np.uint32)
    total = int(counts.sum())
    data = _capi.shx_fit_input()
    initialize(data)
    data.curve_count = len(counts)
    data.points = view = input_rows("points", rows, (3, 4), total)
    data.point_counts = address(counts)
    kept: list[Any] = [view, counts]
    for name, values in (("arclengths", arclengths), ("widths", widths)):
        if values is not None:
            kept.append(column(name, values, np.float64, total))
            setattr(data, name, address(kept[-1]))
    if frames is not None:
        kept.append(_frames_or_directions("frames", frames, total))
        data.frames = kept[-1]
    if roots is not None:
        kept.append(_frames_or_directions("roots", roots, len(counts)))
        data.roots = kept[-1]
    chosen = FitOptions() if options is None else options.copy()
    failures = Failures()
    if parallel_for is not None:
        kept.append(parallel_for_callback(parallel_for, failures))
        attach(chosen._c, "parallel_for", kept[-1])
    elements = chosen.element_count
    # An invalid count is refused before anything is written.
    room = elements if elements <= 100_000 else 0
    table = FittedStrandTable._zeros(len(counts))
    lengths, curvatures = np.zeros((len(counts), room)), np.zeros((len(counts), room, 3))
    result = functions.shx_fit_strands(
        ctypes.byref(chosen._c),
        ctypes.byref(data),
        address(table.data),
        table.data.dtype.itemsize,
        address(lengths),
        address(curvatures),
        lengths.size,
    )
    failure = failures.take()
    if failure is not None:
        raise failure from (error_of(result) if result else None)
    check(result)
    return Fit(table, lengths, curvatures)


def sag_free_curvatures(defs: StrandDefs, curvatures: npt.ArrayLike, gravity: npt.ArrayLike = (0.0, 0.0, -9.81)) -> Numbers:
    """Computes natural curvatures for which strands of these definitions rest under gravity (m/s^2) in the shapes given by curvatures: rows strand by
    strand, rad/m. Solver.adopt_rest_shapes does the same for strands of a solver.
    """
    counts = defs.data["element_count"].astype(np.int64)
    rows = column("curvatures", curvatures, np.float64, int(counts.sum()), 3)
    down = vector("gravity", gravity)
    natural = np.empty_like(rows)
    data = defs._ready()
    place = 0
    for strand, count in enumerate(counts.tolist()):
        check(
            functions.shx_sag_free_curvatures(
                address(data) + strand * data.dtype.itemsize,
                address(rows) + place * 24,
                count,
                address(down),
                address(natural) + place * 24,
            )
        )
        place += count
    return natural


def spline_points(
    controls: npt.ArrayLike,
    kind: SplineKind = SplineKind.CATMULL_ROM,
    ends: SplineEnds = SplineEnds.PINNED,
    points_per_span: int = 8,
    *,
    dtype: npt.DTypeLike = np.float64,
) -> tuple[npt.NDArray[Any], Numbers]:
    """Samples a cubic curve: returns its points and the arclength of each. Pass both to fit_strands."""
    definition = _capi.shx_spline_def()
    initialize(definition)
    definition.kind, definition.ends = whole("kind", kind), whole("ends", ends)
    definition.points_per_span = whole("points_per_span", points_per_span)
    definition.controls = view = input_rows("controls", controls)
    count = ctypes.c_size_t()
    check(functions.shx_spline_points(ctypes.byref(definition), None, None, ctypes.byref(count)))
    points, arclengths = np.empty((count.value, 3), dtype=dtype), np.empty(count.value)
    output = Output("points", points, (3,), count.value)
    check(functions.shx_spline_points(ctypes.byref(definition), ctypes.byref(output.view), address(arclengths), ctypes.byref(count)))
    del view
    return points, arclengths
