"""What every part of Solver uses: the handle, calls and their errors, and which strands, bodies and constraints are meant."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any, Concatenate, ParamSpec

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import address, whole
from superhelix._callbacks import Failures
from superhelix._handle import Owner
from superhelix._library import functions
from superhelix.errors import error_of
from superhelix.ids import BodyId, BodyIds, ConstraintId, ConstraintIds, StrandId, StrandIds

P = ParamSpec("P")

#: Which strands a function is for: None means all of them, in the order they were added.
StrandsLike = StrandIds | StrandId | None
#: Which bodies: None means all.
BodiesLike = BodyIds | BodyId | None
#: Which constraints: None means all.
ConstraintsLike = ConstraintIds | ConstraintId | None

Numbers = npt.NDArray[np.float64]


class SolverBase(Owner):
    """The handle of a solver."""

    __slots__ = ("_all", "_failures", "_wind")
    _failures: Failures
    _all: StrandIds | None
    #: The field of wind that the library calls.
    _wind: object

    def _call(self, function: Callable[Concatenate[Any, P], int], *args: P.args, **kwargs: P.kwargs) -> None:
        """Calls a function of the solver; raises its error, or an exception of a callback that ran in it."""
        result = function(self._handle, *args, **kwargs)
        if result or self._failures.any:
            self._raise(result)

    def _raise(self, result: int) -> None:
        error = error_of(result) if result else None
        failure = self._failures.take()
        if failure is not None:
            raise failure from error
        if error is not None:
            raise error

    def _count(self, function: Callable[[Any, Any], int]) -> int:
        """A number that a function writes to a size_t."""
        number = ctypes.c_size_t()
        self._call(function, ctypes.byref(number))
        return number.value

    def _strands(self, ids: StrandsLike) -> npt.NDArray[np.uint64]:
        """The bits of the strands that are meant."""
        return (self.strand_ids() if ids is None else StrandIds._of(ids)).bits

    def _bodies(self, ids: BodiesLike) -> npt.NDArray[np.uint64]:
        return (self.body_ids() if ids is None else BodyIds._of(ids)).bits

    def _constraints(self, ids: ConstraintsLike) -> npt.NDArray[np.uint64]:
        return (self.constraint_ids() if ids is None else ConstraintIds._of(ids)).bits

    def strand_count(self) -> int:
        """Returns the number of strands."""
        return self._count(functions.shx_solver_strand_count)

    def strand_ids(self) -> StrandIds:
        """Returns the ids of all strands, in the order they were added."""
        if self._all is None:
            bits = np.empty(self.strand_count(), dtype=np.uint64)
            self._call(functions.shx_solver_strand_ids, address(bits), len(bits))
            bits.flags.writeable = False
            self._all = StrandIds(bits)
        return self._all

    def body_count(self) -> int:
        """Returns the number of bodies."""
        return self._count(functions.shx_solver_body_count)

    def body_ids(self) -> BodyIds:
        """Returns the ids of all bodies, in the order they were added."""
        bits = np.empty(self.body_count(), dtype=np.uint64)
        self._call(functions.shx_solver_body_ids, address(bits), len(bits))
        return BodyIds(bits)

    def constraint_count(self) -> int:
        """Returns the number of constraints."""
        return self._count(functions.shx_solver_constraint_count)

    def constraint_ids(self) -> ConstraintIds:
        """Returns the ids of all constraints, in the order they were added."""
        bits = np.empty(self.constraint_count(), dtype=np.uint64)
        self._call(functions.shx_solver_constraint_ids, address(bits), len(bits))
        return ConstraintIds(bits)

    def _strand(self, id: StrandId) -> Any:
        if type(id) is not StrandId:
            raise TypeError(f"id: {type(id).__name__}; StrandId expected")
        return id._value()

    def _body(self, id: BodyId) -> Any:
        if type(id) is not BodyId:
            raise TypeError(f"id: {type(id).__name__}; BodyId expected")
        return id._value()

    def element_count(self, id: StrandId) -> int:
        """Returns the number of elements of a strand."""
        number = ctypes.c_size_t()
        self._call(functions.shx_solver_get_element_count, self._strand(id), ctypes.byref(number))
        return number.value

    def element_counts(self, ids: StrandsLike = None) -> npt.NDArray[np.uint32]:
        """Returns the number of elements of each strand."""
        bits = self._strands(ids)
        counts = np.empty(len(bits), dtype=np.uint32)
        number = ctypes.c_size_t()
        reference = ctypes.byref(number)
        for place, one in enumerate(bits.tolist()):
            self._call(functions.shx_solver_get_element_count, _capi.shx_strand_id(one), reference)
            counts[place] = number.value
        return counts


__all__ = ["BodiesLike", "ConstraintsLike", "Numbers", "SolverBase", "StrandsLike", "whole"]
