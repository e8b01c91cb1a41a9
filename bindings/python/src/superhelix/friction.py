"""Friction coefficients of a strand from a recorded curve."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix._buffers import address, column, frame_rows
from superhelix._library import functions
from superhelix.errors import check
from superhelix.records import FrictionFitDef, FrictionFitReport, SolverDef
from superhelix.strand_defs import StrandDefs


class FrictionFit(NamedTuple):
    """Result of a fit: a report, and the values of the best curve (NaN before report.first_compared)."""

    report: FrictionFitReport
    curve: npt.NDArray[np.float64]


def fit_friction(
    strand: StrandDefs,
    definition: FrictionFitDef,
    times: npt.ArrayLike,
    values: npt.ArrayLike,
    *,
    solver: SolverDef | None = None,
    root_times: npt.ArrayLike | None = None,
    root_frames: Any = None,
) -> FrictionFit:
    """Fits friction coefficients of a strand (one definition) to a recorded curve: values at times (s, strictly increasing). solver: gravity,
    wind, integrator and worker_count. root_times and root_frames: recorded poses through which the root moves.
    """
    moments = column("times", times, np.float64)
    recorded = column("values", values, np.float64, len(moments))
    chosen = definition.copy()
    kept: list[Any] = []
    if (root_times is None) != (root_frames is None):
        raise ValueError("root_times and root_frames: give both or neither")
    if root_times is not None:
        poses = np.ascontiguousarray(frame_rows("root_frames", root_frames).reshape(-1, 7))
        at = column("root_times", root_times, np.float64, len(poses))
        kept = [poses, at]
        chosen._c.root_times, chosen._c.root_frames, chosen._c.root_count = address(at), address(poses), len(poses)
    options = (SolverDef() if solver is None else solver).copy()
    report = FrictionFitReport()
    best = np.empty(len(moments))
    data = strand._ready(1)
    check(
        functions.shx_fit_friction(
            ctypes.byref(options._c),
            address(data),
            ctypes.byref(chosen._c),
            address(moments),
            address(recorded),
            len(moments),
            ctypes.byref(report._c),
            address(best),
        )
    )
    curve = np.full(len(moments), np.nan)
    curve[report.first_compared :] = best[: report.compared]
    del kept
    return FrictionFit(report, curve)
