"""Frames: rows of origin (m) and unit quaternion x, y, z, w. A frame's rotation turns the axes into n0 (along the strand), n1 and n2."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Rows = npt.NDArray[np.float64]


def frames(origins: npt.ArrayLike, rotations: npt.ArrayLike = (0.0, 0.0, 0.0, 1.0)) -> Rows:
    """Frames with these origins (m, (..., 3)) and quaternions x, y, z, w (one for all, or one each)."""
    places = np.asarray(origins, dtype=np.float64)
    turns = np.broadcast_to(np.asarray(rotations, dtype=np.float64), (*places.shape[:-1], 4))
    return np.concatenate([places, turns], axis=-1)


def frames_along(origins: npt.ArrayLike, directions: npt.ArrayLike, reference: npt.ArrayLike = (0.0, 0.0, 1.0)) -> Rows:
    """Frames whose n0 is along directions (any length above zero), and whose n1 is as near to reference as that allows."""
    places = np.asarray(origins, dtype=np.float64)
    n0 = np.broadcast_to(_unit("directions", directions), places.shape)
    toward = np.broadcast_to(_unit("reference", reference), places.shape)
    n1 = toward - n0 * np.sum(toward * n0, axis=-1, keepdims=True)
    # Where the reference is along the strand, the axis that is least along it has to do.
    axis = np.eye(3)[np.argmin(np.abs(n0), axis=-1)]
    other = axis - n0 * np.sum(axis * n0, axis=-1, keepdims=True)
    n1 = np.where(np.linalg.norm(n1, axis=-1, keepdims=True) < 1e-6, other, n1)
    n1 /= np.linalg.norm(n1, axis=-1, keepdims=True)
    return frames(places, quaternions(np.stack([n0, n1, np.cross(n0, n1)], axis=-1)))


def _unit(name: str, vectors: npt.ArrayLike) -> Rows:
    rows = np.asarray(vectors, dtype=np.float64)
    lengths = np.linalg.norm(rows, axis=-1, keepdims=True)
    if rows.shape[-1:] != (3,) or not np.all(lengths > 0.0):
        raise ValueError(f"{name}: rows of three numbers of a length above zero expected")
    return np.asarray(rows / lengths)


def quaternions(matrices: npt.ArrayLike) -> Rows:
    """Quaternions x, y, z, w of rotation matrices (..., 3, 3), whose columns are n0, n1, n2."""
    m = np.asarray(matrices, dtype=np.float64)
    xx, yy, zz = m[..., 0, 0], m[..., 1, 1], m[..., 2, 2]
    # Four times the square of each component; the largest is safe to divide by.
    squares = np.stack([1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz, 1 + xx + yy + zz], axis=-1)
    ab, ac, bc = m[..., 0, 1] + m[..., 1, 0], m[..., 0, 2] + m[..., 2, 0], m[..., 1, 2] + m[..., 2, 1]
    wa, wb, wc = m[..., 2, 1] - m[..., 1, 2], m[..., 0, 2] - m[..., 2, 0], m[..., 1, 0] - m[..., 0, 1]
    candidates = np.stack(
        [
            np.stack([squares[..., 0], ab, ac, wa], axis=-1),
            np.stack([ab, squares[..., 1], bc, wb], axis=-1),
            np.stack([ac, bc, squares[..., 2], wc], axis=-1),
            np.stack([wa, wb, wc, squares[..., 3]], axis=-1),
        ],
        axis=-2,
    )
    best = np.argmax(squares, axis=-1)[..., None, None]
    chosen = np.take_along_axis(candidates, np.broadcast_to(best, (*best.shape[:-1], 4)), axis=-2)[..., 0, :]
    return np.asarray(chosen / np.linalg.norm(chosen, axis=-1, keepdims=True))


def from_axis_angle(axis: npt.ArrayLike, angle: npt.ArrayLike) -> Rows:
    """Quaternions x, y, z, w of turns by angles (rad) about an axis."""
    half = 0.5 * np.asarray(angle, dtype=np.float64)[..., None]
    return np.concatenate([_unit("axis", axis) * np.sin(half), np.cos(half)], axis=-1)


def rotate(rotations: npt.ArrayLike, vectors: npt.ArrayLike) -> Rows:
    """Vectors turned by quaternions x, y, z, w."""
    q, v = np.asarray(rotations, dtype=np.float64), np.asarray(vectors, dtype=np.float64)
    twice = 2.0 * np.cross(q[..., :3], v)
    # In the library's order, so that the bits are the same.
    return np.asarray(twice * q[..., 3:] + np.cross(q[..., :3], twice) + v)


def multiply(left: npt.ArrayLike, right: npt.ArrayLike) -> Rows:
    """Products of quaternions x, y, z, w: the turn right, then the turn left."""
    ax, ay, az, aw = np.moveaxis(np.asarray(left, dtype=np.float64), -1, 0)
    bx, by, bz, bw = np.moveaxis(np.asarray(right, dtype=np.float64), -1, 0)
    # In the library's order, so that the bits are the same.
    x = aw * bx + ax * bw + ay * bz - az * by
    y = aw * by - ax * bz + ay * bw + az * bx
    z = aw * bz + ax * by - ay * bx + az * bw
    return np.stack([x, y, z, aw * bw - ax * bx - ay * by - az * bz], axis=-1)


def moved(motion: npt.ArrayLike, local: npt.ArrayLike) -> Rows:
    """Frames that go with a moving one: local frames, given in the axes of motion (a frame, or one for each)."""
    carrier, frame = np.asarray(motion, dtype=np.float64), np.asarray(local, dtype=np.float64)
    turn = carrier[..., 3:]
    origins = carrier[..., :3] + rotate(turn, frame[..., :3])
    turns = multiply(np.broadcast_to(turn, (*origins.shape[:-1], 4)), frame[..., 3:])
    return np.concatenate([origins, turns], axis=-1)
