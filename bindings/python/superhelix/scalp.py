"""Scalps: meshes on which follicles stand."""

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
    """A triangle mesh at rest, on which follicles stand. It never changes."""

    __slots__ = ()

    def __init__(
        self,
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike,
        *,
        uvs: npt.ArrayLike | None = None,
        reference_axis: npt.ArrayLike | None = None,
    ) -> None:
        """vertices: m; triangles: three indices each, anticlockwise seen from outside. uvs: texture coordinates of the three corners of each
        triangle, (triangles, 3, 2). reference_axis: without uvs, the axis that n1 follows as it lies on the scalp (default x).
        """
        view = input_rows("vertices", vertices)
        corners = column("triangles", triangles, np.uint32, width=3)
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
        """Scatters follicles over the scalp at rest, evenly: count of them, or so that no two are nearer than spacing, m. density: a relative density
        for each vertex, or a picture (rows from v = 0 on) over the texture coordinates. guide_roots: only where these points (m) cover the
        scalp, or no farther from them than max_guide_distance, m.
        """
        definition = _capi.shx_scatter_def()
        initialize(definition)
        definition.count, definition.spacing = whole("count", count, 0, 2**63), spacing
        definition.seed, definition.max_guide_distance = whole("seed", seed, 0, 2**64 - 1), max_guide_distance
        kept: list[Any] = []
        if density is not None:
            picture = np.asarray(density)
            kept.append(column("density", picture, np.float64))
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
        """The follicles at texture coordinates (u and v, a row each), each offset at random by up to jitter."""
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
        """The frames of follicles, rows of origin and quaternion: n0 is the scalp's normal. vertices: the scalp as it is now, m; None: at rest."""
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
