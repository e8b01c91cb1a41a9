"""Strands: adding and removing them, how they fare, their materials, their roots."""

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
        """Adds strands, all or none, and gives their ids in the order of the definitions."""
        data = np.ascontiguousarray(defs.data)
        bits = np.empty(len(data), dtype=np.uint64)
        self._call(functions.shx_solver_add_strands, address(data), data.dtype.itemsize, len(data), address(bits))
        self._all = None
        return StrandIds(bits)

    def remove_strands(self, ids: StrandsLike) -> None:
        """Removes strands, all or none. Their ids are stale from then on."""
        bits = self._strands(ids)
        self._call(functions.shx_solver_remove_strands, address(bits), len(bits))
        self._all = None

    def has_strand(self, id: StrandId) -> bool:
        """Whether an id names a strand of this solver."""
        return bool(functions.shx_solver_has_strand(self._handle, self._strand(id)))

    def element_lengths(self, id: StrandId) -> Numbers:
        """The lengths of a strand's elements from root to tip, m."""
        lengths = np.empty(self.element_count(id))
        self._call(functions.shx_solver_get_element_lengths, self._strand(id), address(lengths), len(lengths))
        return lengths

    def user_data(self, id: StrandId) -> int:
        """The number that the definition gave to a strand."""
        number = ctypes.c_uint64()
        self._call(functions.shx_solver_get_user_data, self._strand(id), ctypes.byref(number))
        return number.value

    def strand_status(self, ids: StrandsLike = None) -> npt.NDArray[np.int32]:
        """How strands fared in the last step: StrandStatus.CONVERGED, UNCONVERGED or QUARANTINED (rolled back to the step's start; reset_strands
        recovers it).
        """
        bits = self._strands(ids)
        status = np.empty(len(bits), dtype=np.int32)
        self._call(functions.shx_solver_strand_status, address(bits), len(bits), address(status))
        return status

    def strand_iterations(self, ids: StrandsLike = None) -> npt.NDArray[np.uint32]:
        """Newton iterations of strands in the last substep."""
        bits = self._strands(ids)
        iterations = np.empty(len(bits), dtype=np.uint32)
        self._call(functions.shx_solver_strand_iterations, address(bits), len(bits), address(iterations))
        return iterations

    def strand_quadrature(self, ids: StrandsLike = None) -> tuple[npt.NDArray[np.uint32], Numbers]:
        """With how many quadrature points the elements of strands are integrated, and the relative error of that in the present shape."""
        bits = self._strands(ids)
        points, errors = np.empty(len(bits), dtype=np.uint32), np.empty(len(bits))
        self._call(functions.shx_solver_strand_quadrature, address(bits), len(bits), address(points), address(errors))
        return points, errors

    def strand_turning_angles(self, ids: StrandsLike = None) -> Numbers:
        """The largest angle by which an element of each strand turns, in its natural or its present shape, rad. Above pi/2 a strand moves too
        stiffly: give it more elements.
        """
        bits = self._strands(ids)
        angles = np.empty(len(bits))
        self._call(functions.shx_solver_strand_turning_angles, address(bits), len(bits), address(angles))
        return angles

    def strand_energies(self, ids: StrandsLike = None) -> Energies:
        """Energies of strands, J."""
        bits = self._strands(ids)
        kinetic, elastic, gravity = (np.empty(len(bits)) for _ in range(3))
        self._call(functions.shx_solver_strand_energies, address(bits), len(bits), address(kinetic), address(elastic), address(gravity))
        return Energies(kinetic, elastic, gravity)

    def reset_strands(self, ids: StrandsLike = None) -> None:
        """Puts strands back to their natural curvatures, at rest relative to their roots, and clears a quarantine."""
        bits = self._strands(ids)
        self._call(functions.shx_solver_reset_strands, address(bits), len(bits))

    def set_materials(self, materials: Material | Sequence[Material], ids: StrandsLike = None) -> None:
        """Changes sections and materials of strands: one for all, or one each. Shapes, natural shapes and velocities stay."""
        bits = self._strands(ids)
        data, size, count = packed("materials", materials, Material, len(bits))
        self._call(functions.shx_solver_set_materials, address(bits), len(bits), address(data), size, count)

    def material(self, id: StrandId) -> Material:
        """The section and material that a strand has now."""
        material = Material()
        self._call(functions.shx_solver_get_material, self._strand(id), ctypes.byref(material._c))
        return material

    def set_root_frames(self, frames: Any, ids: StrandsLike = None, over_seconds: float = 0.0) -> None:
        """Moves the roots of strands smoothly to frames (float64 rows of origin, m, and quaternion x, y, z, w; one for each strand) over the next
        over_seconds of simulated time (0: within the next substep). One call a frame for all roots. Strands that are not named go on as they were.
        """
        bits = self._strands(ids)
        view = input_frames("frames", frames, len(bits))
        self._call(functions.shx_solver_set_root_frames, address(bits), len(bits), ctypes.byref(view), over_seconds)

    def teleport_roots(self, frames: Any, ids: StrandsLike = None) -> None:
        """Puts the roots of strands at frames at once: strands keep their shape and their velocity in the root's frame. For cuts and new takes."""
        bits = self._strands(ids)
        view = input_frames("frames", frames, len(bits))
        self._call(functions.shx_solver_teleport_roots, address(bits), len(bits), ctypes.byref(view))

    def root_frames(self, ids: StrandsLike = None, out: npt.NDArray[Any] | None = None) -> npt.NDArray[Any]:
        """The root frames of strands as they are now, rows of origin and quaternion. out: where to, with rows of seven float64, or of four float32
        or float64 for the quaternions alone.
        """
        return self._frames_out(functions.shx_solver_get_root_frames, self._strands(ids), out)

    def _frames_out(self, function: Callable[[Any, Any, int, Any], int], bits: npt.NDArray[np.uint64], out: npt.NDArray[Any] | None) -> npt.NDArray[Any]:
        array = np.empty((len(bits), 7)) if out is None else out
        output = Output("out", array, (7, 4), len(bits))
        self._call(function, address(bits), len(bits), ctypes.byref(output.view))
        return array
