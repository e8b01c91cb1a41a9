"""Strands: adding and removing them, their status, materials and roots."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix._buffers import Output, address, input_frames
from superhelix._library import functions
from superhelix.ids import StrandId, StrandIds
from superhelix.records import Material
from superhelix.solver._base import Numbers, SolverBase, StrandsLike
from superhelix.solver._packed import packed
from superhelix.strand_defs import StrandDefs


class Energies(NamedTuple):
    """Energies of strands, J, a number each: kinetic, elastic, and of gravity measured from the world's origin."""

    kinetic: Numbers
    elastic: Numbers
    gravity: Numbers


class Strands(SolverBase):
    """Strands of a solver."""

    __slots__ = ()

    def add_strands(self, defs: StrandDefs) -> StrandIds:
        """Adds strands, all or none, and returns their ids in the order of the definitions."""
        data = defs._ready()
        bits = np.empty(len(data), dtype=np.uint64)
        self._call(functions.shx_solver_add_strands, address(data), data.dtype.itemsize, len(data), address(bits))
        self._all = None
        return StrandIds(bits)

    def remove_strands(self, ids: StrandsLike) -> None:
        """Removes strands, all or none. Their ids become invalid."""
        bits = self._strands(ids)
        self._call(functions.shx_solver_remove_strands, address(bits), len(bits))
        self._all = None

    def has_strand(self, id: StrandId) -> bool:
        """Returns whether an id names a strand of this solver."""
        return bool(functions.shx_solver_has_strand(self._handle, self._strand(id)))

    def element_lengths(self, id: StrandId) -> Numbers:
        """Returns the lengths of a strand's elements from root to tip, m."""
        lengths = np.empty(self.element_count(id))
        self._call(functions.shx_solver_get_element_lengths, self._strand(id), address(lengths), len(lengths))
        return lengths

    def strand_lengths(self, ids: StrandsLike = None) -> Numbers:
        """Returns the lengths of strands, m."""
        bits = self._strands(ids)
        lengths = np.empty(len(bits))
        self._call(functions.shx_solver_strand_lengths, address(bits), len(bits), address(lengths))
        return lengths

    def user_data(self, id: StrandId) -> int:
        """Returns the user_data of a strand."""
        number = ctypes.c_uint64()
        self._call(functions.shx_solver_get_user_data, self._strand(id), ctypes.byref(number))
        return number.value

    def strand_status(self, ids: StrandsLike = None) -> npt.NDArray[np.int32]:
        """Returns the status of strands after the last step: StrandStatus.CONVERGED, UNCONVERGED or QUARANTINED (rolled back to the start of the step;
        reset_strands recovers it).
        """
        bits = self._strands(ids)
        status = np.empty(len(bits), dtype=np.int32)
        self._call(functions.shx_solver_strand_status, address(bits), len(bits), address(status))
        return status

    def strand_iterations(self, ids: StrandsLike = None) -> npt.NDArray[np.uint32]:
        """Returns the number of Newton iterations of strands in the last substep."""
        bits = self._strands(ids)
        iterations = np.empty(len(bits), dtype=np.uint32)
        self._call(functions.shx_solver_strand_iterations, address(bits), len(bits), address(iterations))
        return iterations

    def strand_quadrature(self, ids: StrandsLike = None) -> tuple[npt.NDArray[np.uint32], Numbers]:
        """Returns the number of quadrature points of the elements of strands, and the relative integration error in the current shape."""
        bits = self._strands(ids)
        points, errors = np.empty(len(bits), dtype=np.uint32), np.empty(len(bits))
        self._call(functions.shx_solver_strand_quadrature, address(bits), len(bits), address(points), address(errors))
        return points, errors

    def strand_turning_angles(self, ids: StrandsLike = None) -> Numbers:
        """Returns the largest turning angle of an element of each strand, in its natural or its current shape, rad. Above pi/2 a strand moves too
        stiffly: give it more elements.
        """
        bits = self._strands(ids)
        angles = np.empty(len(bits))
        self._call(functions.shx_solver_strand_turning_angles, address(bits), len(bits), address(angles))
        return angles

    def strand_energies(self, ids: StrandsLike = None) -> Energies:
        """Returns the energies of strands, J."""
        bits = self._strands(ids)
        kinetic, elastic, gravity = (np.empty(len(bits)) for _ in range(3))
        self._call(functions.shx_solver_strand_energies, address(bits), len(bits), address(kinetic), address(elastic), address(gravity))
        return Energies(kinetic, elastic, gravity)

    def reset_strands(self, ids: StrandsLike = None) -> None:
        """Resets strands to their natural curvatures, at rest relative to their roots, and ends a quarantine."""
        bits = self._strands(ids)
        self._call(functions.shx_solver_reset_strands, address(bits), len(bits))

    def set_materials(self, materials: Material | Sequence[Material], ids: StrandsLike = None) -> None:
        """Sets the cross-section and material of strands: one Material for all, or one each. Shapes, natural shapes and velocities stay."""
        bits = self._strands(ids)
        data, size, count = packed("materials", materials, Material, len(bits))
        self._call(functions.shx_solver_set_materials, address(bits), len(bits), address(data), size, count)

    def material(self, id: StrandId) -> Material:
        """Returns the current cross-section and material of a strand."""
        material = Material()
        self._call(functions.shx_solver_get_material, self._strand(id), ctypes.byref(material._c))
        return material

    def set_root_frames(self, frames: Any, ids: StrandsLike = None, over_seconds: float = 0.0) -> None:
        """Moves the roots of strands smoothly to frames (float64 rows of origin, m, and quaternion x, y, z, w; one for each strand) over the next
        over_seconds of simulated time (0: within the next substep). Call it once per frame for all roots. Other strands are not affected.
        """
        bits = self._strands(ids)
        view = input_frames("frames", frames, len(bits))
        self._call(functions.shx_solver_set_root_frames, address(bits), len(bits), ctypes.byref(view), over_seconds)

    def teleport_roots(self, frames: Any, ids: StrandsLike = None) -> None:
        """Moves the roots of strands to frames at once. Strands keep their shape, and their velocity in the root frame. For cuts and new takes."""
        bits = self._strands(ids)
        view = input_frames("frames", frames, len(bits))
        self._call(functions.shx_solver_teleport_roots, address(bits), len(bits), ctypes.byref(view))

    def root_frames(self, ids: StrandsLike = None, out: npt.NDArray[Any] | None = None) -> npt.NDArray[Any]:
        """Returns the current root frames of strands, rows of origin and quaternion. out: an array to write to, with rows of seven float64, or of four
        float32 or float64 for the quaternions alone.
        """
        return self._frames_out(functions.shx_solver_get_root_frames, self._strands(ids), out)

    def _frames_out(self, function: Callable[[Any, Any, int, Any], int], bits: npt.NDArray[np.uint64], out: npt.NDArray[Any] | None) -> npt.NDArray[Any]:
        array = np.empty((len(bits), 7)) if out is None else out
        output = Output("out", array, (7, 4), len(bits))
        self._call(function, address(bits), len(bits), ctypes.byref(output.view))
        return array
