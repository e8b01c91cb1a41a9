"""Styling: tools as bodies, clips, scissors, heat, styles that are fixed."""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import address, column, frame_rows
from superhelix._library import functions
from superhelix._record import reference
from superhelix.errors import BufferTooSmallError, check
from superhelix.ids import BodyIds, ConstraintIds, StrandIds
from superhelix.records import ClipDef, Frame, HeatDef, ToolDef
from superhelix.solver._base import ConstraintsLike, Numbers, SolverBase, StrandsLike


class Cuts(NamedTuple):
    """What scissors cut: the strands, their lengths now, what was cut off, m, where, and how many constraints went with it."""

    strands: StrandIds
    lengths: Numbers
    removed: Numbers
    positions: Numbers
    removed_constraints: npt.NDArray[np.uint64]


def one_frame(name: str, value: npt.ArrayLike | Frame) -> npt.NDArray[np.float64]:
    """A frame as a row."""
    rows = frame_rows(name, value if isinstance(value, Frame) else np.asarray(value, dtype=np.float64).reshape(1, -1))
    if len(rows) != 1:
        raise ValueError(f"{name}: {len(rows)} frames; 1 expected")
    return rows


def tool_body_count(definition: ToolDef) -> int:
    """How many bodies a tool is made of."""
    count, frame = ctypes.c_size_t(), one_frame("frame", (0, 0, 0, 0, 0, 0, 1))
    check(functions.shx_tool_frames(reference("definition", definition, ToolDef), address(frame), 0.0, None, 0, ctypes.byref(count)))
    return count.value


class Styling(SolverBase):
    """Styling of a solver's strands."""

    __slots__ = ()

    def add_tool(self, definition: ToolDef, frame: npt.ArrayLike | Frame, opening: float = 0.0) -> BodyIds:
        """Adds the bodies of a tool at a frame. opening: distance between the faces of plates, m. superhelix.tool_frames moves it."""
        rows = one_frame("frame", frame)
        bits, count = np.empty(tool_body_count(definition), dtype=np.uint64), ctypes.c_size_t()
        options = reference("definition", definition, ToolDef)
        self._call(functions.shx_solver_add_tool, options, address(rows), opening, address(bits), len(bits), ctypes.byref(count))
        return BodyIds(bits)

    def clip_strands(self, definition: ClipDef, ids: StrandsLike = None) -> ConstraintIds:
        """Closes a clip: each stretch of a strand in its box is held where it is. Returns the constraints: move_constraints moves the clip,
        remove_constraints opens it.
        """
        strands = self._strands(ids)
        options = reference("definition", definition, ClipDef)
        count, room = ctypes.c_size_t(), len(strands)
        while True:
            bits = np.empty(room, dtype=np.uint64)
            try:
                self._call(functions.shx_solver_clip_strands, options, address(strands), len(strands), address(bits), room, ctypes.byref(count))
            except BufferTooSmallError:
                # A strand may lie in the box more than once.
                room = 2 * room + 1
                continue
            return ConstraintIds(bits[: count.value].copy())

    def move_constraints(
        self,
        start: npt.ArrayLike | Frame,
        end: npt.ArrayLike | Frame,
        ids: ConstraintsLike = None,
        over_seconds: float = 0.0,
    ) -> None:
        """Moves the targets of constraints over the next over_seconds as something rigid that goes from frame start to frame end."""
        bits = self._constraints(ids)
        rows = one_frame("start", start), one_frame("end", end)
        self._call(functions.shx_solver_move_constraints, address(bits), len(bits), address(rows[0]), address(rows[1]), over_seconds)

    def scissor_strands(self, corners: npt.ArrayLike, ids: StrandsLike = None, min_length: float = 1e-3) -> Cuts:
        """Cuts the strands that cross a blade, a quad of four corners in order (4, 3), m, each where that is closest to its root, but no shorter
        than min_length, m. Nothing else moves.
        """
        strands = self._strands(ids)
        blade = column("corners", corners, np.float64, 4, width=3)
        # A shx_cut is seven words: the strand, five numbers, a count.
        made, count = np.empty((len(strands), ctypes.sizeof(_capi.shx_cut) // 8), dtype=np.uint64), ctypes.c_size_t()
        self._call(
            functions.shx_solver_scissor_strands,
            address(strands),
            len(strands),
            address(blade),
            min_length,
            address(made),
            ctypes.byref(count),
        )
        cuts = made[: count.value]
        numbers = cuts.view(np.float64)
        return Cuts(StrandIds(cuts[:, 0].copy()), numbers[:, 1], numbers[:, 2], numbers[:, 3:6], cuts[:, 6])

    def heat_strands(self, definition: HeatDef, seconds: float, ids: StrandsLike = None) -> Numbers:
        """Heats strands: inside the hot box natural shapes approach straight, or the current shape. Returns the length of each that was hot, m."""
        strands = self._strands(ids)
        heated = np.empty(len(strands))
        options = reference("definition", definition, HeatDef)
        self._call(functions.shx_solver_heat_strands, options, address(strands), len(strands), seconds, address(heated))
        return heated

    def freeze_strands(self, ids: StrandsLike = None) -> None:
        """Fixes the style of strands: they keep their shape, move with their roots, cost next to nothing, and wake when a body comes."""
        strands = self._strands(ids)
        self._call(functions.shx_solver_freeze_strands, address(strands), len(strands))

    def wake_strands(self, ids: StrandsLike = None) -> None:
        """Wakes strands: they move again from the next step on."""
        strands = self._strands(ids)
        self._call(functions.shx_solver_wake_strands, address(strands), len(strands))

    def frozen_strands(self, ids: StrandsLike = None) -> npt.NDArray[np.bool_]:
        """Returns which strands are frozen."""
        strands = self._strands(ids)
        frozen = np.empty(len(strands), dtype=np.uint8)
        self._call(functions.shx_solver_frozen_strands, address(strands), len(strands), address(frozen))
        return frozen.astype(np.bool_)
