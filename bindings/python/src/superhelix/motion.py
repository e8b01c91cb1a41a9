"""Motions of a head: frames over time."""

from __future__ import annotations

import csv
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix import frames as turned
from superhelix._buffers import column, frame_rows
from superhelix.curves import Path

Numbers = npt.NDArray[np.float64]

#: A head's motion: the head's frame (origin, m, and quaternion x, y, z, w) at a time, s.
Motion = Callable[[float], npt.ArrayLike]


def still(_time: float) -> Numbers:
    """Motion of a head at rest."""
    return np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])


def motion_from_samples(times: npt.ArrayLike, poses: Any) -> Motion:
    """Creates a motion through frames at times (s, ascending): linear between them, constant outside."""
    moments = column("times", times, np.float64)
    rows = np.array(frame_rows("poses", poses).reshape(-1, 7))
    if len(rows) != len(moments) or len(rows) == 0 or np.any(np.diff(moments) <= 0.0):
        raise ValueError(f"times: {len(moments)} times for {len(rows)} poses; as many, ascending, expected")
    # The shorter rotation from each to the next.
    for place in range(1, len(rows)):
        if rows[place, 3:] @ rows[place - 1, 3:] < 0.0:
            rows[place, 3:] *= -1.0

    def motion(time: float) -> Numbers:
        row = np.array([np.interp(time, moments, rows[:, axis]) for axis in range(7)])
        row[3:] /= np.linalg.norm(row[3:])
        return row

    return motion


def read_motion(path: Path) -> tuple[Numbers, Numbers]:
    """Reads times (s) and frames from a .csv with columns time_s, px_m, py_m, pz_m, qx, qy, qz, qw in any order. Pass them to
    motion_from_samples.
    """
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    names = [name.strip() for name in rows[0]]
    wanted = ("time_s", "px_m", "py_m", "pz_m", "qx", "qy", "qz", "qw")
    if missing := [name for name in wanted if name not in names]:
        raise ValueError(f"{path}: no columns {', '.join(missing)} among {', '.join(names)}")
    columns = [names.index(name) for name in wanted]
    numbers = np.array([[float(row[place]) for place in columns] for row in rows[1:] if row])
    return numbers[:, 0], numbers[:, 1:]


def carried(start: npt.ArrayLike, now: npt.ArrayLike, pivot: npt.ArrayLike) -> Numbers:
    """Returns the frame that maps the groom's axes to the world when the head moves from start to now about its joint at pivot, m."""
    before, after, joint = np.asarray(start, float), np.asarray(now, float), np.asarray(pivot, float)
    turn = turned.multiply(after[3:], before[3:] * [-1.0, -1.0, -1.0, 1.0])
    return np.concatenate([joint + after[:3] - before[:3] - turned.rotate(turn, joint), turn])
