"""Grooms in a few lines, and pictures."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from conftest import GROOMS, ROOT, hanging, sphere_mesh

import superhelix as shx
from superhelix import motion_from_samples, prepare, read_motion, read_obj_mesh


@pytest.fixture(scope="module")
def sintel() -> shx.Groom:
    return shx.Groom.read(GROOMS / "sintel_hair_001.tfx", scale=0.01, every=6)


def test_a_groom_is_read(sintel) -> None:
    assert len(sintel) == 38
    assert sintel.up_axis is shx.UpAxis.Y
    assert sintel.gravity == (0.0, -9.81, 0.0)
    assert sintel.roots.shape == (38, 3)
    with pytest.raises(ValueError, match=r"median strand is .* units long: give metres a unit"):
        shx.Groom.read(GROOMS / "sintel_hair_001.tfx")


def test_curves_drawn_inside_the_body_are_pushed_out_with_a_warning_or_stay_as_drawn() -> None:
    along = np.linspace(0.0, 0.1, 21)
    level = np.stack([along - 0.05, np.zeros(21), np.full(21, 0.046)], axis=1)
    clear, through = level + [0.0, 0.0, 0.01], level - [0.0, 0.0, 0.046]
    body, text = shx.BodyDef.sphere(0.05), r"1 of 2 curves are drawn up to 4\.0 mm inside the body, and pushed out of it by up to \d"
    groom = shx.Groom.from_curves(np.stack([level, clear]))
    with pytest.warns(shx.DrawnInsideWarning, match=text) as caught, prepare(groom, body=body) as made:
        assert caught[0].filename == __file__
        assert made.pushed_out is not None
        assert np.linalg.norm(made.pushed_out.points, axis=1).min() > 0.05
    with pytest.warns(shx.DrawnInsideWarning, match=text) as caught:
        shx.simulate(groom, duration=0.05, body=body)
    assert caught[0].filename == __file__
    with pytest.warns(shx.DrawnInsideWarning, match="no way out was found for 1 of them"):
        prepare(shx.Groom.from_curves(np.stack([through, through + [0.0, 1e-3, 0.0], clear])), body=body).solver.close()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with prepare(groom, body=body, push_out=False) as made:
            assert made.pushed_out is None
            drawn = made.solver.sample_strands(21, made.strands)
            assert np.linalg.norm(drawn[0], axis=1).min() < 0.0465
        # What lies within 2 mm is moved without a word: roots lie in the skin.
        prepare(shx.Groom.from_curves(np.stack([level + [0.0, 0.0, 0.003], clear])), body=body).solver.close()


def test_a_groom_rests_as_drawn_and_goes_with_a_walking_head(sintel, tmp_path) -> None:
    times, poses = read_motion(GROOMS / "walk_figure8_head.csv")
    vertices, triangles = read_obj_mesh(GROOMS / "sintel_bust.obj", 0.01)
    body = shx.BodyDef.grid(shx.bake_distance_grid(vertices, triangles, cell=0.006, band=0.02))
    seen = []
    result = shx.simulate(
        sintel,
        motion_from_samples(times, poses),
        start=float(times[0]),
        duration=0.5,
        body=body,
        cache=tmp_path / "hair.usda",
        points_per_strand=17,
        progress=lambda frame, frames: seen.append((frame, frames)),
    )
    assert result.points.shape == (16, 38 - len(result.skipped), 17, 3)
    assert seen[-1] == (16, 16)
    assert sum(report.unconverged for report in result.reports) == 0
    assert len(result.quarantined) == 0
    # In the head's own axes the style keeps its shape to a few per cent of the strands' length.
    drawn, last = result.points[0].astype(float), result.points[-1].astype(float)
    pivot = drawn[:, 0].mean(axis=0)
    motion = motion_from_samples(times, poses)
    first, now = motion(times[0]), motion(times[0] + 0.5)
    frame = shx.carried(first, now, pivot)
    back = shx.frames.rotate(frame[3:] * [-1, -1, -1, 1], last - frame[:3])
    lengths = np.linalg.norm(np.diff(drawn, axis=1), axis=-1).sum(axis=1)
    distance = np.linalg.norm(back - drawn, axis=-1).mean(axis=1) / lengths
    assert distance.mean() < 0.05
    assert np.linalg.norm(last - drawn, axis=-1).mean() > 0.01
    with shx.CurveCache(tmp_path / "hair.usda") as cache:
        assert len(cache.times()) == 16
        with cache.sample(0.5) as curves:
            assert curves.units() == (pytest.approx(0.01), shx.UpAxis.Y)
            np.testing.assert_allclose(curves.points(0.01).reshape(last.shape), last, atol=1e-6)
            assert curves.attribute(shx.CurveAttribute.VELOCITY) is not None


def turning(times: np.ndarray) -> np.ndarray:
    """Poses that turn about z at 2 rad/s on a way at 0.5 m/s."""
    return shx.frames.frames(np.c_[0.5 * times, 0 * times, 1.0 + 0 * times], shx.frames.from_axis_angle([0, 0, 1], 2.0 * times))


def test_a_motion_is_smooth_through_its_samples() -> None:
    times = np.array([1.0, 1.1, 1.25, 1.3, 1.5])
    motion = motion_from_samples(times, turning(times))
    between = np.array([1.03, 1.2, 1.26, 1.499])
    np.testing.assert_allclose(motion(between), turning(between), atol=1e-14)
    np.testing.assert_allclose(motion(times), turning(times), atol=1e-15)
    # One time gives what many give, and outside the motion rests.
    np.testing.assert_array_equal(motion(between[1]), motion(between)[1])
    np.testing.assert_array_equal(motion([0.0, 9.0]), motion(times[[0, -1]]))
    velocity, spin = motion.velocity(1.2)
    np.testing.assert_allclose(np.r_[velocity, spin], [0.5, 0, 0, 0, 0, 2.0], atol=1e-12)
    velocities, spins = motion.velocity([0.9, 1.0, 1.5, 1.6])
    np.testing.assert_allclose(velocities[:, 0], [0, 0.5, 0.5, 0], atol=1e-12)
    np.testing.assert_allclose(spins[:, 2], [0, 2.0, 2.0, 0], atol=1e-12)
    # A velocity that changes at the samples is not followed by corners.
    there = motion_from_samples([0.0, 1.0, 2.0], shx.frames.frames([[0.0, 0, 0], [1.0, 0, 0], [0.0, 0, 0]]))
    assert there(1.5)[0] > 0.6
    np.testing.assert_allclose(there.velocity(1.0)[0], 0.0, atol=1e-12)


def test_a_motion_may_be_linear() -> None:
    poses = shx.frames.frames([[0.0, 0, 0], [1.0, 0, 0], [0.0, 0, 0]])
    motion = motion_from_samples([0.0, 1.0, 2.0], poses, interpolation="linear")
    np.testing.assert_array_equal([motion(time)[0] for time in (-1.0, 0.25, 1.0, 1.5, 3.0)], [0, 0.25, 1.0, 0.5, 0])
    assert not hasattr(motion, "velocity")
    with pytest.raises(ValueError, match="interpolation: 'cubic'; 'smooth' or 'linear' expected"):
        motion_from_samples([0.0], poses[:1], interpolation="cubic")


def test_motions_that_cannot_be_are_refused() -> None:
    pose = [0.0, 0, 0, 0, 0, 0, 1]
    for kind in ("smooth", "linear"):
        with pytest.raises(ValueError, match="times: 2 times for 1 poses"):
            motion_from_samples([0.0, 1.0], [pose], interpolation=kind)
        with pytest.raises(ValueError, match="times: 2 times for 2 poses; as many, ascending"):
            motion_from_samples([0.0, np.nan], [pose, pose], interpolation=kind)
        with pytest.raises(ValueError, match="times: 0 times"):
            motion_from_samples([], np.zeros((0, 7)), interpolation=kind)
    with pytest.raises(shx.InvalidArgumentError, match=r"poses\[1\]\.rotation"):
        motion_from_samples([0.0, 1.0], [pose, [0.0, 0, 0, 0, 0, 0, 2]])
    with pytest.raises(shx.InvalidArgumentError, match=r"times\[0\]"):
        motion_from_samples([0.0, 1.0], [pose, pose])(np.inf)


def test_hair_begins_with_the_velocity_of_the_motion() -> None:
    groom = shx.Groom.from_curves(np.linspace([0.1, 0, 0], [0.1, 0, -0.1], 8)[None])
    times = np.linspace(0.0, 1.0, 11)
    for kind, speed in (("smooth", [0.5, 0.2, 0.0]), ("linear", [0.0, 0.0, 0.0])):
        motion = motion_from_samples(times, turning(times), interpolation=kind)
        with prepare(groom, motion=motion, start=0.3, pivot=[0.0, 0.0, 0.0]) as made:
            # A turn at 2 rad/s, 0.1 m from the joint: 0.2 m/s across. The whole strand begins so.
            velocities = made.solver.sample_velocities(5, made.strands)[0]
            np.testing.assert_allclose(velocities, np.broadcast_to(speed, (5, 3)), atol=1e-12)
    # Rigidly moved hair at constant speed without turn or drag stays in its shape, if it began so.
    straight = motion_from_samples(times, shx.frames.frames(np.c_[0.5 * times, 0 * times, 0 * times]))
    result = shx.simulate(groom, straight, duration=0.5, hair=shx.Material(air_drag=0.0))
    moved = result.points[:, 0] - result.points[0, 0]
    np.testing.assert_allclose(moved[..., 0], np.broadcast_to(0.5 * result.times[:, None], moved.shape[:2]), atol=1e-5)


def test_bare_hair_falls_and_wisps_do_not(sintel) -> None:
    def nudge(time: float) -> np.ndarray:
        return np.array([0.02 * np.sin(20.0 * min(time, np.pi / 10)), 0, 0, 0, 0, 0, 1])

    sag = {}
    for bare in (False, True):
        result = shx.simulate(sintel, nudge, duration=1.0, bare=bare, points_per_strand=9)
        sag[bare] = float(np.linalg.norm(result.points[-1] - result.points[0], axis=-1).mean())
    assert sag[True] > 5 * sag[False]


def test_coarse_strands_are_fitted_by_more_elements() -> None:
    angle = np.linspace(0, 8 * np.pi, 120)
    curl = np.stack([0.01 * np.cos(angle), 0.01 * np.sin(angle), -0.002 * angle], axis=1)
    straight = np.stack([np.full(120, 0.1), np.zeros(120), np.linspace(0, -0.2, 120)], axis=1)
    with prepare(shx.Groom.from_curves(np.stack([curl, straight])), element_count=4) as made:
        counts = made.solver.element_counts()
        assert counts[0] > 12
        assert counts[1] == 4
        assert made.solver.strand_turning_angles().max() <= np.pi / 2
        assert (made.stiffening >= 1.0).all()


def test_what_cannot_be_simulated_is_said() -> None:
    good, point = np.linspace([0, 0, 0], [0, 0, -0.1], 5), np.zeros((5, 3))
    with prepare(shx.Groom.from_curves(np.stack([point, good])), wisp_contact_radius=1e-3) as made:
        assert made.skipped.tolist() == [0]
        assert made.indices.tolist() == [1]
        assert made.solver.strand_contact(made.strands[0]).wisp_radius == 1e-3
    with pytest.raises(ValueError, match="no curve can be simulated"):
        prepare(shx.Groom.from_curves(point[None]))
    with pytest.raises(ValueError, match="duration, fps"):
        shx.simulate(shx.Groom.from_curves(good[None]), duration=0.0)


def test_a_cache_that_fails_leaves_nothing(sintel, tmp_path) -> None:
    def stop(frame: int, frames: int) -> None:
        if frame == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        shx.simulate(sintel, duration=1.0, cache=tmp_path / "a.usda", progress=stop)
    assert list(tmp_path.iterdir()) == []


def test_render_hair_of_a_cache(tmp_path) -> None:
    vertices, triangles = sphere_mesh(0.1)
    with shx.Scalp(vertices, triangles) as scalp:
        top = scalp.root_frames(scalp.scatter(20, density=(vertices[:, 2] > 0.05).astype(float)))
        along = shx.frames.rotate(top[:, 3:], [1.0, 0.0, 0.0])
        curves = top[:, None, :3] + along[:, None] * np.linspace(0, 0.1, 12)[:, None]
        shx.simulate(shx.Groom.from_curves(curves), duration=0.2, cache=tmp_path / "guides.usda", points_per_strand=12)
        assert shx.interpolate(tmp_path / "guides.usda", tmp_path / "hair.usda", scalp=scalp, count=300) == 300
    assert shx.interpolate(tmp_path / "guides.usda", tmp_path / "some.usda", roots=top[:5, :3]) == 5
    with shx.CurveCache(tmp_path / "hair.usda") as cache:
        assert len(cache.times()) == 7
        with cache.sample(0.1) as hair:
            assert hair.strand_count == 300
            assert np.linalg.norm(hair.points(), axis=-1).max() < 0.25
            assert hair.attribute(shx.CurveAttribute.VELOCITY) is not None
    with pytest.raises(ValueError, match="give one of the two"):
        shx.interpolate(tmp_path / "guides.usda", tmp_path / "none.usda")


def test_frames() -> None:
    rng = np.random.default_rng(3)
    directions = rng.normal(size=(50, 3))
    frames = shx.frames.frames_along(np.zeros((50, 3)), directions)
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    np.testing.assert_allclose(shx.frames.rotate(frames[:, 3:], [1.0, 0, 0]), unit, atol=1e-12)
    upward = shx.frames.frames_along([0.0, 0.0, 0.0], [0.0, 0.0, 2.0])
    np.testing.assert_allclose(shx.frames.rotate(upward[3:], [1.0, 0, 0]), [0, 0, 1], atol=1e-12)
    quarter = shx.frames.from_axis_angle([0, 0, 1], np.pi / 2)
    np.testing.assert_allclose(shx.frames.rotate(quarter, [1.0, 0, 0]), [0, 1, 0], atol=1e-12)
    twice = shx.frames.multiply(quarter, quarter)
    np.testing.assert_allclose(shx.frames.rotate(twice, [1.0, 0, 0]), [-1, 0, 0], atol=1e-12)
    carried = shx.frames.moved([1.0, 0, 0, *quarter], shx.frames.frames([[1.0, 0, 0]]))
    np.testing.assert_allclose(carried, [[1.0, 1.0, 0, *quarter]], atol=1e-12)
    with pytest.raises(ValueError, match="directions"):
        shx.frames.frames_along([0.0, 0, 0], [0.0, 0, 0])
    matrices = np.stack([np.eye(3), np.diag([1.0, -1, -1]), np.diag([-1.0, 1, -1]), np.diag([-1.0, -1, 1])])
    turned = shx.frames.rotate(shx.frames.quaternions(matrices)[:, None], np.eye(3))
    np.testing.assert_allclose(turned, np.swapaxes(matrices, 1, 2), atol=1e-12)


def test_plots(tmp_path, solver) -> None:
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    solver.add_strands(hanging(3))
    ax = solver.plot(colors="tab:blue")
    assert len(ax.collections) == 1
    assert solver.plot(solver.strand_ids()[:2], ax=ax, up="y") is ax
    low, high = ax.get_xlim()
    assert low < 0.0
    assert high > 0.02
    ax.figure.savefig(tmp_path / "a.png")
    picture = plt.imread(tmp_path / "a.png")
    blue = picture[..., 2] > picture[..., 0] + 0.2
    assert blue.sum() > 30
    with pytest.raises(ValueError, match="colors: 2 colours; 3 expected"):
        solver.plot(colors=["r", "g"])
    with pytest.raises(ValueError, match="up: 'x'"):
        solver.plot(up="x")
    plt.close("all")
    assert (ROOT / "docs").exists()
