"""Curves read and written, caches, scalps and render hair."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import GROOMS, hanging, sphere_mesh

import superhelix as shx


def curves(count: int = 4, points: int = 6) -> np.ndarray:
    rows = np.zeros((count, points, 3), dtype=np.float32)
    rows[..., 0] = np.arange(count)[:, None]
    rows[..., 2] = -np.arange(points)
    return rows


@pytest.mark.parametrize("ending", [".hair", ".obj", ".usda", ".tfx"])
def test_points_come_back(tmp_path, ending) -> None:
    path, rows = tmp_path / f"groom{ending}", curves(4, 8)
    shx.write_curves(path, rows)
    with shx.Curves(path) as read:
        assert (len(read), read.strand_count, read.point_count) == (4, 4, 32)
        assert read.point_counts().tolist() == [8] * 4
        np.testing.assert_array_equal(read.points().reshape(4, 8, 3), rows)
        np.testing.assert_allclose(read.points(0.01, 1, 2, dtype=np.float64), rows[1:3].reshape(-1, 3) * 0.01)
        out = np.zeros((32, 5))
        read.points(out=out[:, 1:4])
        np.testing.assert_array_equal(out[:, 1:4], rows.reshape(-1, 3))


def test_all_that_a_file_says_comes_back(tmp_path, rng) -> None:
    rows = curves()
    thickness, colors = rng.random(24, dtype=np.float32), rng.random((24, 3), dtype=np.float32)
    data = shx.CurveData(rows, thickness=thickness, colors=colors, transparency=np.full(24, 0.5))
    shx.write_curves(tmp_path / "a.hair", data)
    with shx.Curves(tmp_path / "a.hair") as read:
        np.testing.assert_array_equal(read.attribute(shx.CurveAttribute.THICKNESS), thickness)
        np.testing.assert_array_equal(read.attribute(shx.CurveAttribute.COLOR), colors)
        assert read.attribute(shx.CurveAttribute.VELOCITY) is None
        assert read.units() == (0.0, shx.UpAxis.UNKNOWN)
    velocities = rng.normal(size=(24, 3))
    usda = shx.CurveData(rows.reshape(-1, 3), [6, 6, 6, 6], velocities=velocities, up_axis=shx.UpAxis.Y, metres_per_unit=0.01, strand_uvs=rng.random((4, 2)))
    shx.write_curves(tmp_path / "a.usda", usda)
    with shx.Curves(tmp_path / "a.usda") as read:
        assert read.units() == (0.01, shx.UpAxis.Y)
        np.testing.assert_allclose(read.attribute(shx.CurveAttribute.VELOCITY), velocities, rtol=1e-6)
    tfx = shx.CurveData(np.ascontiguousarray(rows.repeat(2, axis=1)[:, :8]), pinned=np.eye(4, 8, dtype=bool), strand_thickness=np.ones(4), tfx_version=4)
    shx.write_curves(tmp_path / "a.tfx", tfx)


def test_files_that_are_none_are_named(tmp_path) -> None:
    with pytest.raises(shx.FileError, match="none.hair") as caught:
        shx.Curves(tmp_path / "none.hair")
    assert isinstance(caught.value, OSError)
    (tmp_path / "broken.hair").write_bytes(b"HAIR nonsense")
    with pytest.raises(shx.FileError, match="broken.hair"):
        shx.Curves(tmp_path / "broken.hair")
    with pytest.raises(shx.InvalidArgumentError):
        shx.write_curves(tmp_path / "a.doc", curves())
    with pytest.raises(ValueError, match="points: 24 items; 23 expected"):
        shx.write_curves(tmp_path / "a.obj", curves(), [6, 6, 6, 5])
    with pytest.raises(ValueError, match="thickness: 3 numbers; 24 expected"):
        shx.CurveData(curves(), thickness=[1, 2, 3])
    read = shx.Curves(GROOMS / "fibermesh_1k.tfx")
    assert repr(read) == "Curves(1000 strands, 6000 points)"
    read.close()
    with pytest.raises(ValueError, match="this Curves is closed"):
        read.points()


def test_caches_are_written_and_sampled(tmp_path) -> None:
    path, rows = tmp_path / "cache.usda", curves()
    first = shx.CurveData(rows, velocities=rows)
    with shx.CurveCacheWriter(path, first, 24.0) as writer:
        for frame in range(3):
            writer.write(frame / 24, rows + frame, np.full_like(rows, 24.0))
        assert writer.frame_count == 3
    with shx.CurveCache(path) as cache:
        np.testing.assert_allclose(cache.times(), [0.0, 1 / 24, 2 / 24])
        with cache.sample(1.5 / 24) as between:
            np.testing.assert_allclose(between.points().reshape(rows.shape), rows + 1.5, atol=1e-5)
        assert [pytest.approx(time) for time, _ in cache] == [0.0, 1 / 24, 2 / 24]


def test_a_cache_that_is_given_up_leaves_nothing(tmp_path) -> None:
    rows = curves()
    with pytest.raises(RuntimeError, match="no more"):
        with shx.CurveCacheWriter(tmp_path / "a.usda", shx.CurveData(rows), 24.0) as writer:
            writer.write(0.0, rows)
            raise RuntimeError("no more")
    writer = shx.CurveCacheWriter(tmp_path / "b.usda", shx.CurveData(rows), 24.0)
    writer.write(0.0, rows)
    writer.abandon()
    writer.close()
    assert list(tmp_path.iterdir()) == []
    empty = shx.CurveCacheWriter(tmp_path / "c.usda", shx.CurveData(rows), 24.0)
    with pytest.raises(shx.InvalidArgumentError):
        empty.close()
    with pytest.raises(ValueError, match="this CurveCacheWriter is closed"):
        empty.write(0.0, rows)


def test_follicles_stand_on_their_scalp() -> None:
    vertices, triangles = sphere_mesh(0.1)
    with shx.Scalp(vertices, triangles) as scalp:
        follicles = scalp.scatter(200, seed=3)
        assert len(follicles) == 200
        frames = scalp.root_frames(follicles)
        normals = shx.frames.rotate(frames[:, 3:], [1.0, 0.0, 0.0])
        outward = frames[:, :3] / np.linalg.norm(frames[:, :3], axis=1, keepdims=True)
        assert (np.sum(normals * outward, axis=1) > 0.95).all()
        moved = scalp.root_frames(follicles, vertices + [0.0, 0.0, 1.0])
        np.testing.assert_allclose(moved[:, 2], frames[:, 2] + 1.0)
        top = (vertices[:, 2] > 0.0).astype(float)
        assert scalp.root_frames(scalp.scatter(100, density=top))[:, 2].min() > -0.03
        near = scalp.scatter(50, guide_roots=[[0.0, 0.0, 0.1]], max_guide_distance=0.05)
        assert np.linalg.norm(scalp.root_frames(near)[:, :3] - [0.0, 0.0, 0.1], axis=1).max() < 0.055
        assert len(scalp.scatter(spacing=0.02)) > 20
        with pytest.raises(shx.InvalidArgumentError):
            scalp.follicles_at_uvs([[0.5, 0.5]])
        with pytest.raises(shx.InvalidArgumentError):
            scalp.scatter()
        with pytest.raises(ValueError, match=f"density: 3 numbers; {len(vertices)} expected"):
            scalp.scatter(10, density=[1.0, 1.0, 1.0])


def test_follicles_at_texture_coordinates() -> None:
    square, halves = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2], [0, 2, 3]])
    with shx.Scalp(square, halves, uvs=square[halves][..., :2], reference_axis=(0.0, 1.0, 0.0)) as scalp:
        frames = scalp.root_frames(scalp.follicles_at_uvs([[0.25, 0.75], [0.5, 0.25]]))
        np.testing.assert_allclose(frames[:, :2], [[0.25, 0.75], [0.5, 0.25]], atol=1e-12)
        picture = np.array([[0.0, 0.0], [1.0, 1.0]])
        assert scalp.root_frames(scalp.scatter(200, density=picture))[:, 1].mean() > 0.6


@pytest.fixture
def guides(solver):
    solver.add_strands(hanging(6, 5, 0.2))
    return solver


def test_render_hair_follows_its_guides(guides) -> None:
    roots = np.c_[np.linspace(0.0, 0.05, 40), np.full(40, 1e-3), np.zeros(40)]
    settings = shx.RenderSettings(points_per_strand=8, length_variation=0.0, flyaway_fraction=0.0)
    with shx.RenderHair.from_solver(guides, roots, settings) as hair, hair.pose() as pose:
        assert (hair.strand_count, hair.points_per_strand) == (40, 8)
        pose.set_from_solver(guides, velocities=True)
        points = pose.evaluate()
        assert points.shape == (40, 8, 3)
        np.testing.assert_allclose(points[:, 0], roots, atol=1e-6)
        assert (points[:, -1, 2] < -0.15).all()
        wide, turned, speeds = np.zeros((10, 8, 4), np.float32), np.zeros((10, 8, 4), np.float32), np.ones((10, 8, 3), np.float32)
        pose.evaluate(first_strand=5, strand_count=10, out=wide, frames=turned, velocities=speeds, origin=(0.0, 0.0, 1.0))
        np.testing.assert_allclose(wide[..., :2], points[5:15, :, :2], atol=1e-6)
        np.testing.assert_allclose(wide[..., 2], points[5:15, :, 2] - 1.0, atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(turned, axis=-1), 1.0, atol=1e-5)
        tangents = np.zeros((40, 8, 3), np.float32)
        pose.evaluate(frames=tangents)
        x, y, z, w = np.moveaxis(turned, -1, 0)
        np.testing.assert_allclose(tangents[5:15, :, 2], 2.0 * (x * z - w * y), atol=1e-5)
        np.testing.assert_allclose(np.linalg.norm(tangents, axis=-1), 1.0, atol=1e-6)
        np.testing.assert_allclose(speeds, 0.0, atol=1e-6)
        first_guides, wisps = hair.wisps()
        assert first_guides[0] == 0
        assert first_guides[-1] == 5
        assert wisps.max() < settings.wisps_per_guide
        guides.add_body(shx.BodyDef.sphere(0.05, pose=shx.Frame(origin=(0.02, 0.045, -0.1))))
        out = pose.evaluate(solver=guides)
        assert np.linalg.norm(points - np.float32([0.02, 0.045, -0.1]), axis=-1).min() < 0.047
        assert np.linalg.norm(out - np.float32([0.02, 0.045, -0.1]), axis=-1).min() > 0.05


def test_render_hair_is_saved_and_loses_guides(guides) -> None:
    roots = np.c_[np.linspace(0.0, 0.05, 37), np.zeros((37, 2))]
    with shx.RenderHair.from_solver(guides, roots) as hair:
        image = hair.save()
        with shx.RenderHair.load(image, points_per_strand=16) as same:
            assert same.strand_count == 37
            for one in (hair, same):
                pose = one.pose()
                pose.set_from_solver(guides)
                points = pose.evaluate() if one is hair else points  # noqa: F821
                np.testing.assert_array_equal(pose.evaluate(), points)
        with shx.RenderHair.load(image, points_per_strand=17) as wrong, wrong.pose() as pose:
            pose.set_from_solver(guides)
            with pytest.raises(ValueError, match="points_per_strand: 17"):
                pose.evaluate()
        less = hair.without_guides([5])
        assert less.wisps()[0].max() <= 4
    with shx.RenderHair.from_solver(guides, roots, shx.RenderSettings(length_variation=0.0)) as hair:
        pose = hair.pose()
        pose.set_from_solver(guides)
        shapes = pose.evaluate().astype(np.float64).reshape(37, 16, 3)
        shapes[..., 1] += 0.02 * np.sin(np.linspace(0.0, 5.0, 16))
        line = np.stack([shapes[:, 0], shapes[:, 0] - [0.0, 0.05, 0.1]], axis=1)
        even = line[:, :1] + (line[:, 1:] - line[:, :1]) * np.linspace(0.0, 1.0, 16)[:, None]
        for own, expected in (
            (hair.with_own_shapes(shapes), shapes),
            (hair.with_own_shapes(line.reshape(-1, 3), np.full(37, 2)), even),
            (shx.RenderHair.load(hair.with_own_shapes(shapes).save(), points_per_strand=16), shapes),
        ):
            assert own.strand_count == 37
            pose = own.pose()
            pose.set_from_solver(guides)
            np.testing.assert_allclose(pose.evaluate().reshape(37, 16, 3), expected, atol=2e-6)
        with pytest.raises(ValueError, match=r"points: shape \(36, 16, 3\); \(37, points_per_strand, 3\) expected"):
            hair.with_own_shapes(shapes[1:])
        with pytest.raises(shx.InvalidArgumentError, match=r"points.count"):
            hair.with_own_shapes(shapes[:, 1:].copy())
    with pytest.raises(TypeError, match="from_guides"):
        shx.RenderHair()


def test_guides_as_curves_with_a_loop_of_the_host_and_velocities_between_poses() -> None:
    rest = curves().astype(np.float64) * 0.01
    roots = rest[:, 0] + [0.002, 0.0, 0.0]
    used = []

    def loop(count, min_range, run):
        used.append(count)
        run(0, count, 0)

    still = shx.frames.frames(rest[:, 0])
    guides = shx.RenderGuides(rest, roots=still, velocities=np.zeros_like(rest), root_angular_velocities=np.zeros((4, 3)))
    with shx.RenderHair.from_guides(guides, np.repeat(roots, 400, axis=0), parallel_for=loop) as hair:
        before, now = hair.pose(), hair.pose()
        before.set_guides(guides)
        moved = shx.frames.frames(rest[:, 0] + [0.0, 0.1, 0.0])
        now.set_guides(shx.RenderGuides((rest + [0.0, 0.1, 0.0]).reshape(-1, 3), [6] * 4, roots=moved))
        velocities = np.zeros((1600, 16, 3), dtype=np.float32)
        points = now.evaluate(previous_pose=before, interval=0.5, velocities=velocities)
        np.testing.assert_allclose(velocities, np.broadcast_to(np.float32([0.0, 0.2, 0.0]), velocities.shape), atol=1e-5)
        np.testing.assert_allclose(points[:, 0, 1], 0.1, atol=1e-6)
        shifted = now.evaluate(roots=np.repeat(roots, 400, axis=0) + [0.0, 0.1, 0.01])
        np.testing.assert_allclose(shifted[:, 0, 2], roots[:, 2].repeat(400) + 0.01, atol=1e-6)
    assert used
