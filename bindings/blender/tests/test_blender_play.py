"""Frames of a real groom in Blender: the engine's own, to the bit; scrubbed, baked, resumed."""

from __future__ import annotations

import subprocess
import sys
import textwrap
import threading
from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
import superhelix as shx

from superhelix_hair import cache_operators, memory, play
from superhelix_hair.core.space import polar, relative, transformed
from superhelix_hair.play import State

FRAMES = 100


def go(frame: int, subframe: float = 0.0) -> np.ndarray:
    """Changes the frame; returns the positions of the evaluated curves, which is what is drawn."""
    bpy.context.scene.frame_set(frame, subframe=subframe)
    obj = bpy.context.object
    graph = bpy.context.evaluated_depsgraph_get()
    shown = memory.read(obj.evaluated_get(graph).data)
    assert np.array_equal(shown, memory.read(obj.data))
    return shown


def check(obj: bpy.types.Object, state: State = State.READY) -> play.Playback:
    here = play.playback(obj)
    assert here.state is state, here.message
    return here


def engine_run(bust: bpy.types.Object, hair: bpy.types.Object, frames: int) -> list[np.ndarray]:
    """The engine without the extension: superhelix.prepare and step, with the head as Blender animates it."""
    scene = bpy.context.scene

    def world(obj: bpy.types.Object) -> np.ndarray:
        return np.array(obj.matrix_world, dtype=np.float64)

    flat = np.empty(3 * len(bust.data.vertices), dtype=np.float32)
    bust.data.vertices.foreach_get("co", flat)
    vertices = flat.reshape(-1, 3).astype(np.float64)
    faces = np.array([polygon.vertices[:] for polygon in bust.data.polygons], dtype=np.uint32)
    uv = np.empty(2 * len(bust.data.loops), dtype=np.float32)
    bust.data.uv_layers["UVMap"].data.foreach_get("uv", uv)
    at = np.empty(2 * len(hair.data.curves), dtype=np.float32)
    hair.data.attributes["surface_uv_coordinate"].data.foreach_get("vector", at)

    scene.frame_set(1)
    drawn = transformed(world(hair), memory.drawn(hair.data))
    counts = memory.point_counts(hair.data)
    scalp = shx.Scalp(transformed(world(bust), vertices), faces, uvs=uv.reshape(-1, 3, 2))
    follicles = scalp.follicles_at_uvs(at.reshape(-1, 2))
    pose, stretch = polar(world(bust))
    body = shx.BodyDef.grid(
        shx.bake_distance_grid(vertices @ stretch.T, faces, 0.005, 0.03), pose=shx.Frame(origin=pose[:3].tolist(), rotation=pose[3:].tolist())
    )
    rows = []
    with shx.prepare(shx.Groom(drawn, counts), body=body, hair=shx.Material(air_drag=5e-6)) as made:
        assert len(made.skipped) == 0
        solver, strands = made.solver, made.strands
        local = relative(scalp.root_frames(follicles, transformed(world(bust), vertices)), solver.root_frames(strands))
        lengths = solver.strand_lengths(strands)
        places = []
        for number, curve in enumerate(np.split(drawn, np.cumsum(counts)[:-1])):
            along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
            along *= lengths[number] / along[-1]
            along[-1] = lengths[number]
            places.append(along)
        for frame in range(1, frames + 1):
            if frame > 1:
                scene.frame_set(frame)
                carriers = scalp.root_frames(follicles, transformed(world(bust), vertices))
                solver.set_root_frames(shx.frames.moved(carriers, local), strands, 1 / 24)
                solver.set_body_frames(polar(world(bust))[0][None], made.body, 1 / 24)
                solver.step(1 / 24, 2)
            points = np.concatenate([solver.sample_at(strands[number], along) for number, along in enumerate(places)])
            rows.append(transformed(np.linalg.inv(world(hair)), points).astype(np.float32))
    scalp.close()
    return rows


@pytest.fixture(scope="module")
def straight() -> list[np.ndarray]:
    """A hundred frames of the walk, simulated as frames change."""
    carrier, _, hair = scenes.head_scene(frames=FRAMES)
    scenes.walk(carrier, FRAMES)
    assert bpy.ops.superhelix.setup() == {"FINISHED"}
    rows = [go(frame) for frame in range(1, FRAMES + 1)]
    report = check(hair).session.report
    assert report.quarantined == 0 and report.unconverged == 0
    return rows


def walking(**options: object) -> tuple[bpy.types.Object, bpy.types.Object]:
    carrier, bust, hair = scenes.head_scene(frames=FRAMES)
    scenes.walk(carrier, FRAMES)
    for name, value in options.items():
        setattr(hair.superhelix, name, value)
    assert bpy.ops.superhelix.setup() == {"FINISHED"}
    return bust, hair


def test_equal_to_the_engine(straight: list[np.ndarray]) -> None:
    """All frames are those of the engine's own run, to the bit; and hair does move."""
    bust, hair = walking()
    hair.superhelix.role = "NONE"
    expected = engine_run(bust, hair, FRAMES)
    different = [frame + 1 for frame in range(FRAMES) if not np.array_equal(straight[frame], expected[frame])]
    assert different == []
    assert np.linalg.norm(straight[-1] - straight[0], axis=1).max() > 0.01
    # Roots stay on the head, which carries the space of the curves.
    roots = [curve.first_point_index for curve in hair.data.curves]
    assert np.abs(straight[-1][roots] - straight[0][roots]).max() < 1e-5


def test_scrubbing(straight: list[np.ndarray]) -> None:
    _, hair = walking()
    order = np.random.default_rng(3)
    go(1)
    for frame in range(2, 31):
        assert np.array_equal(go(frame), straight[frame - 1])
        for other in order.integers(1, frame + 1, 2).tolist():
            assert np.array_equal(go(other), straight[other - 1])
    # Beyond what is simulated the last frame stays, and says so.
    assert np.array_equal(go(60), straight[29])
    assert "1 to 30" in check(hair, State.WAITING).message
    assert np.array_equal(go(31), straight[30])
    check(hair)
    middle = go(20, 0.5)
    assert np.allclose(middle, 0.5 * (straight[19] + straight[20]), atol=1e-7)
    # The engine goes on where it was.
    assert np.array_equal(go(32), straight[31])


def test_simulate_again_from_here(straight: list[np.ndarray]) -> None:
    _, hair = walking(snapshot_every=1)
    for frame in range(1, 21):
        go(frame)
    go(12)
    assert bpy.ops.superhelix.simulate_again() == {"FINISHED"}
    assert check(hair).session.last == 12
    hair.superhelix.wind = (4.0, 0.0, 0.0)
    assert not np.array_equal(go(13), straight[12])
    go(12)
    bpy.ops.superhelix.simulate_again()
    hair.superhelix.wind = (0.0, 0.0, 0.0)
    assert np.array_equal(go(13), straight[12])


def test_bake_is_the_straight_run_and_outlives_blender(straight: list[np.ndarray], tmp_path: Path) -> None:
    _, hair = walking(cache_folder=str(tmp_path / "cache"))
    go(7)
    assert bpy.ops.superhelix.bake() == {"FINISHED"}
    assert bpy.context.scene.frame_current == 7
    assert np.array_equal(go(100), straight[99])
    blend = str(tmp_path / "walk.blend")
    bpy.ops.wm.save_as_mainfile(filepath=blend)
    bpy.ops.wm.open_mainfile(filepath=blend)
    hair = bpy.data.objects["hair"]
    # A cache is shown without a simulation.
    for frame in (42, 99, 3):
        assert np.array_equal(go(frame), straight[frame - 1])
        check(hair, State.RECORDED)
    assert np.array_equal(np.load(tmp_path / "cache" / "000042.npy"), straight[41])
    # A second bake has nothing to do; other options are refused, and the frames stay.
    assert bpy.ops.superhelix.bake() == {"FINISHED"}
    hair.superhelix.hold = 0.9
    with pytest.raises(RuntimeError, match="another simulation .other: settings"):
        bpy.ops.superhelix.bake()
    assert len(list((tmp_path / "cache").glob("*.npy"))) == 100
    assert bpy.ops.superhelix.free() == {"FINISHED"}
    assert not (tmp_path / "cache").exists()


def test_resumes_after_a_crash(straight: list[np.ndarray], tmp_path: Path) -> None:
    """A bake in a process that is killed in the middle; another bake continues it."""
    _, hair = walking(cache_folder=str(tmp_path / "cache"))
    blend = str(tmp_path / "walk.blend")
    bpy.ops.wm.save_as_mainfile(filepath=blend)
    program = f"""
        import os, signal, sys
        sys.path[:0] = [{str(Path(__file__).resolve().parents[1])!r}]
        import bpy, superhelix_hair
        superhelix_hair.register()
        bpy.ops.wm.open_mainfile(filepath={blend!r})
        # After the extension's own handler: while frame 41 is being written.
        from superhelix_hair.core import store
        write = store._write
        def crash(path, data):
            if path.name == "000041.npy":
                path.with_name("000041.npy.1.part").write_bytes(data[:1000])
                os.kill(os.getpid(), signal.SIGKILL)
            write(path, data)
        store._write = crash
        bpy.context.view_layer.objects.active = bpy.data.objects["hair"]
        bpy.ops.superhelix.bake()
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == -9, done.stdout + done.stderr
    assert len(list((tmp_path / "cache").glob("*.npy"))) == 40
    assert bpy.ops.superhelix.bake() == {"FINISHED"}
    notes = check(hair).session.notes
    assert notes == ["continues after frame 40, which was cached"]
    for frame in range(1, FRAMES + 1):
        assert np.array_equal(np.load(tmp_path / "cache" / f"{frame:06d}.npy"), straight[frame - 1])
    bpy.ops.superhelix.free()
    assert not (tmp_path / "cache").exists()


def test_cancel_a_bake(straight: list[np.ndarray]) -> None:
    _, hair = walking()
    go(1)
    timer = threading.Timer(0.4, play.playback(hair).cancel.set)
    timer.start()
    assert bpy.ops.superhelix.bake() == {"CANCELLED"}
    timer.join()
    last = check(hair).session.last
    assert 1 <= last < FRAMES
    assert bpy.context.scene.frame_current == 1
    assert bpy.ops.superhelix.bake() == {"FINISHED"}
    for frame in (last, last + 1, FRAMES):
        assert np.array_equal(go(frame), straight[frame - 1])


def test_bake_in_a_window(straight: list[np.ndarray]) -> None:
    """The modal operator, a frame at a tick: Escape cancels, other events pass, a second one goes on. Blender has no window here: a stub stands for it."""
    _, hair = walking()
    bpy.context.scene.frame_end = 12
    go(1)
    reports: list[tuple[set[str], str]] = []
    calls: list[str] = []

    class Manager:
        def __getattr__(self, name: str):
            return lambda *args, **kwargs: calls.append(name)

    class Context:
        scene, object, window, window_manager = bpy.context.scene, hair, object(), Manager()

    class Event:
        def __init__(self, kind: str) -> None:
            self.type = kind

    bake = cache_operators.SUPERHELIX_OT_bake
    functions = {name: item for base in reversed(bake.__mro__) for name, item in vars(base).items() if callable(item) and not name.startswith("__")}
    functions["report"] = lambda self, kind, text: reports.append((kind, text))
    one = type("Bake", (), functions)()
    assert one.invoke(Context, Event("LEFTMOUSE")) == {"RUNNING_MODAL"}
    for _ in range(3):
        assert one.modal(Context, Event("TIMER")) == {"RUNNING_MODAL"}
    assert one.modal(Context, Event("MOUSEMOVE")) == {"PASS_THROUGH"}
    assert check(hair).session.last == 4
    assert one.modal(Context, Event("ESC")) == {"CANCELLED"}
    assert reports == [({"WARNING"}, "Cancelled after frame 4; Bake continues from there")]
    assert calls.count("event_timer_add") == calls.count("event_timer_remove") == 1
    two = type("Bake", (), functions)()
    assert two.invoke(Context, Event("LEFTMOUSE")) == {"RUNNING_MODAL"}
    results = [two.modal(Context, Event("TIMER")) for _ in range(9)]
    assert results == [{"RUNNING_MODAL"}] * 8 + [{"FINISHED"}]
    assert all(np.array_equal(go(frame), straight[frame - 1]) for frame in range(1, 13))


def test_cancel_while_playing(straight: list[np.ndarray]) -> None:
    _, hair = walking()
    for frame in range(1, 5):
        go(frame)
    bpy.ops.superhelix.cancel()
    go(5)
    assert "go to frame 1" in check(hair, State.CANCELLED).message
    go(1)
    check(hair)
    assert np.array_equal(go(5), straight[4])


def alike(one: np.ndarray, other: np.ndarray) -> None:
    """Nearly all points agree. A rounding may decide how a curve that is drawn inside the head leaves it, and when a contact begins."""
    apart = np.linalg.norm(one - other, axis=1)
    assert np.median(apart) < 1e-7 and np.quantile(apart, 0.95) < 5e-5 and apart.max() < 5e-3


def test_without_uvs_the_nearest_face_carries(straight: list[np.ndarray]) -> None:
    """The same roots by another path: frames turn about the normal differently, motion does not."""
    carrier, _, hair = scenes.head_scene(frames=FRAMES, uvs=False)
    scenes.walk(carrier, FRAMES)
    bpy.ops.superhelix.setup()
    for frame in range(1, 21):
        shown = go(frame)
    check(hair)
    alike(shown, straight[19])


def test_centimetres(straight: list[np.ndarray]) -> None:
    """A scene in centimetres moves as one in metres."""
    carrier, _, hair = scenes.head_scene(frames=FRAMES, unit=0.01)
    scenes.walk(carrier, FRAMES, unit=0.01)
    bpy.ops.superhelix.setup()
    for frame in range(1, 21):
        shown = go(frame)
    assert check(hair).warnings == []
    alike(0.01 * shown, straight[19])
    # In metres, the same numbers are hair of ten metres, which is worth a warning.
    bpy.context.scene.unit_settings.scale_length = 1.0
    go(1)
    assert any("Unit Scale" in warning for warning in check(hair).warnings)


def test_rendering_an_animation_simulates(straight: list[np.ndarray], tmp_path: Path) -> None:
    """Frames of a render are those of playing, and pictures show them."""
    _, hair = walking()
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (0.0, -1.2, 0.35), (np.pi / 2, 0.0, 0.0)
    scene.collection.objects.link(camera)
    scene.camera, scene.frame_end = camera, 8
    scene.render.engine, scene.cycles.samples, scene.cycles.device = "CYCLES", 1, "CPU"
    scene.render.resolution_x = scene.render.resolution_y = 48
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = str(tmp_path / "f")
    bpy.ops.render.render(animation=True)
    assert check(hair).session.last == 8
    for frame in range(1, 9):
        assert np.array_equal(go(frame), straight[frame - 1])
    assert len({path.read_bytes() for path in tmp_path.glob("f*.png")}) == 8


def test_undo_is_no_edit(straight: list[np.ndarray]) -> None:
    """Undo puts older curves and other objects in Blender's memory; the simulation goes on."""
    _, hair = walking()
    for frame in range(1, 6):
        go(frame)
    bpy.ops.ed.undo_push(message="five")
    bpy.data.objects["carrier"].empty_display_size = 2.0
    for frame in range(6, 9):
        go(frame)
    bpy.ops.ed.undo_push(message="eight")
    bpy.ops.ed.undo()
    assert bpy.data.objects["carrier"].empty_display_size == 1.0
    hair = bpy.data.objects["hair"]
    for frame in (7, 8, 9, 10):
        assert np.array_equal(go(frame), straight[frame - 1])
    check(hair)


def test_bounds_follow() -> None:
    """What Blender keeps about positions is not that of an older frame."""
    carrier, _, hair = scenes.head_scene(every=8, frames=20)
    scenes.shake(carrier, 20, angle=0.6)
    bpy.ops.superhelix.setup()
    for frame in range(1, 16):
        shown = go(frame)
        evaluated = hair.evaluated_get(bpy.context.evaluated_depsgraph_get())
        box = np.array([corner[:] for corner in evaluated.bound_box])
        # Hair that states no radius has one of a centimetre.
        assert np.allclose(box.max(0) - shown.max(0), 0.01, atol=2e-4) and np.allclose(shown.min(0) - box.min(0), 0.01, atol=2e-4)
