"""Bodies of a solver: adding, moving and deforming them, and the forces on them."""

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
        """Adds bodies, all or none, and returns their ids. Only strands with contact collide with bodies: see set_strand_contact."""
        data, size, count = packed("defs", defs, BodyDef, None)
        bits = np.empty(count, dtype=np.uint64)
        self._call(functions.shx_solver_add_bodies, address(data), size, count, address(bits))
        return BodyIds(bits)

    def add_body(self, definition: BodyDef) -> BodyId:
        """Adds a body and returns its id."""
        return self.add_bodies([definition])[0]

    def remove_bodies(self, ids: BodiesLike) -> None:
        """Removes bodies, all or none. Their ids become invalid."""
        bits = self._bodies(ids)
        self._call(functions.shx_solver_remove_bodies, address(bits), len(bits))

    def has_body(self, id: BodyId) -> bool:
        """Returns whether an id names a body of this solver."""
        return bool(functions.shx_solver_has_body(self._handle, self._body(id)))

    def body_user_data(self, id: BodyId) -> int:
        """Returns the user_data of a body."""
        number = ctypes.c_uint64()
        self._call(functions.shx_solver_get_body_user_data, self._body(id), ctypes.byref(number))
        return number.value

    def set_body_frames(self, frames: Any, ids: BodiesLike = None, over_seconds: float = 0.0) -> None:
        """Moves bodies smoothly to frames (float64 rows of origin, m, and quaternion x, y, z, w; one for each body) over the next over_seconds of
        simulated time (0: within the next substep). They push the strands in between.
        """
        bits = self._bodies(ids)
        view = input_frames("frames", frames, len(bits))
        self._call(functions.shx_solver_set_body_frames, address(bits), len(bits), ctypes.byref(view), over_seconds)

    def teleport_bodies(self, frames: Any, ids: BodiesLike = None) -> None:
        """Moves bodies to frames at once, at rest. They do not push strands in between."""
        bits = self._bodies(ids)
        view = input_frames("frames", frames, len(bits))
        self._call(functions.shx_solver_teleport_bodies, address(bits), len(bits), ctypes.byref(view))

    def body_frames(self, ids: BodiesLike = None, out: npt.NDArray[Any] | None = None) -> npt.NDArray[Any]:
        """Returns the current frames of bodies, rows of origin and quaternion. out: as in root_frames."""
        bits = self._bodies(ids)
        array = np.empty((len(bits), 7)) if out is None else out
        output = Output("out", array, (7, 4), len(bits))
        self._call(functions.shx_solver_get_body_frames, address(bits), len(bits), ctypes.byref(output.view))
        return array

    def set_body_vertices(self, id: BodyId, vertices: npt.ArrayLike, over_seconds: float = 0.0) -> None:
        """Moves the vertices of a mesh (m, body axes, as many as it was created with) to new positions over the next over_seconds of simulated time.
        Call it once per frame for deforming skin.
        """
        view = input_rows("vertices", vertices, (3,))
        self._call(functions.shx_solver_set_body_vertices, self._body(id), ctypes.byref(view), over_seconds)

    def set_body_surface(self, id: BodyId, thickness: float, friction_scale: float = 1.0, viscous_friction_scale: float = 1.0) -> None:
        """Sets the thickness of a body (m) and its factors on the strands' friction coefficients."""
        self._call(functions.shx_solver_set_body_surface, self._body(id), thickness, friction_scale, viscous_friction_scale)

    def set_body_filter(self, id: BodyId, groups: int, mask: int) -> None:
        """Sets the collision groups of a body and the groups that it collides with (bits)."""
        self._call(functions.shx_solver_set_body_filter, self._body(id), whole("groups", groups), whole("mask", mask))

    def body_wrenches(self, ids: BodiesLike = None, dtype: npt.DTypeLike = np.float64) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
        """Returns the forces (N) and torques about the bodies' origins (N m) that strands exerted on bodies in the last substep, world axes."""
        bits = self._bodies(ids)
        forces, torques = (np.empty((len(bits), 3), dtype=float_type("dtype", dtype)) for _ in range(2))
        views = [Output("forces", forces, (3,), len(bits)).view, Output("torques", torques, (3,), len(bits)).view]
        self._call(functions.shx_solver_body_wrenches, address(bits), len(bits), ctypes.byref(views[0]), ctypes.byref(views[1]))
        return forces, torques
