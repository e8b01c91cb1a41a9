"""Reads hair from a stage: .usda, .usdc, .usdz, or a stage that a host has open."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from superhelix.enums import UpAxis
from superhelix.frames import multiply, quaternions, rotate
from superhelix.usd import instances
from superhelix.usd._pxr import Usd, UsdError, UsdGeom, UsdWarning, errors_of, refuse
from superhelix.usd.curves import primvars
from superhelix.usd.curves.bases import Evaluator, LinearCurves, Numbers
from superhelix.usd.curves.controls import Controls, sample_times
from superhelix.usd.hair import Hair
from superhelix.usd.merge import Part, merged
from superhelix.usd.skel import Skeletons, Skinned
from superhelix.usd.skin import SkinMesh, read_mesh

#: Half of the time, in time codes, over which the speed of what moves a prim is measured.
_SPEED_STEP = 1.0 / 64.0
_TURNS = {(UpAxis.Y, UpAxis.Z): np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]), (UpAxis.Z, UpAxis.Y): np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])}


@dataclass
class ReadOptions:
    """What to read, and how. The defaults are those of HairStage."""

    prims: Sequence[str] | None = None
    purposes: Sequence[str] | None = None
    tolerance: float | None = 5e-5
    primvars: Sequence[str] = ()
    max_points: int = 100_000_000
    max_prims: int = 100_000
    steady: bool = False


class HairStage:
    """Hair on a stage. times says when it has samples; read returns the strands at a time."""

    def __init__(
        self,
        stage: Any,
        *,
        prims: str | Sequence[str] | None = None,
        purposes: Sequence[str] | None = None,
        tolerance: float | None = 5e-5,
        up_axis: UpAxis | None = None,
        metres_per_unit: float | None = None,
        primvars: Sequence[str] = (),
        max_points: int = 100_000_000,
        max_prims: int = 100_000,
        steady: bool = False,
    ) -> None:
        """stage: a path to .usda, .usdc, .usdz or .usd, or a Usd.Stage.

        prims: paths of prims; only curves at or below them (None: all). purposes: some of "default", "render", "guide", "proxy"; None: default and
        render, and if there is no such hair, guide and proxy. tolerance: how far chords may be from the curve, m, above 0; None: control vertices
        as they are. up_axis: axis that shall point up (None: the stage's). metres_per_unit: in place of what the stage states. primvars: names of
        further primvars to read. max_points, max_prims: bounds on what a stage may ask for, its instances included. steady: strands
        have as many points at all times, chosen at the time that is read first; the tolerance holds there.
        """
        if isinstance(stage, (str, os.PathLike)):
            name = os.fspath(stage)
            if not os.path.exists(name):
                raise FileNotFoundError(f"{name}: there is no such file")
            with errors_of(name):
                self.stage = Usd.Stage.Open(name)
        else:
            self.stage = stage
        if tolerance is not None and not 0.0 < tolerance < np.inf:
            raise ValueError(f"tolerance: {tolerance}; above 0 m expected, or None for control vertices")
        if metres_per_unit is not None and not 0.0 < metres_per_unit < np.inf:
            raise ValueError(f"metres_per_unit: {metres_per_unit}; above 0 expected")
        if up_axis is not None and up_axis not in (UpAxis.Y, UpAxis.Z):
            raise ValueError(f"up_axis: {up_axis!r}; UpAxis.Y or UpAxis.Z expected")
        chosen = [prims] if isinstance(prims, str) else prims
        self.options = ReadOptions(chosen, purposes, tolerance, tuple(primvars), max_points, max_prims, steady)
        with errors_of(self.name):
            self.unit_stated = metres_per_unit is not None or bool(UsdGeom.StageHasAuthoredMetersPerUnit(self.stage))
            self.metres_per_unit = metres_per_unit or float(UsdGeom.GetStageMetersPerUnit(self.stage))
            own = UpAxis.Z if UsdGeom.GetStageUpAxis(self.stage) == UsdGeom.Tokens.z else UpAxis.Y
        if not 0.0 < self.metres_per_unit < np.inf:
            raise UsdError(self.name, f"metersPerUnit is {self.metres_per_unit}; above 0 expected")
        self.up_axis = own if up_axis is None else up_axis
        self._turn = _TURNS.get((own, self.up_axis), np.eye(3)).astype(np.float64)
        self._skeletons: Skeletons | None = None
        self._times: list[float] | None = None
        self._evaluators: dict[str, Evaluator] = {}

    @property
    def name(self) -> str:
        """The file, or what stands for it in memory."""
        return str(self.stage.GetRootLayer().identifier)

    # --- Time -----------------------------------------------------------------------------------------------------------------

    @property
    def codes_per_second(self) -> float:
        """Time codes per second of the stage."""
        return float(self.stage.GetTimeCodesPerSecond())

    def _code(self, time: float | None) -> Any:
        if time is not None:
            if not np.isfinite(time):
                raise ValueError(f"time: {time}; a finite number of seconds expected")
            return Usd.TimeCode(time * self.codes_per_second)
        with errors_of(self.name):
            codes = self._codes()
        return Usd.TimeCode(codes[0]) if codes else Usd.TimeCode.Default()

    def _codes(self) -> list[float]:
        if self._times is None:
            found: set[float] = set()
            # Instances and purposes are those at the start: prims that appear later have samples of their own, seen with purposes and times given.
            start = self.stage.GetStartTimeCode() if self.stage.HasAuthoredTimeCodeRange() else None
            code = Usd.TimeCode.Default() if start is None else Usd.TimeCode(start)
            for placed in self._placed(code):
                found |= placed.times | sample_times(placed.prim)
                skinned = self.skeletons.of(placed.prim)
                if skinned is not None:
                    found |= skinned.times
            self._times = sorted(found)
        return self._times

    @property
    def times(self) -> Numbers:
        """Times at which the curves, their transforms or their skeletons have samples, s, ascending. Empty for hair that does not change."""
        with errors_of(self.name):
            return np.array(self._codes()) / self.codes_per_second

    # --- What is there --------------------------------------------------------------------------------------------------------

    @property
    def skeletons(self) -> Skeletons:
        """The stage's skeletons."""
        if self._skeletons is None:
            self._skeletons = Skeletons(self.stage)
        return self._skeletons

    def _placed(self, code: Any) -> Iterator[instances.Placed]:
        kinds = (UsdGeom.BasisCurves, UsdGeom.NurbsCurves)
        options = self.options
        if options.purposes is not None:
            yield from instances.Walk(self.stage, code, options.purposes, options.prims, options.max_prims).find(kinds)
            return
        found = False
        for placed in instances.Walk(self.stage, code, ("default", "render"), options.prims, options.max_prims).find(kinds):
            found = True
            yield placed
        if not found:
            yield from instances.Walk(self.stage, code, ("guide", "proxy"), options.prims, options.max_prims).find(kinds)

    def placing(self, matrix: Callable[[Any], Numbers], skinned: Skinned | None) -> Callable[[Numbers, Any], Numbers]:
        """Takes points of a prim at a time code to metres in the chosen axes."""

        def place(points: Numbers, code: Any) -> Numbers:
            moved = points if skinned is None else skinned.deform(points, code)
            linear, offset = self.placement(matrix(code))
            out = instances.transformed(moved, linear)
            out += offset
            return out

        return place

    def placement(self, matrix: Numbers) -> tuple[Numbers, Numbers]:
        """A placement of the stage as a matrix on rows and an offset, in metres and the chosen axes."""
        turn = self._turn * self.metres_per_unit
        return matrix[:3, :3] @ turn, matrix[3, :3] @ turn

    def mesh(self, path: str, time: float | None = None) -> SkinMesh:
        """Reads a mesh as it is at a time (s; None: the first sample): placed, deformed by its skeleton, in metres, in the axes of this object."""
        with errors_of(self.name):
            return read_mesh(self, path, time)

    # --- Strands --------------------------------------------------------------------------------------------------------------

    def read(self, time: float | None = None) -> Hair:
        """Reads the strands at a time, s. None: the first sample."""
        code = self._code(time)
        left = [self.options.max_points]
        with errors_of(self.name):
            parts = [part for placed in self._placed(code) if (part := self._part(placed, code, left)) is not None]
        if not parts:
            where = "" if self.options.prims is None else f" at or below {', '.join(self.options.prims)}"
            raise UsdError(self.name, f"has no BasisCurves or NurbsCurves with points that are visible{where}")
        seconds = 0.0 if code.IsDefault() else code.GetValue() / self.codes_per_second
        hair = merged(parts, self.options.primvars)
        hair.up_axis, hair.metres_per_unit, hair.unit_stated, hair.time = self.up_axis, self.metres_per_unit, self.unit_stated, seconds
        return hair

    def __iter__(self) -> Iterator[Hair]:
        """Reads the strands at each of times; hair that does not change is read once."""
        for time in self.times.tolist() or [None]:
            yield self.read(time)

    def _part(self, placed: instances.Placed, code: Any, left: list[int]) -> Part | None:
        prim = placed.prim
        controls = Controls(prim, code)
        if not len(controls.points):
            return None

        def bound(points: int) -> None:
            left[0] -= points
            if left[0] < 0:
                most = self.options.max_points
                refuse(
                    prim, f"the stage has more than {most} points at a tolerance of {self.options.tolerance} m: allow more by max_points, or a larger tolerance"
                )

        skinned = self.skeletons.of(prim)
        place = self.placing(placed.matrix, skinned)
        points = place(controls.points, code)
        if not np.isfinite(points).all():
            refuse(prim, "its placement takes points to numbers that are not finite")
        evaluator = controls.evaluator(points, self.options.tolerance, bound, self._evaluators.get(placed.path))
        if self.options.steady:
            self._evaluators.setdefault(placed.path, evaluator)
        counts = controls.counts
        part = Part(placed.path, evaluator.vertex(points), evaluator.counts, evaluator.closed)
        # Polylines are as long as they are.
        part.arclengths = None if isinstance(evaluator, LinearCurves) else evaluator.arclengths(points)
        speeds = self._velocities(placed, controls, skinned, place, points)
        part.velocities = None if speeds is None else evaluator.vertex(speeds)
        matrix = placed.matrix(code)
        scale = abs(float(np.linalg.det(matrix[:3, :3]))) ** (1.0 / 3.0) * self.metres_per_unit
        widths = primvars.widths(prim, code, evaluator, counts)
        if widths is not None:
            # A cubic basis may overshoot below zero between control vertices.
            part.widths = np.maximum(widths.along(evaluator, counts)[:, 0], 0.0) * scale
        part.frames = self._frames(prim, code, evaluator, counts, matrix[:3, :3] @ self._turn, skinned)
        for name, names, width in (("root_uvs", primvars.ROOT_UV, 2), ("skin_uvs", primvars.SKIN_UV, 2), ("skin_prims", primvars.SKIN_PRIM, 1)):
            found = primvars.first_primvar(prim, names, code, evaluator, counts)
            if found is not None and found.values.dtype.kind in "iuf":
                values = found.per_curve(evaluator, counts).reshape(len(counts), -1)
                if values.shape[1] >= width:
                    setattr(part, name, values[:, :width] if width > 1 else values[:, 0].astype(np.int64))
        ids = primvars.first_primvar(prim, primvars.STRAND_ID, code, evaluator, counts)
        if ids is not None and ids.interpolation != "constant" and ids.values.ndim == 1 and ids.values.dtype.kind in "iuf":
            part.ids = ids.per_curve(evaluator, counts).astype(np.int64)
        groups = primvars.first_primvar(prim, primvars.GROUP, code, evaluator, counts)
        if groups is not None and groups.values.ndim == 1:
            part.groups = [str(value) for value in groups.per_curve(evaluator, counts).tolist()]
        for name in self.options.primvars:
            found = primvars.primvar(prim, name, code, evaluator, counts)
            if found is not None:
                per_point = found.interpolation in ("vertex", "varying") and found.values.dtype.kind in "iuf"
                part.primvars[name] = found.along(evaluator, counts) if per_point else found.per_curve(evaluator, counts)
        return part

    def _velocities(
        self, placed: instances.Placed, controls: Controls, skinned: Skinned | None, place: Callable[[Numbers, Any], Numbers], points: Numbers
    ) -> Numbers | None:
        """Velocities of the control vertices, m/s: their own, and those of what moves the prim."""
        own, code, local = controls.velocities, controls.code, controls.points
        moving = placed.moving or (skinned is not None and skinned.moving)
        if own is None and not moving:
            return None
        if own is None:
            speeds = np.zeros_like(points)
        elif skinned is None:
            speeds = instances.transformed(own, self.placement(placed.matrix(code))[0])
        else:
            # Skins are affine in the points.
            speeds = place(local + own, code) - points
        if code.IsDefault() or not moving:
            return speeds
        now = code.GetValue()
        times = placed.times | (set() if skinned is None else skinned.times)
        before, after = max(now - _SPEED_STEP, min(times, default=now)), min(now + _SPEED_STEP, max(times, default=now))
        if len(times) < 2:
            # An instancer with velocities and a single sample.
            before, after = now - _SPEED_STEP, now + _SPEED_STEP
        if before < after:
            ends = [place(local, Usd.TimeCode(moment)) for moment in (before, after)]
            speeds = speeds + (ends[1] - ends[0]) * (self.codes_per_second / (after - before))
        return speeds

    def _frames(self, prim: Any, code: Any, evaluator: Evaluator, counts: Any, linear: Numbers, skinned: Skinned | None) -> Numbers | None:
        """Material frames at the points, turned with the prim."""
        found = primvars.primvar(prim, primvars.FRAME, code, evaluator, counts)
        if found is None:
            return None
        values = _quaternions(found.values)
        ends = int((evaluator.segments + (0 if evaluator.closed else 1)).sum())
        if values is None or len(values) != ends or found.interpolation not in ("vertex", "varying"):
            warnings.warn(
                f"{prim.GetPath()}: primvars:{primvars.FRAME} does not have a quaternion for each end of a segment: left out", UsdWarning, stacklevel=2
            )
            return None
        if skinned is not None:
            warnings.warn(f"{prim.GetPath()}: a skeleton moves it, but not its primvars:{primvars.FRAME}: left out", UsdWarning, stacklevel=2)
            return None
        # Neighbours on the same side of the sphere, so that their mean is between them.
        flips = np.sign(np.sum(values[1:] * values[:-1], axis=1))
        values[1:] *= np.cumprod(np.where(flips == 0.0, 1.0, flips))[:, None]
        along = evaluator.varying(values)
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        size = float(np.cbrt(np.linalg.det(linear)))
        if size > 0.0 and np.allclose(linear @ linear.T, size * size * np.eye(3), rtol=0.0, atol=1e-12 * size * size):
            # A rotation, and one scale.
            return multiply(np.broadcast_to(quaternions(linear.T / size), along.shape), along)
        n0 = rotate(along, (1.0, 0.0, 0.0)) @ linear
        n0 /= np.linalg.norm(n0, axis=1, keepdims=True)
        n1 = rotate(along, (0.0, 1.0, 0.0)) @ linear
        n1 -= n0 * np.sum(n0 * n1, axis=1, keepdims=True)
        n1 /= np.linalg.norm(n1, axis=1, keepdims=True)
        return quaternions(np.stack([n0, n1, np.cross(n0, n1)], axis=-1))


def _quaternions(values: Any) -> Numbers | None:
    """Rows x, y, z, w."""
    array = np.asarray(values)
    return array.astype(np.float64).copy() if array.ndim == 2 and array.shape[1] == 4 else None


def read_hair(stage: Any, time: float | None = None, **options: Any) -> Hair:
    """Reads the strands of a stage at a time, s (None: the first sample). options: those of HairStage."""
    return HairStage(stage, **options).read(time)
