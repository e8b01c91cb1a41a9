"""From a stage to a simulation and back: grooms, caches, roots on a skin, the converter."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import usd_stages as make
from conftest import GROOMS, sphere_mesh
from pxr import Gf, Usd, UsdGeom, Vt

import superhelix as shx
from superhelix import usd

SOURCES = Path(__file__).resolve().parents[1] / "src"


def run(*arguments: str, code: int = 0) -> str:
    environment = {**os.environ, "PYTHONPATH": str(SOURCES)}
    done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, env=environment, check=False)
    assert done.returncode == code, done.stderr
    return done.stdout + done.stderr


@pytest.fixture(scope="module")
def groom_file(tmp_path_factory) -> Path:
    """A groom as a studio has it: centimetres, y up, Catmull-Rom curves, on a turned and scaled Xform."""
    source = shx.Groom.read(GROOMS / "sintel_hair_001.tfx", scale=0.01, every=6)
    path = tmp_path_factory.mktemp("usd") / "groom.usdc"
    on = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(on, "Y")
    UsdGeom.SetStageMetersPerUnit(on, 0.01)
    top = UsdGeom.Xform.Define(on, "/char")
    on.SetDefaultPrim(top.GetPrim())
    top.AddTransformOp().Set(Gf.Matrix4d().SetScale(2.0) * Gf.Matrix4d().SetTranslate(Gf.Vec3d(0, 3, 0)))
    local = (source.points * 100 - [0, 3, 0]) / 2
    hair = make.curves(on, "/char/hair", local, source.point_counts.tolist(), "cubic", "catmullRom", "pinned")
    hair.CreateWidthsAttr([0.003])
    hair.SetWidthsInterpolation("constant")
    on.Save()
    return path


def test_a_binary_groom_is_read_fitted_simulated_and_cached(groom_file, tmp_path) -> None:
    source = shx.Groom.read(GROOMS / "sintel_hair_001.tfx", scale=0.01, every=6)
    hair = usd.read_hair(groom_file)
    assert len(hair) == 38 and hair.widths.min() == pytest.approx(6e-5)
    np.testing.assert_allclose(hair.roots, source.roots, atol=1e-7)
    groom = shx.Groom.read(groom_file, every=2)
    assert len(groom) == 19 and groom.up_axis is shx.UpAxis.Y and groom.gravity == (0.0, -9.81, 0.0)
    np.testing.assert_allclose(groom.roots, source.roots[::2], atol=1e-7)
    fit = hair.fit(shx.FitOptions(element_count=10))
    assert fit.fitted.all()
    # The radius comes from the widths, the length from the curve.
    assert fit.strands.length == pytest.approx(hair.lengths, rel=1e-6)
    for suffix in ("usdc", "usdz"):
        path = tmp_path / f"sim.{suffix}"
        result = shx.simulate(groom, duration=0.2, fps=20, cache=path, points_per_strand=12)
        assert make.validation_errors(path) == []
        frames = list(usd.HairStage(path, tolerance=None, primvars=["superhelix:curve"]))
        assert [frame.time for frame in frames] == pytest.approx(result.times)
        for frame, points in zip(frames, result.points):
            np.testing.assert_allclose(frame.points.reshape(-1, 12, 3), points, atol=1e-6)
            n0 = shx.frames.rotate(frame.frames.reshape(-1, 12, 4)[:, 1:-1], (1.0, 0.0, 0.0))
            along = points[:, 2:] - points[:, :-2]
            assert (np.sum(n0 * along, axis=2) / np.linalg.norm(along, axis=2)).min() > 0.9
        assert frames[0].metres_per_unit == pytest.approx(0.01)
        assert frames[0].primvars["superhelix:curve"].tolist() == result.indices.tolist()
    assert sorted(os.listdir(tmp_path)) == ["sim.usdc", "sim.usdz"]


def test_strands_follow_a_skinned_head(tmp_path) -> None:
    on = make.stage()
    make.skinned_head(on)
    stage = usd.HairStage(on)
    hair = stage.read(0.0)
    with shx.Solver() as solver:
        strands = solver.add_strands(shx.StrandDefs.from_fit(hair.fit(), air_drag=1e-5))
        solver.adopt_rest_shapes()
        roots = usd.SkinRoots(stage, "/actor/head", hair, solver.root_frames(strands))
        for frame in range(1, 13):
            solver.set_root_frames(roots.frames(frame / 24), strands, over_seconds=1 / 24)
            report = solver.step(1 / 24, 4)
            assert report.quarantined == 0
        np.testing.assert_allclose(solver.root_frames(strands)[:, :3], roots.frames(0.5)[:, :3], atol=1e-9)
        assert np.linalg.norm(solver.root_frames(strands)[:, :3] - hair.roots, axis=1).min() > 0.2
    mesh = stage.mesh("/actor/head", 0.5)
    assert mesh.scalp().vertex_count == 9
    with pytest.raises(usd.UsdError, match="/actor/hair: is a BasisCurves; a Mesh expected"):
        stage.mesh("/actor/hair")
    with pytest.raises(usd.UsdError, match="/none: there is no such prim"):
        stage.mesh("/none")
    on.GetPrimAtPath("/actor/head").GetAttribute("faceVertexIndices").Set([0, 1, 99, 3] + [0] * 12)
    with pytest.raises(usd.UsdError, match=r"/actor/head: faceVertexIndices\[2\] is 99; 0 to 8 expected"):
        stage.mesh("/actor/head")


def test_roots_are_bound_to_the_nearest_place_of_a_mesh(rng) -> None:
    vertices, triangles = sphere_mesh(0.1)
    on = make.stage()
    mesh = UsdGeom.Mesh.Define(on, "/head")
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(vertices.astype(np.float32)))
    mesh.CreateFaceVertexCountsAttr([3] * len(triangles))
    mesh.CreateFaceVertexIndicesAttr(triangles.reshape(-1).tolist())
    directions = rng.normal(0, 1, (200, 3))
    roots = directions / np.linalg.norm(directions, axis=1, keepdims=True) * rng.uniform(0.09, 0.13, (200, 1))
    make.curves(on, "/hair", np.stack([roots, roots * 1.5], axis=1), [2] * 200)
    stage = usd.HairStage(on)
    hair = stage.read()
    bound = usd.SkinRoots(stage, "/head", hair, shx.frames.frames(hair.roots))
    # No other place of the mesh, of many, is nearer.
    weights = rng.dirichlet([0.5] * 3, (40,))
    corners = stage.mesh("/head").vertices[triangles]
    places = np.einsum("kw,twd->tkd", weights, corners).reshape(-1, 3)
    nearest = np.array([np.linalg.norm(places - root, axis=1).min() for root in hair.roots])
    assert (bound.distances <= nearest + 1e-9).all()
    assert (nearest - bound.distances).max() < 0.01


def test_the_converter_makes_files_that_the_program_reads(groom_file, tmp_path) -> None:
    text = run("-m", "superhelix.usd", "info", str(groom_file))
    assert "38 strands" in text and "unit 0.01 m (stated), up y, 0 time samples" in text and "group /char/hair: 38 strands" in text
    out = tmp_path / "groom.usda"
    assert "38 strands" in run("-m", "superhelix.usd", "convert", str(groom_file), str(out))
    groom, hair = shx.Groom.read(out), usd.read_hair(groom_file)
    np.testing.assert_allclose(groom.points, hair.points, atol=2e-7)
    assert groom.point_counts.tolist() == hair.point_counts.tolist() and groom.up_axis is shx.UpAxis.Y
    # A skeleton over time, which the program refuses, becomes a cache that it reads.
    on = make.stage()
    make.skinned_head(on)
    assert on.GetRootLayer().Export(str(tmp_path / "actor.usdc"))
    run("-m", "superhelix.usd", "convert", str(tmp_path / "actor.usdc"), str(tmp_path / "actor.usda"))
    with shx.CurveCache(tmp_path / "actor.usda") as cache:
        np.testing.assert_allclose(cache.times(), [0.0, 0.5, 1.0], atol=1e-9)
        for time in cache.times().tolist():
            with cache.sample(time) as curves:
                np.testing.assert_allclose(curves.points(1.0, dtype=np.float64), usd.read_hair(on, time).points, atol=2e-7)
    run("-m", "superhelix.usd", "convert", str(tmp_path / "actor.usdc"), str(tmp_path / "one.usda"), "--time", "0.5", "--prims", "/actor/hair")
    assert len(shx.Groom.read(tmp_path / "one.usda")) == 3
    assert "there is no such file" in run("-m", "superhelix.usd", "convert", "none.usdc", str(out), code=1)
    assert "x.obj ends in '.obj'" in run("-m", "superhelix.usd", "convert", str(groom_file), str(tmp_path / "x.obj"), code=1)


def test_the_number_of_points_can_stay_the_same_over_time(tmp_path) -> None:
    on = make.stage()
    hair = make.curves(on, "/hair", np.zeros((6, 3)), [6], "cubic", "bspline", "pinned")
    hair.GetPointsAttr().Clear()
    for code in range(4):
        bend = np.stack([0.05 * code * np.sin(np.arange(6)), np.zeros(6), 0.1 * np.arange(6)], axis=1)
        hair.GetPointsAttr().Set(Vt.Vec3fArray.FromNumpy(bend.astype(np.float32)), code)
    assert len({len(frame.points) for frame in usd.HairStage(on)}) == 4
    steady = usd.HairStage(on, steady=True)
    steady.read(3 / 24)
    assert len({len(frame.points) for frame in steady}) == 1


def test_without_the_usd_library_the_remedy_is_named(tmp_path) -> None:
    (tmp_path / "pxr").mkdir()
    (tmp_path / "pxr" / "__init__.py").write_text("raise ImportError('no USD here')")
    script = (
        f"import sys; sys.path.insert(0, {str(tmp_path)!r})\n"
        "import superhelix as shx\ntry:\n    shx.Groom.read('x.usdc')\nexcept ImportError as error:\n    print(error)"
    )
    assert 'needs the USD library (the module pxr): pip install "superhelix[usd]"' in run("-c", script)
