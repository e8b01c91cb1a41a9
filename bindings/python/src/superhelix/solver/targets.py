"""Targets: curves, of a rig for example, to which strands are drawn with a weight along their length."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import address, as_rows, column, input_rows
from superhelix._library import functions
from superhelix._record import initialize
from superhelix.solver._base import Numbers, SolverBase, StrandsLike


class Targets(SolverBase):
    """Targets of a solver's strands."""

    __slots__ = ()

    def set_targets(
        self,
        points: npt.ArrayLike,
        ids: StrandsLike = None,
        *,
        point_counts: npt.ArrayLike | None = None,
        arclengths: npt.ArrayLike | None = None,
        weights: Sequence[tuple[float, float]] | npt.ArrayLike = ((0.0, 1.0), (1.0, 0.0)),
        strand_weights: npt.ArrayLike | None = None,
        time_constant: float | None = None,
        over_seconds: float = 0.0,
    ) -> None:
        """Draws strands to curves. Call it once per frame before the step, with the curves as they are at its end: targets move there from where they
        are over the next over_seconds of simulated time (0: within the next substep). points: world space, m, root first, (strands, points, 3), or
        strand by strand (points, 3) with point_counts. arclengths: of the strand's point that belongs to each point, m; None: in proportion to the
        curve's length. weights: (position, weight) rows, position from 0 (root) to 1 (tip), weight from 0 (free) to 1 (on the curve). strand_weights:
        a factor for each strand. time_constant: of a point of weight 0.5, s (0.1). Roots do not move: see set_root_frames.
        """
        bits = self._strands(ids)
        rows = as_rows("points", points)
        definition = _capi.shx_target_def()
        initialize(definition)
        kept: list[Any] = []
        if point_counts is None:
            if rows.ndim != 3:
                raise ValueError(f"points: shape {rows.shape}; (strands, points, 3) expected, or give point_counts")
            definition.curve_count, total = rows.shape[0], rows.shape[0] * rows.shape[1]
        else:
            counts = column("point_counts", point_counts, np.uint32)
            definition.curve_count, total = len(counts), int(counts.sum())
            definition.point_counts = address(counts)
            kept.append(counts)
        definition.points = view = input_rows("points", rows, (3, 4), total)
        kept.append(view)
        if arclengths is not None:
            kept.append(column("arclengths", arclengths, np.float64, total))
            definition.arclengths = address(kept[-1])
        keys = np.asarray(weights, dtype=np.float64)
        if keys.ndim != 2 or keys.shape[1] != 2:
            raise ValueError(f"weights: shape {keys.shape}; rows of position and weight expected")
        positions, values = np.ascontiguousarray(keys[:, 0]), np.ascontiguousarray(keys[:, 1])
        definition.weight_count = len(keys)
        definition.weight_positions, definition.weights = address(positions), address(values)
        if strand_weights is not None:
            kept.append(column("strand_weights", strand_weights, np.float64, definition.curve_count))
            definition.strand_weights = address(kept[-1])
        if time_constant is not None:
            definition.time_constant = time_constant
        self._call(functions.shx_solver_set_targets, address(bits), len(bits), ctypes.byref(definition), over_seconds)

    def clear_targets(self, ids: StrandsLike = None) -> None:
        """Lets strands go: nothing draws them any more."""
        bits = self._strands(ids)
        self._call(functions.shx_solver_clear_targets, address(bits), len(bits))

    def target_distances(self, ids: StrandsLike = None) -> Numbers:
        """Returns how far strands are from their targets, m: the root mean square over a strand's length, where each point counts by its weight.
        -1 for a strand without a target, or with one that draws no part of it.
        """
        bits = self._strands(ids)
        distances = np.empty(len(bits))
        self._call(functions.shx_solver_target_distances, address(bits), len(bits), address(distances))
        return distances
