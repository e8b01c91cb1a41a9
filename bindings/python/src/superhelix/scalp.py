"""Scalps: meshes with follicles."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._buffers import Output, address, as_rows, column, input_rows, vector, whole
from superhelix._handle import Owner, made
from superhelix._library import functions
from superhelix._record import initialize
from superhelix.errors import check
from superhelix.records import FollicleTable


class Scalp(Owner):
    """Triangle mesh at rest that carries follicles. Immutable."""

    __slots__ = ("vertex_count",)
    #: Number of vertices.
    vertex_count: int

    def __init__(
        self,
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike,
        *,
        uvs: npt.ArrayLike | None = None,
        reference_axis: npt.ArrayLike | None = None,
    ) -> None:
        """vertices: m; triangles: three indices each, anticlockwise seen from outside. uvs: texture coordinates of the three corners of each
        triangle, (triangles, 3, 2). reference_axis: without uvs, the axis that n1 follows, projected on the scalp (default x).
        """
        view = input_rows("vertices", vertices)
        corners = column("triangles", triangles, np.uint32, width=3)
        self.vertex_count = int(view.count)
        definition = _capi.shx_scalp_def()
        initialize(definition)
        definition.vertices = view
        definition.triangles, definition.triangle_count = address(corners), len(corners)
        coordinates = None
        if uvs is not None:
            coordinates = column("uvs", uvs, np.float64, 3 * len(corners), 2)
            definition.uvs = address(coordinates)
        if reference_axis is not None:
            definition.reference_axis = (ctypes.c_double * 3)(*vector("reference_axis", reference_axis))
        self._open = made(functions.shx_scalp_destroy, lambda out: functions.shx_scalp_create(ctypes.byref(definition), out), None)
        del coordinates

    def scatter(
        self,
        count: int = 0,
        *,
        spacing: float = 0.0,
        density: npt.ArrayLike | None = None,
        seed: int = 0,
        guide_roots: npt.ArrayLike | None = None,
        max_guide_distance: float = 0.0,
    ) -> FollicleTable:
        """Scatters follicles evenly over the scalp at rest: count of them, or with a minimum distance of spacing, m. density: a relative density for
        each vertex, or an image (rows from v = 0) over the texture coordinates. guide_roots: points (m); follicles only where these cover the
        scalp, or within max_guide_distance (m) of one.
        """
        definition = _capi.shx_scatter_def()
        initialize(definition)
        definition.count, definition.spacing = whole("count", count, 0, 2**63), spacing
        definition.seed, definition.max_guide_distance = whole("seed", seed, 0, 2**64 - 1), max_guide_distance
        kept: list[Any] = []
        if density is not None:
            picture = np.asarray(density)
            if picture.ndim not in (1, 2):
                raise ValueError(f"density: shape {picture.shape}; ({self.vertex_count},) or (rows, pixels) expected")
            # A density for each vertex has no count of its own.
            kept.append(column("density", picture, np.float64, self.vertex_count if picture.ndim == 1 else None))
            definition.density = address(kept[-1])
            if picture.ndim == 2:
                definition.density_height, definition.density_width = picture.shape
        if guide_roots is not None:
            kept.append(input_rows("guide_roots", guide_roots))
            definition.guide_roots = kept[-1]
        number = ctypes.c_size_t()
        self._scatter(definition, None, 0, number)
        table = FollicleTable._zeros(number.value)
        self._scatter(definition, address(table.data), len(table), number)
        return table[: number.value]

    def _scatter(self, definition: Any, place: int | None, room: int, number: ctypes.c_size_t) -> None:
        check(functions.shx_scalp_scatter(self._handle, ctypes.byref(definition), place, room, ctypes.byref(number), None))

    def follicles_at_uvs(self, uvs: npt.ArrayLike, jitter: float = 0.0, seed: int = 0) -> FollicleTable:
        """Returns the follicles at texture coordinates (u and v, one row each), offset at random by up to jitter."""
        coordinates = column("uvs", uvs, np.float64, width=2)
        table = FollicleTable._zeros(len(coordinates))
        check(
            functions.shx_scalp_follicles_at_uvs(
                self._handle,
                address(coordinates),
                len(coordinates),
                jitter,
                whole("seed", seed, 0, 2**64 - 1),
                address(table.data),
            )
        )
        return table

    def root_frames(self, follicles: FollicleTable, vertices: npt.ArrayLike | None = None) -> npt.NDArray[np.float64]:
        """Returns the frames of follicles, rows of origin and quaternion; n0 is the normal of the scalp. vertices: the deformed scalp, m; None: at rest."""
        data = np.ascontiguousarray(follicles.data)
        view = None if vertices is None else input_rows("vertices", as_rows("vertices", vertices))
        frames = np.empty((len(data), 7))
        output = Output("frames", frames, (7,), len(data))
        check(
            functions.shx_scalp_root_frames(
                self._handle,
                None if view is None else ctypes.byref(view),
                address(data),
                len(data),
                ctypes.byref(output.view),
            )
        )
        return frames
