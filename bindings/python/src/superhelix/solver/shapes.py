"""Shapes of strands: curvatures, elements, static equilibrium, natural and rest shapes."""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix._buffers import address, column, whole
from superhelix._library import functions
from superhelix._record import reference
from superhelix.enums import Stiffen
from superhelix.ids import StrandId
from superhelix.records import SettleDef, SettleReport
from superhelix.solver._base import Numbers, SolverBase, StrandsLike


class Settled(NamedTuple):
    """Result of settle: a report for all strands, and for each strand its status (StrandStatus), the smallest eigenvalue of the static Hessian
    relative to the elastic stiffness (above 0: stable), and the relative residual.
    """

    report: SettleReport
    status: npt.NDArray[np.int32]
    eigenvalues: Numbers
    residuals: Numbers


class Stability(NamedTuple):
    """Stability of shapes: the smallest eigenvalue of each strand (above 0: stable), and the smallest factors on Young's modulus and on both radii
    that raise it to the margin.
    """

    eigenvalues: Numbers
    youngs_scales: Numbers
    radius_scales: Numbers


class Shapes(SolverBase):
    """Shapes of a solver's strands. Rows of curvatures are (twist, about n1, about n2), rad/m, one an element, from root to tip."""

    __slots__ = ()

    def natural_curvatures(self, id: StrandId) -> Numbers:
        """Returns the natural curvatures of a strand, (elements, 3), rad/m."""
        rows = np.empty((self.element_count(id), 3))
        self._call(functions.shx_solver_get_natural_curvatures, self._strand(id), address(rows), len(rows))
        return rows

    def set_natural_curvatures(self, id: StrandId, curvatures: npt.ArrayLike) -> None:
        """Sets the natural curvatures of a strand, (elements, 3), rad/m. The strand moves towards them from the next step on."""
        rows = column("curvatures", curvatures, np.float64, width=3)
        self._call(functions.shx_solver_set_natural_curvatures, self._strand(id), address(rows), len(rows))

    def curvatures(self, id: StrandId) -> tuple[Numbers, Numbers]:
        """Returns the current curvatures of a strand (rad/m) and their rates (rad/(m s)), (elements, 3) each."""
        rows = np.empty((self.element_count(id), 3))
        rates = np.empty_like(rows)
        self._call(functions.shx_solver_get_curvatures, self._strand(id), address(rows), address(rates), len(rows))
        return rows, rates

    def set_curvatures(self, id: StrandId, curvatures: npt.ArrayLike, rates: npt.ArrayLike | None = None) -> None:
        """Sets the current curvatures of a strand (rad/m) and their rates (rad/(m s), None: 0), (elements, 3) each."""
        rows = column("curvatures", curvatures, np.float64, width=3)
        speeds = None if rates is None else column("rates", rates, np.float64, len(rows), 3)
        self._call(
            functions.shx_solver_set_curvatures,
            self._strand(id),
            address(rows),
            None if speeds is None else address(speeds),
            len(rows),
        )

    def shapes(self, ids: StrandsLike = None) -> Numbers:
        """Returns the current curvatures of strands, rad/m, strand by strand. set_shapes restores them."""
        bits = self._strands(ids)
        rows = np.empty((int(self.element_counts(ids).sum()), 3))
        self._call(functions.shx_solver_get_shapes, address(bits), len(bits), address(rows), len(rows))
        return rows

    def set_shapes(self, curvatures: npt.ArrayLike, ids: StrandsLike = None) -> None:
        """Sets the shapes of strands, at rest relative to their roots: rows as shapes returns them. Ends a quarantine."""
        bits = self._strands(ids)
        rows = column("curvatures", curvatures, np.float64, width=3)
        self._call(functions.shx_solver_set_shapes, address(bits), len(bits), address(rows), len(rows))

    def set_element_count(self, element_count: int, ids: StrandsLike = None) -> Numbers:
        """Changes the number of elements of strands, for level of detail. Returns the largest displacement of each strand's curve, m. The solver
        keeps the natural shape: nothing is lost by going back and forth.
        """
        bits = self._strands(ids)
        distances = np.empty(len(bits))
        count = whole("element_count", element_count)
        self._call(functions.shx_solver_set_element_count, address(bits), len(bits), count, address(distances))
        return distances

    def set_element_lengths(self, id: StrandId, lengths: npt.ArrayLike) -> float:
        """Changes the elements of a strand to the given lengths, m, from root to tip. Returns the largest displacement of its curve, m."""
        numbers = column("lengths", lengths, np.float64)
        distance = ctypes.c_double()
        self._call(functions.shx_solver_set_element_lengths, self._strand(id), address(numbers), len(numbers), ctypes.byref(distance))
        return distance.value

    def settle(self, ids: StrandsLike = None, options: SettleDef | None = None) -> Settled:
        """Moves strands to their static equilibrium under gravity, at rest. The search goes downhill from the current shapes with fixed roots, and
        ignores wind, contact and constraints.
        """
        bits = self._strands(ids)
        report = SettleReport()
        status, eigenvalues, residuals = np.empty(len(bits), dtype=np.int32), np.empty(len(bits)), np.empty(len(bits))
        self._call(
            functions.shx_solver_settle,
            address(bits),
            len(bits),
            reference("options", options, SettleDef),
            ctypes.byref(report._c),
            address(status),
            address(eigenvalues),
            address(residuals),
        )
        return Settled(report, status, eigenvalues, residuals)

    def adopt_natural_shapes(self, ids: StrandsLike = None) -> None:
        """Makes the current shapes of strands their natural shapes: without gravity they would rest in them, with it they sag."""
        bits = self._strands(ids)
        self._call(functions.shx_solver_adopt_natural_shapes, address(bits), len(bits))

    def adopt_rest_shapes(self, ids: StrandsLike = None) -> None:
        """Makes the current shapes of strands their rest shapes under gravity: natural curvatures balance their weight. Velocities stay. The
        equilibrium need not be stable: see shape_stability.
        """
        bits = self._strands(ids)
        self._call(functions.shx_solver_adopt_rest_shapes, address(bits), len(bits))

    def shape_stability(self, ids: StrandsLike = None, margin: float = 0.0) -> Stability:
        """Computes the stability of strands in their current shapes, once adopt_rest_shapes has made them rest shapes. Changes nothing."""
        bits = self._strands(ids)
        found = Stability(np.empty(len(bits)), np.empty(len(bits)), np.empty(len(bits)))
        self._call(functions.shx_solver_shape_stability, address(bits), len(bits), margin, *(address(numbers) for numbers in found))
        return found

    def stiffen_strands(self, margin: float, ids: StrandsLike = None, by: Stiffen = Stiffen.YOUNGS_MODULUS) -> Numbers:
        """Stiffens strands whose current shapes would not be stable rest shapes by as much as it takes, and adopts the shapes of all strands as rest
        shapes. margin, 0 to below 1: the smallest eigenvalue afterwards. Returns the factors, 1 for strands that are unchanged.
        """
        bits = self._strands(ids)
        scales = np.empty(len(bits))
        self._call(functions.shx_solver_stiffen_strands, address(bits), len(bits), whole("by", by), margin, address(scales))
        return scales
