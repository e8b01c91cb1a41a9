"""Strands that were read from a stage, ready for the functions of grooms."""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix.enums import UpAxis
from superhelix.fit import Fit, fit_strands
from superhelix.groom import Groom
from superhelix.records import FitOptions
from superhelix.usd.curves.bases import Integers, Numbers, edges_along, points_of, starts_of


@dataclass
class Hair:
    """Strands of a stage at one time, in metres, in the axes of up_axis. Rows per point are strand by strand, root first.

    What only some prims have is NaN (numbers) or -1 (indices) for strands of the others, and None where no prim has it.
    """

    #: Points on the curves, m, and the number of points of each strand.
    points: Numbers
    point_counts: npt.NDArray[np.uint32]
    #: The axis that points up, of points and all else; metres per unit of the stage, and whether the stage states them.
    up_axis: UpAxis = UpAxis.Z
    metres_per_unit: float = 1.0
    unit_stated: bool = True
    #: Seconds; 0 for a stage without time.
    time: float = 0.0
    #: Arclength of each point along the curve itself, m.
    arclengths: Numbers | None = None
    #: Velocities of the points, m/s: authored ones and those of whatever moves the prim.
    velocities: Numbers | None = None
    #: Widths (diameters) at the points, m.
    widths: Numbers | None = None
    #: Material frames at the points, quaternions x, y, z, w: n0 is the tangent. Only superhelix writes them.
    frames: Numbers | None = None
    #: Texture coordinates of the roots.
    root_uvs: Numbers | None = None
    #: The face of the skin that each root is on, and where on it, as Houdini's skinprim and skinprimuv.
    skin_prims: Integers | None = None
    skin_uvs: Numbers | None = None
    #: The number that the file gives to each strand.
    ids: Integers | None = None
    #: Names of groups, and the group of each strand: what the file says, else the prim's path.
    groups: list[str] = field(default_factory=list)
    group_of: Integers = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    #: Paths of the prims (an instance: that of the instancer, its number in brackets, that of the prim), the prim of each strand, and its number in it.
    prims: list[str] = field(default_factory=list)
    prim_of: Integers = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    curve_of: Integers = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    #: Which strands are closed curves (wrap periodic): their last point is their first.
    closed: npt.NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=bool))
    #: Other primvars that were asked for: a row per strand if they are uniform or constant, else a row per point.
    primvars: dict[str, npt.NDArray[Any]] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.point_counts)

    def __repr__(self) -> str:
        return f"Hair({len(self)} strands, {len(self.points)} points, {len(self.prims)} prims, time {self.time:g} s)"

    @property
    def first_points(self) -> Integers:
        """Index of the first point of each strand."""
        return starts_of(self.point_counts.astype(np.int64))

    @property
    def roots(self) -> Numbers:
        """The first point of each strand, m."""
        return np.asarray(self.points[self.first_points])

    @property
    def lengths(self) -> Numbers:
        """The length of each strand, m."""
        counts = self.point_counts.astype(np.int64)
        along = self.arclengths if self.arclengths is not None else edges_along(self.points, counts)
        return np.asarray(along[starts_of(counts) + counts - 1])

    def select(self, which: slice | npt.NDArray[Any] | list[int]) -> Hair:
        """Selects strands: by a mask, indices in any order, or a slice."""
        chosen = np.arange(len(self))[which]
        counts = self.point_counts.astype(np.int64)
        points = points_of(chosen, counts)
        changed: dict[str, Any] = {}
        for item in fields(self):
            value = getattr(self, item.name)
            if isinstance(value, np.ndarray):
                changed[item.name] = value[points] if self._per_point(item.name) else value[chosen]
        changed["primvars"] = {name: value[points] if self._long(value) else value[chosen] for name, value in self.primvars.items()}
        return replace(self, **changed)

    @staticmethod
    def _per_point(name: str) -> bool:
        return name in ("points", "arclengths", "velocities", "widths", "frames")

    def _long(self, value: npt.NDArray[Any]) -> bool:
        return len(value) == len(self.points) and len(value) != len(self)

    def fit(self, options: FitOptions | None = None, *, roots: Any = None) -> Fit:
        """Fits a strand to each curve, with the curve's own arclengths, and its widths and material frames if it has them. See superhelix.fit_strands."""
        widths = self.widths if self.widths is not None and np.isfinite(self.widths).all() and (self.widths > 0.0).all() else None
        frames = self.frames if self.frames is not None and np.isfinite(self.frames).all() else None
        return fit_strands(self.points, self.point_counts, options, arclengths=self.arclengths, widths=widths, frames=frames, roots=roots)

    def groom(self) -> Groom:
        """The strands as a superhelix.Groom, for prepare and simulate. A stage without a unit, whose hair would be of no hair's length, is refused."""
        lengths = self.lengths
        median = float(np.median(lengths)) if len(lengths) else 0.0
        if not self.unit_stated and not 0.005 <= median <= 1.2:
            raise ValueError(f"metersPerUnit: the stage does not state it, and its median strand would be {median:.3g} m long: pass metres_per_unit")
        return Groom(self.points, self.point_counts, self.up_axis, self.metres_per_unit, self.arclengths)
