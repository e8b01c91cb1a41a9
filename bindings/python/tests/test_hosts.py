"""The same hair in different hosts: the command line, a C program and Python give the same positions. (Blender: bindings/blender/tests.)

The engine gives the same bits for the same bits. Each host turns roots about the head by formulas of its own, so that here and there the last bit differs.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import GROOMS, ROOT

import superhelix as shx

BINARY = os.environ.get("SUPERHELIX_BINARY")
LIBRARY = os.environ.get("SUPERHELIX_LIBRARY")
FPS, SUBSTEPS, SECONDS = 24, 2, 1.0


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with some of Sintel's hair and her bust in metres, and the recorded walk from rest, a pose for each step.

    The C program goes straight from pose to pose, so there is nothing to interpolate.
    """
    folder = tmp_path_factory.mktemp("hosts")
    groom = shx.Groom.read(GROOMS / "sintel_hair_001.tfx", scale=0.01, every=8)
    shx.write_curves(folder / "hair.hair", groom.points.astype(np.float32), groom.point_counts)
    vertices, faces = shx.read_obj_mesh(GROOMS / "sintel_bust.obj", 0.01)
    with open(folder / "bust.obj", "w", encoding="utf-8") as file:
        file.writelines("v {} {} {}\n".format(*(repr(float(number)) for number in row)) for row in vertices)
        file.writelines("f {} {} {}\n".format(*(row + 1)) for row in faces)
    walk = shx.motion_from_samples(*shx.read_motion(GROOMS / "walk_figure8_head.csv"))
    with open(folder / "walk.csv", "w", encoding="utf-8") as file:
        file.write("time_s,px_m,py_m,pz_m,qw,qx,qy,qz\n")
        for step in range(int(SECONDS * FPS * SUBSTEPS) + 2):
            time = step / (FPS * SUBSTEPS)
            # A quarter of a second at rest, then up to speed in half a second.
            late = max(time - 0.25, 0.0)
            x, y, z, qx, qy, qz, qw = walk(late**2 if late < 0.5 else late - 0.25)
            file.write(",".join(repr(float(number)) for number in (time, x, y, z, qw, qx, qy, qz)) + "\n")
    return folder


def frames_of(folder: Path, name: str, first: int, count: int) -> list[np.ndarray]:
    """Points of the .hair files of frames."""
    rows = []
    for frame in range(count):
        with shx.Curves(folder / f"{name}.{frame + first:04d}.hair") as curves:
            rows.append(curves.points())
    return rows


def alike(one: np.ndarray, other: np.ndarray, below: float = 1e-7) -> None:
    """Single-precision numbers in m that are equal but for a last bit of one in twenty. (From 1 to 2 m a last bit is 1.2e-7.)"""
    assert one.dtype == other.dtype == np.float32
    assert np.abs(one - other).max() < below and (one == other).mean() > 0.95


@pytest.mark.skipif(BINARY is None, reason="SUPERHELIX_BINARY names no superhelix program")
@pytest.mark.parametrize("start", [None, 1.0])
def test_command_line(scene: Path, tmp_path: Path, start: float | None) -> None:
    """superhelix simulate and superhelix.simulate: wisps with contact on a bust that walks, from rest, or from the middle of the recorded walk, whose
    poses are at other times than steps.
    """
    walk = scene / "walk.csv" if start is None else GROOMS / "walk_figure8_head.csv"
    hair = shx.Material(internal_friction=1e-10, air_drag=5e-6)
    flags = "--radius 5e-5 --ellipticity 1 --density 1300 --youngs-modulus 2e9 --poisson-ratio 0.48 --internal-friction 1e-10 --viscosity 0 --air-drag 5e-6"
    command = [BINARY, "simulate", scene / "hair.hair", "--scale", "1", "--motion", walk, "--body", scene / "bust.obj", "--body-cell", "0.005"]
    command += [*flags.split(), *f"--duration {SECONDS} --fps {FPS} --substeps {SUBSTEPS} --samples 24 --format hair --out".split(), tmp_path / "out"]
    command += [] if start is None else ["--start", start]
    subprocess.run([str(word) for word in command], check=True, capture_output=True, cwd=tmp_path)
    groom = shx.Groom.read(scene / "hair.hair", scale=1.0)
    body = shx.BodyDef.grid(shx.bake_distance_grid(*shx.read_obj_mesh(scene / "bust.obj"), 0.005, 0.03))
    times, poses = shx.read_motion(walk)
    motion, begin = shx.motion_from_samples(times, poses), float(times[0]) + (start or 0.0)
    done = shx.simulate(groom, motion, start=begin, duration=SECONDS, fps=FPS, substeps=SUBSTEPS, points_per_strand=24, body=body, hair=hair)
    there = frames_of(tmp_path / "out", "hair", 1, len(done.times))
    assert np.linalg.norm(done.points[-1] - done.points[0], axis=-1).max() > 0.1
    for frame, rows in enumerate(there):
        alike(rows, done.points[frame].reshape(-1, 3), 1e-7 if start is None else 1.2e-7)


@pytest.mark.skipif(LIBRARY is None or shutil.which("cc") is None, reason="no C compiler, or SUPERHELIX_LIBRARY names no library")
def test_c_program(scene: Path, tmp_path: Path) -> None:
    """examples_c/groom.c, compiled here, and the same calls from Python: bare hair whose roots walk."""
    assert LIBRARY is not None
    library = Path(LIBRARY).resolve()
    program, out = tmp_path / "groom", tmp_path / "out"
    out.mkdir()
    command = ["cc", "-std=c99", "-O2", "-I", ROOT / "include", ROOT / "examples_c" / "groom.c", "-o", program, library, "-lm", f"-Wl,-rpath,{library.parent}"]
    subprocess.run([str(word) for word in command], check=True)
    flags = f"--scale 1 --seconds {SECONDS} --rate {FPS * SUBSTEPS} --elements 8 --format hair"
    subprocess.run([str(program), str(scene / "hair.hair"), str(scene / "walk.csv"), str(out), *flags.split()], check=True, capture_output=True)

    groom = shx.Groom.read(scene / "hair.hair", scale=1.0)
    times, poses = shx.read_motion(scene / "walk.csv")
    fit = shx.fit_strands(groom.points, groom.point_counts, shx.FitOptions(element_count=8))
    with shx.Solver(gravity=(0.0, -9.81, 0.0)) as solver:
        strands = solver.add_strands(shx.StrandDefs.from_fit(fit, material=shx.Material(internal_friction=1e-10, air_drag=5e-5)))
        solver.adopt_rest_shapes(strands)
        roots = solver.root_frames(strands)
        pivot = roots[:, :3].sum(axis=0) / len(roots)
        there = frames_of(out, "groom", 0, len(times) - 1)
        for step in range(len(times) - 1):
            if step:
                solver.set_root_frames(shx.frames.moved(shx.carried(poses[0], poses[step], pivot)[None], roots), strands, 1.0 / (FPS * SUBSTEPS))
                solver.step(1.0 / (FPS * SUBSTEPS))
            here = np.concatenate([solver.sample_strands(int(count), strands[place : place + 1])[0] for place, count in enumerate(groom.point_counts)])
            alike(here, there[step])
        assert np.abs(there[-1] - there[0]).max() > 0.1
