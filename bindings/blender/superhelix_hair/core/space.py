"""Matrices to frames, and roots on a surface."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import superhelix as shx

Numbers = npt.NDArray[np.float64]


def transformed(matrix: npt.ArrayLike, points: npt.ArrayLike) -> Numbers:
    """Points moved by a 4x4 matrix that acts on columns."""
    m, rows = np.asarray(matrix, dtype=np.float64), np.asarray(points, dtype=np.float64)
    return np.asarray(rows @ m[:3, :3].T + m[:3, 3])


def polar(matrix: npt.ArrayLike) -> tuple[Numbers, Numbers]:
    """A 4x4 matrix as a frame, and the stretch (3x3, symmetric) that comes before it. Raises ValueError for a matrix that mirrors or flattens."""
    m = np.asarray(matrix, dtype=np.float64)
    left, sizes, right = np.linalg.svd(m[:3, :3])
    if not np.all(np.isfinite(m)) or sizes[2] < 1e-9 * sizes[0] or np.linalg.det(m[:3, :3]) <= 0.0:
        raise ValueError("scale: the matrix mirrors or flattens; apply the scale")
    frame = np.concatenate([m[:3, 3], shx.frames.quaternions(left @ right)])
    return frame, np.asarray(right.T @ np.diag(sizes) @ right)


def relative(carriers: npt.ArrayLike, frames: npt.ArrayLike) -> Numbers:
    """Frames in the axes of their carriers: shx.frames.moved(carriers, relative(carriers, frames)) gives the frames back."""
    carrier, frame = np.asarray(carriers, dtype=np.float64), np.asarray(frames, dtype=np.float64)
    back = carrier[..., 3:] * [-1.0, -1.0, -1.0, 1.0]
    origins = shx.frames.rotate(back, frame[..., :3] - carrier[..., :3])
    return np.concatenate([origins, shx.frames.multiply(back, frame[..., 3:])], axis=-1)


def barycentric(points: npt.ArrayLike, corners: npt.ArrayLike) -> Numbers:
    """Weights of the second and the third corner for points in triangles, (n, 2), kept inside them."""
    p, c = np.asarray(points, dtype=np.float64), np.asarray(corners, dtype=np.float64)
    one, two, to = c[:, 1] - c[:, 0], c[:, 2] - c[:, 0], p - c[:, 0]
    a, b, d = (one * one).sum(1), (one * two).sum(1), (two * two).sum(1)
    e, f = (to * one).sum(1), (to * two).sum(1)
    area = np.maximum(a * d - b * b, 1e-300)
    weights = np.clip(np.stack([(d * e - b * f) / area, (a * f - b * e) / area], axis=1), 0.0, 1.0)
    return np.asarray(weights / np.maximum(weights.sum(1, keepdims=True), 1.0))


class Attachment:
    """Roots on triangles of a mesh that moves and deforms, and may not change its number of vertices or triangles."""

    def __init__(self, name: str, vertices: Numbers, triangles: npt.NDArray[np.uint32], follicles: Any, uvs: Numbers | None = None) -> None:
        self.name = name
        self.follicles = follicles
        self.vertex_count, self.triangle_count = len(vertices), len(triangles)
        self._scalp = shx.Scalp(vertices, triangles, uvs=uvs)

    @classmethod
    def by_uvs(cls, name: str, vertices: Numbers, triangles: npt.NDArray[np.uint32], corner_uvs: Numbers, uvs: Numbers) -> Attachment:
        """Roots at texture coordinates. corner_uvs: (triangles, 3, 2)."""
        with shx.Scalp(vertices, triangles, uvs=corner_uvs) as scalp:
            follicles = scalp.follicles_at_uvs(uvs)
        return cls(name, vertices, triangles, follicles, corner_uvs)

    @classmethod
    def by_places(cls, name: str, vertices: Numbers, triangles: npt.NDArray[np.uint32], places: npt.ArrayLike, points: npt.ArrayLike) -> Attachment:
        """Roots at points near the triangles of these indices."""
        which = np.asarray(places, dtype=np.int64)
        table = np.zeros(len(which), dtype=np.dtype(shx.records.FollicleTable._STRUCT))
        table["triangle"] = which
        table["barycentric"] = barycentric(points, vertices[triangles[which]])
        return cls(name, vertices, triangles, shx.records.FollicleTable(table))

    def frames(self, vertices: Numbers, triangle_count: int) -> Numbers:
        """Frames of the roots on the mesh as it is now, (roots, 7)."""
        if len(vertices) != self.vertex_count or triangle_count != self.triangle_count:
            raise ValueError(
                f"surface {self.name}: {len(vertices)} vertices and {triangle_count} triangles, where the first frame has {self.vertex_count} and "
                f"{self.triangle_count}; a modifier changes them: turn it off, or move it before the simulation starts"
            )
        return self._scalp.root_frames(self.follicles, vertices)

    def close(self) -> None:
        """Frees the mesh."""
        self._scalp.close()
