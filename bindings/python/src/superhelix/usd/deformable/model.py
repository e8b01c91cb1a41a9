"""Curves of one simulation geometry with their material, in SI units."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix._buffers import column
from superhelix.fit import Fit, fit_strands
from superhelix.records import FitOptions, Material
from superhelix.usd.curves.bases import Integers, Numbers, starts_of

#: Commits of the proposal: the one that is written, and those that are read.
REVISION = "63c74d79aa67dc98d8707af8ad68f2e1a10622b5"
READ_REVISIONS = (REVISION, "61d83b54b7efbe97ad2f480de885255cd1e593be", "5d89c0ed46a26de92f4d3fefef3bfad6500c07ce")

CURVES_API = "PhysicsCurvesDeformableSimAPI"
MATERIAL_API = "PhysicsCurvesDeformableMaterialAPI"
BODY_API = "PhysicsDeformableBodyAPI"
#: What the proposal takes where nothing is authored: Pa, none, m, kg/m^3.
YOUNGS_MODULUS, POISSONS_RATIO, THICKNESS, DENSITY = 1e6, 0.3, 1e-3, 1000.0
#: Shear correction of a circular section.
SHEAR_FACTOR = 0.9
#: Powers of length in the units of stiffnesses, and their attributes.
STIFFNESSES = {"stretch": 1, "shear": 1, "bend": 3, "twist": 3}


class Stiffness(NamedTuple):
    """Stiffnesses of each curve: stretch and shear, N; bend and twist, N m^2."""

    stretch: Numbers
    shear: Numbers
    bend: Numbers
    twist: Numbers


def element_counts(counts: Integers, closed: bool) -> dict[str, int]:
    """How many values each element type has."""
    segments = counts if closed else counts - 1
    return {"constant": 1, "curve": len(counts), "segment": int(segments.sum()), "point": int(counts.sum())}


@dataclass
class DeformableCurves:
    """Curves of one prim with one material. Lengths in m, along the axes of the file or of the solver."""

    #: Points, m, curve by curve, and the points of each curve.
    points: Numbers
    point_counts: npt.NDArray[np.uint32]
    #: Normals of the material frames: at each point that of the segment after it; unit vectors.
    normals: Numbers | None = None
    velocities: Numbers | None = None
    #: The shape without forces; None: points and normals are that shape.
    rest_points: Numbers | None = None
    rest_normals: Numbers | None = None
    #: Diameters, m, for the elements of thickness_of: "constant", "curve", "segment" or "point".
    thickness: Numbers = field(default_factory=lambda: np.array([THICKNESS]))
    thickness_of: str = "constant"
    #: Masses, kg, for the elements of masses_of; None: density says them.
    masses: Numbers | None = None
    masses_of: str = "point"
    density: float = DENSITY
    youngs_modulus: float = YOUNGS_MODULUS
    poissons_ratio: float = POISSONS_RATIO
    #: Stiffnesses that are given rather than derived from modulus, ratio and thickness: N, N, N m^2, N m^2.
    stretch_stiffness: float | None = None
    shear_stiffness: float | None = None
    bend_stiffness: float | None = None
    twist_stiffness: float | None = None
    closed: bool = False
    #: Indices of the points that are attached to a frame, and the path of that frame.
    attached: Integers | None = None
    attached_to: str | None = None
    name: str = "strands"
    #: Where they were read, and by which revision of the proposal; empty for curves of a solver.
    path: str = ""
    revision: str = ""
    #: The largest relative difference of a strand's bending stiffness from that of the prim, for curves of a solver.
    stiffness_error: float = 0.0
    #: Indices of the strands in the solver or fit that they were made from.
    strands: Integers = field(default_factory=lambda: np.zeros(0, dtype=np.int64))

    def __post_init__(self) -> None:
        self.point_counts = column("point_counts", self.point_counts, np.uint32)
        total = int(self.point_counts.sum())
        self.points = column("points", self.points, np.float64, total, 3)
        for name in ("normals", "velocities", "rest_points", "rest_normals"):
            if getattr(self, name) is not None:
                setattr(self, name, column(name, getattr(self, name), np.float64, total, 3))
        counts = element_counts(self.point_counts.astype(np.int64), self.closed)
        for name in ("thickness", "masses"):
            values = getattr(self, name)
            if values is None:
                continue
            kind = getattr(self, f"{name}_of")
            if kind not in counts:
                raise ValueError(f"{name}_of: {kind!r}; one of {', '.join(counts)} expected")
            values = column(name, np.atleast_1d(values), np.float64, counts[kind])
            if not (np.isfinite(values) & (values > 0.0)).all():
                raise ValueError(f"{name}: {values[~(np.isfinite(values) & (values > 0.0))][0]}; above 0 expected")
            setattr(self, name, values)
        for name in ("density", "youngs_modulus"):
            if not 0.0 < getattr(self, name) < np.inf:
                raise ValueError(f"{name}: {getattr(self, name)}; above 0 expected")
        if not -1.0 < self.poissons_ratio <= 0.5:
            raise ValueError(f"poissons_ratio: {self.poissons_ratio}; above -1, at most 0.5 expected")
        for mode in STIFFNESSES:
            value = getattr(self, f"{mode}_stiffness")
            if value is not None and not 0.0 <= value < np.inf:
                raise ValueError(f"{mode}_stiffness: {value}; 0 or more expected")

    def __len__(self) -> int:
        return len(self.point_counts)

    def thickness_of_curves(self) -> Numbers:
        """The diameter of each curve, m: the mean over its elements."""
        counts = self.point_counts.astype(np.int64)
        if self.thickness_of == "constant":
            return np.full(len(counts), self.thickness[0])
        if self.thickness_of == "curve":
            return self.thickness
        sizes = counts if self.thickness_of == "point" or self.closed else counts - 1
        return np.asarray(np.add.reduceat(self.thickness, starts_of(sizes)) / sizes)

    def stiffness(self) -> Stiffness:
        """The stiffnesses of each curve: given, or derived for a solid circular section, as the proposal says."""
        diameter, modulus = self.thickness_of_curves(), self.youngs_modulus
        shear = modulus / (2.0 * (1.0 + self.poissons_ratio))
        area, bend, twist = np.pi * diameter**2 / 4.0, np.pi * diameter**4 / 64.0, np.pi * diameter**4 / 32.0
        derived = {"stretch": modulus * area, "shear": SHEAR_FACTOR * shear * area, "bend": modulus * bend, "twist": shear * twist}
        given = {mode: getattr(self, f"{mode}_stiffness") for mode in STIFFNESSES}
        return Stiffness(**{mode: derived[mode] if given[mode] is None else np.full(len(self), given[mode]) for mode in STIFFNESSES})

    def materials(self) -> list[Material]:
        """The material of each curve for StrandDefs or Solver.set_materials: of the same bending and twisting stiffness and mass. Stretch and shear are
        left out: strands of superhelix do neither.
        """
        stiffness, diameter = self.stiffness(), self.thickness_of_curves()
        made = []
        for curve in range(len(self)):
            second = np.pi * diameter[curve] ** 4 / 64.0
            modulus, shear = stiffness.bend[curve] / second, stiffness.twist[curve] / (2.0 * second)
            if not modulus > 0.0:
                raise ValueError(f"{self.path or self.name}: curve {curve} has a bending stiffness of 0, which no strand can have")
            ratio = modulus / (2.0 * shear) - 1.0 if shear > 0.0 else np.inf
            # Rounded to floats in the file.
            if 0.5 < ratio < 0.5 + 1e-5:
                ratio = 0.5
            if not -1.0 < ratio <= 0.5:
                raise ValueError(
                    f"{self.path or self.name}: curve {curve} bends with {stiffness.bend[curve]:.4g} N m^2 and twists with {stiffness.twist[curve]:.4g} N m^2; "
                    f"a strand with that ratio would have Poisson's ratio {ratio:.3g}; above -1, at most 0.5 expected"
                )
            material = Material(youngs_modulus=modulus, poisson_ratio=ratio, density=self._density(curve))
            material.radius = (0.5 * diameter[curve], 0.5 * diameter[curve])
            made.append(material)
        return made

    def _density(self, curve: int) -> float:
        if self.masses is None:
            return self.density
        counts = self.point_counts.astype(np.int64)
        rest = self.points if self.rest_points is None else self.rest_points
        lengths = np.array([np.linalg.norm(np.diff(rows, axis=0), axis=1).sum() for rows in np.split(rest, np.cumsum(counts)[:-1])])
        volume = lengths * np.pi * self.thickness_of_curves() ** 2 / 4.0
        if self.masses_of == "constant":
            return float(self.masses[0] / volume.sum())
        sizes = {"curve": np.ones(len(counts), dtype=np.int64), "point": counts}.get(self.masses_of, counts if self.closed else counts - 1)
        return float(np.add.reduceat(self.masses, starts_of(sizes))[curve] / volume[curve])

    def fit(self, options: FitOptions | None = None, *, rest: bool = True) -> Fit:
        """Fits a strand to each curve: to its rest shape (its curvatures are then natural curvatures), or to the present one."""
        points = self.rest_points if rest and self.rest_points is not None else self.points
        return fit_strands(points, self.point_counts, options)


def authored(value: Any) -> float | None:
    """A number of a schema; its sentinel, minus infinity, is none."""
    return None if value is None or value == -np.inf else float(value)
