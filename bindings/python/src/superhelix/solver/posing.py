"""Posing strands by hand: dragging, brushing, cutting, growing, mirroring."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix._buffers import address, column, input_rows, vector, whole
from superhelix._library import functions
from superhelix._record import reference
from superhelix.ids import StrandIds
from superhelix.records import Brush, ElementChange, PoseOptions
from superhelix.solver._base import Numbers, SolverBase, StrandsLike
from superhelix.solver._packed import packed


class Brushed(NamedTuple):
    """Result of a brush for each strand: whether a point of it was in the brush, and the root mean square distance of these points from their
    targets, m.
    """

    touched: npt.NDArray[np.bool_]
    distances: Numbers


def pose_options(options: PoseOptions | None, movable: npt.ArrayLike | None) -> Any:
    """Options with the elements that may change; None where both are left out. The structure keeps the array alive."""
    reference("options", options, PoseOptions)
    if movable is None:
        return None if options is None else options._c
    chosen = PoseOptions() if options is None else options.copy()
    flags = column("movable", movable, np.uint8)
    chosen._c.movable, chosen._c.movable_count = address(flags), len(flags)
    chosen._c.kept = flags
    return chosen._c


class Posing(SolverBase):
    """Posing a solver's strands."""

    __slots__ = ()

    def drag_strands(
        self,
        targets: npt.ArrayLike,
        arclengths: npt.ArrayLike,
        ids: StrandsLike = None,
        options: PoseOptions | None = None,
        *,
        movable: npt.ArrayLike | None = None,
    ) -> Numbers:
        """Drags a point of each strand, at arclengths (m from the root), to targets (world space, m, one row each). Strands are at rest afterwards.
        movable: 1 or 0 for each element, strand by strand: whether it may change. Returns the distance of each point from its target, m.
        """
        bits = self._strands(ids)
        along = column("arclengths", arclengths, np.float64, len(bits))
        view = input_rows("targets", targets, (3,), len(bits))
        chosen = pose_options(options, movable)
        distances = np.empty(len(bits))
        self._call(
            functions.shx_solver_drag_strands,
            address(bits),
            len(bits),
            address(along),
            ctypes.byref(view),
            None if chosen is None else ctypes.byref(chosen),
            address(distances),
        )
        return distances

    def brush_strands(self, brush: Brush, ids: StrandsLike = None, options: PoseOptions | None = None, *, movable: npt.ArrayLike | None = None) -> Brushed:
        """Moves a brush through strands: the points in it follow, weighted by its falloff. Strands with no point in it do not change."""
        bits = self._strands(ids)
        chosen = pose_options(options, movable)
        touched, distances = np.empty(len(bits), dtype=np.uint8), np.empty(len(bits))
        self._call(
            functions.shx_solver_brush_strands,
            address(bits),
            len(bits),
            reference("brush", brush, Brush),
            None if chosen is None else ctypes.byref(chosen),
            address(touched),
            address(distances),
        )
        return Brushed(touched.astype(bool), distances)

    def change_elements(self, changes: ElementChange | Sequence[ElementChange], ids: StrandsLike = None) -> None:
        """Changes one element of each strand: twist, bend, length. One ElementChange for all strands, or one each."""
        bits = self._strands(ids)
        listed = [changes] * len(bits) if isinstance(changes, ElementChange) else changes
        data, size, _ = packed("changes", listed, ElementChange, len(bits))
        self._call(functions.shx_solver_change_elements, address(bits), len(bits), address(data), size)

    def cut_strands(self, arclengths: npt.ArrayLike, ids: StrandsLike = None) -> None:
        """Cuts each strand at an arclength (m from the root). The rest keeps its shape and velocities."""
        bits = self._strands(ids)
        along = column("arclengths", arclengths, np.float64, len(bits))
        self._call(functions.shx_solver_cut_strands, address(bits), len(bits), address(along))

    def grow_strands(self, length: float, ids: StrandsLike = None, *, element_count: int = 0, curvatures: npt.ArrayLike | None = None) -> None:
        """Grows strands at their tips by length, m. Adds element_count elements; 0: the last element becomes longer. curvatures: three numbers,
        rad/m, for the added elements; None: those of the last one.
        """
        bits = self._strands(ids)
        added = None if curvatures is None else vector("curvatures", curvatures)
        self._call(
            functions.shx_solver_grow_strands,
            address(bits),
            len(bits),
            length,
            whole("element_count", element_count),
            None if added is None else address(added),
        )

    def mirror_strands(self, point: npt.ArrayLike, normal: npt.ArrayLike, ids: StrandsLike = None) -> StrandIds:
        """Adds mirror images of strands in the plane through point (m) with the given normal, and returns their ids."""
        bits = self._strands(ids)
        through, across = vector("point", point), vector("normal", normal)
        images = np.empty(len(bits), dtype=np.uint64)
        self._call(functions.shx_solver_mirror_strands, address(bits), len(bits), address(through), address(across), address(images))
        self._all = None
        return StrandIds(images)
