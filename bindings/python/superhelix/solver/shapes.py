"""Shapes of strands: curvatures, elements, static rest, and shapes adopted as natural or rest shapes."""

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
    """How searches for static rest ended: report for all, and for each strand its status (StrandStatus), the smallest eigenvalue of the static
    Hessian against the elastic stiffness (above 0: stable), and the largest moment out of balance, relative.
    """

    report: SettleReport
    status: npt.NDArray[np.int32]
    eigenvalues: Numbers
    residuals: Numbers


class Stability(NamedTuple):
    """How firmly strands would rest: the smallest eigenvalue of each (above 0: stable), and the smallest factors on Young's modulus and on both
    radii with which it would be at least the margin.
    """

    eigenvalues: Numbers
    youngs_scales: Numbers
    radius_scales: Numbers


class Shapes(SolverBase):
    """Shapes of a solver's strands. Rows of curvatures are (twist, about n1, about n2), rad/m, one an element, from root to tip."""

    __slots__ = ()

    def natural_curvatures(self, id: StrandId) -> Numbers:
        """The natural curvatures of a strand, (elements, 3), rad/m."""
        rows = np.empty((self.element_count(id), 3))
        self._call(functions.shx_solver_get_natural_curvatures, self._strand(id), address(rows), len(rows))
        return rows

    def set_natural_curvatures(self, id: StrandId, curvatures: npt.ArrayLike) -> None:
        """Sets the natural curvatures of a strand, (elements, 3), rad/m. The strand moves towards them from the next step on."""
        rows = column("curvatures", curvatures, np.float64, width=3)
        self._call(functions.shx_solver_set_natural_curvatures, self._strand(id), address(rows), len(rows))

    def curvatures(self, id: StrandId) -> tuple[Numbers, Numbers]:
        """The present curvatures of a strand (rad/m) and their rates (rad/(m s)), (elements, 3) each."""
        rows = np.empty((self.element_count(id), 3))
        rates = np.empty_like(rows)
        self._call(functions.shx_solver_get_curvatures, self._strand(id), address(rows), address(rates), len(rows))
        return rows, rates

    def set_curvatures(self, id: StrandId, curvatures: npt.ArrayLike, rates: npt.ArrayLike | None = None) -> None:
        """Sets the present curvatures of a strand (rad/m) and their rates (rad/(m s), None: 0), (elements, 3) each."""
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
        """The present curvatures of strands, rad/m: the rows of all, one strand after the other. set_shapes puts strands back into them."""
        bits = self._strands(ids)
        rows = np.empty((int(self.element_counts(ids).sum()), 3))
        self._call(functions.shx_solver_get_shapes, address(bits), len(bits), address(rows), len(rows))
        return rows

    def set_shapes(self, curvatures: npt.ArrayLike, ids: StrandsLike = None) -> None:
        """Puts strands into shapes, at rest relative to their roots: rows as shapes gives them. Clears quarantines."""
        bits = self._strands(ids)
        rows = column("curvatures", curvatures, np.float64, width=3)
        self._call(functions.shx_solver_set_shapes, address(bits), len(bits), address(rows), len(rows))

    def set_element_count(self, element_count: int, ids: StrandsLike = None) -> Numbers:
        """Puts strands on element_count elements each, for level of detail by distance; gives how far each strand's curve has moved at most, m.
        The natural shape is remembered: nothing of it is lost by going back and forth.
        """
        bits = self._strands(ids)
        distances = np.empty(len(bits))
        count = whole("element_count", element_count)
        self._call(functions.shx_solver_set_element_count, address(bits), len(bits), count, address(distances))
        return distances

    def set_element_lengths(self, id: StrandId, lengths: npt.ArrayLike) -> float:
        """Puts a strand on elements of given lengths, m, from root to tip; gives how far its curve has moved at most, m."""
        numbers = column("lengths", lengths, np.float64)
        distance = ctypes.c_double()
        self._call(functions.shx_solver_set_element_lengths, self._strand(id), address(numbers), len(numbers), ctypes.byref(distance))
        return distance.value

    def settle(self, ids: StrandsLike = None, options: SettleDef | None = None) -> Settled:
        """Puts strands at rest in their static equilibrium under gravity, searched for downhill from their present shapes with roots held still.
        Wind, contact and constraints are not felt.
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
        """Makes the present shapes of strands their natural ones: without weight they would rest in them, with it they sag from here."""
        bits = self._strands(ids)
        self._call(functions.shx_solver_adopt_natural_shapes, address(bits), len(bits))

    def adopt_rest_shapes(self, ids: StrandsLike = None) -> None:
        """Makes the present shapes of strands those in which they rest under gravity, by natural curvatures that balance their weight. Velocities
        stay. The rest need not be stable: see shape_stability.
        """
        bits = self._strands(ids)
        self._call(functions.shx_solver_adopt_rest_shapes, address(bits), len(bits))

    def shape_stability(self, ids: StrandsLike = None, margin: float = 0.0) -> Stability:
        """How firmly strands would rest in their present shapes once adopt_rest_shapes has made them rest shapes. Changes nothing."""
        bits = self._strands(ids)
        found = Stability(np.empty(len(bits)), np.empty(len(bits)), np.empty(len(bits)))
        self._call(functions.shx_solver_shape_stability, address(bits), len(bits), margin, *(address(numbers) for numbers in found))
        return found

    def stiffen_strands(self, margin: float, ids: StrandsLike = None, by: Stiffen = Stiffen.YOUNGS_MODULUS) -> Numbers:
        """Makes strands that would not rest stably in their present shapes as much stiffer as that takes, and adopts the shapes of all as rest
        shapes. margin, 0 to below 1, is what the smallest eigenvalue is at least afterwards. Gives the factors, 1 where nothing was changed.
        """
        bits = self._strands(ids)
        scales = np.empty(len(bits))
        self._call(functions.shx_solver_stiffen_strands, address(bits), len(bits), whole("by", by), margin, address(scales))
        return scales
