"""Haptics: a tool of several bodies in a hand, and the wrench that the hand feels."""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import address, frame_rows
from superhelix._handle import Owner, made
from superhelix._library import functions
from superhelix._record import reference
from superhelix.errors import check
from superhelix.ids import BodyId, BodyIds, StrandIds
from superhelix.records import Frame, HapticDef, HapticState, RingCombDef, ToolDef
from superhelix.solver import Solver
from superhelix.solver.styling import one_frame
from superhelix.styling import RingCombReport


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

    def add_ring_comb(
        self, solver: Solver, tool: ToolDef, frame: npt.ArrayLike | Frame, definition: RingCombDef | None = None, ids: StrandIds | None = None
    ) -> int:
        """Gives the hand a ring comb with the teeth of a tool (any but plates), which is at a frame now, and returns its index. From the next step on
        it goes with the bodies, catches those strands (None: all there are now) that its teeth run into, and the hand feels what they pull with.
        Bodies where the teeth are push the strands off them: give these strands no contact, or let the tool have a body only where it is held.
        """
        at, bits, index = one_frame("frame", frame), solver._strands(ids), ctypes.c_size_t()
        teeth, options = reference("tool", tool, ToolDef), reference("definition", definition, RingCombDef)
        add = functions.shx_haptic_add_ring_comb
        check(add(self._handle, solver._handle, teeth, address(at), options, address(bits), len(bits), ctypes.byref(index)))
        return index.value

    def ring_comb_report(self, index: int) -> RingCombReport:
        """Returns what the last step did to a ring comb in the hand."""
        report = _capi.shx_ring_comb_report()
        check(functions.shx_haptic_ring_comb_report(self._handle, index, ctypes.byref(report)))
        return RingCombReport._of(report)

    def ring_comb_frame(self, index: int) -> npt.NDArray[np.float64]:
        """Returns where a ring comb in the hand is: origin, m, and quaternion x, y, z, w."""
        frame = np.empty(7)
        check(functions.shx_haptic_ring_comb_frame(self._handle, index, address(frame)))
        return frame

    def release_ring_combs(self, solver: Solver) -> None:
        """Lets go of all strands on the teeth of the hand's ring combs. Call it before close: what holds them belongs to the solver."""
        check(functions.shx_haptic_release_ring_combs(self._handle, solver._handle))
