"""Styling tools and hair handle: where the bodies of tools are, combs whose teeth hold strands, what a hand feels of hair."""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import address
from superhelix._handle import Owner, made
from superhelix._library import functions
from superhelix._record import reference
from superhelix.errors import check
from superhelix.ids import StrandIds
from superhelix.records import CombingTest, Frame, HairHandle, HairType, RingCombDef, ToolDef
from superhelix.solver import Solver
from superhelix.solver.styling import one_frame, tool_body_count


def tool_frames(definition: ToolDef, frame: npt.ArrayLike | Frame, opening: float = 0.0) -> npt.NDArray[np.float64]:
    """Returns where the bodies of a tool are when it is at a frame, rows of origin and quaternion: pass them to Solver.set_body_frames. opening:
    distance between the faces of plates, m.
    """
    rows, count = np.empty((tool_body_count(definition), 7)), ctypes.c_size_t()
    at = one_frame("frame", frame)
    options = reference("definition", definition, ToolDef)
    check(functions.shx_tool_frames(options, address(at), opening, address(rows), len(rows), ctypes.byref(count)))
    return rows


def tool_hot_box(definition: ToolDef, opening: float = 0.0) -> npt.NDArray[np.float64]:
    """Returns half the edges, m, of the box in which plates or a barrel heat hair (HeatDef.half_edges)."""
    half_edges = np.empty(3)
    check(functions.shx_tool_hot_box(reference("definition", definition, ToolDef), opening, address(half_edges)))
    return half_edges


def hair_handle(name: str) -> HairHandle:
    """Returns what a hand feels of a measured type of hair, by the names of hair_type."""
    found = HairHandle()
    check(functions.shx_hair_handle_from_name(name.encode(), ctypes.byref(found._c)))
    return found


def adjust_hair_handle(handle: HairHandle, *, curliness: float = 0.0, combing_ease: float = 0.0) -> HairHandle:
    """Returns a handle with two sliders moved, each from -1 to 1."""
    moved = HairHandle()
    check(functions.shx_hair_handle_adjust(reference("handle", handle, HairHandle), curliness, combing_ease, ctypes.byref(moved._c)))
    return moved


def hair_handle_type(handle: HairHandle) -> HairType:
    """Returns the type of hair that has this handle, for hair_strands."""
    found = HairType()
    check(functions.shx_hair_handle_to_type(reference("handle", handle, HairHandle), ctypes.byref(found._c)))
    return found


class CombingCurve(NamedTuple):
    """A combing experiment: position, m, force against the stroke and pressure across it, N, step by step; steady means of both, their ratio, and the
    work of the stroke, J.
    """

    stroke: npt.NDArray[np.float64]
    force: npt.NDArray[np.float64]
    pressure: npt.NDArray[np.float64]
    mean_force: float
    mean_pressure: float
    friction: float
    work: float


def run_combing_test(handle: HairHandle, test: CombingTest | None = None) -> CombingCurve:
    """Combs hair with this handle: three rods close on hanging hairs and are drawn down over them. test: None for the defaults."""
    options = CombingTest() if test is None else test
    given = reference("test", options, CombingTest)
    steps = options.stroke / options.speed * options.rate if options.speed else 0.0
    room = int(steps) + 4 if 0.0 < steps < 1e8 else 4
    lists, result = np.empty((3, room)), _capi.shx_combing_result()
    stroke, force, pressure = (address(row) for row in lists)
    check(functions.shx_combing_test_run(given, reference("handle", handle, HairHandle), stroke, force, pressure, room, ctypes.byref(result)))
    curves = lists[:, : result.step_count].copy()
    return CombingCurve(curves[0], curves[1], curves[2], result.mean_force, result.mean_pressure, result.friction, result.work)


class RingCombReport(NamedTuple):
    """The report of a step: strands on teeth, caught, combed to the tip and let go in this step; force, N, and torque, N m, on the comb."""

    held: int
    caught: int
    combed: int
    let_go: int
    force: npt.NDArray[np.float64]
    torque: npt.NDArray[np.float64]

    @classmethod
    def _of(cls, report: _capi.shx_ring_comb_report) -> RingCombReport:
        return cls(report.held, report.caught, report.combed, report.let_go, np.array(report.force), np.array(report.torque))


class RingComb(Owner):
    """A comb whose teeth hold the strands that they run into, each in a ring with friction, until it has been combed to the tip or is let go."""

    __slots__ = ()

    def __init__(self, tool: ToolDef, frame: npt.ArrayLike | Frame, definition: RingCombDef | None = None) -> None:
        """With the teeth of a tool (any but plates), at a frame. definition: None for all defaults."""
        at = one_frame("frame", frame)
        teeth, options = reference("tool", tool, ToolDef), reference("definition", definition, RingCombDef)
        self._open = made(
            functions.shx_ring_comb_destroy,
            lambda out: functions.shx_ring_comb_create(teeth, address(at), options, out),
        )

    def before_step(self, solver: Solver, frame: npt.ArrayLike | Frame, dt: float, ids: StrandIds | None = None) -> None:
        """Call it before a step of dt seconds: the comb moves to a frame meanwhile and catches those strands (None: all) that its teeth run into."""
        bits, at = solver._strands(ids), one_frame("frame", frame)
        check(functions.shx_ring_comb_before_step(self._handle, solver._handle, address(bits), len(bits), address(at), dt))

    def after_step(self, solver: Solver) -> RingCombReport:
        """Call it after the step: lets go of strands that are combed to the tip or pulled too hard."""
        report = _capi.shx_ring_comb_report()
        check(functions.shx_ring_comb_after_step(self._handle, solver._handle, ctypes.byref(report)))
        return RingCombReport._of(report)

    def release(self, solver: Solver) -> None:
        """Lets go of all strands."""
        check(functions.shx_ring_comb_release(self._handle, solver._handle))
