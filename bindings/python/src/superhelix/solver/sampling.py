"""Sampling: points, frames, velocities and root forces of strands."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import Output, address, column, float_type, vector, whole
from superhelix._callbacks import attach, vertices_callback
from superhelix._library import functions
from superhelix._record import dtype_of, initialize
from superhelix._transform import put_transform
from superhelix.enums import DebugLayers
from superhelix.ids import StrandId
from superhelix.records import DebugVertexTable
from superhelix.solver._base import SolverBase, StrandsLike


def _reference(output: Output | None) -> Any:
    return None if output is None else ctypes.byref(output.view)


class DebugDrawing(NamedTuple):
    """What debug drawing gave: lines, a pair of rows each, and points; with positions, colours (0xRRGGBB) and layers."""

    lines: DebugVertexTable
    points: DebugVertexTable


class Sampling(SolverBase):
    """Reading strands of a solver."""

    __slots__ = ()

    def debug_draw(
        self,
        layers: DebugLayers | None = None,
        *,
        points_per_strand: int | None = None,
        frame_length: float | None = None,
        normal_length: float | None = None,
        force_scale: float | None = None,
        origin: npt.ArrayLike | None = None,
        transform: npt.ArrayLike | None = None,
    ) -> DebugDrawing:
        """Draws what the solver knows as of the last step as coloured lines and points.

        layers: a union of DebugLayers, by default centrelines, contacts and bodies. points_per_strand: of a centreline. frame_length and normal_length, m:
        of the axes of frames and of the normals of contacts. force_scale: length of a force of 1 N, m. origin and transform: as in sample_strands.
        """
        definition = _capi.shx_debug_draw_def()
        initialize(definition)
        for name, value in (("frame_length", frame_length), ("normal_length", normal_length), ("force_scale", force_scale)):
            if value is not None:
                setattr(definition, name, value)
        if layers is not None:
            definition.layers = DebugLayers(layers)
        if points_per_strand is not None:
            definition.points_per_strand = whole("points_per_strand", points_per_strand)
        if origin is not None:
            definition.origin = (ctypes.c_double * 3)(*vector("origin", origin))
        put_transform(definition, transform)
        size = ctypes.sizeof(_capi.shx_debug_vertex)
        lines: list[bytes] = []
        points: list[bytes] = []
        definition.kept = (vertices_callback(lines, size), vertices_callback(points, size))
        attach(definition, "lines", definition.kept[0])
        attach(definition, "points", definition.kept[1])
        self._call(functions.shx_solver_debug_draw, ctypes.byref(definition))

        def table(batches: list[bytes]) -> DebugVertexTable:
            return DebugVertexTable(np.frombuffer(b"".join(batches), dtype=dtype_of(_capi.shx_debug_vertex)))

        return DebugDrawing(table(lines), table(points))

    def sample_strands(
        self,
        points_per_strand: int = 33,
        ids: StrandsLike = None,
        *,
        dtype: npt.DTypeLike = np.float32,
        origin: npt.ArrayLike | None = None,
        transform: npt.ArrayLike | None = None,
        out: npt.NDArray[Any] | None = None,
        frames: npt.NDArray[Any] | None = None,
        velocities: npt.NDArray[Any] | None = None,
    ) -> npt.NDArray[Any]:
        """Returns points of strands, uniform in arclength, including root and tip, m: an array (strands, points, 3) of dtype float32 or float64.

        out: an array to write the points to instead, without a copy: any strided view with items of three numbers, or four, the fourth the
        strand's radius. frames and velocities: arrays for the frames along the strands (seven float64; quaternions x, y, z, w; or three numbers, the
        unit tangent alone) and the velocities of the points (m/s). origin is subtracted from positions before they are rounded to float32, m.
        transform: a matrix of 3x3, 3x4 or 4x4 numbers to your space, a rotation or a reflection with one scale; it acts on columns.
        """
        bits = self._strands(ids)
        definition = _capi.shx_sample_def()
        initialize(definition)
        definition.points_per_strand = whole("points_per_strand", points_per_strand)
        if origin is not None:
            definition.origin = (ctypes.c_double * 3)(*vector("origin", origin))
        put_transform(definition, transform)
        count = len(bits) * definition.points_per_strand
        if out is None:
            out = np.empty((len(bits), definition.points_per_strand, 3), dtype=float_type("dtype", dtype))
        points = Output("out", out, (3, 4), count)
        frame = None if frames is None else Output("frames", frames, (7, 4, 3), count)
        velocity = None if velocities is None else Output("velocities", velocities, (3,), count)
        self._call(
            functions.shx_solver_sample_strands,
            address(bits),
            len(bits),
            ctypes.byref(definition),
            ctypes.byref(points.view),
            _reference(frame),
            _reference(velocity),
        )
        return out

    def sample_frames(self, points_per_strand: int = 33, ids: StrandsLike = None) -> npt.NDArray[np.float64]:
        """Returns frames along strands, (strands, points, 7): origin, m, and quaternion x, y, z, w; n0 is the tangent."""
        bits = self._strands(ids)
        frames = np.empty((len(bits), whole("points_per_strand", points_per_strand), 7))
        self._sample_one("frames", frames, bits, points_per_strand)
        return frames

    def sample_tangents(self, points_per_strand: int = 33, ids: StrandsLike = None, dtype: npt.DTypeLike = np.float64) -> npt.NDArray[Any]:
        """Returns unit tangents along strands, towards the tip, (strands, points, 3)."""
        bits = self._strands(ids)
        tangents = np.empty((len(bits), whole("points_per_strand", points_per_strand), 3), dtype=float_type("dtype", dtype))
        self._sample_one("frames", tangents, bits, points_per_strand)
        return tangents

    def sample_velocities(self, points_per_strand: int = 33, ids: StrandsLike = None, dtype: npt.DTypeLike = np.float64) -> npt.NDArray[Any]:
        """Returns velocities of material points of strands, (strands, points, 3), m/s."""
        bits = self._strands(ids)
        velocities = np.empty((len(bits), whole("points_per_strand", points_per_strand), 3), dtype=float_type("dtype", dtype))
        self._sample_one("velocities", velocities, bits, points_per_strand)
        return velocities

    def _sample_one(self, which: str, array: npt.NDArray[Any], bits: npt.NDArray[np.uint64], points_per_strand: int) -> None:
        definition = _capi.shx_sample_def()
        initialize(definition)
        definition.points_per_strand = points_per_strand
        output = Output(which, array, array.shape[-1:], array.size // array.shape[-1])
        frames, velocities = (output, None) if which == "frames" else (None, output)
        self._call(
            functions.shx_solver_sample_strands,
            address(bits),
            len(bits),
            ctypes.byref(definition),
            None,
            _reference(frames),
            _reference(velocities),
        )

    def sample_at(
        self,
        id: StrandId,
        arclengths: npt.ArrayLike,
        *,
        dtype: npt.DTypeLike = np.float64,
        origin: npt.ArrayLike | None = None,
        transform: npt.ArrayLike | None = None,
        out: npt.NDArray[Any] | None = None,
        frames: npt.NDArray[Any] | None = None,
        velocities: npt.NDArray[Any] | None = None,
    ) -> npt.NDArray[Any]:
        """Returns points of one strand at arclengths from the root (m, in any order). Other outputs as in sample_strands."""
        along = column("arclengths", arclengths, np.float64)
        start = None if origin is None else vector("origin", origin)
        if out is None:
            out = np.empty((len(along), 3), dtype=float_type("dtype", dtype))
        points = Output("out", out, (3, 4), len(along))
        frame = None if frames is None else Output("frames", frames, (7, 4, 3), len(along))
        velocity = None if velocities is None else Output("velocities", velocities, (3,), len(along))
        if transform is not None:
            definition = _capi.shx_sample_def()
            initialize(definition)
            if start is not None:
                definition.origin = (ctypes.c_double * 3)(*start)
            put_transform(definition, transform)
            self._call(
                functions.shx_solver_sample_at_with,
                self._strand(id),
                address(along),
                len(along),
                ctypes.byref(definition),
                ctypes.byref(points.view),
                _reference(frame),
                _reference(velocity),
            )
            return out
        self._call(
            functions.shx_solver_sample_at,
            self._strand(id),
            address(along),
            len(along),
            None if start is None else address(start),
            ctypes.byref(points.view),
            _reference(frame),
            _reference(velocity),
        )
        return out

    def root_wrenches(self, ids: StrandsLike = None, dtype: npt.DTypeLike = np.float64) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
        """Returns the forces (N) and torques about the roots (N m) that strands exerted on their follicles in the last step, world axes."""
        bits = self._strands(ids)
        forces, torques = (np.empty((len(bits), 3), dtype=float_type("dtype", dtype)) for _ in range(2))
        views = [Output("forces", forces, (3,), len(bits)).view, Output("torques", torques, (3,), len(bits)).view]
        self._call(functions.shx_solver_root_wrenches, address(bits), len(bits), ctypes.byref(views[0]), ctypes.byref(views[1]))
        return forces, torques
