"""Time: steps, their limits, gravity and wind."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import address, vector, whole
from superhelix._library import functions
from superhelix._record import initialize, reference
from superhelix.enums import RestoreOptions, SnapshotShapes
from superhelix.records import SolverOptions, StepReport
from superhelix.solver._base import SolverBase


class Cancel:
    """A flag by which another thread cancels a step: solver.step(..., cancel=flag) there, flag.set() here."""

    __slots__ = ("_flag",)

    def __init__(self) -> None:
        self._flag = ctypes.c_uint32()

    def set(self) -> None:
        """Cancels the steps that were given this flag, until clear is called."""
        self._flag.value = 1

    def clear(self) -> None:
        """Lets steps run again."""
        self._flag.value = 0

    def is_set(self) -> bool:
        """Whether set was called."""
        return self._flag.value != 0


class Stepping(SolverBase):
    """Time of a solver."""

    __slots__ = ()

    def step(
        self,
        dt: float,
        substeps: int = 1,
        *,
        max_work: int | None = None,
        max_seconds: float | None = None,
        cancel: Cancel | None = None,
        report: StepReport | None = None,
    ) -> StepReport:
        """Advances the solver by dt seconds in equal substeps, each a full solve, and returns a report. Other Python threads run meanwhile.

        With limits the step may stop early; all strands stay finite, and report.stop_reason says why. max_work: maximum work per substep on strands
        in contact or with constraints, in units of about a microsecond of one core; counted, so results are the same on every machine.
        max_seconds: wall-clock time; results then depend on the clock. cancel: a flag that another thread sets. Pass report to reuse one.
        """
        if report is None:
            report = StepReport()
        elif type(report) is not StepReport:
            raise TypeError(f"report: {report!r}; StepReport expected")
        substeps = whole("substeps", substeps)
        if max_work is None and max_seconds is None and cancel is None:
            self._call(functions.shx_solver_step, dt, substeps, ctypes.byref(report._c))
            return report
        limits = _capi.shx_step_limits()
        initialize(limits)
        if max_work is not None:
            limits.max_work = whole("max_work", max_work, 0, 2**64 - 1)
        if max_seconds is not None:
            limits.max_seconds = max_seconds
        if cancel is not None:
            limits.cancel = ctypes.addressof(cancel._flag)
        self._call(functions.shx_solver_step_with_limits, dt, substeps, ctypes.byref(limits), ctypes.byref(report._c))
        return report

    def set_gravity(self, gravity: npt.ArrayLike) -> None:
        """Sets gravity, m/s^2, from the next step on."""
        numbers = vector("gravity", gravity)
        self._call(functions.shx_solver_set_gravity, address(numbers))

    def set_wind(self, wind: npt.ArrayLike) -> None:
        """Sets the uniform wind, m/s, from the next step on. Only strands with an air_drag feel it."""
        numbers = vector("wind", wind)
        self._call(functions.shx_solver_set_wind, address(numbers))

    @property
    def own_user_data(self) -> int:
        """A number of yours, which the library does not use."""
        number = ctypes.c_uint64()
        self._call(functions.shx_solver_get_own_user_data, ctypes.byref(number))
        return number.value

    @own_user_data.setter
    def own_user_data(self, number: int) -> None:
        self._call(functions.shx_solver_set_own_user_data, whole("own_user_data", number, 0, 2**64 - 1))

    def memory_usage(self) -> int:
        """Returns the memory of the solver, bytes, including all strands, bodies and constraints."""
        number = ctypes.c_uint64()
        self._call(functions.shx_solver_memory_usage, ctypes.byref(number))
        return number.value

    def options(self) -> SolverOptions:
        """Returns the options of the solver. Change a copy and pass it to set_options: solver.set_options(solver.options().copy(tolerance=1e-4))."""
        options = SolverOptions()
        self._call(functions.shx_solver_get_options, ctypes.byref(options._c))
        return options

    def set_options(self, options: SolverOptions) -> None:
        """Changes the options of the solver from the next step on. The number of threads is fixed: another worker_count raises UnsupportedError."""
        self._call(functions.shx_solver_set_options, reference("options", options, SolverOptions))

    def snapshot(self, *, include_shapes: bool = True) -> bytes:
        """Returns an image of everything that a step depends on: strands, roots, states, bodies, constraints, gravity, wind, options.

        With include_shapes=False it refers to meshes, hulls and grids that never deformed. restore finds them in the bodies of the solver that is
        restored, or in what snapshot_shapes returned.
        """
        if include_shapes:
            return self._image(functions.shx_solver_snapshot)
        definition = _capi.shx_snapshot_def()
        initialize(definition)
        definition.shapes = SnapshotShapes.REFERENCED
        chosen = ctypes.byref(definition)
        return self._image(lambda handle, *place: functions.shx_solver_snapshot_with(handle, chosen, *place))

    def snapshot_shapes(self) -> bytes:
        """Returns the shapes that snapshots without shapes refer to. One image serves all snapshots until a body is added."""
        return self._image(functions.shx_solver_snapshot_shapes)

    def _image(self, write: Callable[[Any, Any, int, Any], int]) -> bytes:
        """The output of a function that first reports its size."""
        size = ctypes.c_size_t()
        self._call(write, None, 0, ctypes.byref(size))
        image = ctypes.create_string_buffer(max(size.value, 1))
        self._call(write, image, size.value, ctypes.byref(size))
        return image.raw[: size.value]

    def restore(
        self,
        image: bytes | bytearray | memoryview,
        *,
        keep_options: bool = False,
        shapes: bytes | bytearray | memoryview | None = None,
    ) -> None:
        """Restores a snapshot, with the ids that were valid when it was taken. Further steps give the same bits.

        The options become those of the snapshot; with keep_options=True the solver keeps its own. shapes: what snapshot_shapes returned, for a
        snapshot without shapes that the solver's bodies do not have.
        """
        data: Any = bytes(image)
        if not keep_options and shapes is None:
            self._call(functions.shx_solver_restore, data, len(data))
        else:
            definition = _capi.shx_restore_def()
            initialize(definition)
            definition.options = RestoreOptions.KEEP if keep_options else RestoreOptions.SNAPSHOT
            kept = b"" if shapes is None else bytes(shapes)
            definition.shapes = ctypes.cast(ctypes.c_char_p(kept), ctypes.c_void_p)
            definition.shapes_size = len(kept)
            self._call(functions.shx_solver_restore_with, data, len(data), ctypes.byref(definition))
        self._all = None

    def state_hash(self) -> int:
        """Returns a hash of everything that a step depends on: equal states give equal hashes."""
        number = ctypes.c_uint64()
        self._call(functions.shx_solver_state_hash, ctypes.byref(number))
        return number.value
