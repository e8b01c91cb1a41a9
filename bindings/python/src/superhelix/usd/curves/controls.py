"""Control vertices of a BasisCurves or NurbsCurves prim at a time."""

from __future__ import annotations

from typing import Any

import numpy as np

from superhelix.usd._pxr import Usd, UsdGeom, refuse
from superhelix.usd.curves.bases import WRAPS, Bound, CubicCurves, Evaluator, Integers, LinearCurves, Numbers
from superhelix.usd.curves.nurbs import NurbsCurves


def sample_times(prim: Any) -> set[float]:
    """Time codes at which points, counts or velocities have samples."""
    curves = UsdGeom.Curves(prim)
    attributes = (curves.GetPointsAttr(), curves.GetCurveVertexCountsAttr(), curves.GetVelocitiesAttr())
    return {time for attribute in attributes for time in attribute.GetTimeSamples()}


def rows(values: Any, width: int) -> Numbers | None:
    """Vectors as rows of float64; None where there are none."""
    if values is None:
        return None
    return np.asarray(values, dtype=np.float64).reshape(-1, width)


class Controls:
    """Control vertices of a prim at a time code, in the prim's own space and units."""

    def __init__(self, prim: Any, code: Any) -> None:
        self.prim, self.code = prim, code
        self.nurbs = bool(prim.IsA(UsdGeom.NurbsCurves))
        curves = UsdGeom.Curves(prim)
        self.points = self.points_at(code)
        found = curves.GetCurveVertexCountsAttr().Get(code)
        self.counts: Integers = np.zeros(0, dtype=np.int64) if found is None else np.asarray(found, dtype=np.int64)
        if not len(self.points):
            self.counts = self.counts[:0]
            return
        total = int(self.counts.sum())
        if total != len(self.points):
            refuse(prim, f"curveVertexCounts has {len(self.counts)} curves of {total} vertices, and points has {len(self.points)}")
        short = np.flatnonzero(self.counts < 2)
        if len(short):
            refuse(prim, f"curveVertexCounts[{short[0]}] is {self.counts[short[0]]}; at least 2 expected")
        bad = np.flatnonzero(~np.isfinite(self.points).all(axis=1))
        if len(bad):
            refuse(prim, f"points[{bad[0]}] is {tuple(self.points[bad[0]].tolist())}; finite numbers expected")

    @property
    def velocities(self) -> Numbers | None:
        """Velocities, units/s: authored ones if there are as many as points, else the rates between the samples of the points; None without either."""
        found = rows(UsdGeom.Curves(self.prim).GetVelocitiesAttr().Get(self.code), 3)
        if found is not None and len(found) == len(self.points):
            return found
        attribute = UsdGeom.Curves(self.prim).GetPointsAttr()
        times = np.array(attribute.GetTimeSamples())
        if self.code.IsDefault() or len(times) < 2:
            return None
        now = self.code.GetValue()
        rates = []
        # The interval that ends at or after now, and the one that starts at or before it: the same but at a sample.
        for index in {int(np.searchsorted(times, now, side="left")), int(np.searchsorted(times, now, side="right"))}:
            if 1 <= index < len(times):
                ends = [rows(attribute.Get(Usd.TimeCode(times[place])), 3) for place in (index - 1, index)]
                if ends[0] is not None and ends[1] is not None and len(ends[0]) == len(ends[1]) == len(self.points):
                    rates.append((ends[1] - ends[0]) * (self.prim.GetStage().GetTimeCodesPerSecond() / (times[index] - times[index - 1])))
        return np.asarray(np.mean(rates, axis=0)) if rates else None

    def points_at(self, code: Any) -> Numbers:
        """Points at a time code: linear between samples of as many points, else carried on from the earlier sample by its velocities."""
        curves = UsdGeom.Curves(self.prim)
        attribute = curves.GetPointsAttr()
        found = rows(attribute.Get(code), 3)
        if found is None:
            return np.zeros((0, 3))
        if code.IsDefault():
            return found
        around = attribute.GetBracketingTimeSamples(code.GetValue())
        if len(around) == 2 and around[0] < code.GetValue() < around[1]:
            after = attribute.Get(Usd.TimeCode(around[1]))
            speeds = rows(curves.GetVelocitiesAttr().Get(Usd.TimeCode(around[0])), 3)
            if len(after) != len(found) and speeds is not None and len(speeds) == len(found):
                seconds = (code.GetValue() - around[0]) / self.prim.GetStage().GetTimeCodesPerSecond()
                return np.asarray(found + seconds * speeds)
        return found

    def evaluator(self, points: Numbers, tolerance: float | None, bound: Bound, like: Evaluator | None = None) -> Evaluator:
        """What evaluates the curves. points: the control vertices where the tolerance applies. tolerance: None: control vertices stay as they are. like:
        an earlier evaluator of the prim, whose chords are taken over.
        """

        def fail(reason: str) -> None:
            refuse(self.prim, reason)

        if self.nurbs:
            if tolerance is None:
                bound(len(points))
                return LinearCurves(self.counts, False)
            nurbs = UsdGeom.NurbsCurves(self.prim)
            weights = nurbs.GetPointWeightsAttr().Get(self.code)
            ranges = rows(nurbs.GetRangesAttr().Get(self.code), 2)
            return NurbsCurves(
                points,
                self.counts,
                np.asarray(nurbs.GetOrderAttr().Get(self.code) or (), dtype=np.int64),
                np.asarray(nurbs.GetKnotsAttr().Get(self.code) or (), dtype=np.float64),
                ranges if ranges is not None and len(ranges) else None,
                np.asarray(weights, dtype=np.float64) if weights else None,
                tolerance,
                fail,
                bound,
                like,
            )
        curves = UsdGeom.BasisCurves(self.prim)
        kind, wrap = curves.GetTypeAttr().Get(self.code), curves.GetWrapAttr().Get(self.code)
        if kind not in ("linear", "cubic"):
            fail(f'type is "{kind}"; "linear" or "cubic" expected')
        if wrap not in WRAPS:
            fail(f'wrap is "{wrap}"; "nonperiodic", "pinned" or "periodic" expected')
        if kind == "linear" or tolerance is None:
            bound(len(points) + len(self.counts))
            return LinearCurves(self.counts, wrap == "periodic")
        basis = curves.GetBasisAttr().Get(self.code)
        if basis not in ("bezier", "bspline", "catmullRom"):
            fail(f'basis is "{basis}"; "bezier", "bspline" or "catmullRom" expected')
        return CubicCurves(points, self.counts, basis, wrap, tolerance, fail, bound, like)
