"""The scene as drawn, and the inputs of a frame."""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
import numpy.typing as npt
import superhelix as shx

Numbers = npt.NDArray[np.float64]


class Motion(Enum):
    """How a collider moves."""

    RIGID = "RIGID"
    DEFORMING = "DEFORMING"


def is_closed(triangles: npt.NDArray[np.uint32]) -> bool:
    """Whether every edge of a mesh has two triangles, one on each side."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).astype(np.int64)
    size = int(edges.max(initial=0)) + 1
    there, back = edges[:, 0] * size + edges[:, 1], edges[:, 1] * size + edges[:, 0]
    return len(np.unique(there)) == len(there) and bool(np.array_equal(np.sort(there), np.sort(back)))


_GRIDS: OrderedDict[str, bytes] = OrderedDict()
_MOST_GRIDS = 8


def _grid(vertices: Numbers, triangles: npt.NDArray[np.uint32], cell: float) -> bytes:
    """A distance grid; the latest few are kept, since a simulation starts again and again with the same head."""
    key = hashlib.sha256(vertices.tobytes() + triangles.tobytes() + str(cell).encode()).hexdigest()
    if key not in _GRIDS:
        _GRIDS[key] = shx.bake_distance_grid(vertices, triangles, cell, max(0.03, 4 * cell))
        while len(_GRIDS) > _MOST_GRIDS:
            _GRIDS.popitem(last=False)
    _GRIDS.move_to_end(key)
    return _GRIDS[key]


@dataclass
class Collider:
    """A mesh that hair stays out of. Rigid: vertices in the body's axes, and frames move it. Deforming: vertices in world space, every frame."""

    name: str
    motion: Motion
    vertices: Numbers
    triangles: npt.NDArray[np.uint32]
    #: Sides of a deforming mesh; None: solid where it is closed, else in front.
    sides: shx.Sides | None = None
    #: Of a rigid mesh: size of the distance grid's cells, m; 0: 5 mm, or a 128th of a large mesh.
    cell: float = 0.0
    thickness: float = 0.0
    #: How far behind its faces a deforming mesh that acts in front of them pushes hair out, m.
    depth: float = 0.02
    friction: float = 1.0

    def definition(self, pose: Numbers) -> shx.BodyDef:
        """The body. pose: the frame of the first moment (of a deforming mesh: none)."""
        surface = {"thickness": self.thickness, "friction_scale": self.friction}
        if len(self.triangles) == 0:
            raise ValueError(f"collider {self.name}: a mesh without faces")
        if self.motion is Motion.RIGID:
            extent = float(np.ptp(self.vertices, axis=0).max())
            grid = _grid(self.vertices, self.triangles, self.cell or max(0.005, extent / 128))
            frame = shx.Frame(origin=pose[:3].tolist(), rotation=pose[3:].tolist())
            return shx.BodyDef.grid(grid, pose=frame, **surface)
        sides = self.sides if self.sides is not None else shx.Sides.SOLID if is_closed(self.triangles) else shx.Sides.FRONT
        depth = self.depth if sides is shx.Sides.FRONT else None
        return shx.BodyDef.mesh(self.vertices, self.triangles, sides=sides, depth=depth, **surface)


@dataclass
class FrameInputs:
    """What moves hair: its surroundings at the end of a frame."""

    #: What carries the root of each curve: frames, (curves, 7).
    carriers: Numbers
    #: For each collider its frame (7), or its vertices (n, 3).
    bodies: list[Numbers] = field(default_factory=list)
    #: From world space to that of the curves' positions, a 4x4 matrix that acts on columns.
    to_local: Numbers = field(default_factory=lambda: np.eye(4))
    #: Wind, m/s.
    wind: tuple[float, float, float] = (0.0, 0.0, 0.0)
    #: Points of rigged curves that the curves follow, world space, m, curve by curve; None: they follow none.
    targets: Numbers | None = None


@dataclass
class Rest:
    """Curves as drawn, in world space at the first frame, with their surroundings then."""

    points: Numbers
    point_counts: npt.NDArray[np.uint32]
    colliders: list[Collider]
    inputs: FrameInputs
    #: The number of points of each rigged curve; None where there are none.
    target_counts: npt.NDArray[np.uint32] | None = None

    def __post_init__(self) -> None:
        self.points = np.ascontiguousarray(self.points, dtype=np.float64)
        self.point_counts = np.ascontiguousarray(self.point_counts, dtype=np.uint32)
        if len(self.point_counts) == 0:
            raise ValueError("curves: none; draw some first")
        if self.points.shape != (int(self.point_counts.sum()), 3):
            raise ValueError(f"points: shape {self.points.shape}; ({int(self.point_counts.sum())}, 3) expected")
        if self.inputs.carriers.shape != (len(self.point_counts), 7):
            raise ValueError(f"carriers: shape {self.inputs.carriers.shape}; ({len(self.point_counts)}, 7) expected")
        if not np.all(np.isfinite(self.points)):
            raise ValueError("points: some are not finite")
        if (self.target_counts is None) != (self.inputs.targets is None):
            raise ValueError("targets: points and their numbers, or neither, expected")
        if self.target_counts is not None:
            self.target_counts = np.ascontiguousarray(self.target_counts, dtype=np.uint32)
            if len(self.target_counts) != len(self.point_counts):
                raise ValueError(f"rigged curves: {len(self.target_counts)}; {len(self.point_counts)} expected, one for each simulated curve")
            if np.any(self.target_counts < 2):
                raise ValueError("rigged curves: one has a single point")
            self.check_targets(self.inputs)

    def check_targets(self, inputs: FrameInputs) -> None:
        """Raises ValueError if the rigged curves of a frame are others than at the first."""
        count = 0 if self.target_counts is None else int(self.target_counts.sum())
        found = 0 if inputs.targets is None else len(inputs.targets)
        if found != count:
            raise ValueError(f"rigged curves: {found} points, where the first frame has {count}")

    def digest(self) -> str:
        """A hash of everything that is here."""
        total = hashlib.sha256()
        for array in (self.points, self.point_counts, self.inputs.carriers, self.inputs.to_local, *self.inputs.bodies):
            total.update(np.ascontiguousarray(array).tobytes())
        if self.target_counts is not None and self.inputs.targets is not None:
            total.update(self.target_counts.tobytes() + np.ascontiguousarray(self.inputs.targets).tobytes())
        for body in self.colliders:
            total.update(np.ascontiguousarray(body.vertices).tobytes() + np.ascontiguousarray(body.triangles).tobytes())
            total.update(f"{body.name}|{body.motion}|{body.sides}|{body.cell}|{body.thickness}|{body.depth}|{body.friction}".encode())
        return total.hexdigest()

    def median_length(self) -> float:
        """The median length of the curves, m."""
        edges = np.linalg.norm(np.diff(self.points, axis=0), axis=1)
        ends = np.cumsum(self.point_counts).astype(np.int64)
        edges[ends[:-1] - 1] = 0.0
        along = np.concatenate([[0.0], np.cumsum(edges)])
        return float(np.median(along[ends - 1] - along[ends - self.point_counts]))
