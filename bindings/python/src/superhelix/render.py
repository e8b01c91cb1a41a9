"""Render hair: many strands interpolated from few guides."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import Output, address, as_rows, column, frame_rows, input_frames, input_rows, vector, whole
from superhelix._callbacks import Failures, ParallelFor, attach, parallel_for_callback
from superhelix._handle import Handle, Owner, made
from superhelix._library import functions
from superhelix._record import initialize
from superhelix._transform import put_transform
from superhelix.errors import check
from superhelix.records import RenderSettings

if TYPE_CHECKING:
    from superhelix.solver import Solver
    from superhelix.solver._base import StrandsLike


def _places(name: str, values: Any, count: int | None = None) -> Any:
    """Points, or frames whose origins count."""
    rows = frame_rows(name, values) if hasattr(values, "rotation") else as_rows(name, values, 3)
    return input_frames(name, rows, count) if rows.shape[-1] == 7 else input_rows(name, rows, (3, 4), count)


class RenderGuides:
    """Guides at one moment, as curves: points (m, root first, (guides, points, 3), or guide by guide (points, 3) with point_counts); roots:
    orientation of each follicle (frames, or quaternions); velocities of the points, m/s; root_angular_velocities, rad/s.
    """

    __slots__ = ("_c", "_kept")

    def __init__(
        self,
        points: npt.ArrayLike,
        point_counts: npt.ArrayLike | None = None,
        *,
        roots: Any = None,
        velocities: npt.ArrayLike | None = None,
        root_angular_velocities: npt.ArrayLike | None = None,
    ) -> None:
        rows = as_rows("points", points)
        self._c = _capi.shx_render_guides()
        initialize(self._c)
        self._kept: list[Any] = []
        if point_counts is not None:
            counts = column("point_counts", point_counts, np.uint32)
            self._kept.append(counts)
            self._c.point_counts, guides, total = address(counts), len(counts), int(counts.sum())
        elif rows.ndim == 3:
            guides, total = rows.shape[0], rows.shape[0] * rows.shape[1]
            counts = np.full(guides, rows.shape[1], dtype=np.uint32)
            self._kept.append(counts)
            self._c.point_counts = address(counts)
        else:
            raise ValueError(f"points: shape {rows.shape}; (guides, points, 3) expected, or give point_counts")
        self._c.guide_count = guides
        self._c.points = self._keep(input_rows("points", rows, (3, 4), total))
        if roots is not None:
            self._c.roots = self._keep(_places("roots", roots, guides))
        if velocities is not None:
            self._c.velocities = self._keep(input_rows("velocities", velocities, (3,), total))
        if root_angular_velocities is not None:
            spins = input_rows("root_angular_velocities", root_angular_velocities, (3,), guides)
            self._c.root_angular_velocities = self._keep(spins)

    def _keep(self, view: Any) -> Any:
        self._kept.append(view)
        return view


class RenderHair(Owner):
    """Binding of render strands to their guides. Immutable. Create it with from_guides, from_solver or load."""

    __slots__ = ("_failures", "_guessed", "points_per_strand", "strand_count")
    _failures: Failures
    #: Whether points_per_strand is load's argument, and not yet confirmed.
    _guessed: bool
    strand_count: int
    points_per_strand: int

    def __init__(self) -> None:
        raise TypeError("RenderHair: use from_guides, from_solver or load")

    @classmethod
    def _make(cls, make: Any, settings: RenderSettings | None, parallel_for: ParallelFor | None, strands: int | None) -> RenderHair:
        hair = cls.__new__(cls)
        hair._failures = Failures()
        hair._guessed = False
        chosen = RenderSettings() if settings is None else settings.copy()
        kept = None
        if parallel_for is not None:
            kept = parallel_for_callback(parallel_for, hair._failures)
            attach(chosen._c, "parallel_for", kept)
        hair._open = made(functions.shx_render_hair_destroy, lambda out: make(ctypes.byref(chosen._c), out), kept)
        hair.points_per_strand = chosen.points_per_strand
        hair.strand_count = hair._find_count() if strands is None else strands
        return hair

    @classmethod
    def from_guides(
        cls,
        guides: RenderGuides,
        roots: Any,
        settings: RenderSettings | None = None,
        *,
        parallel_for: ParallelFor | None = None,
    ) -> RenderHair:
        """Creates render hair from guides in their rest pose. roots: the roots of the render strands in that pose (m, or frames), one per strand."""
        view = _places("roots", roots)

        def make(chosen: Any, out: Any) -> int:
            return functions.shx_render_hair_create(chosen, ctypes.byref(guides._c), ctypes.byref(view), out)

        return cls._make(make, settings, parallel_for, int(view.count))

    @classmethod
    def from_solver(
        cls,
        solver: Solver,
        roots: Any,
        settings: RenderSettings | None = None,
        ids: StrandsLike = None,
        *,
        parallel_for: ParallelFor | None = None,
    ) -> RenderHair:
        """Creates render hair whose guides are strands of a solver in their current shapes. Call it while they rest."""
        view, bits = _places("roots", roots), solver._strands(ids)

        def make(chosen: Any, out: Any) -> int:
            solver._call(functions.shx_solver_create_render_hair, address(bits), len(bits), chosen, ctypes.byref(view), out)
            return _capi.SHX_OK

        return cls._make(make, settings, parallel_for, int(view.count))

    @classmethod
    def load(cls, image: bytes, settings: RenderSettings | None = None, *, parallel_for: ParallelFor | None = None, points_per_strand: int) -> RenderHair:
        """Creates render hair from the bytes of save. Uses only worker_count of settings. points_per_strand must be that of the hair."""

        def make(chosen: Any, out: Any) -> int:
            return functions.shx_render_hair_load(image, len(image), chosen, out)

        hair = cls._make(make, settings, parallel_for, None)
        hair.points_per_strand = whole("points_per_strand", points_per_strand, 2)
        hair._guessed = True
        return hair

    def _find_count(self) -> int:
        """How many strands there are, by asking for wisps: the API has no count, and refuses strands that are not there."""
        least, most = 0, 1
        while self._has(most):
            least, most = most, most * 2
        while most - least > 1:
            middle = (least + most) // 2
            least, most = (middle, most) if self._has(middle) else (least, middle)
        return least

    def _has(self, count: int) -> bool:
        guide = ctypes.c_uint32()
        return functions.shx_render_hair_wisps(self._handle, count, 0, ctypes.byref(guide), None) == _capi.SHX_OK

    def save(self) -> bytes:
        """Returns the hair as bytes, for load: the same hair without binding it again."""
        size = ctypes.c_size_t()
        check(functions.shx_render_hair_save(self._handle, None, 0, ctypes.byref(size)))
        image = ctypes.create_string_buffer(max(size.value, 1))
        check(functions.shx_render_hair_save(self._handle, image, size.value, ctypes.byref(size)))
        return image.raw[: size.value]

    def without_guides(self, gone: npt.ArrayLike) -> RenderHair:
        """Returns hair without some guides (indices as at creation). Strands that follow none of them do not change."""
        numbers = column("gone", gone, np.uint32)
        handle = self._handle

        def make(_chosen: Any, out: Any) -> int:
            return functions.shx_render_hair_without_guides(handle, address(numbers), len(numbers), out)

        hair = self._make(make, None, None, None)
        hair.points_per_strand, hair._guessed = self.points_per_strand, self._guessed
        return hair

    def with_own_shapes(self, points: npt.ArrayLike, point_counts: npt.ArrayLike | None = None) -> RenderHair:
        """Returns hair whose strands have shapes of their own: while the guides are at rest, each strand is its curve in points, m (cut short by
        length_variation). When guides move, what distinguishes it from them goes with its first guide. points: (strands, points_per_strand, 3), or
        curve by curve (points, 3) with point_counts, which are resampled.
        """
        rows = as_rows("points", points)
        if point_counts is None and (rows.ndim != 3 or rows.shape[0] != self.strand_count):
            raise ValueError(f"points: shape {rows.shape}; ({self.strand_count}, points_per_strand, 3) expected, or give point_counts")
        counts = None if point_counts is None else column("point_counts", point_counts, np.uint32, self.strand_count)
        view, handle, strands = input_rows("points", rows, (3, 4)), self._handle, self.strand_count

        def make(_chosen: Any, out: Any) -> int:
            given = None if counts is None else address(counts)
            return functions.shx_render_hair_with_own_shapes(handle, ctypes.byref(view), given, strands, out)

        hair = self._make(make, None, None, strands)
        hair.points_per_strand, hair._guessed = self.points_per_strand, self._guessed
        return hair

    def wisps(self, first_strand: int = 0, strand_count: int | None = None) -> tuple[npt.NDArray[np.uint32], npt.NDArray[np.uint32]]:
        """Returns the first guide of each strand, and the index of its wisp around that guide."""
        first = whole("first_strand", first_strand, 0, 2**63)
        count = max(self.strand_count - first, 0) if strand_count is None else whole("strand_count", strand_count, 0, 2**63)
        guides, wisps = np.empty(count, dtype=np.uint32), np.empty(count, dtype=np.uint32)
        check(functions.shx_render_hair_wisps(self._handle, first, count, address(guides), address(wisps)))
        return guides, wisps

    def pose(self) -> RenderPose:
        """Creates a pose of this hair. Set its guides before you evaluate it."""
        return RenderPose(self)


class RenderPose(Owner):
    """Guides of render hair at one moment."""

    __slots__ = ("hair",)
    hair: RenderHair

    def __init__(self, hair: RenderHair) -> None:
        handle: Handle = hair._handle
        # The pose lives on by itself, but the hair's callback must.
        self._open = made(functions.shx_render_pose_destroy, lambda out: functions.shx_render_pose_create(handle, out), handle)
        self.hair = hair

    def set_guides(self, guides: RenderGuides) -> None:
        """Sets the guides, in the number and order of creation."""
        check(functions.shx_render_pose_set_guides(self._handle, ctypes.byref(guides._c)))

    def set_from_solver(self, solver: Solver, ids: StrandsLike = None, *, velocities: bool = False) -> None:
        """Sets the guides from the current strands of a solver. velocities: whether evaluate will be asked for velocities."""
        bits = solver._strands(ids)
        solver._call(functions.shx_solver_set_render_pose, address(bits), len(bits), int(velocities), self._handle)

    def evaluate(
        self,
        *,
        solver: Solver | None = None,
        first_strand: int = 0,
        strand_count: int | None = None,
        origin: npt.ArrayLike | None = None,
        transform: npt.ArrayLike | None = None,
        previous_pose: RenderPose | None = None,
        interval: float = 0.0,
        roots: Any = None,
        previous_roots: Any = None,
        out: npt.NDArray[Any] | None = None,
        frames: npt.NDArray[Any] | None = None,
        velocities: npt.NDArray[Any] | None = None,
    ) -> npt.NDArray[Any]:
        """Evaluates render strands: returns points, m, (strands, points, 3) float32. out: an array to write them to instead, float32, items of three
        numbers, or four, the fourth the radius. frames: an array for quaternions x, y, z, w, or for unit tangents (float32); velocities: an array for
        velocities, m/s (float32). solver: strands stay out of its bodies. previous_pose: the pose interval seconds earlier, for velocities. roots: the
        current roots (m, or frames; None: they move with the roots of their guides). transform: a matrix to your space, as in Solver.sample_strands.
        """
        count = max(self.hair.strand_count - first_strand, 0) if strand_count is None else whole("strand_count", strand_count, 0, 2**63)
        view = _capi.shx_render_view()
        initialize(view)
        view.first_strand, view.strand_count = whole("first_strand", first_strand, 0, 2**63), count
        kept: list[Any] = []
        if origin is not None:
            view.origin = (ctypes.c_double * 3)(*vector("origin", origin))
        put_transform(view, transform)
        if previous_pose is not None:
            kept.append(previous_pose._handle)
            view.previous_pose, view.interval = kept[-1]._as_parameter_, interval
        for name, values in (("roots", roots), ("previous_roots", previous_roots)):
            if values is not None:
                kept.append(_places(name, values, count))
                setattr(view, name, kept[-1])
        total = count * self.hair.points_per_strand
        if out is None:
            out = np.empty((count, self.hair.points_per_strand, 3), dtype=np.float32)
        outputs = [Output("out", out, (3, 4), total)]
        outputs += [Output("frames", frames, (4, 3), total)] if frames is not None else []
        outputs += [Output("velocities", velocities, (3,), total)] if velocities is not None else []
        references = [ctypes.byref(output.view) for output in outputs]
        points = references.pop(0)
        turned = references.pop(0) if frames is not None else None
        speeds = references.pop(0) if velocities is not None else None
        if self.hair._guessed:
            self._check_points(count, view, out)
        try:
            if solver is None:
                check(functions.shx_render_pose_evaluate(self._handle, ctypes.byref(view), points, turned, speeds))
            else:
                function = functions.shx_solver_evaluate_render_pose
                solver._call(function, self._handle, ctypes.byref(view), points, turned, speeds)
        finally:
            failure = self.hair._failures.take() if self.hair._failures.any else None
            if failure is not None:
                raise failure
        return out

    def _check_points(self, count: int, view: Any, out: npt.NDArray[Any]) -> None:
        """Raises if loaded hair has fewer points per strand than load's argument: the library wants room for more than one point less."""
        if count == 0:
            return
        short = Output("out", out, (3, 4), 0).view
        short.count = count * self.hair.points_per_strand - 1
        result = functions.shx_render_pose_evaluate(self._handle, ctypes.byref(view), ctypes.byref(short), None, None)
        if result == _capi.SHX_OK:
            raise ValueError(f"points_per_strand: {self.hair.points_per_strand}; the hair that was loaded has fewer")
        if result == _capi.SHX_ERROR_BUFFER_TOO_SMALL:
            self.hair._guessed = False
