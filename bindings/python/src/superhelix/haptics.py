"""Haptics: a tool of several bodies in a hand, and the wrench that the hand feels."""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix._buffers import address, frame_rows
from superhelix._handle import Owner, made
from superhelix._library import functions
from superhelix._record import reference
from superhelix.errors import check
from superhelix.ids import BodyId, BodyIds
from superhelix.records import Frame, HapticDef, HapticState
from superhelix.solver import Solver


class HapticUpdate(NamedTuple):
    """What an update returns: force on the hand, N, torque about the handle's origin, N m, and the state."""

    force: npt.NDArray[np.float64]
    torque: npt.NDArray[np.float64]
    state: HapticState


class Haptic(Owner):
    """Bodies of a solver that move as one rigid tool in a hand. Its two sides may be used at the same time: before_step and after_step by the thread
    that steps the solver, update by that of the device.
    """

    __slots__ = ()

    def __init__(self, solver: Solver, bodies: BodyIds | BodyId, definition: HapticDef | None = None) -> None:
        """The bodies move from their present places. definition: None for all defaults."""
        bits = BodyIds._of(bodies).bits
        options = reference("definition", definition, HapticDef)
        self._open = made(
            functions.shx_haptic_destroy,
            lambda out: functions.shx_haptic_create(solver._handle, options, address(bits), len(bits), out),
        )

    def before_step(self, solver: Solver, dt: float) -> None:
        """Call it before a step, or several substeps, of dt seconds in all: moves the bodies over dt to where the device is now. They are placed at
        the device's first pose at once.
        """
        check(functions.shx_haptic_before_step(self._handle, solver._handle, dt))

    def after_step(self, solver: Solver) -> None:
        """Call it after the step: hands what touches the tool, and how it yields, over to the device's side."""
        check(functions.shx_haptic_after_step(self._handle, solver._handle))

    def update(self, pose: npt.ArrayLike | Frame, velocity: npt.ArrayLike = (0.0,) * 6, *, dt: float) -> HapticUpdate:
        """Gives the device's pose (origin, m, and quaternion x, y, z, w) and velocity (linear, m/s, then angular, rad/s, world axes), dt seconds after
        the last update, and returns what the hand is to feel. The library itself takes microseconds and never waits; Python may, for its own lock: drive
        a device from C.
        """
        frame = frame_rows("pose", pose if isinstance(pose, Frame) else np.asarray(pose, dtype=np.float64).reshape(1, -1))
        twist = np.ascontiguousarray(velocity, dtype=np.float64)
        if twist.shape != (6,):
            raise ValueError(f"velocity: shape {twist.shape}; (6,) expected")
        wrench, state = np.empty(6), HapticState()
        check(functions.shx_haptic_update(self._handle, address(frame), address(twist), dt, address(wrench), ctypes.byref(state._c)))
        return HapticUpdate(wrench[:3], wrench[3:], state)
