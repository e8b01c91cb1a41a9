"""Frames and snapshots in a folder, written so that a crash leaves every file whole or absent.

The folder holds cache.json (what the frames belong to), 000001.npy (positions of a frame: float32, (points, 3), as Blender stores them) and
000001.snap (the engine's state after it). A frame counts if all frames since the first are there.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
from collections import OrderedDict
from pathlib import Path

import numpy as np
import numpy.typing as npt

Positions = npt.NDArray[np.float32]

FORMAT = 1
_OURS = re.compile(r"^(\d{6,}\.(npy|snap)|cache\.json)(\.\d+\.part)?$")
_NAME = re.compile(r"^(\d{6,})\.npy$")


class CacheMismatchError(ValueError):
    """A folder holds frames of another simulation."""


def _write(path: Path, data: bytes) -> None:
    """Writes a whole file or none, should this process end meanwhile."""
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        part.write_bytes(data)
        os.replace(part, path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def _encoded(positions: Positions) -> bytes:
    """An array as the bytes of a .npy file."""
    file = io.BytesIO()
    np.save(file, positions, allow_pickle=False)
    return file.getvalue()


class FrameStore:
    """The frames of one simulation. memory_bytes: how many bytes of positions stay in memory."""

    def __init__(self, folder: str | os.PathLike[str], identity: dict[str, object], point_count: int, first: int, memory_bytes: int = 256 << 20) -> None:
        if first < 0:
            raise ValueError(f"first: {first}; frames below 0 cannot be cached")
        self.folder, self.first, self.point_count = Path(folder), first, point_count
        self.identity = {"format": FORMAT, "first": first, "points": point_count, **identity}
        self._memory: OrderedDict[int, Positions] = OrderedDict()
        self._most = memory_bytes
        self.folder.mkdir(parents=True, exist_ok=True)
        self._claim()
        self.last = self._find_last()

    def _claim(self) -> None:
        """Writes what the frames belong to, or checks it."""
        path = self.folder / "cache.json"
        if not path.exists():
            if strange := [file.name for file in self.folder.iterdir() if _NAME.match(file.name)]:
                raise CacheMismatchError(f"cache folder {self.folder}: holds {strange[0]} but no cache.json; choose another folder")
            _write(path, json.dumps(self.identity, indent=1).encode())
            return
        try:
            found = json.loads(path.read_bytes())
        except ValueError as error:
            raise CacheMismatchError(f"cache folder {self.folder}: cache.json cannot be read: {error}") from None
        if not isinstance(found, dict) or found != self.identity:
            known = found if isinstance(found, dict) else {}
            other = [name for name in self.identity if known.get(name) != self.identity[name]]
            raise CacheMismatchError(
                f"cache folder {self.folder}: its frames belong to another simulation (other: {', '.join(other)}); free it, or choose another folder"
            )

    def _find_last(self) -> int:
        """The last frame without a gap before it; first - 1: none."""
        frames = {int(found[1]) for file in self.folder.iterdir() if (found := _NAME.match(file.name))}
        last = self.first - 1
        while last + 1 in frames:
            last += 1
        return last

    def __len__(self) -> int:
        return self.last - self.first + 1

    def path(self, frame: int, kind: str = "npy") -> Path:
        """The file of a frame."""
        return self.folder / f"{frame:06d}.{kind}"

    def append(self, positions: Positions, snapshot: bytes, *, keep_previous: bool = True) -> int:
        """Writes the next frame, and returns its number. The snapshot goes first, so that a frame that is there has its own. keep_previous: whether the
        snapshot of the frame before stays.
        """
        if positions.shape != (self.point_count, 3) or positions.dtype != np.float32:
            raise ValueError(f"positions: {positions.dtype} {positions.shape}; float32 ({self.point_count}, 3) expected")
        frame = self.last + 1
        _write(self.path(frame, "snap"), snapshot)
        _write(self.path(frame), _encoded(positions))
        self.last = frame
        if not keep_previous:
            self.path(frame - 1, "snap").unlink(missing_ok=True)
        self._keep(frame, positions)
        return frame

    def _keep(self, frame: int, positions: Positions) -> None:
        self._memory[frame] = positions
        self._memory.move_to_end(frame)
        while len(self._memory) > 1 and sum(array.nbytes for array in self._memory.values()) > self._most:
            self._memory.popitem(last=False)

    def read(self, frame: int) -> Positions | None:
        """The positions of a frame; None if it is not cached. A file that is damaged ends the cache before it, and raises ValueError."""
        if not self.first <= frame <= self.last:
            return None
        positions = self._memory.get(frame)
        if positions is None:
            try:
                positions = np.load(self.path(frame), allow_pickle=False)
                if positions.shape != (self.point_count, 3) or positions.dtype != np.float32:
                    raise ValueError(f"{positions.dtype} {positions.shape}")
            except (OSError, ValueError, EOFError) as error:
                self.drop_from(frame)
                raise ValueError(f"cache folder {self.folder}: frame {frame} is damaged ({error}); it and later frames have to be simulated again") from None
        self._keep(frame, positions)
        return positions

    def snapshot(self, frame: int) -> bytes | None:
        """The engine's state after a frame; None if there is no snapshot of it."""
        try:
            return self.path(frame, "snap").read_bytes() if self.first <= frame <= self.last else None
        except FileNotFoundError:
            return None

    def drop_from(self, frame: int) -> None:
        """Removes a frame and all later ones: the last first, so that no gap is left by a crash."""
        frame = max(frame, self.first)
        later = [int(found[1]) for file in self.folder.iterdir() if (found := _NAME.match(file.name))]
        for number in sorted((number for number in later if number >= frame), reverse=True):
            self.path(number).unlink(missing_ok=True)
            self.path(number, "snap").unlink(missing_ok=True)
            self._memory.pop(number, None)
        self.last = min(self.last, frame - 1)

    def size(self) -> int:
        """Bytes on disk."""
        return sum(file.stat().st_size for file in self.folder.iterdir())


def recorded(folder: str | os.PathLike[str]) -> FrameStore | None:
    """The frames that a folder holds, of whatever simulation, to look at; None if it holds none."""
    try:
        identity = json.loads((Path(folder) / "cache.json").read_bytes())
        points, first = identity.pop("points"), identity.pop("first")
        if identity.pop("format") != FORMAT:
            return None
        return FrameStore(folder, identity, points, first)
    except (OSError, ValueError, KeyError, AttributeError, TypeError):
        return None


def free(folder: str | os.PathLike[str]) -> int:
    """Removes the frames of a cache folder, of whatever simulation, and returns how many there were. Other files stay."""
    place, count = Path(folder), 0
    if not place.is_dir():
        return 0
    for file in sorted(place.iterdir(), reverse=True):
        if _OURS.match(file.name):
            count += file.suffix == ".npy"
            file.unlink()
    with contextlib.suppress(OSError):
        place.rmdir()
    return count
