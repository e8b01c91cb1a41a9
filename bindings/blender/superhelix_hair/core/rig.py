"""A solver built from a rest, so that hair rests as drawn."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import superhelix as shx
from superhelix.groom import fit_groom

from .rest import FrameInputs, Motion, Rest
from .settings import PRESETS, HairSettings
from .space import relative, transformed

Numbers = npt.NDArray[np.float64]


def _pushed_out(solver: shx.Solver, bodies: list[shx.BodyId], rest: Rest, clearance: float) -> tuple[Numbers, int]:
    """Curves out of all bodies, and how many found no way out."""
    points, stuck = rest.points, np.zeros(len(rest.point_counts), dtype=bool)
    for body in bodies:
        pushed = solver.push_out_curves(body, points, rest.point_counts, clearance)
        points, stuck = pushed.points, stuck | pushed.stuck
    return points, int(stuck.sum())


class Rig:
    """Curves in a solver, with their surroundings at the first frame."""

    def __init__(self, rest: Rest, settings: HairSettings, frame_time: float) -> None:
        if not 1e-4 <= frame_time <= 1.0:
            raise ValueError(f"frame_time: {frame_time}; 0.0001 to 1 s expected")
        rod = settings.rod()
        contact = settings.contact(rod)
        self.rest, self.frame_time = rest, frame_time
        self._weights, self._follow_time = ((0.0, settings.follow_root), (1.0, settings.follow_tip)), settings.follow_time
        chosen = self._choose(rest, settings, frame_time)
        self.substeps = settings.substeps or (2 if chosen is None else chosen.substeps)
        elements = settings.element_count or (10 if chosen is None else chosen.element_count)
        fields: dict[str, Any] = {"tolerance": 1e-4} if chosen is None else {}
        self.solver = shx.Solver(gravity=settings.gravity, worker_count=settings.worker_count, settings=chosen, **fields)
        try:
            self._add(rest, settings, rod, contact, elements)
        except BaseException:
            self.solver.close()
            raise

    @staticmethod
    def _choose(rest: Rest, settings: HairSettings, frame_time: float) -> shx.Settings | None:
        """Settings of a preset, for hair as curly and as long as this."""
        preset = PRESETS.get(settings.quality)
        if preset is None:
            return None
        fit = fit_groom(shx.Groom(rest.points, rest.point_counts), refine=False, worker_count=settings.worker_count)
        fit = fit.select(fit.fitted)
        if not len(fit):
            raise ValueError("curves: none has a length")
        turns = np.linalg.norm(fit.curvatures, axis=2) * fit.element_lengths
        curvature = float(np.median(turns.sum(axis=1) / fit.strands.length))
        return shx.preset_settings(preset, curvature=curvature, length=float(np.median(fit.strands.length)), frame_time=frame_time)

    def _add(self, rest: Rest, settings: HairSettings, rod: shx.hair.WispMaterial, contact: shx.StrandContact, elements: int) -> None:
        solver, thick = self.solver, max(rod.material.radius)
        defs = [body.definition(pose) for body, pose in zip(rest.colliders, rest.inputs.bodies, strict=True)]
        self.bodies: list[shx.BodyId] = [solver.add_body(definition) for definition in defs]
        points, self.stuck = _pushed_out(solver, self.bodies, rest, contact.radius)
        fit = fit_groom(shx.Groom(points, rest.point_counts), elements, worker_count=settings.worker_count)
        good = fit.fitted & (fit.strands.length > 2.0 * thick)
        if not good.any():
            raise ValueError("curves: none can be simulated: all are without length, or not longer than wide")
        self.indices, self.skipped = np.flatnonzero(good), np.flatnonzero(~good)
        self.fit = fit.select(good)
        self.strands = solver.add_strands(shx.StrandDefs.from_fit(self.fit, material=rod.material))
        if rod.margin > 0.0:
            self.stiffening = solver.stiffen_strands(rod.margin, self.strands)
        else:
            solver.adopt_rest_shapes(self.strands)
            self.stiffening = np.ones(len(self.strands))
        if self.bodies or contact.wisp_radius > 0.0:
            solver.set_contact_options(shx.ContactOptions(model=settings.contact_model, hair_contact=contact.wisp_radius > 0.0))
            solver.set_strand_contact(contact, self.strands)
            solver.permit_overlaps(self.strands)
        solver.set_wind(rest.inputs.wind)
        self._roots = relative(rest.inputs.carriers[self.indices], solver.root_frames(self.strands))
        self._place_points()
        self._follow(rest.inputs, 0.0)

    def _follow(self, inputs: FrameInputs, over_seconds: float) -> None:
        """Sends the strands' targets to where the rigged curves are."""
        counts, points = self.rest.target_counts, inputs.targets
        if counts is None or points is None:
            return
        if len(self.skipped):
            points = points[np.isin(np.repeat(np.arange(len(counts)), counts), self.indices)]
            counts = counts[self.indices]
        self.solver.set_targets(points, self.strands, point_counts=counts, weights=self._weights, time_constant=self._follow_time, over_seconds=over_seconds)

    def _place_points(self) -> None:
        """Where on its strand each drawn point is, and the points of curves that are not simulated in the axes of what carries them."""
        ends = np.cumsum(self.rest.point_counts).astype(np.int64)
        starts = ends - self.rest.point_counts
        self.curve_starts = starts
        lengths = self.solver.strand_lengths(self.strands)
        self._rows: list[tuple[int, int, Numbers]] = []
        uniform: dict[int, list[int]] = {}
        for strand, curve in enumerate(self.indices.tolist()):
            drawn = self.rest.points[starts[curve] : ends[curve]]
            along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(drawn, axis=0), axis=1))])
            along *= lengths[strand] / along[-1]
            along[-1] = lengths[strand]
            even = np.linspace(0.0, lengths[strand], len(along))
            if np.abs(along - even).max() <= 1e-6 * lengths[strand]:
                uniform.setdefault(len(along), []).append(strand)
            else:
                self._rows.append((strand, int(starts[curve]), along))
        #: Strands whose points are even go by one call for all of the same number: their places, the number, and the rows of their points.
        self._even = [(np.array(places), count, (starts[self.indices[places]][:, None] + np.arange(count)).reshape(-1)) for count, places in uniform.items()]
        carried = [np.arange(starts[curve], ends[curve]) for curve in self.skipped.tolist()]
        self._carried = np.concatenate(carried) if carried else np.zeros(0, dtype=np.int64)
        owners = np.repeat(np.arange(len(ends)), self.rest.point_counts)[self._carried]
        self._owners = owners
        carrier = self.rest.inputs.carriers[owners]
        self._local = shx.frames.rotate(carrier[:, 3:] * [-1.0, -1.0, -1.0, 1.0], self.rest.points[self._carried] - carrier[:, :3])

    def points(self, carriers: Numbers) -> Numbers:
        """Where the drawn points are now, world space, m, curve by curve. carriers: those of the present frame, for curves that are not simulated."""
        out = np.empty_like(self.rest.points)
        for places, count, rows in self._even:
            out[rows] = self.solver.sample_strands(count, self.strands[places], dtype=np.float64).reshape(-1, 3)
        for strand, start, along in self._rows:
            self.solver.sample_at(self.strands[strand], along, out=out[start : start + len(along)])
        if len(self._carried):
            carrier = carriers[self._owners]
            out[self._carried] = carrier[:, :3] + shx.frames.rotate(carrier[:, 3:], self._local)
        return out

    def local_points(self, inputs: FrameInputs) -> npt.NDArray[np.float32]:
        """The same in the space of the curves' positions, rounded as Blender stores them."""
        return transformed(inputs.to_local, self.points(inputs.carriers)).astype(np.float32)

    def restore(self, image: bytes) -> None:
        """Puts the solver into the state of a snapshot of this rig, also one that another process took."""
        self.solver.restore(image)
        # A snapshot brings the ids of the solver that wrote it.
        self.strands, self.bodies = self.solver.strand_ids(), list(self.solver.body_ids())

    def check(self, inputs: FrameInputs) -> None:
        """Raises ValueError if the inputs of a frame do not belong to this rig."""
        if inputs.carriers.shape != self.rest.inputs.carriers.shape:
            raise ValueError(f"carriers: shape {inputs.carriers.shape}; {self.rest.inputs.carriers.shape} expected: the number of curves has changed")
        self.rest.check_targets(inputs)
        if len(inputs.bodies) != len(self.bodies):
            raise ValueError(f"colliders: {len(inputs.bodies)}, where the first frame has {len(self.bodies)}")
        for body, now in zip(self.rest.colliders, inputs.bodies, strict=True):
            expected = (7,) if body.motion is Motion.RIGID else body.vertices.shape
            if now.shape != expected:
                raise ValueError(f"collider {body.name}: {len(now)} vertices, where the first frame has {len(body.vertices)}: a modifier changes them")

    def move(self, inputs: FrameInputs, over_seconds: float) -> None:
        """Sets where roots and colliders will be over_seconds from now."""
        self.check(inputs)
        self.solver.set_root_frames(shx.frames.moved(inputs.carriers[self.indices], self._roots), self.strands, over_seconds)
        for body, collider, now in zip(self.bodies, self.rest.colliders, inputs.bodies, strict=True):
            if collider.motion is Motion.RIGID:
                self.solver.set_body_frames(now[None], body, over_seconds)
            else:
                self.solver.set_body_vertices(body, now, over_seconds)
        self.solver.set_wind(inputs.wind)
        self._follow(inputs, over_seconds)

    def step(self, inputs: FrameInputs, cancel: shx.Cancel | None = None) -> shx.StepReport:
        """Advances by one frame, at whose end the surroundings are as inputs say."""
        self.move(inputs, self.frame_time)
        return self.solver.step(self.frame_time, self.substeps, cancel=cancel)

    def close(self) -> None:
        """Frees the solver."""
        self.solver.close()
