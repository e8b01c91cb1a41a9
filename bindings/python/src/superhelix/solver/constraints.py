"""Constraints: points, directions, frames, rings and ties."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix._buffers import Output, address, input_frames
from superhelix._library import functions
from superhelix.ids import ConstraintId, ConstraintIds
from superhelix.records import ConstraintDef, ConstraintStateTable
from superhelix.solver._base import ConstraintsLike, SolverBase
from superhelix.solver._packed import packed


class Constraints(SolverBase):
    """Constraints of a solver."""

    __slots__ = ()

    def add_constraints(self, defs: Sequence[ConstraintDef]) -> ConstraintIds:
        """Adds constraints, all or none, and returns their ids. They hold from the end of the next substep on."""
        data, size, count = packed("defs", defs, ConstraintDef, None)
        bits = np.empty(count, dtype=np.uint64)
        self._call(functions.shx_solver_add_constraints, address(data), size, count, address(bits))
        return ConstraintIds(bits)

    def add_constraint(self, definition: ConstraintDef) -> ConstraintId:
        """Adds a constraint."""
        return self.add_constraints([definition])[0]

    def remove_constraints(self, ids: ConstraintsLike) -> None:
        """Removes constraints, all or none. Their ids become invalid."""
        bits = self._constraints(ids)
        self._call(functions.shx_solver_remove_constraints, address(bits), len(bits))

    def has_constraint(self, id: ConstraintId) -> bool:
        """Returns whether an id names a constraint of this solver."""
        if type(id) is not ConstraintId:
            raise TypeError(f"id: {type(id).__name__}; ConstraintId expected")
        return bool(functions.shx_solver_has_constraint(self._handle, id._value()))

    def constraint_user_data(self, id: ConstraintId) -> int:
        """Returns the user_data of a constraint."""
        if type(id) is not ConstraintId:
            raise TypeError(f"id: {type(id).__name__}; ConstraintId expected")
        number = ctypes.c_uint64()
        self._call(functions.shx_solver_get_constraint_user_data, id._value(), ctypes.byref(number))
        return number.value

    def set_constraint_targets(self, frames: Any, ids: ConstraintsLike = None, over_seconds: float = 0.0) -> None:
        """Moves the targets of constraints smoothly to frames (float64 rows of origin, m, and quaternion x, y, z, w; one for each) over the next
        over_seconds of simulated time (0: within the next substep).
        """
        bits = self._constraints(ids)
        view = input_frames("frames", frames, len(bits))
        self._call(functions.shx_solver_set_constraint_targets, address(bits), len(bits), ctypes.byref(view), over_seconds)

    def constraint_targets(self, ids: ConstraintsLike = None, out: npt.NDArray[Any] | None = None) -> npt.NDArray[Any]:
        """Returns the current targets of constraints, rows of origin and quaternion. out: as in root_frames."""
        bits = self._constraints(ids)
        array = np.empty((len(bits), 7)) if out is None else out
        output = Output("out", array, (7, 4), len(bits))
        self._call(functions.shx_solver_get_constraint_targets, address(bits), len(bits), ctypes.byref(output.view))
        return array

    def constraint_states(self, ids: ConstraintsLike = None) -> ConstraintStateTable:
        """Returns the state of constraints after the last substep: status, error, force and torque."""
        bits = self._constraints(ids)
        table = ConstraintStateTable._zeros(len(bits))
        self._call(functions.shx_solver_constraint_states, address(bits), len(bits), address(table.data), table.data.dtype.itemsize)
        return table
