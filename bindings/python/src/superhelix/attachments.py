"""Rigid attachments: roots, bodies and targets of constraints that follow one pose."""

from __future__ import annotations

import numpy.typing as npt

from superhelix._buffers import address
from superhelix._handle import Owner, made
from superhelix._library import functions
from superhelix.errors import check
from superhelix.records import Frame
from superhelix.solver import Solver
from superhelix.solver._base import BodiesLike, ConstraintsLike, StrandsLike
from superhelix.solver.styling import one_frame


class Attachment(Owner):
    """What follows one pose, for example all that belongs to a head: one call moves it."""

    __slots__ = ()

    def __init__(
        self,
        solver: Solver,
        pose: npt.ArrayLike | Frame,
        strands: StrandsLike = None,
        bodies: BodiesLike = None,
        constraints: ConstraintsLike = None,
    ) -> None:
        """Attaches strands by their roots, bodies, and targets of constraints (None: all; empty ids: none) to something that is at pose now."""
        s, b, c = solver._strands(strands), solver._bodies(bodies), solver._constraints(constraints)
        at = one_frame("pose", pose)

        def create(out: object) -> int:
            return functions.shx_attachment_create(
                solver._handle,
                address(at),
                address(s),
                len(s),
                address(b),
                len(b),
                address(c),
                len(c),
                out,
            )

        self._open = made(functions.shx_attachment_destroy, create)

    def move(self, solver: Solver, pose: npt.ArrayLike | Frame, over_seconds: float = 0.0) -> None:
        """Moves all smoothly to where it is when its carrier is at pose, over the next over_seconds of simulated time (0: within the next substep)."""
        check(functions.shx_attachment_move(self._handle, solver._handle, address(one_frame("pose", pose)), over_seconds))

    def teleport(self, solver: Solver, pose: npt.ArrayLike | Frame) -> None:
        """Puts all there at once: strands keep their shapes, bodies sweep nothing."""
        check(functions.shx_attachment_teleport(self._handle, solver._handle, address(one_frame("pose", pose))))
