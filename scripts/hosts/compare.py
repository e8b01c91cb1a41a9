"""Whether the hosts' frames of the walk are the same numbers, for scripts/hosts.sh: compare.py FOLDER.

FOLDER has a folder for each host. Prints the farthest that points of one are from those of the other. Exits with 1 if frames differ by more than they may.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt

from superhelix.alembic import AlembicFile
from superhelix.usd import HairStage

FRAMES = 100
Points = npt.NDArray[np.float32]


def array(path: Path) -> Points:
    """What walk.py run kept."""
    return np.asarray(np.load(path), dtype=np.float32).reshape(FRAMES, -1, 3)


def usd(path: Path) -> Points:
    """Every frame of a cache in USD."""
    stage = HairStage(path, tolerance=None)
    return np.stack([stage.read(time).points for time in stage.times]).astype(np.float32)


def alembic(path: Path) -> Points:
    """Every frame of a cache in Alembic."""
    with AlembicFile(path) as file:
        return np.stack([file.read(time).points for time in file.times]).astype(np.float32)


#: Two files and how far their points may be apart, m. 0: they must be the same to the bit. The command line and Python round the head's frames in other
#: places, and contact amplifies that.
PAIRS: tuple[tuple[tuple[str, Callable[[Path], Points]], tuple[str, Callable[[Path], Points]], float], ...] = (
    (("python/points.npy", array), ("python/hair.usda", usd), 0.0),
    (("python/points.npy", array), ("usd/hair.usdc", usd), 0.0),
    (("python/points.npy", array), ("alembic/hair.abc", alembic), 0.0),
    (("python/points.npy", array), ("command_line/usda/hair.usda", usd), 3e-3),
    (("blender_5.0/hair.abc", alembic), ("blender_4.5/hair.abc", alembic), 0.0),
    (("blender_5.0/hair.usdc", usd), ("blender_4.5/hair.usdc", usd), 0.0),
)


def main(folder: Path) -> int:
    """Compares what is there."""
    differ = 0
    for (one, read_one), (other, read_other), most in PAIRS:
        if not (folder / one).exists() or not (folder / other).exists():
            print(f"{one}, {other}: left out: not there")
            continue
        first, second = read_one(folder / one), read_other(folder / other)
        if first.shape != second.shape:
            print(f"{one}, {other}: {first.shape} and {second.shape} numbers")
            differ += 1
            continue
        far = float(np.abs(first - second).max())
        same = first.tobytes() == second.tobytes()
        print(f"{one}, {other}: {len(first)} frames of {first.shape[1]} points, {'the same to the bit' if same else f'at most {1e3 * far:.2g} mm apart'}")
        differ += not same and (most == 0.0 or not far <= most)
    return 1 if differ else 0


if __name__ == "__main__":
    raise SystemExit(main(Path(sys.argv[1])))
