"""Motions of a head: frames over time."""

from __future__ import annotations

import csv
import ctypes
from collections.abc import Callable, Iterator
from typing import Any, Literal, overload

import numpy as np
import numpy.typing as npt

from superhelix import frames as turned
from superhelix._buffers import Output, address, column, frame_rows, input_rows
from superhelix._library import functions
from superhelix.curves import Path
from superhelix.errors import check

Numbers = npt.NDArray[np.float64]

#: A head's motion: the head's frame (origin, m, and quaternion x, y, z, w) at a time, s. One with a method velocity(time), as SmoothMotion has,
#: also says how fast the head is where a simulation starts.
Motion = Callable[[float], npt.ArrayLike]


def still(_time: float) -> Numbers:
    """Motion of a head at rest."""
    return np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])


class SmoothMotion:
    """Motion through frames at times, cubic between them: continuous in velocity and angular velocity, exact at the frames, constant before the first
    and after the last. The command line moves heads, bodies and tools in the same way. Created by motion_from_samples; call it with a time, s, for the
    frame, or with an array of times for a row each.
    """

    __slots__ = ("_poses", "_times")

    def __init__(self, times: npt.ArrayLike, poses: Any) -> None:
        self._times, self._poses = _samples(times, poses)
        self(self._times[0])  # refuses poses that cannot be

    def __call__(self, time: npt.ArrayLike) -> Numbers:
        """The frame at a time, s, or a row for each of an array of times."""
        return self._sample(time, (7,))[0]

    def velocity(self, time: npt.ArrayLike) -> tuple[Numbers, Numbers]:
        """Velocity of the origin (m/s) and angular velocity (rad/s), world axes, at a time, s, or rows for an array of times. Zero outside the
        samples' times; at the first and the last, one-sided.
        """
        linear, angular = self._sample(time, (3, 3))
        return linear, angular

    def _sample(self, time: npt.ArrayLike, widths: tuple[int, ...]) -> list[Numbers]:
        """The frames, or the velocities and angular velocities, at times."""
        moments = column("time", time, np.float64)
        shape = np.shape(time)
        poses = input_rows("poses", self._poses, (7,))
        arrays = [np.empty((*shape, width)) for width in widths]
        outputs = [Output("out", array.reshape(-1, array.shape[-1]), (array.shape[-1],), len(moments)) for array in arrays]
        views = [ctypes.byref(output.view) for output in outputs]
        asked = (*views, None, None) if widths == (7,) else (None, *views)
        check(functions.shx_sample_motion(address(self._times), ctypes.byref(poses), address(moments), len(moments), *asked))
        return arrays


@overload
def motion_from_samples(times: npt.ArrayLike, poses: Any) -> SmoothMotion: ...
@overload
def motion_from_samples(times: npt.ArrayLike, poses: Any, *, interpolation: Literal["smooth"]) -> SmoothMotion: ...
@overload
def motion_from_samples(times: npt.ArrayLike, poses: Any, *, interpolation: Literal["linear"]) -> Motion: ...
def motion_from_samples(times: npt.ArrayLike, poses: Any, *, interpolation: Literal["smooth", "linear"] = "smooth") -> Motion:
    """Creates a motion through frames at times (s, ascending), constant outside. Frames that follow each other must be less than half a turn apart.

    interpolation: "smooth" gives a SmoothMotion: simulate then starts with the motion's velocity, as the command line does. "linear" goes straight
    from frame to frame; simulate then starts from rest.
    """
    if interpolation == "smooth":
        return SmoothMotion(times, poses)
    if interpolation != "linear":
        raise ValueError(f"interpolation: {interpolation!r}; 'smooth' or 'linear' expected")
    moments, rows = _samples(times, poses)
    # The shorter rotation from each to the next.
    for place in range(1, len(rows)):
        if rows[place, 3:] @ rows[place - 1, 3:] < 0.0:
            rows[place, 3:] *= -1.0

    def motion(time: float) -> Numbers:
        row = np.array([np.interp(time, moments, rows[:, axis]) for axis in range(7)])
        row[3:] /= np.linalg.norm(row[3:])
        return row

    return motion


def frames_at(motion: Motion, times: npt.NDArray[np.floating[Any]]) -> Iterator[npt.ArrayLike]:
    """Iterates over a motion's frames at times, s."""
    return iter(motion(times)) if isinstance(motion, SmoothMotion) else map(motion, times.tolist())


def _samples(times: npt.ArrayLike, poses: Any) -> tuple[Numbers, Numbers]:
    """Copies of times and frames: as many, ascending, at least one."""
    moments = np.array(column("times", times, np.float64))
    rows = np.array(frame_rows("poses", poses).reshape(-1, 7))
    if len(rows) != len(moments) or len(rows) == 0 or not np.all(np.diff(moments) > 0.0):
        raise ValueError(f"times: {len(moments)} times for {len(rows)} poses; as many, ascending, expected")
    return moments, rows


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
    turn, joint, place = _turned(start, now, pivot)
    return np.concatenate([place + turned.rotate(turn, -joint), turn])


def carried_roots(start: npt.ArrayLike, now: npt.ArrayLike, pivot: npt.ArrayLike, roots: npt.ArrayLike) -> Numbers:
    """Returns where frames of the groom (rows) are when the head moves from start to now about its joint at pivot, m."""
    turn, joint, place = _turned(start, now, pivot)
    rows = np.asarray(roots, float)
    origins = place + turned.rotate(turn, rows[:, :3] - joint)
    return np.concatenate([origins, turned.multiply(np.broadcast_to(turn, (len(rows), 4)), rows[:, 3:])], axis=1)


def _turned(start: npt.ArrayLike, now: npt.ArrayLike, pivot: npt.ArrayLike) -> tuple[Numbers, Numbers, Numbers]:
    """How a head turns from start to now, and where its joint was and is."""
    before, after, joint = np.asarray(start, float), np.asarray(now, float), np.asarray(pivot, float)
    turn = turned.multiply(after[3:], before[3:] * [-1.0, -1.0, -1.0, 1.0])
    return turn, joint, joint + after[:3] - before[:3]


def root_velocities(motion: Motion, time: float, pivot: npt.ArrayLike, origins: npt.ArrayLike) -> tuple[Numbers, Numbers]:
    """Returns velocities (m/s) and angular velocities (rad/s) of roots at origins (m, rows) on a head with its joint at pivot, m: zero for a motion
    without a method velocity.
    """
    places = np.asarray(origins, float)
    of_head = getattr(motion, "velocity", None)
    if of_head is None:
        return np.zeros_like(places), np.zeros_like(places)
    velocity, spin = (np.asarray(value, float) for value in of_head(time))
    turning = np.broadcast_to(spin, places.shape)
    return velocity + np.cross(turning, places - np.asarray(pivot, float)), np.array(turning)
