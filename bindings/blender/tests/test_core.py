"""The core without Blender: frames, snapshots, cache, resume."""

from __future__ import annotations

import json
import threading
from pathlib import Path

import numpy as np
import pytest
import superhelix as shx

from superhelix_hair.core import store
from superhelix_hair.core.pose import Poser
from superhelix_hair.core.rest import Collider, FrameInputs, Motion, Rest, is_closed
from superhelix_hair.core.session import CancelledError, Session
from superhelix_hair.core.settings import HAIR_TYPES, HairSettings, Quality
from superhelix_hair.core.space import Attachment, barycentric, polar, relative, transformed
from superhelix_hair.core.store import CacheMismatchError, FrameStore

HAIR = HairSettings(gravity=(0.0, 0.0, -9.81))
DT = 1.0 / 24.0


def ball(radius: float = 0.1, rings: int = 12) -> tuple[np.ndarray, np.ndarray]:
    """A closed sphere."""
    turn, tilt = np.meshgrid(np.linspace(0, 2 * np.pi, 2 * rings, endpoint=False), np.linspace(0, np.pi, rings + 1)[1:-1])
    rows = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], axis=-1).reshape(-1, 3)
    vertices = radius * np.concatenate([[[0, 0, 1.0]], rows, [[0, 0, -1.0]]])
    n, faces = 2 * rings, []
    for i in range(n):
        j = (i + 1) % n
        faces += [(0, 1 + i, 1 + j), (len(vertices) - 1, 1 + (rings - 2) * n + j, 1 + (rings - 2) * n + i)]
        for row in range(rings - 2):
            a, b = 1 + row * n, 1 + (row + 1) * n
            faces += [(a + i, b + i, b + j), (a + i, b + j, a + j)]
    return vertices, np.array(faces, dtype=np.uint32)


def drawn(count: int = 12, points: int = 10) -> np.ndarray:
    """Curls that stand out from the ball."""
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)
    outward = np.stack([np.cos(turn), np.sin(turn), 0.4 * np.ones(count)], axis=-1) / np.hypot(1, 0.4)
    along = np.linspace(0, 0.12, points)
    rows = outward[:, None] * (0.102 + along)[:, None]
    rows[..., 2] += 0.004 * np.sin(60 * along)
    return rows


def head(frame: int) -> np.ndarray:
    return np.r_[0.01 * (frame - 1), 0.0, 0.0, shx.frames.from_axis_angle((0, 0, 1), 0.4 * np.sin(0.5 * (frame - 1)))]


def scene(count: int = 12, motion: Motion = Motion.RIGID) -> tuple[Rest, object]:
    vertices, faces = ball()
    points = drawn(count)

    def inputs(frame: int) -> FrameInputs:
        pose = head(frame)
        body = pose if motion is Motion.RIGID else pose[:3] + shx.frames.rotate(pose[3:], vertices)
        return FrameInputs(np.tile(pose, (count, 1)), [body], np.eye(4), (0.1, 0.0, 0.0))

    rest = Rest(points.reshape(-1, 3), np.full(count, points.shape[1]), [Collider("ball", motion, vertices, faces, cell=0.01)], inputs(1))
    return rest, inputs


def make(rest: Rest, folder: Path, **options) -> Session:
    return Session(rest, HAIR, folder=folder, frame_time=DT, **options)


def straight(folder: Path, frames: int = 20) -> list[np.ndarray]:
    rest, inputs = scene()
    session = make(rest, folder)
    session.run(frames, inputs)
    rows = [session.positions(frame).copy() for frame in range(1, frames + 1)]
    session.close()
    return rows


def test_equals_prepare(tmp_path: Path) -> None:
    """A run through the session is that of superhelix.prepare, to the bit."""
    rest, inputs = scene()
    session = make(rest, tmp_path)
    session.run(8, inputs)
    body = shx.BodyDef.grid(shx.bake_distance_grid(*ball(), 0.01, 0.04))
    with shx.prepare(shx.Groom(rest.points, rest.point_counts), body=body) as made:
        made.solver.set_wind((0.1, 0, 0))
        local = relative(np.tile(head(1), (12, 1)), made.solver.root_frames(made.strands))
        for frame in range(2, 9):
            made.solver.set_root_frames(shx.frames.moved(np.tile(head(frame), (12, 1)), local), made.strands, DT)
            made.solver.set_body_frames(head(frame)[None], made.body, DT)
            made.solver.step(DT, 2)
        assert made.solver.state_hash() == session.rig.solver.state_hash()
        tips = made.solver.sample_strands(2, made.strands, dtype=np.float64)[:, 1].astype(np.float32)
    assert np.array_equal(session.positions(8).reshape(12, -1, 3)[:, -1], tips)
    session.close()


def rigged(frame: int, count: int = 12) -> np.ndarray:
    """Curves of another number of points that go with the head and nod."""
    rows = drawn(count, 15)
    rows[..., 2] += 0.02 * np.sin(0.6 * (frame - 1)) * np.linspace(0, 1, 15) ** 2
    pose = head(frame)
    return pose[:3] + shx.frames.rotate(pose[3:], rows.reshape(-1, 3))


def followed(tmp_path: Path, root: float, tip: float) -> tuple[Session, object]:
    rest, inputs = scene()

    def with_targets(frame: int) -> FrameInputs:
        now = inputs(frame)
        now.targets = rigged(frame)
        return now

    rest = Rest(rest.points, rest.point_counts, rest.colliders, with_targets(1), np.full(12, 15))
    settings = HairSettings(gravity=(0.0, 0.0, -9.81), follow_root=root, follow_tip=tip)
    return Session(rest, settings, folder=tmp_path, frame_time=DT), with_targets


def test_curves_follow_a_rig(tmp_path: Path) -> None:
    session, inputs = followed(tmp_path / "a", 1.0, 1.0)
    session.run(10, inputs)
    # The rig is 5 mm shorter here than the strands, which do not stretch: spread along them, that is 2.9 mm rms.
    assert session.rig.solver.target_distances(session.rig.strands).max() < 2.9e-3
    on_rig = session.positions(10).copy()
    session.close()
    free, inputs = followed(tmp_path / "b", 0.0, 0.0)
    free.run(10, inputs)
    rest, alone = scene()
    plain = make(rest, tmp_path / "c")
    plain.run(10, alone)
    assert np.array_equal(free.positions(10), plain.positions(10))
    assert np.abs(on_rig - plain.positions(10)).max() > 5e-3
    free.close()
    plain.close()
    # A second process continues on the rig.
    again, inputs = followed(tmp_path / "d", 1.0, 0.2)
    again.run(6, inputs)
    again.close()
    again, inputs = followed(tmp_path / "d", 1.0, 0.2)
    again.run(10, inputs)
    whole, inputs = followed(tmp_path / "e", 1.0, 0.2)
    whole.run(10, inputs)
    assert np.array_equal(again.positions(10), whole.positions(10))
    broken = inputs(11)
    broken.targets = broken.targets[:-1]
    with pytest.raises(ValueError, match="rigged curves: 179 points, where the first frame has 180"):
        whole.advance(broken)
    again.close()
    whole.close()


def test_rigged_curves_are_one_for_each(tmp_path: Path) -> None:
    rest, inputs = scene()
    now = inputs(1)
    now.targets = rigged(1)
    with pytest.raises(ValueError, match="rigged curves: 11; 12 expected"):
        Rest(rest.points, rest.point_counts, rest.colliders, now, np.full(11, 15))
    with pytest.raises(ValueError, match="targets: points and their numbers"):
        Rest(rest.points, rest.point_counts, rest.colliders, now)
    with pytest.raises(ValueError, match="follow_tip: 2"):
        HairSettings(follow_tip=2.0)


def test_scrubbing_is_the_straight_run(tmp_path: Path) -> None:
    rows = straight(tmp_path / "a")
    rest, inputs = scene()
    session = make(rest, tmp_path / "b", memory_bytes=3000)
    order = np.random.default_rng(5)
    while session.last < 20:
        session.advance(inputs(session.last + 1))
        for frame in order.integers(1, session.last + 1, 3).tolist():
            assert np.array_equal(session.positions(frame), rows[frame - 1])
    assert session.positions(21) is None and session.positions(0) is None
    session.close()


@pytest.mark.parametrize("every", [1, 4])
def test_a_second_process_continues(tmp_path: Path, every: int) -> None:
    rows = straight(tmp_path / "a")
    rest, inputs = scene()
    one = make(rest, tmp_path / "b", snapshot_every=every)
    one.run(11, inputs)
    one.close()
    two = make(rest, tmp_path / "b", snapshot_every=every)
    assert two.last == 11
    assert len(list((tmp_path / "b").glob("*.snap"))) == (11 if every == 1 else 4)
    two.run(20, inputs)
    for frame in range(1, 21):
        assert np.array_equal(two.positions(frame), rows[frame - 1])
    two.close()


def test_damage_is_found(tmp_path: Path) -> None:
    rows = straight(tmp_path, 12)
    rest, inputs = scene()
    place = tmp_path / "000012.snap"
    place.write_bytes(place.read_bytes()[:-100] + bytes(100))
    session = make(rest, tmp_path)
    assert session.last == 11 and any("snapshot of frame 12" in note for note in session.notes)
    place = session.store.path(5)
    place.write_bytes(place.read_bytes()[:200])
    with pytest.raises(ValueError, match="frame 5 is damaged"):
        session.positions(5)
    assert session.last == 4
    session.run(12, inputs)
    assert all(np.array_equal(session.positions(frame), rows[frame - 1]) for frame in range(1, 13))
    session.close()


def test_a_half_written_frame_does_not_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rest, inputs = scene()
    session = make(rest, tmp_path)
    session.run(4, inputs)
    with monkeypatch.context() as patch:

        def full(*_: object) -> None:
            raise OSError(28, "No space left on device")

        patch.setattr(store.os, "replace", full)
        with pytest.raises(OSError, match="No space"):
            session.advance(inputs(5))
    assert session.last == 4 and not list(tmp_path.glob("*.part"))
    session.run(6, inputs)
    assert np.array_equal(session.positions(6), straight(tmp_path / "b", 6)[5])
    session.close()


def test_another_simulation_is_refused(tmp_path: Path) -> None:
    rest, _ = scene()
    make(rest, tmp_path).close()
    with pytest.raises(CacheMismatchError, match=r"other: settings\)"):
        Session(rest, HairSettings(hold=0.9), folder=tmp_path, frame_time=DT)
    rest.points[3, 0] += 1e-6
    with pytest.raises(CacheMismatchError, match="other: scene"):
        make(rest, tmp_path)
    # Threads change nothing.
    rest, _ = scene()
    Session(rest, HairSettings(worker_count=2), folder=tmp_path, frame_time=DT).close()
    (tmp_path / "cache.json").write_text("[")
    with pytest.raises(CacheMismatchError, match="cannot be read"):
        make(rest, tmp_path)
    assert store.recorded(tmp_path) is None
    (tmp_path / "cache.json").write_text(json.dumps([1]))
    with pytest.raises(CacheMismatchError):
        make(rest, tmp_path)
    (tmp_path / "cache.json").unlink()
    with pytest.raises(CacheMismatchError, match="no cache.json"):
        make(rest, tmp_path)
    (tmp_path / "mine.txt").write_text("kept")
    assert store.free(tmp_path) == 1 and (tmp_path / "mine.txt").exists()
    assert store.free(tmp_path / "none") == 0


def test_going_back_branches(tmp_path: Path) -> None:
    rest, inputs = scene()
    session = make(rest, tmp_path / "a", snapshot_every=3)
    session.run(12, inputs)
    old = session.positions(12).copy()
    assert session.go_back(9) == 7 and session.last == 7
    session.run(12, inputs)
    assert np.array_equal(session.positions(12), old)
    assert session.go_back(7) == 7
    session.run(12, lambda frame: inputs(7))
    assert not np.array_equal(session.positions(12), old)
    with pytest.raises(ValueError, match="frame: 13"):
        session.go_back(13)
    session.close()


def test_cancel(tmp_path: Path) -> None:
    rows = straight(tmp_path / "a")
    rest, inputs = scene()
    session, cancel = make(rest, tmp_path / "b"), shx.Cancel()
    session.run(5, inputs)
    cancel.set()
    with pytest.raises(CancelledError):
        session.advance(inputs(6), cancel)
    assert session.last == 5
    cancel.clear()
    timer = threading.Timer(0.02, cancel.set)
    timer.start()
    with pytest.raises(CancelledError):
        session.run(100_000, inputs, cancel)
    timer.join()
    session.run(20, inputs)
    assert all(np.array_equal(session.positions(frame), rows[frame - 1]) for frame in range(1, 21))
    session.close()


def test_the_limit_of_work_is_no_cancellation(tmp_path: Path) -> None:
    """Contact that is cut short gives a frame that is rougher, and a note; the run goes on, and repeats to the bit."""
    rows = []
    for folder in ("a", "b"):
        rest, inputs = scene()
        session = Session(rest, HairSettings(hair_contact=True), folder=tmp_path / folder, frame_time=DT)
        options = session.rig.solver.options()
        options.max_work = 1
        session.rig.solver.set_options(options)
        session.run(6, inputs)
        assert session.last == 6 and session.report.stop_reason == shx.StopReason.WORK
        assert session.notes[-1].startswith("frame 6: contact of ") and "limit of work" in session.notes[-1]
        rows.append(session.positions(6).copy())
        session.close()
    assert np.isfinite(rows[0]).all() and np.array_equal(*rows)


def test_wrong_inputs_change_nothing(tmp_path: Path) -> None:
    rest, inputs = scene()
    session = make(rest, tmp_path)
    state = session.rig.solver.state_hash()
    good = inputs(2)
    for bad, text in (
        (FrameInputs(good.carriers[:3], good.bodies), "number of curves"),
        (FrameInputs(good.carriers, []), "colliders: 0"),
        (FrameInputs(good.carriers, [np.zeros((4, 3))]), "collider ball: 4 vertices"),
        (FrameInputs(np.full_like(good.carriers, np.nan), good.bodies), "frames"),
    ):
        with pytest.raises((ValueError, shx.SuperhelixError), match=text):
            session.advance(bad)
        assert session.last == 1
    session.run(3, inputs)
    assert np.array_equal(session.positions(3), straight(tmp_path / "b", 3)[2]) and session.rig.solver.state_hash() != state
    session.close()
    for change, text in (({"substeps": -1}, "substeps: -1"), ({"hair_type": "blond"}, "'blond'"), ({"friction": -1.0}, "friction: -1")):
        with pytest.raises(ValueError, match=text):
            HairSettings(**change)
    with pytest.raises(ValueError, match="frame_time: 0"):
        Session(rest, HAIR, folder=tmp_path / "c", frame_time=0.0)
    with pytest.raises(ValueError, match="none"):
        Rest(np.zeros((0, 3)), np.zeros(0), [], FrameInputs(np.zeros((0, 7))))


def test_a_deforming_collider_pushes(tmp_path: Path) -> None:
    """A block whose top rises under hair: no point stays inside it, and hair comes along."""
    corners = np.array([[x, y, z] for z in (-0.2, -0.05) for y in (-0.3, 0.3) for x in (0.13, 0.4)])
    faces = np.array(
        [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]], dtype=np.uint32
    )
    assert is_closed(faces)
    rest, _ = scene()
    block = Collider("block", Motion.DEFORMING, corners, faces)
    rest = Rest(rest.points, rest.point_counts, [block], FrameInputs(rest.inputs.carriers, [corners]))
    session = make(rest, tmp_path)
    top = -0.05
    for frame in range(2, 60):
        top = min(-0.05 + 0.005 * frame, 0.075)
        risen = corners.copy()
        risen[4:, 2] = top
        session.advance(FrameInputs(rest.inputs.carriers, [risen]))
    points = session.positions(59).astype(np.float64)
    over = (points[:, 0] > 0.132) & (np.abs(points[:, 1]) < 0.298)
    assert over.sum() > 5
    assert points[over, 2].min() > top - 5e-4
    assert (points[:, 2] - rest.points[:, 2]).max() > 0.02
    session.close()


def test_quality_and_types(tmp_path: Path) -> None:
    """Each quality and type runs, and each moves hair in its own way."""
    ends = {}
    cases = [HairSettings(quality=quality) for quality in Quality] + [HairSettings(hair_type=name, bare=True) for name in HAIR_TYPES]
    for number, settings in enumerate(cases):
        rest, inputs = scene(4)
        session = Session(rest, settings, folder=tmp_path / str(number), frame_time=DT)
        session.run(4, inputs)
        ends[number] = session.positions(4).tobytes()
        assert np.isfinite(session.positions(4)).all()
        session.close()
    assert len(set(ends.values())) == len(cases)


def test_short_curves_follow_their_roots(tmp_path: Path) -> None:
    rest, inputs = scene()
    points = rest.points.reshape(12, 10, 3).copy()
    points[3] = points[3, 0]
    rest = Rest(points.reshape(-1, 3), rest.point_counts, rest.colliders, rest.inputs)
    session = make(rest, tmp_path)
    session.run(5, inputs)
    expected = shx.frames.moved(head(5), relative(head(1), shx.frames.frames(points[3, 0])))[:3]
    assert np.allclose(session.positions(5).reshape(12, 10, 3)[3], expected, atol=1e-7)
    assert session.rig.skipped.tolist() == [3]
    session.close()


def test_rests_as_drawn(tmp_path: Path) -> None:
    rest, _ = scene()
    session = make(rest, tmp_path)
    still = FrameInputs(rest.inputs.carriers, rest.inputs.bodies)
    # Wind is a force that is not in the drawing.
    session.rig.solver.set_wind((0.0, 0.0, 0.0))
    session.run(48, lambda frame: still)
    assert np.abs(session.positions(48) - session.positions(1)).max() < 2e-6
    session.close()


def test_poses() -> None:
    rest, _ = scene()
    lengths = np.linalg.norm(np.diff(rest.points.reshape(12, 10, 3), axis=1), axis=2).sum(1)
    with Poser(rest, HAIR) as poser:
        target = rest.points[9] + [-0.02, 0.03, 0.02]
        posed = poser.drag(0, 1.0, target)
        assert posed.distance < 1e-4 and posed.changed == 1
        rows = posed.points.reshape(12, 10, 3)
        assert np.allclose(rows[0, -1], target, atol=1e-4) and np.array_equal(rows[1:], rest.points.reshape(12, 10, 3)[1:])
        assert np.linalg.norm(np.diff(rows[0], axis=0), axis=1).sum() == pytest.approx(lengths[0], rel=0.01)
        with pytest.raises(ValueError, match="curve: 12"):
            poser.drag(12, 1.0, target)
        with pytest.raises(ValueError, match="fraction: 0"):
            poser.drag(0, 0.0, target)
    with Poser(rest, HAIR) as poser:
        posed = poser.brush(rest.points[19], 0.03, (0.0, 0.0, 0.02))
        assert posed.changed >= 1
        assert posed.points[19, 2] > rest.points[19, 2] + 0.01
        with pytest.raises(shx.SuperhelixError, match="radius"):
            poser.brush(rest.points[19], -1.0, (0, 0, 0))


def test_space() -> None:
    rng = np.random.default_rng(1)
    turn = shx.frames.from_axis_angle((1, 2, 3), 0.7)
    rotation = shx.frames.rotate(turn, np.eye(3)).T
    stretch = np.diag([1.0, 2.0, 0.5])
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation @ stretch, (1, 2, 3)
    frame, found = polar(matrix)
    assert np.allclose(found, stretch) and np.allclose(frame[:3], (1, 2, 3)) and np.allclose(np.abs(frame[3:] @ turn), 1)
    points = rng.normal(size=(7, 3))
    assert np.allclose(transformed(matrix, points), shx.frames.rotate(frame[3:], points @ found.T) + frame[:3])
    with pytest.raises(ValueError, match="mirrors"):
        polar(np.diag([-1.0, 1, 1, 1]))
    carriers, frames = np.stack([head(2), head(5)]), np.stack([head(7), head(3)])
    assert np.allclose(shx.frames.moved(carriers, relative(carriers, frames)), frames)
    corners = rng.normal(size=(5, 3, 3))
    weights = barycentric((corners * [[[0.2], [0.3], [0.5]]]).sum(1), corners)
    assert np.allclose(weights, [0.3, 0.5])
    vertices, faces = ball()
    assert is_closed(faces) and not is_closed(faces[1:])
    places = Attachment.by_places("ball", vertices, faces, [4, 9], vertices[faces[[4, 9], 0]])
    assert np.allclose(places.frames(vertices, len(faces))[:, :3], vertices[faces[[4, 9], 0]])
    with pytest.raises(ValueError, match="surface ball: 3 vertices"):
        places.frames(vertices[:3], len(faces))


def test_store_bounds(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="first: -1"):
        FrameStore(tmp_path, {}, 4, -1)
    frames = FrameStore(tmp_path / "a", {}, 4, 3, memory_bytes=100)
    with pytest.raises(ValueError, match="float64"):
        frames.append(np.zeros((4, 3)), None)
    for number in range(10):
        frames.append(np.full((4, 3), number, dtype=np.float32), b"state")
    assert frames.last == 12 and len(frames) == 10 and len(frames._memory) <= 2
    assert store.recorded(tmp_path / "a").last == 12
    assert frames.read(3)[0, 0] == 0 and frames.snapshot(12) == b"state" and frames.snapshot(13) is None
    frames.path(7).unlink()
    assert FrameStore(tmp_path / "a", {}, 4, 3).last == 6
