"""Definitions of bodies, and baking of distance grids."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix import _capi, records
from superhelix._buffers import address, column, input_rows
from superhelix._library import functions
from superhelix._record import initialize
from superhelix.enums import Shape, Sides
from superhelix.errors import check
from superhelix.ids import BodyId


class BodyDef(records.BodyDef):
    """Definition of a body: create it with sphere, capsule, ellipsoid, box, half_space, hull, mesh, grid or shared.

    All of these take, beside the arguments of the shape: pose (a Frame), thickness (distance of the surface from the shape, m), friction_scale and
    viscous_friction_scale (factors on the strands' coefficients), groups and mask (collision groups, bits).
    """

    __slots__ = ("_arrays",)
    _arrays: list[Any]

    def __init__(self, **fields: Any) -> None:
        super().__init__(**fields)
        self._arrays = []

    @classmethod
    def sphere(cls, radius: float, **surface: Any) -> BodyDef:
        """A sphere about the body's origin. radius: m."""
        return cls(shape=Shape.SPHERE, radius=radius, **surface)

    @classmethod
    def capsule(cls, a: Sequence[float], b: Sequence[float], radius: float, **surface: Any) -> BodyDef:
        """All points within radius of the segment from a to b, m, the body's axes."""
        return cls(shape=Shape.CAPSULE, a=a, b=b, radius=radius, **surface)

    @classmethod
    def ellipsoid(cls, semi_axes: Sequence[float], **surface: Any) -> BodyDef:
        """An ellipsoid about the body's origin. semi_axes: m, along the body's axes."""
        return cls(shape=Shape.ELLIPSOID, semi_axes=semi_axes, **surface)

    @classmethod
    def box(cls, half_extents: Sequence[float], **surface: Any) -> BodyDef:
        """A box about the body's origin. half_extents: half its edges, m, along the body's axes."""
        return cls(shape=Shape.BOX, half_extents=half_extents, **surface)

    @classmethod
    def half_space(cls, normal: Sequence[float] = (0.0, 0.0, 1.0), **surface: Any) -> BodyDef:
        """All that lies behind the plane through the body's origin across normal, which points out of it."""
        return cls(shape=Shape.HALF_SPACE, normal=normal, **surface)

    @classmethod
    def hull(cls, vertices: npt.ArrayLike, **surface: Any) -> BodyDef:
        """The convex hull of vertices, m, the body's axes."""
        body = cls(shape=Shape.HULL, **surface)
        body._put_vertices(vertices)
        return body

    @classmethod
    def mesh(
        cls,
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike,
        sides: Sides = Sides.SOLID,
        depth: float | None = None,
        **surface: Any,
    ) -> BodyDef:
        """A triangle mesh, which may deform. vertices: m, the body's axes; triangles: three indices each, anticlockwise seen from outside. depth:
        with Sides.FRONT, how far behind its triangles it acts, m.
        """
        body = cls(shape=Shape.MESH, sides=sides, depth=depth, **surface)
        body._put_vertices(vertices)
        corners = column("triangles", triangles, np.uint32, width=3)
        body._arrays.append(corners)
        body._c.triangles, body._c.triangle_count = address(corners), len(corners)
        return body

    @classmethod
    def grid(cls, grid: bytes, **surface: Any) -> BodyDef:
        """A signed distance grid, as bake_distance_grid makes it. Cheap for large meshes that do not deform."""
        body = cls(shape=Shape.GRID, **surface)
        data = np.frombuffer(grid, dtype=np.uint8)
        body._arrays.append(data)
        body._c.grid, body._c.grid_size = address(data), len(data)
        return body

    @classmethod
    def shared(cls, shape_of: BodyId, **surface: Any) -> BodyDef:
        """The current shape of another body of the solver."""
        return cls(shape=Shape.SHARED, shape_of=shape_of, **surface)

    def _put_vertices(self, vertices: npt.ArrayLike) -> None:
        view = input_rows("vertices", vertices, (3,))
        self._arrays.append(view)
        self._c.vertices = view

    def copy(self, **changes: object) -> BodyDef:
        """A copy, with some fields changed. It shares the arrays."""
        other = super().copy(**changes)
        other._arrays = self._arrays
        return other

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a BodyDef cannot be pickled: it points to arrays")


def bake_distance_grid(vertices: npt.ArrayLike, triangles: npt.ArrayLike, cell: float, band: float) -> bytes:
    """Bakes a mesh into a signed distance grid, for BodyDef.grid: its distances at the nodes of a lattice of cell metres that reaches at least
    band metres beyond it. vertices: m; triangles: three indices each, anticlockwise seen from outside. The mesh need not be closed. The bytes
    may be kept in a file; they are the same on every machine.
    """
    view = input_rows("vertices", vertices, (3,))
    corners = column("triangles", triangles, np.uint32, width=3)
    definition = _capi.shx_distance_grid_def()
    initialize(definition)
    definition.vertices = view
    definition.triangles, definition.triangle_count = address(corners), len(corners)
    definition.cell, definition.band = cell, band
    size = ctypes.c_size_t()
    check(functions.shx_distance_grid_bake(ctypes.byref(definition), None, 0, ctypes.byref(size)))
    grid = ctypes.create_string_buffer(size.value)
    check(functions.shx_distance_grid_bake(ctypes.byref(definition), grid, size.value, ctypes.byref(size)))
    return grid.raw[: size.value]
