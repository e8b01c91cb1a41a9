"""The solver: strands, bodies, constraints, and everything that a step needs. A file a subject."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any

from superhelix._callbacks import Failures, Log, ParallelFor, attach, log_callback, parallel_for_callback
from superhelix._handle import made
from superhelix._library import functions
from superhelix.records import Settings, SolverDef
from superhelix.solver.bodies import Bodies
from superhelix.solver.constraints import Constraints
from superhelix.solver.contact import Contact, ContactEvents, Overlaps, PermittedOverlap, PushedOut
from superhelix.solver.posing import Brushed, Posing
from superhelix.solver.sampling import DebugDrawing, Sampling
from superhelix.solver.shapes import Settled, Shapes, Stability
from superhelix.solver.stepping import Cancel, Stepping
from superhelix.solver.strands import Energies, Strands
from superhelix.solver.styling import Cuts, Styling
from superhelix.solver.targets import Targets

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_FROM_SETTINGS = (
    "integrator",
    "max_iterations",
    "max_subdivisions",
    "tolerance",
    "error_tolerance",
    "quadrature_tolerance",
)


class Solver(Strands, Targets, Shapes, Posing, Sampling, Bodies, Contact, Constraints, Styling, Stepping):
    """Strands, gravity, wind and everything that a step needs.

    with superhelix.Solver(gravity=(0, -9.81, 0), worker_count=4) as solver:
        strands = solver.add_strands(superhelix.StrandDefs(100, element_count=8, length=0.2, root=frames))
        solver.step(1 / 60, substeps=2)
        points = solver.sample_strands(16)

    Functions take ids of strands, bodies or constraints; without ids they are for all of them. Reading functions may run at the same time on any
    threads; one that changes the solver must be alone, or it raises BusyError.
    """

    __slots__ = ()

    def __init__(
        self,
        options: SolverDef | None = None,
        *,
        settings: Settings | None = None,
        parallel_for: ParallelFor | None = None,
        log: Log | None = None,
        **fields: Any,
    ) -> None:
        """options: a SolverDef, or None for the defaults; fields: fields of a SolverDef by name, on top. settings: what preset or suggest_settings
        gave, on top of options. parallel_for: a parallel loop of yours (or parallel_for_on an executor). log: receives messages up to
        options.log_level (or log_to_logging).
        """
        chosen = (SolverDef() if options is None else options).copy()
        if settings is not None:
            chosen._set(**{name: getattr(settings, name) for name in _FROM_SETTINGS})
        chosen = chosen.copy(**fields)
        self._open = None
        self._all = None
        self._failures = Failures()
        self._wind = None
        kept = []
        if parallel_for is not None:
            kept.append(parallel_for_callback(parallel_for, self._failures))
            attach(chosen._c, "parallel_for", kept[-1])
        if log is not None:
            kept.append(log_callback(log, self._failures))
            attach(chosen._c, "log", kept[-1])

        def create(out: Any) -> int:
            return functions.shx_solver_create(ctypes.byref(chosen._c), out)

        self._open = made(functions.shx_solver_destroy, create, kept)
        if self._failures.any:
            self._raise(0)

    def plot(self, ids: Any = None, *, points_per_strand: int = 24, ax: Axes | None = None, **style: Any) -> Axes:
        """Draws strands as lines in a 3D plot of matplotlib (pip install superhelix[plot]); see superhelix.plot.plot_curves for the style."""
        from superhelix.plot import plot_solver

        return plot_solver(self, ids, points_per_strand=points_per_strand, ax=ax, **style)

    def __repr__(self) -> str:
        return "Solver(closed)" if self.closed else f"Solver({self.strand_count()} strands)"


__all__ = [
    "Brushed",
    "Cancel",
    "ContactEvents",
    "Cuts",
    "DebugDrawing",
    "Energies",
    "Overlaps",
    "PermittedOverlap",
    "PushedOut",
    "Settled",
    "Solver",
    "Stability",
]
