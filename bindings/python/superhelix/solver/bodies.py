"""Bodies in a solver: adding, moving, deforming them, and what strands do to them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix._buffers import Output, address, float_type, input_frames, input_rows, whole
from superhelix._library import functions
from superhelix.bodies import BodyDef
from superhelix.ids import BodyId, BodyIds
from superhelix.solver._base import BodiesLike, SolverBase
from superhelix.solver._packed import packed


class Bodies(SolverBase):
    """Bodies of a solver."""

    __slots__ = ()

    def add_bodies(self, defs: Sequence[BodyDef]) -> BodyIds:
        """Adds bodies, all or none, and gives their ids. Strands meet them once set_strand_contact has made them to."""
        data, size, count = packed("defs", defs, BodyDef, None)
        bits = np.empty(count, dtype=np.uint64)
        self._call(functions.shx_solver_add_bodies, address(data), size, count, address(bits))
        return BodyIds(bits)

    def add_body(self, definition: BodyDef) -> BodyId:
        """Adds a body."""
        return self.add_bodies([definition])[0]

    def remove_bodies(self, ids: BodiesLike) -> None:
        """Removes bodies, all or none. Their ids are stale from then on."""
        bits = self._bodies(ids)
        self._call(functions.shx_solver_remove_bodies, address(bits), len(bits))

    def has_body(self, id: BodyId) -> bool:
        """Whether an id names a body of this solver."""
        return bool(functions.shx_solver_has_body(self._handle, self._body(id)))

    def set_body_frames(self, frames: Any, ids: BodiesLike = None, over_seconds: float = 0.0) -> None:
        """Moves bodies smoothly to frames (float64 rows of origin, m, and quaternion x, y, z, w; one for each body) over the next over_seconds of
        simulated time (0: within the next substep); they push what lies between.
        """
        bits = self._bodies(ids)
        view = input_frames("frames", frames, len(bits))
        self._call(functions.shx_solver_set_body_frames, address(bits), len(bits), ctypes.byref(view), over_seconds)

    def teleport_bodies(self, frames: Any, ids: BodiesLike = None) -> None:
        """Puts bodies at frames at once, at rest: they push nothing that lies between."""
        bits = self._bodies(ids)
        view = input_frames("frames", frames, len(bits))
        self._call(functions.shx_solver_teleport_bodies, address(bits), len(bits), ctypes.byref(view))

    def body_frames(self, ids: BodiesLike = None, out: npt.NDArray[Any] | None = None) -> npt.NDArray[Any]:
        """The frames of bodies as they are now, rows of origin and quaternion. out: as in root_frames."""
        bits = self._bodies(ids)
        array = np.empty((len(bits), 7)) if out is None else out
        output = Output("out", array, (7, 4), len(bits))
        self._call(functions.shx_solver_get_body_frames, address(bits), len(bits), ctypes.byref(output.view))
        return array

    def set_body_vertices(self, id: BodyId, vertices: npt.ArrayLike, over_seconds: float = 0.0) -> None:
        """Sends the vertices of a mesh (m, the body's axes, as many as it was made with) to new places over the next over_seconds of simulated time.
        For skin that deforms: once a frame.
        """
        view = input_rows("vertices", vertices, (3,))
        self._call(functions.shx_solver_set_body_vertices, self._body(id), ctypes.byref(view), over_seconds)

    def set_body_surface(self, id: BodyId, thickness: float, friction_scale: float = 1.0, viscous_friction_scale: float = 1.0) -> None:
        """Changes how far outside its shape a body's surface lies (m), and the factors on the strands' coefficients of friction."""
        self._call(functions.shx_solver_set_body_surface, self._body(id), thickness, friction_scale, viscous_friction_scale)

    def set_body_filter(self, id: BodyId, groups: int, mask: int) -> None:
        """Changes which groups a body is in and which it meets (bits)."""
        self._call(functions.shx_solver_set_body_filter, self._body(id), whole("groups", groups), whole("mask", mask))

    def body_wrenches(self, ids: BodiesLike = None, dtype: npt.DTypeLike = np.float64) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
        """What strands did to bodies in the last substep: forces (N) and torques about the bodies' origins (N m), world axes."""
        bits = self._bodies(ids)
        forces, torques = (np.empty((len(bits), 3), dtype=float_type("dtype", dtype)) for _ in range(2))
        views = [Output("forces", forces, (3,), len(bits)).view, Output("torques", torques, (3,), len(bits)).view]
        self._call(functions.shx_solver_body_wrenches, address(bits), len(bits), ctypes.byref(views[0]), ctypes.byref(views[1]))
        return forces, torques
