"""From control vertices to points on UsdGeom.NurbsCurves, rational or not, of any order.

Spans are subdivided evenly. Without weights, the number of chords follows from the control points of the second derivative, which bound it. With
weights, chords are doubled until the curve, looked at in the middle and at the quarters of each chord, is within the tolerance.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from superhelix.usd.curves.bases import Bound, Evaluator, Integers, Numbers, Refuse, starts_of

_MOST_CHORDS = 4096
_MOST_ORDER = 32
#: Arclength is measured on so many pieces of each chord, and extrapolated.
_PIECES = 4


def basis_functions(knots: Numbers, order: int, count: int, parameters: Numbers) -> Numbers:
    """Values of the count basis functions of a knot vector at parameters: (parameters, count). The last span contains its end."""
    degree = order - 1
    span = np.clip(np.searchsorted(knots, parameters, side="right") - 1, degree, count - 1)
    # The span before the end of the domain that has a length.
    while np.any(empty := (knots[span + 1] <= knots[span]) & (span > degree)):
        span = np.where(empty, span - 1, span)
    values = np.zeros((len(parameters), order))
    values[:, 0] = 1.0
    for level in range(1, order):
        saved = np.zeros(len(parameters))
        for place in range(level):
            right, left = knots[span + place + 1], knots[span + 1 - level + place]
            width = right - left
            share = np.where(width > 0.0, values[:, place] / np.where(width > 0.0, width, 1.0), 0.0)
            values[:, place] = saved + (right - parameters) * share
            saved = (parameters - left) * share
        values[:, level] = saved
    out = np.zeros((len(parameters), count))
    rows = np.arange(len(parameters))
    for place in range(order):
        out[rows, span - degree + place] = values[:, place]
    return out


class _Family:
    """Curves with the same number of vertices, order, knots and range, and the parameters of their points."""

    def __init__(self, curves: Integers, rows: Integers, order: int, knots: Numbers, spans: Numbers) -> None:
        """rows: indices of the vertices of each curve."""
        self.curves, self.rows, self.count, self.order, self.knots, self.spans = curves, rows, rows.shape[1], order, knots, spans

    def some(self, mask: npt.NDArray[np.bool_]) -> _Family:
        """Some of the curves."""
        return _Family(self.curves[mask], self.rows[mask], self.order, self.knots, self.spans)

    def parameters(self, chords: int) -> Numbers:
        pieces = [low + (high - low) * np.arange(chords) / chords for low, high in zip(self.spans[:-1], self.spans[1:])]
        return np.concatenate([*pieces, self.spans[-1:]])

    def evaluate(self, parameters: Numbers, data: Numbers, weights: Numbers | None) -> Numbers:
        """(curves, parameters, width)."""
        basis = basis_functions(self.knots, self.order, self.count, parameters)
        rows = data[self.rows]
        if weights is None:
            return np.asarray(np.einsum("pc,kcd->kpd", basis, rows))
        factor = weights[self.rows]
        above = np.einsum("pc,kcd->kpd", basis, rows * factor[:, :, None])
        return np.asarray(above / np.einsum("pc,kc->kp", basis, factor)[:, :, None])


class NurbsCurves:
    """NURBS curves. See superhelix.usd.curves.bases.Evaluator."""

    def __init__(
        self,
        points: Numbers,
        counts: Integers,
        orders: Integers,
        knots: Numbers,
        ranges: Numbers | None,
        weights: Numbers | None,
        tolerance: float,
        fail: Refuse,
        bound: Bound,
        like: Evaluator | None = None,
    ) -> None:
        """like: curves of as many vertices and segments, whose chords are taken over."""
        self.closed = False
        self.total, self._weights = int(counts.sum()), weights
        self._check(counts, orders, knots, ranges, weights, fail)
        first, knot_first = starts_of(counts), starts_of(counts + orders)
        families: dict[tuple[int, int, bytes, bytes], list[int]] = {}
        for curve, (count, order) in enumerate(zip(counts.tolist(), orders.tolist())):
            own = knots[knot_first[curve] : knot_first[curve] + count + order]
            domain = (own[order - 1], own[count]) if ranges is None else ranges[curve]
            families.setdefault((count, order, own.tobytes(), np.asarray(domain).tobytes()), []).append(curve)
        self.segments = np.zeros(len(counts), dtype=np.int64)
        self.counts = np.zeros(len(counts), dtype=np.int64)
        self.chords = np.ones(len(counts), dtype=np.int64)
        self._parts: list[tuple[_Family, int]] = []
        for (count, order, raw, domain_raw), members in families.items():
            own, (low, high) = np.frombuffer(raw), np.frombuffer(domain_raw)
            inner = own[order - 1 : count + 1]
            spans = np.unique(np.concatenate([[low], inner[(inner > low) & (inner < high)], [high]]))
            curves = np.array(members, dtype=np.int64)
            self.segments[curves] = len(spans) - 1
            family = _Family(curves, first[curves][:, None] + np.arange(count), order, own, spans)
            old = like if isinstance(like, NurbsCurves) and len(like.chords) == len(counts) else None
            wanted = self._chords(family, points, tolerance, fail) if old is None else old.chords[curves]
            self.chords[curves] = wanted
            for chords in np.unique(wanted).tolist():
                part = family.some(wanted == chords)
                self.counts[part.curves] = chords * (len(spans) - 1) + 1
                self._parts.append((part, chords))
        bound(int(self.counts.sum()))
        self._first = starts_of(self.counts)

    @staticmethod
    def _check(counts: Integers, orders: Integers, knots: Numbers, ranges: Numbers | None, weights: Numbers | None, fail: Refuse) -> None:
        if len(orders) != len(counts):
            fail(f"order has {len(orders)} numbers; one for each curve expected, {len(counts)}")
        bad = np.flatnonzero((orders < 2) | (orders > np.minimum(counts, _MOST_ORDER)))
        if len(bad):
            fail(f"order[{bad[0]}] is {orders[bad[0]]} for a curve of {counts[bad[0]]} vertices; 2 to the number of vertices expected, {_MOST_ORDER} at most")
        if len(knots) != int((counts + orders).sum()):
            fail(f"knots has {len(knots)} numbers; vertices plus order of each curve expected, {int((counts + orders).sum())} in all")
        if not np.isfinite(knots).all():
            fail("knots has a number that is not finite")
        falls = np.diff(knots) < 0.0
        falls[np.cumsum(counts + orders)[:-1] - 1] = False
        if falls.any():
            place = int(np.flatnonzero(falls)[0])
            fail(f"knots[{place + 1}] is {knots[place + 1]:g} after {knots[place]:g}; knots that do not fall expected")
        first = starts_of(counts + orders)
        low, high = knots[first + orders - 1], knots[first + counts]
        if ranges is not None:
            if len(ranges) != len(counts):
                fail(f"ranges has {len(ranges)} entries; one for each curve expected, {len(counts)}")
            outside = np.flatnonzero(~((ranges[:, 0] >= low) & (ranges[:, 1] <= high)))
            if len(outside):
                place = int(outside[0])
                fail(f"ranges[{place}] is {tuple(ranges[place].tolist())}; within the knots' ({low[place]:g}, {high[place]:g}) expected")
            low, high = ranges[:, 0], ranges[:, 1]
        empty = np.flatnonzero(~(high > low))
        if len(empty):
            fail(f"curve {empty[0]} has no length in its parameter: from {low[empty[0]]:g} to {high[empty[0]]:g}")
        if weights is not None:
            if len(weights) != int(counts.sum()):
                fail(f"pointWeights has {len(weights)} numbers; one for each vertex expected, {int(counts.sum())}")
            if not (np.isfinite(weights) & (weights > 0.0)).all():
                place = int(np.flatnonzero(~(np.isfinite(weights) & (weights > 0.0)))[0])
                fail(f"pointWeights[{place}] is {weights[place]:g}; above 0 expected")

    def _chords(self, family: _Family, points: Numbers, tolerance: float, fail: Refuse) -> Integers:
        widest = float(np.diff(family.spans).max())
        if self._weights is None:
            rows, degree, knots = points[family.rows], family.order - 1, family.knots
            for level in (0, 1):
                size = degree - level
                if size == 0:
                    return np.ones(len(family.curves), dtype=np.int64)
                width = knots[1 + level + size : 1 + level + size + rows.shape[1] - 1] - knots[1 + level : 1 + level + rows.shape[1] - 1]
                rows = size * np.diff(rows, axis=1) / np.where(width > 0.0, width, np.inf)[:, None]
            bend = np.linalg.norm(rows, axis=2).max(axis=1) if rows.shape[1] else np.zeros(len(family.curves))
            chords = np.ceil(widest * np.sqrt(bend / (8.0 * tolerance)))
        else:
            chords = np.full(len(family.curves), np.inf)
            number, open_ = 1, np.ones(len(chords), dtype=bool)
            while open_.any() and number <= _MOST_CHORDS:
                part = family.some(open_)
                fine = part.evaluate(part.parameters(4 * number), points, self._weights)
                ends, offset = fine[:, ::4], np.zeros(len(part.curves))
                for quarter in (1, 2, 3):
                    chord = ends[:, :-1] + 0.25 * quarter * np.diff(ends, axis=1)
                    offset = np.maximum(offset, np.linalg.norm(fine[:, quarter::4] - chord, axis=2).max(axis=1))
                good = np.flatnonzero(open_)[offset <= 0.5 * tolerance]
                chords[good], open_[good] = number, False
                number *= 2
        if not chords.max() <= _MOST_CHORDS:
            fail(f"curve {family.curves[int(np.argmax(chords))]} bends so far that more than {_MOST_CHORDS} chords a span are needed: allow a larger tolerance")
        # A few sizes only, so that curves can be evaluated together.
        return np.asarray(2 ** np.ceil(np.log2(np.maximum(chords, 1.0))).astype(np.int64))

    def _gathered(self, width: int) -> Numbers:
        return np.empty((int(self.counts.sum()), width))

    def _put(self, out: Numbers, family: _Family, rows: Numbers) -> None:
        places = self._first[family.curves][:, None] + np.arange(rows.shape[1])
        out[places.reshape(-1)] = rows.reshape(-1, rows.shape[2])

    def vertex(self, data: Numbers) -> Numbers:
        """See Evaluator."""
        out = self._gathered(data.shape[1])
        for family, chords in self._parts:
            self._put(out, family, family.evaluate(family.parameters(chords), data, self._weights))
        return out

    def varying(self, data: Numbers) -> Numbers:
        """See Evaluator."""
        out, first = self._gathered(data.shape[1]), starts_of(self.segments + 1)
        for family, chords in self._parts:
            rows = data[first[family.curves][:, None] + np.arange(len(family.spans))]
            share = (np.arange(chords) / chords)[None, None, :, None]
            inner = (1.0 - share) * rows[:, :-1, None] + share * rows[:, 1:, None]
            self._put(out, family, np.concatenate([inner.reshape(len(rows), -1, data.shape[1]), rows[:, -1:]], axis=1))
        return out

    def arclengths(self, points: Numbers) -> Numbers:
        """See Evaluator. Lengths of finer polylines, extrapolated once."""
        out = self._gathered(1)
        for family, chords in self._parts:
            fine = family.evaluate(family.parameters(_PIECES * chords), points, self._weights)
            steps = np.linalg.norm(np.diff(fine, axis=1), axis=2)
            short = steps.reshape(len(steps), -1, _PIECES).sum(axis=2)
            half = np.linalg.norm(np.diff(fine[:, ::2], axis=1), axis=2).reshape(len(steps), -1, _PIECES // 2).sum(axis=2)
            exact = short + (short - half) / 3.0
            self._put(out, family, np.concatenate([np.zeros((len(exact), 1)), np.cumsum(exact, axis=1)], axis=1)[:, :, None])
        return out[:, 0]
