"""Sintel's hair on a walk of a hundred frames, for scripts/hosts.sh: walk.py run|draw|scrub|bake FOLDER [FILE]."""

from __future__ import annotations

import random
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import superhelix as shx
from superhelix.groom import GroomSolver

GROOMS = Path(__file__).resolve().parents[2] / "tests" / "data" / "grooms"
FPS, FRAMES, EVERY, SUBSTEPS, POINTS = 24, 100, 10, 2, 32


def scene() -> tuple[shx.Groom, shx.BodyDef, shx.motion.Motion]:
    """Hair, bust and motion, m."""
    drawn = shx.Groom.read(GROOMS / "sintel_hair_001.tfx", scale=0.01)
    groom = shx.Groom(drawn.points, drawn.point_counts, drawn.up_axis)
    vertices, triangles = shx.read_obj_mesh(GROOMS / "sintel_bust.obj", 0.01)
    body = shx.BodyDef.grid(shx.bake_distance_grid(vertices, triangles, 0.005, 0.035))
    return groom, body, shx.motion_from_samples(*shx.read_motion(GROOMS / "walk_figure8_head.csv"))


def hair() -> shx.Material:
    """The hair that the command line takes by default: the type caucasian1."""
    row = shx.hair_strands(shx.hair_type("caucasian1"), [1], [0.1]).strands.data[0]
    names = ("radius", "density", "youngs_modulus", "poisson_ratio", "internal_friction", "viscosity", "air_drag")
    return shx.Material(**{name: row[name].tolist() for name in names})


def advance(made: GroomSolver, motion: shx.motion.Motion, frame: int) -> None:
    """Steps to a frame from the one before."""
    interval = 1.0 / (FPS * SUBSTEPS)
    for substep in range(SUBSTEPS):
        made.move_head(motion(0.0), motion(((frame - 1) * SUBSTEPS + substep + 1) * interval), interval)
        made.solver.step(interval)


def run(folder: Path) -> None:
    """Simulates, and keeps points and a snapshot each ten frames."""
    groom, body, motion = scene()
    with shx.prepare(groom, body=body, hair=hair(), motion=motion, worker_count=2) as made:
        rows, images = [], {}
        for frame in range(FRAMES):
            if frame:
                advance(made, motion, frame)
            rows.append(made.solver.sample_strands(POINTS, made.strands))
            if frame % EVERY == 0:
                images[frame] = made.solver.snapshot()
        np.save(folder / "points.npy", rows)
        for frame, image in images.items():
            (folder / f"{frame:03d}.snap").write_bytes(image)


def draw(folder: Path) -> None:
    """Draws a frame."""
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot

    from superhelix.plot import plot_curves

    plot_curves(np.load(folder / "points.npy")[-1])
    pyplot.savefig(folder / "walk.png")


def scrub(folder: Path) -> None:
    """Goes to frames at random: by what was kept, and by the nearest snapshot and the steps from there, which give the same points."""
    points = np.load(folder / "points.npy", mmap_mode="r")
    order = random.Random(1).sample(range(FRAMES), 20)
    began = time.perf_counter()
    kept = [np.array(points[frame]) for frame in order]
    print(f"kept points: {1e3 * (time.perf_counter() - began) / len(order):.2f} ms a frame")
    groom, body, motion = scene()
    with shx.prepare(groom, body=body, hair=hair(), motion=motion, worker_count=2) as made:
        began = time.perf_counter()
        for frame, there in zip(order, kept, strict=True):
            at = frame // EVERY * EVERY
            made.solver.restore((folder / f"{at:03d}.snap").read_bytes())
            made.strands, made.body = made.solver.strand_ids(), made.solver.body_ids()[0]
            for later in range(at + 1, frame + 1):
                advance(made, motion, later)
            if not np.array_equal(made.solver.sample_strands(POINTS, made.strands), there):
                raise SystemExit(f"walk.py: frame {frame} is not that of the straight run")
        print(f"snapshot and steps: {1e3 * (time.perf_counter() - began) / len(order):.0f} ms a frame; the points are those of the straight run to the bit")


def bake(folder: Path, name: str) -> None:
    """Writes a cache, and reads a frame of it."""
    groom, body, motion = scene()
    shx.simulate(
        groom,
        motion,
        duration=(FRAMES - 1) / FPS,
        fps=FPS,
        substeps=SUBSTEPS,
        points_per_strand=POINTS,
        cache=folder / name,
        body=body,
        hair=hair(),
        worker_count=2,
    )
    print(f"{name}: {(folder / name).stat().st_size / 1e6:.1f} MB")


def read(folder: Path, name: str) -> None:
    """Goes to frames of a cache at random."""
    order = random.Random(1).sample(range(FRAMES), 20)
    began = time.perf_counter()
    if name.endswith(".abc"):
        from superhelix.alembic import AlembicFile

        with AlembicFile(folder / name) as file:
            for frame in order:
                file.read(frame / FPS)
    else:
        from superhelix.usd import HairStage

        stage = HairStage(folder / name, tolerance=None)
        for frame in order:
            stage.read(frame / FPS)
    print(f"{name}: {1e3 * (time.perf_counter() - began) / len(order):.1f} ms a frame")


if __name__ == "__main__":
    what, where = sys.argv[1], Path(sys.argv[2])
    steps: dict[str, Callable[..., None]] = {"run": run, "draw": draw, "scrub": scrub, "bake": bake, "read": read}
    steps[what](where, *sys.argv[3:])
