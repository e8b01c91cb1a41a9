"""Grooms in a few lines: fit strands, make them wisps that rest as drawn, move the head, write caches and render hair.

These functions do what the command line's simulate and interpolate do. prepare gives you the solver, the ids and the fit to continue with.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from superhelix._buffers import column
from superhelix.bodies import BodyDef
from superhelix.curves import CurveCacheWriter, CurveData, Curves, Path
from superhelix.drawn_inside import warn_of
from superhelix.enums import CurveAttribute, StrandStatus, UpAxis
from superhelix.fit import Fit, fit_strands
from superhelix.hair import wisp_material
from superhelix.ids import BodyId, StrandIds
from superhelix.motion import Motion, carried, carried_roots, frames_at, root_velocities, still
from superhelix.records import ContactOptions, FitOptions, Material, Settings, StepReport, StrandContact, Wisp
from superhelix.solver import Solver
from superhelix.solver.contact import PushedOut
from superhelix.strand_defs import StrandDefs

if TYPE_CHECKING:
    from superhelix import alembic
    from superhelix.usd import HairWriter

Numbers = npt.NDArray[np.float64]

_MOST_ELEMENTS = 100
_REFITS = 12


def is_alembic(path: Path) -> bool:
    """Whether a path is that of an Alembic file."""
    return os.fsdecode(path).lower().endswith(".abc")


def is_binary_usd(path: Path) -> bool:
    """Whether a path is that of a USD file that only superhelix.usd reads and writes."""
    return os.fsdecode(path).lower().endswith((".usdc", ".usdz", ".usd"))


@dataclass
class Groom:
    """Curves of a groom, root first: points (m, curve by curve), the number of points of each curve, and the up axis."""

    points: Numbers
    point_counts: npt.NDArray[np.uint32]
    up_axis: UpAxis = UpAxis.Z
    metres_per_unit: float = 1.0
    arclengths: Numbers | None = None

    def __post_init__(self) -> None:
        rows = np.asarray(self.points, dtype=np.float64)
        if rows.ndim == 3 and self.point_counts is None:
            self.point_counts = np.full(rows.shape[0], rows.shape[1], dtype=np.uint32)
        self.point_counts = column("point_counts", self.point_counts, np.uint32)
        self.points = column("points", rows, np.float64, int(self.point_counts.sum()), 3)

    @classmethod
    def from_curves(cls, points: npt.ArrayLike, point_counts: npt.ArrayLike | None = None, up_axis: UpAxis = UpAxis.Z) -> Groom:
        """Creates a groom from curves in metres: (curves, points, 3), or curve by curve (points, 3) with point_counts."""
        return cls(points, point_counts, up_axis)  # type: ignore[arg-type]

    @classmethod
    def read(cls, path: Path, *, scale: float | None = None, up_axis: UpAxis | None = None, every: int = 1) -> Groom:
        """Reads a groom file. scale: metres per file unit; None: as the file states, else 1, with an error if no hair has such a length. up_axis: None:
        as the file states, else y. every: 2 takes every second strand, and so on. Binary USD (.usdc, .usdz, .usd) needs superhelix[usd], whose
        superhelix.usd.read_hair has more choices. Alembic (.abc): the first time of the file; superhelix.alembic.read_hair has others.
        """
        if every < 1:
            raise ValueError(f"every: {every}; at least 1 expected")
        if is_binary_usd(path):
            from superhelix.usd import read_hair

            groom = read_hair(path, metres_per_unit=scale).select(slice(None, None, every)).groom()
            return groom if up_axis is None else cls(groom.points, groom.point_counts, up_axis, groom.metres_per_unit, groom.arclengths)
        rows, counts, along, metres, stated, axis = _read_curves(path, scale)
        lengths = np.array([np.linalg.norm(np.diff(curve, axis=0), axis=1).sum() for curve in np.split(rows, np.cumsum(counts)[:-1])])
        median = float(np.median(lengths)) if len(lengths) else 0.0
        if scale is None and not stated and not 0.005 <= median <= 1.2:
            raise ValueError(f"scale: {path} does not state its unit, and its median strand is {median:.3g} units long: give metres a unit")
        keep = np.zeros(len(counts), dtype=bool)
        keep[::every] = True
        mask = np.repeat(keep, counts)
        up = up_axis if up_axis is not None else (axis or UpAxis.Y)
        return cls(rows[mask], counts[keep], up, metres, None if along is None else along[mask].astype(np.float64) * metres)

    @property
    def gravity(self) -> tuple[float, float, float]:
        """Gravity, m/s^2, against the axis that points up."""
        return (0.0, -9.81, 0.0) if self.up_axis == UpAxis.Y else (0.0, 0.0, -9.81)

    @property
    def roots(self) -> Numbers:
        """The first point of each curve, m."""
        starts = np.concatenate([[0], np.cumsum(self.point_counts)[:-1]]).astype(np.int64)
        return self.points[starts]

    def __len__(self) -> int:
        return len(self.point_counts)


def _read_curves(path: Path, scale: float | None) -> tuple[Numbers, npt.NDArray[np.uint32], Any, float, bool, UpAxis]:
    """Points (m) of a file's curves, their numbers, arclengths (in the file's unit) if it has some, its unit, whether it states it, and its up axis."""
    if is_alembic(path):
        from superhelix.alembic import read_hair

        metres = 1.0 if scale is None else scale
        hair = read_hair(path, metres_per_unit=metres)
        return hair.points, hair.point_counts, None, metres, False, UpAxis.Y
    with Curves(path) as curves:
        units, counts = curves.units(), curves.point_counts()
        metres = scale if scale is not None else (units.metres or 1.0)
        along = curves.attribute(CurveAttribute.ARCLENGTH)
        return curves.points(metres, dtype=np.float64), counts, along, metres, bool(units.metres), UpAxis(units.up_axis)


def _largest_turns(fit: Fit) -> Numbers:
    """The largest angle by which an element of each strand turns, rad."""
    angles = fit.element_lengths * np.linalg.norm(fit.curvatures, axis=2)
    return np.asarray(angles.max(axis=1))


def _fit_with(points: Numbers, counts: npt.NDArray[np.uint32], along: Numbers | None, elements: int, workers: int) -> Fit:
    options = FitOptions(element_count=elements, worker_count=workers)
    return fit_strands(points, counts, options, arclengths=along)


def fit_groom(groom: Groom, element_count: int = 10, *, refine: bool = True, worker_count: int = 1) -> Fit:
    """Fits a strand to each curve. refine: strands with an element that turns by more than a quarter turn get more elements, up to 100."""
    fit = _fit_with(groom.points, groom.point_counts, groom.arclengths, element_count, worker_count)
    ends = np.cumsum(groom.point_counts).astype(np.int64)
    limits = np.minimum(4 * groom.point_counts.astype(np.int64), _MOST_ELEMENTS)
    for _ in range(_REFITS if refine else 0):
        counts, turns = fit.strands.element_count.astype(np.int64), _largest_turns(fit)
        coarse = np.flatnonzero(fit.fitted & (turns > np.pi / 2) & (counts < limits))
        if not len(coarse):
            break
        wanted = np.ceil(counts[coarse] * turns[coarse] / (np.pi / 2)).astype(np.int64)
        wanted = np.clip(wanted, counts[coarse] + 1, limits[coarse])
        for elements in np.unique(wanted).tolist():
            chosen = coarse[wanted == elements]
            rows = np.concatenate([np.arange(ends[strand] - groom.point_counts[strand], ends[strand]) for strand in chosen])
            along = None if groom.arclengths is None else groom.arclengths[rows]
            again = _fit_with(groom.points[rows], groom.point_counts[chosen], along, elements, worker_count)
            _replace(fit, chosen, again)
    return fit


def _replace(fit: Fit, places: npt.NDArray[np.int64], other: Fit) -> None:
    """Puts strands of another fit, which may have more elements, in the place of some."""
    missing = other.element_lengths.shape[1] - fit.element_lengths.shape[1]
    if missing > 0:
        fit.element_lengths = np.pad(fit.element_lengths, ((0, 0), (0, missing)))
        fit.curvatures = np.pad(fit.curvatures, ((0, 0), (0, missing), (0, 0)))
    width = other.element_lengths.shape[1]
    fit.element_lengths[places], fit.curvatures[places] = 0.0, 0.0
    fit.element_lengths[places, :width], fit.curvatures[places, :width] = other.element_lengths, other.curvatures
    fit.strands.data[places] = other.strands.data


@dataclass
class GroomSolver:
    """Groom in a solver, on a head: the result of prepare. A context manager that closes the solver."""

    solver: Solver
    strands: StrandIds
    fit: Fit
    #: Indices of the groom's curves that are simulated, and of those that cannot be.
    indices: npt.NDArray[np.int64]
    skipped: npt.NDArray[np.int64]
    #: The roots' frames in the groom, and where the head's joint is in it, m.
    roots: Numbers
    pivot: Numbers
    body: BodyId | None
    #: By which factor each strand was made stiffer, so that it rests as drawn.
    stiffening: Numbers
    wisp_radius: float
    #: The groom's curves pushed out of the body; None without a body, or with push_out=False.
    pushed_out: PushedOut | None = None

    def move_head(self, start: npt.ArrayLike, now: npt.ArrayLike, over_seconds: float = 0.0) -> None:
        """Moves roots and body with a head that went from the frame start, where the groom was drawn, to the frame now."""
        self.solver.set_root_frames(carried_roots(start, now, self.pivot, self.roots), self.strands, over_seconds)
        if self.body is not None:
            self.solver.set_body_frames(carried(start, now, self.pivot)[None], self.body, over_seconds)

    def __enter__(self) -> GroomSolver:
        return self

    def __exit__(self, *_: object) -> None:
        self.solver.close()


def prepare(
    groom: Groom,
    *,
    hair: Material | None = None,
    wisp: Wisp | None = None,
    bare: bool = False,
    element_count: int = 10,
    refine: bool = True,
    body: BodyDef | None = None,
    push_out: bool = True,
    wisp_contact_radius: float = 0.0,
    contact: StrandContact | None = None,
    settings: Settings | None = None,
    worker_count: int = 1,
    pivot: npt.ArrayLike | None = None,
    gravity: Sequence[float] | None = None,
    motion: Motion = still,
    start: float = 0.0,
    **solver_fields: Any,
) -> GroomSolver:
    """Adds a groom to a new solver so that it rests as drawn: pushes curves out of the body, fits strands, gives them the material of wisps (wisp: the
    wisp; hair: the material of its hairs; bare: single hairs), stiffens them as far as rest takes, and permits the overlaps that remain.

    body: keeps hair out, in the groom's axes, m. push_out: whether curves that are drawn inside it are pushed out first; if that moves one by more than
    2 mm, or finds no way out, there is a DrawnInsideWarning. False: they stay as drawn. wisp_contact_radius: above 0, strands collide with each other
    as wisps of that radius, m. contact: a StrandContact in place of the default. settings: the result of preset_settings. pivot: the head's joint, m
    (default: the mean of the roots).
    motion, start: hair begins with the velocity that this motion has at the time start, if it has a method velocity (see motion_from_samples);
    else at rest. solver_fields: fields of SolverDef.
    """
    rod = wisp_material(Wisp(hairs=1.0, hold=0.0) if bare else wisp, hair)
    down = groom.gravity if gravity is None else tuple(gravity)
    if settings is None:
        solver_fields.setdefault("tolerance", 1e-4)
    solver = Solver(gravity=down, worker_count=worker_count, settings=settings, **solver_fields)
    meets = contact if contact is not None else StrandContact(radius=max(rod.material.radius), wisp_radius=wisp_contact_radius)
    curves, body_id, pushed = groom, None, None
    if body is not None:
        body_id = solver.add_body(body)
    if body_id is not None and push_out:
        pushed = solver.push_out_curves(body_id, groom.points, groom.point_counts, meets.radius)
        warn_of(pushed)
        curves = Groom(pushed.points, groom.point_counts, groom.up_axis, groom.metres_per_unit, groom.arclengths)
    fit = fit_groom(curves, element_count, refine=refine, worker_count=worker_count)
    good = fit.fitted & (fit.strands.length > 2.0 * max(rod.material.radius))
    if not good.any():
        raise ValueError("groom: no curve can be simulated: all are without length, or not longer than wide")
    fit = fit.select(good)
    defs = StrandDefs.from_fit(fit, material=rod.material)
    joint = defs.data["root"]["origin"].mean(axis=0) if pivot is None else np.asarray(pivot, dtype=np.float64)
    defs.data["root_velocity"], defs.data["root_angular_velocity"] = root_velocities(motion, start, joint, defs.data["root"]["origin"])
    strands = solver.add_strands(defs)
    if rod.margin > 0.0:
        stiffening = solver.stiffen_strands(rod.margin, strands)
    else:
        solver.adopt_rest_shapes(strands)
        stiffening = np.ones(len(strands))
    if body is not None or wisp_contact_radius > 0.0 or contact is not None:
        if meets.wisp_radius > 0.0:
            solver.set_contact_options(ContactOptions(hair_contact=True))
        solver.set_strand_contact(meets, strands)
        solver.permit_overlaps(strands)
    roots = solver.root_frames(strands)
    indices = np.arange(len(groom))
    radius = max(rod.radius, meets.wisp_radius)
    return GroomSolver(solver, strands, fit, indices[good], indices[~good], roots, joint, body_id, stiffening, radius, pushed)


@dataclass
class Simulation:
    """Result of simulate: times (s), points (frames, strands, points, 3) in m, a StepReport for each step, the indices of the simulated curves and
    of the skipped ones, the stiffening of each strand, and the indices of strands that were ever quarantined.
    """

    times: Numbers
    points: npt.NDArray[np.float32]
    reports: list[StepReport]
    indices: npt.NDArray[np.int64]
    skipped: npt.NDArray[np.int64]
    stiffening: Numbers
    quarantined: npt.NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))


def simulate(
    groom: Groom,
    motion: Motion = still,
    *,
    duration: float,
    start: float = 0.0,
    fps: float = 30.0,
    substeps: int | None = None,
    points_per_strand: int = 33,
    cache: Path | None = None,
    progress: Callable[[int, int], None] | None = None,
    settings: Settings | None = None,
    **preparation: Any,
) -> Simulation:
    """Simulates a groom on a moving head for duration seconds at fps frames per second. With cache, also writes a file with velocities: .usda; .abc
    with widths; or with superhelix[usd] .usdc or .usdz, which have material frames and widths too.

    motion: the head's frame at a time; at the time start the groom is as drawn, and hair has the velocity of the motion if it has a method velocity
    (see motion_from_samples), else none. substeps: steps per frame (default: 2, or as settings say).
    progress(frame, frames) is called after each frame. preparation: arguments of prepare.
    """
    if not duration > 0.0 or not fps > 0.0:
        raise ValueError(f"duration, fps: {duration}, {fps}; both above zero expected")
    if substeps is None:
        substeps = 2 if settings is None else settings.substeps
    frame_count = int(np.floor(duration * fps + 1e-9)) + 1
    times = np.arange(frame_count) / fps
    first, dt = np.asarray(motion(start), dtype=np.float64), 1.0 / (fps * substeps)
    heads = frames_at(motion, start + np.arange(1, (frame_count - 1) * substeps + 1) * dt)
    with prepare(groom, settings=settings, motion=motion, start=start, **preparation) as made:
        solver, strands = made.solver, made.strands
        points = np.empty((frame_count, len(strands), points_per_strand, 3), dtype=np.float32)
        reports: list[StepReport] = []
        quarantined = np.zeros(len(strands), dtype=bool)
        writer = None
        try:
            for frame in range(frame_count):
                if frame:
                    for _ in range(substeps):
                        made.move_head(first, next(heads), dt)
                        reports.append(solver.step(dt))
                        if reports[-1].quarantined:
                            quarantined |= solver.strand_status(strands) == StrandStatus.QUARANTINED
                solver.sample_strands(points_per_strand, strands, out=points[frame])
                if cache is not None:
                    writer = _write_frame(made, groom, cache, writer, fps, times[frame], points[frame])
                if progress is not None:
                    progress(frame + 1, frame_count)
            if writer is not None:
                writer.close()
        except BaseException:
            if writer is not None:
                writer.abandon()
            raise
    return Simulation(times, points, reports, made.indices, made.skipped, made.stiffening, np.flatnonzero(quarantined))


def _write_frame(
    made: GroomSolver,
    groom: Groom,
    cache: Path,
    writer: CurveCacheWriter | HairWriter | alembic.HairWriter | None,
    fps: float,
    time: float,
    points: npt.NDArray[np.float32],
) -> CurveCacheWriter | HairWriter | alembic.HairWriter:
    """Writes a frame of the cache, in the groom's own units."""
    velocities = made.solver.sample_velocities(points.shape[1], made.strands)
    if is_binary_usd(cache):
        return _write_usd_frame(made, groom, cache, writer, fps, time, points, velocities)
    if is_alembic(cache):
        return _write_alembic_frame(made, groom, cache, writer, time, points, velocities)
    scale = 1.0 / groom.metres_per_unit
    rows, velocities = points * np.float32(scale), velocities * scale
    if writer is None:
        data = CurveData(rows, velocities=velocities, up_axis=groom.up_axis, metres_per_unit=groom.metres_per_unit)
        writer = CurveCacheWriter(cache, data, fps)
    writer.write(time, rows, velocities)
    return writer


def _write_usd_frame(
    made: GroomSolver,
    groom: Groom,
    cache: Path,
    writer: Any,
    fps: float,
    time: float,
    points: npt.NDArray[np.float32],
    velocities: Numbers,
) -> HairWriter:
    """The same in binary USD, with frames and widths."""
    from superhelix.usd import HairWriter

    if writer is None:
        counts, widths = np.full(points.shape[0], points.shape[1]), _widths(made)
        options: dict[str, Any] = {"up_axis": groom.up_axis, "metres_per_unit": groom.metres_per_unit, "widths": widths}
        writer = HairWriter(cache, counts, frames_per_second=fps, primvars={"superhelix:curve": made.indices}, **options)
    writer.write(time, points, velocities, made.solver.sample_frames(points.shape[1], made.strands))
    made_writer: HairWriter = writer
    return made_writer


def _write_alembic_frame(
    made: GroomSolver, groom: Groom, cache: Path, writer: Any, time: float, points: npt.NDArray[np.float32], velocities: Numbers
) -> alembic.HairWriter:
    """The same in Alembic, with widths."""
    from superhelix.alembic import HairWriter

    if writer is None:
        counts = np.full(points.shape[0], points.shape[1])
        writer = HairWriter(cache, counts, up_axis=groom.up_axis, metres_per_unit=groom.metres_per_unit, widths=_widths(made))
    writer.write(time, points, velocities)
    made_writer: HairWriter = writer
    return made_writer


def _widths(made: GroomSolver) -> list[float]:
    """The diameter of each strand, m."""
    return [2.0 * max(made.solver.material(strand).radius) for strand in made.strands]
