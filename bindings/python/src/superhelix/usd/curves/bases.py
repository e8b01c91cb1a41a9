"""From control vertices to points on the curves: linear and cubic curves, with each wrap of UsdGeom.BasisCurves.

A cubic segment is subdivided evenly into as many chords as keep the chords within the tolerance of the curve: the distance of a chord of a Bézier
segment from it is at most 3/4 of the largest second difference of its control points, divided by the square of the number of chords.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]

#: Rows: Bézier control points of a segment from its four control vertices.
TO_BEZIER: dict[str, Numbers] = {
    "bezier": np.eye(4),
    "bspline": np.array([[1, 4, 1, 0], [0, 4, 2, 0], [0, 2, 4, 0], [0, 1, 4, 1]]) / 6.0,
    "catmullRom": np.array([[0, 6, 0, 0], [-1, 6, 1, 0], [0, 1, 6, -1], [0, 0, 6, 0]]) / 6.0,
}
WRAPS = ("nonperiodic", "pinned", "periodic")
#: Chords a segment has at most.
_MOST_CHORDS = 4096
_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(5)

#: Called with the number of points that evaluation will make, before it makes them; raises if these are too many.
Bound = Callable[[int], None]
#: Raises an error with a text about the curves.
Refuse = Callable[[str], Any]


class Evaluator(Protocol):
    """Curves ready to be evaluated. counts: points of each curve; segments: segments of each; total: control vertices of all."""

    counts: Integers
    segments: Integers
    total: int
    closed: bool

    def vertex(self, data: Numbers) -> Numbers:
        """Evaluates rows that belong to the control vertices, as points do."""

    def varying(self, data: Numbers) -> Numbers:
        """Interpolates rows that belong to the ends of segments."""

    def arclengths(self, points: Numbers) -> Numbers:
        """Returns the arclength of the curve at each of its points; points: control vertices."""


def starts_of(counts: Integers) -> Integers:
    """Index of the first item of each curve."""
    return np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.int64) if len(counts) else np.zeros(0, dtype=np.int64)


def points_of(strands: Integers, counts: Integers) -> Integers:
    """The points of these strands, one strand after the other, where strand k has counts[k] points."""
    own = counts[strands]
    return np.repeat(starts_of(counts)[strands] - starts_of(own), own) + np.arange(int(own.sum()))


def edges_along(points: Numbers, counts: Integers) -> Numbers:
    """Arclength of each point along its polyline."""
    edges = np.diff(points, axis=0)
    steps = np.zeros(len(points))
    steps[1:] = np.sqrt(np.einsum("ij,ij->i", edges, edges))
    return accumulated(steps, counts)


def accumulated(steps: Numbers, counts: Integers) -> Numbers:
    """Sums of steps from the first point of each curve; the step of a first point does not count."""
    first = starts_of(counts)
    steps = steps.copy()
    steps[first] = 0.0
    sums = np.cumsum(steps)
    return np.asarray(sums - np.repeat(sums[first], counts))


def varying_counts(segments: Integers, closed: bool) -> Integers:
    """How many varying values each curve has."""
    return segments if closed else segments + 1


class LinearCurves:
    """Linear curves: their points are the control vertices; a closed curve ends where it began."""

    def __init__(self, counts: Integers, closed: bool) -> None:
        self.closed = closed
        self.total = int(counts.sum())
        self.segments = counts if closed else counts - 1
        self.counts = counts + 1 if closed else counts
        if closed:
            starts = starts_of(counts)
            self._take: Integers | None = np.insert(np.arange(self.total), starts + counts, starts)
        else:
            self._take = None

    def vertex(self, data: Numbers) -> Numbers:
        """See Evaluator."""
        return data if self._take is None else data[self._take]

    varying = vertex

    def arclengths(self, points: Numbers) -> Numbers:
        """See Evaluator."""
        return edges_along(self.vertex(points), self.counts)


def segment_counts(counts: Integers, basis: str, wrap: str, fail: Refuse) -> Integers:
    """Number of segments of cubic curves, or an error that names a curve whose number of vertices does not fit."""
    step = 3 if basis == "bezier" else 1
    if wrap == "periodic":
        segments, whole, least = counts // step, counts % step == 0, 3
    elif wrap == "pinned" and step == 1:
        segments, whole, least = counts - 1, np.ones(len(counts), dtype=bool), 2
    else:
        segments, whole, least = (counts - 4) // step + 1, (counts - 4) % step == 0, 4
    bad = np.flatnonzero((counts < least) | ~whole)
    if len(bad):
        rule = f"{least}, {least + step}, {least + 2 * step} and so on" if step == 3 else f"{least} or more"
        fail(f"curveVertexCounts[{bad[0]}] is {counts[bad[0]]}; a {wrap} {basis} curve has {rule}")
    return np.asarray(segments)


class CubicCurves:
    """Cubic curves. points decide on the number of chords, or like, curves of as many segments, whose chords are taken over."""

    def __init__(
        self, points: Numbers, counts: Integers, basis: str, wrap: str, tolerance: float, fail: Refuse, bound: Bound, like: Evaluator | None = None
    ) -> None:
        self.closed = wrap == "periodic"
        self.total = int(counts.sum())
        self.segments = segment_counts(counts, basis, wrap, fail)
        self._matrix = TO_BEZIER[basis]
        starts = starts_of(counts)
        self._curve_of = np.repeat(np.arange(len(counts)), self.segments)
        place = np.arange(len(self._curve_of)) - np.repeat(starts_of(self.segments), self.segments)
        # Ends whose neighbours have to be made up: for each curve one before its first and one after its last vertex.
        self._ends = (starts, starts + counts - 1) if wrap == "pinned" and basis != "bezier" else None
        step = 3 if basis == "bezier" else 1
        local = step * place[:, None] + np.arange(4) - (1 if self._ends is not None else 0)
        size, first = counts[self._curve_of][:, None], starts[self._curve_of][:, None]
        if self.closed:
            self._vertices = first + local % size
        else:
            self._vertices = first + local
            if self._ends is not None:
                phantom = self.total + 2 * self._curve_of[:, None]
                self._vertices = np.where(local < 0, phantom, np.where(local >= size, phantom + 1, self._vertices))
        same = isinstance(like, CubicCurves) and np.array_equal(like.segments, self.segments)
        self._chords: Integers = like._chords if isinstance(like, CubicCurves) and same else self._chords_within(points, tolerance, fail)
        last = np.zeros(len(self._chords), dtype=np.int64)
        last[np.cumsum(self.segments) - 1] = 1
        bound(int(self._chords.sum()) + len(counts))
        repeats = self._chords + last
        self._segment = np.repeat(np.arange(len(repeats)), repeats)
        self._parameter = (np.arange(len(self._segment)) - np.repeat(starts_of(repeats), repeats)) / self._chords[self._segment]
        self.counts = np.bincount(self._curve_of, weights=self._chords, minlength=len(counts)).astype(np.int64) + 1

    def _chords_within(self, points: Numbers, tolerance: float, fail: Refuse) -> Integers:
        bend = np.linalg.norm(np.diff(self._bezier(points), n=2, axis=1), axis=2).max(axis=1)
        chords = np.ceil(np.sqrt(0.75 * bend / tolerance))
        if len(chords) and not chords.max() <= _MOST_CHORDS:
            curve = self._curve_of[int(np.argmax(chords))]
            fail(f"curve {curve} bends so far that it needs {chords.max():.3g} chords a segment, {_MOST_CHORDS} at most: allow a larger tolerance")
        return np.asarray(np.maximum(chords, 1.0), dtype=np.int64)

    def _extended(self, data: Numbers) -> Numbers:
        if self._ends is None:
            return data
        first, last = self._ends
        made = np.stack([2.0 * data[first] - data[first + 1], 2.0 * data[last] - data[last - 1]], axis=1)
        return np.concatenate([data, made.reshape(-1, data.shape[1])])

    def _bezier(self, data: Numbers) -> Numbers:
        return np.asarray(np.einsum("ij,sjd->sid", self._matrix, self._extended(data)[self._vertices]))

    def vertex(self, data: Numbers) -> Numbers:
        """See Evaluator."""
        u = self._parameter
        v = 1.0 - u
        bernstein = np.stack([v * v * v, 3.0 * u * v * v, 3.0 * u * u * v, u * u * u])
        weights = self._matrix.T @ bernstein
        extended = self._extended(data)
        out = np.zeros((len(u), data.shape[1]))
        for place in range(4):
            out += weights[place][:, None] * extended[self._vertices[:, place][self._segment]]
        return out

    def varying(self, data: Numbers) -> Numbers:
        """See Evaluator."""
        sizes = varying_counts(self.segments, self.closed)
        place = np.arange(len(self._curve_of)) - starts_of(self.segments)[self._curve_of]
        first = starts_of(sizes)[self._curve_of]
        before, after = first + place, first + (place + 1) % sizes[self._curve_of]
        u = self._parameter[:, None]
        return np.asarray((1.0 - u) * data[before[self._segment]] + u * data[after[self._segment]])

    def arclengths(self, points: Numbers) -> Numbers:
        """See Evaluator. By Gauss's rule of five points on each chord's piece of the curve."""
        bezier = self._bezier(points)
        slopes = 3.0 * np.diff(bezier, axis=1)
        # A point is the end of the piece before it.
        ends = np.flatnonzero(np.diff(self._segment, prepend=-1) == 0)
        firsts = np.flatnonzero(np.diff(self._segment, prepend=-1) != 0)
        steps = np.zeros(len(self._segment))
        for index, segment, upper in (
            (ends, self._segment[ends], self._parameter[ends]),
            # The first point of a segment ends the last piece of the segment before it.
            (firsts[1:], self._segment[firsts[1:]] - 1, np.ones(max(len(firsts) - 1, 0))),
        ):
            size = 1.0 / self._chords[segment]
            for node, weight in zip(_GAUSS_NODES, _GAUSS_WEIGHTS):
                u = (upper + (0.5 * (node - 1.0)) * size)[:, None]
                v = 1.0 - u
                slope = v * v * slopes[segment, 0] + 2.0 * u * v * slopes[segment, 1] + u * u * slopes[segment, 2]
                steps[index] += 0.5 * weight * size * np.linalg.norm(slope, axis=1)
        return accumulated(steps, self.counts)
