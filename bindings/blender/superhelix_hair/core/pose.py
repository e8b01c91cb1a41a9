"""Posing the drawn hair: dragging a point of a curve, brushing many. Shapes keep their lengths, and stay out of colliders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import superhelix as shx

from .rest import Rest
from .rig import Rig
from .settings import HairSettings

Numbers = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Posed:
    """The drawn points after a stroke, world space, m; how many curves changed; and the largest distance from where a point should be, m."""

    points: Numbers
    changed: int
    distance: float


class Poser:
    """The drawn hair in a solver at rest. A context manager."""

    def __init__(self, rest: Rest, settings: HairSettings) -> None:
        self.rig = Rig(rest, settings, 1.0 / 60.0)
        self._rest = rest

    def __enter__(self) -> Poser:
        return self

    def __exit__(self, *_: object) -> None:
        self.rig.close()

    def drag(self, curve: int, fraction: float, target: npt.ArrayLike) -> Posed:
        """Drags the point at a fraction of the length of a curve to a target, m."""
        if not 0.0 < fraction <= 1.0:
            raise ValueError(f"fraction: {fraction}; above 0, up to 1 expected")
        found = np.flatnonzero(self.rig.indices == curve)
        if not len(found):
            raise ValueError(f"curve: {curve}; one of {len(self._rest.point_counts)} that can be simulated expected")
        solver, strand = self.rig.solver, self.rig.strands[found]
        along = fraction * solver.strand_lengths(strand)
        distances = solver.drag_strands(np.asarray(target, dtype=np.float64)[None], along, strand)
        moved = np.zeros(len(self._rest.point_counts), dtype=bool)
        moved[curve] = True
        return self._posed(moved, float(distances[0]))

    def brush(self, centre: npt.ArrayLike, radius: float, displacement: npt.ArrayLike, falloff: float = 1.0) -> Posed:
        """Moves a sphere through the hair."""
        brush = shx.Brush(centre=np.asarray(centre).tolist(), radius=radius, displacement=np.asarray(displacement).tolist(), falloff=falloff)
        result = self.rig.solver.brush_strands(brush, self.rig.strands)
        moved = np.zeros(len(self._rest.point_counts), dtype=bool)
        moved[self.rig.indices[result.touched]] = True
        return self._posed(moved, float(result.distances[result.touched].max(initial=0.0)))

    def _posed(self, moved: npt.NDArray[np.bool_], distance: float) -> Posed:
        """Curves that a stroke did not change stay exactly as they were drawn."""
        points = self.rig.points(self._rest.inputs.carriers)
        rows = np.repeat(moved, self._rest.point_counts)
        return Posed(np.where(rows[:, None], points, self._rest.points), int(moved.sum()), distance)
