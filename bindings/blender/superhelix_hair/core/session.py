"""Frames in order: each is simulated once, and read from then on."""

from __future__ import annotations

import os
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import superhelix as shx

from .rest import FrameInputs, Rest
from .rig import Rig
from .settings import HairSettings
from .store import FrameStore

Positions = npt.NDArray[np.float32]


class CancelledError(Exception):
    """A step was cancelled. The session is where it was before it."""


class Session:
    """A rest, its solver and its frames. The first frame is the rest; a folder with frames of the same simulation is continued.

    The last frame has a snapshot, and every snapshot_every-th from the first on.
    """

    def __init__(
        self,
        rest: Rest,
        settings: HairSettings,
        *,
        folder: str | os.PathLike[str],
        frame_time: float,
        first: int = 1,
        snapshot_every: int = 1,
        memory_bytes: int = 256 << 20,
    ) -> None:
        if snapshot_every < 1:
            raise ValueError(f"snapshot_every: {snapshot_every}; at least 1 expected")
        identity: dict[str, object] = {
            "engine": shx.version(),
            "settings": settings.digest(),
            "scene": rest.digest(),
            "frame_time": frame_time,
        }
        self.store = FrameStore(folder, identity, len(rest.points), first, memory_bytes)
        self.rest, self.settings, self.first, self._every = rest, settings, first, snapshot_every
        #: What went on that is worth knowing, the latest last.
        self.notes: list[str] = []
        self.report: shx.StepReport | None = None
        self.rig = Rig(rest, settings, frame_time)
        #: The frame whose state the solver has.
        self.frame = first
        try:
            if len(self.store) == 0:
                self.store.append(self.rig.local_points(rest.inputs), self._snapshot())
            elif self.last > first:
                self._return_to_last()
                self.notes.append(f"continues after frame {self.last}, which was cached")
        except BaseException:
            self.rig.close()
            raise

    @property
    def last(self) -> int:
        """The last frame that is simulated."""
        return self.store.last

    def _snapshot(self) -> bytes:
        return self.rig.solver.snapshot(include_shapes=False)

    def positions(self, frame: int) -> Positions | None:
        """The positions of a frame, in the space of the curves; None if it is not simulated yet."""
        return self.store.read(frame)

    def _return_to_last(self) -> None:
        """Puts the solver at the last frame: by its snapshot, or by an earlier one, after which frames are simulated again."""
        for frame in range(self.last, self.first - 1, -1):
            image = self.store.snapshot(frame)
            if image is None:
                continue
            try:
                self.rig.restore(image)
            except shx.SuperhelixError as error:
                self.notes.append(f"the snapshot of frame {frame} cannot be used: {error}")
                continue
            if frame < self.last:
                self.notes.append(f"frames after {frame} are simulated again: frame {self.last} has no snapshot")
                self.store.drop_from(frame + 1)
            self.frame = frame
            return
        raise ValueError(f"cache folder {self.store.folder}: no snapshot can be used; free it")

    def advance(self, inputs: FrameInputs, cancel: shx.Cancel | None = None) -> Positions:
        """Simulates the frame after the last, at whose end the surroundings are as inputs say, and returns its positions."""
        self.rig.check(inputs)
        if self.frame != self.last:
            self._return_to_last()
        try:
            report = self.rig.step(inputs, cancel)
            if report.stop_reason == shx.StopReason.CANCELLED:
                raise CancelledError(f"frame {self.last + 1} was cancelled")
            positions = self.rig.local_points(inputs)
            if not np.all(np.isfinite(positions)):
                raise ValueError(f"frame {self.last + 1}: positions are not finite; is the curves' object scaled to nothing?")
            kept = (self.last - self.first) % self._every == 0
            self.frame = self.store.append(positions, self._snapshot(), keep_previous=kept)
        except BaseException:
            # Whatever stopped it, the next attempt starts from the last frame.
            self.frame = self.first - 1
            raise
        self.report = report
        if report.quarantined:
            self.notes.append(f"frame {self.frame}: {report.quarantined} strand steps diverged and were rolled back")
        if report.stop_reason == shx.StopReason.WORK:
            self.notes.append(f"frame {self.frame}: contact of {report.unfinished} curves was cut short at the limit of work, and looks rougher")
        return positions

    def go_back(self, frame: int) -> int:
        """Forgets the frames after a frame, or after the nearest one before it that has a snapshot; returns the one."""
        if not self.first <= frame <= self.last:
            raise ValueError(f"frame: {frame}; {self.first} to {self.last} expected")
        while frame > self.first and self.store.snapshot(frame) is None:
            frame -= 1
        self.store.drop_from(frame + 1)
        self.frame = self.first - 1
        self._return_to_last()
        return frame

    def run(self, to: int, inputs_at: Callable[[int], FrameInputs], cancel: shx.Cancel | None = None) -> None:
        """Simulates all frames up to a frame."""
        while self.last < to:
            self.advance(inputs_at(self.last + 1), cancel)

    def close(self) -> None:
        """Frees the solver. Frames stay on disk."""
        self.rig.close()
