"""Alembic and USD, through Blender's operators: every frame goes out and comes back; grooms come in."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
import superhelix as shx
from superhelix import alembic
from test_blender_play import check, go

from superhelix_hair import memory, play
from superhelix_hair.play import State

FRAMES = 12


def world(obj: bpy.types.Object) -> np.ndarray:
    """The points that are drawn, in world space."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    matrix = np.array(evaluated.matrix_world, dtype=np.float64)
    return memory.read(evaluated.data) @ matrix[:3, :3].T + matrix[:3, 3]


def walking(frames: int = FRAMES) -> bpy.types.Object:
    carrier, _, hair = scenes.head_scene(every=8, frames=frames)
    scenes.walk(carrier, frames)
    assert bpy.ops.superhelix.setup() == {"FINISHED"}
    return hair


def rows_of(obj: bpy.types.Object, frames: range) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Points of frames, in the space of the curves and in the world."""
    local, there = [], []
    for frame in frames:
        bpy.context.scene.frame_set(frame)
        local.append(memory.read(obj.data))
        there.append(world(obj))
    return local, there


def imported(path: Path) -> bpy.types.Object:
    """The curves of a file, in an empty scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if path.suffix == ".abc":
        bpy.ops.wm.alembic_import(filepath=str(path), as_background_job=False)
    else:
        bpy.ops.wm.usd_import(filepath=str(path))
    return next(obj for obj in bpy.data.objects if obj.type == "CURVES")


def exported(hair: bpy.types.Object, path: Path) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Exports in the middle of the frames; nothing of it stays in the scene. Points as rows_of gives them."""
    bpy.context.scene.frame_set(5)
    handlers = list(bpy.app.handlers.frame_change_post)
    assert bpy.ops.superhelix.export(filepath=str(path)) == {"FINISHED"}
    assert bpy.context.scene.frame_current == 5 and list(bpy.app.handlers.frame_change_post) == handlers
    assert "velocity" not in hair.data.attributes and hair.select_get() and len(list(path.parent.iterdir())) == 1
    check(hair)
    local, there = rows_of(hair, range(1, FRAMES + 1))
    assert np.abs(local[-1] - local[-2]).max() > 1e-4
    return local, there


def test_every_frame_comes_back_from_alembic(tmp_path: Path) -> None:
    """The points of the world, rounded to single precision, at every frame; and velocities, which Blender 5.0 does not read, by superhelix.alembic."""
    hair, path = walking(), tmp_path / "hair.abc"
    fps = bpy.context.scene.render.fps
    _, there = exported(hair, path)
    found = imported(path)
    for frame in range(1, FRAMES + 1):
        bpy.context.scene.frame_set(frame)
        evaluated = found.evaluated_get(bpy.context.evaluated_depsgraph_get())
        assert np.array_equal(memory.read(evaluated.data), there[frame - 1].astype(np.float32)), frame
        assert np.array_equal(world(found).astype(np.float32), there[frame - 1].astype(np.float32)), frame
    with alembic.AlembicFile(path) as file:
        assert np.allclose(file.times, np.arange(1, FRAMES + 1) / fps)
        for frame in range(2, FRAMES):
            read = file.read(frame / fps, up_axis=shx.UpAxis.Z)
            assert np.array_equal(read.points.astype(np.float32), there[frame - 1].astype(np.float32))
            assert np.allclose(read.velocities, (there[frame] - there[frame - 2]) * fps / 2, atol=1e-6)
        assert np.allclose(file.read(1 / fps, up_axis=shx.UpAxis.Z).velocities, (there[1] - there[0]) * fps, atol=1e-6)


@pytest.mark.parametrize("suffix", ["usdc", "usda"])
def test_every_frame_comes_back_from_usd(tmp_path: Path, suffix: str) -> None:
    """The points in the space of the curves, to the bit, with velocities; and what carries the curves, as transforms."""
    hair, path = walking(), tmp_path / f"hair.{suffix}"
    fps = bpy.context.scene.render.fps
    local, there = exported(hair, path)
    found = imported(path)
    for frame in range(1, FRAMES + 1):
        bpy.context.scene.frame_set(frame)
        evaluated = found.evaluated_get(bpy.context.evaluated_depsgraph_get())
        assert np.array_equal(memory.read(evaluated.data), local[frame - 1]), frame
        assert np.abs(world(found) - there[frame - 1]).max() < 1e-6, frame
        if 1 < frame < FRAMES:
            velocities = memory.read(evaluated.data, "velocity")
            assert np.allclose(velocities, (local[frame] - local[frame - 2]) * fps / 2, atol=1e-5)


def test_render_hair_goes_out_too(tmp_path: Path) -> None:
    """With its widths; and the frames that the scene has now, not those when the hair was set up."""
    hair = walking()
    hair.superhelix.render_count, hair.superhelix.render_points, hair.superhelix.hair_radius = 300, 8, 0.05
    go(1)
    bpy.ops.superhelix.grow()
    grown = next(obj for obj in bpy.data.objects if obj.superhelix.role == "GROWN")
    bpy.context.scene.frame_end = 15
    bpy.context.view_layer.objects.active = grown
    for name in ("hair.abc", "hair.usdc"):
        assert bpy.ops.superhelix.export(filepath=str(tmp_path / name)) == {"FINISHED"}
    local, there = rows_of(grown, range(1, 16))
    assert play.playback(hair).session.last == 15
    radius = np.empty(len(local[0]), dtype=np.float32)
    grown.data.attributes["radius"].data.foreach_get("value", radius)
    for name, rows in (("hair.abc", there), ("hair.usdc", local)):
        found = imported(tmp_path / name)
        for frame in range(1, 16):
            bpy.context.scene.frame_set(frame)
            evaluated = found.evaluated_get(bpy.context.evaluated_depsgraph_get())
            assert np.array_equal(memory.read(evaluated.data), rows[frame - 1].astype(np.float32)), (name, frame)
            assert np.abs(world(found) - there[frame - 1]).max() < 1e-6
        again = np.empty_like(radius)
        evaluated.data.attributes["radius"].data.foreach_get("value", again)
        assert np.allclose(again, radius, rtol=1e-6)


def test_hair_that_starts_later(tmp_path: Path) -> None:
    carrier, _, _ = scenes.head_scene(every=12, frames=9)
    scenes.walk(carrier, 9)
    bpy.context.scene.frame_set(4)
    bpy.ops.superhelix.setup()
    bpy.ops.superhelix.export(filepath=str(tmp_path / "hair.usda"))
    text = (tmp_path / "hair.usda").read_text()
    assert "startTimeCode = 4" in text and "endTimeCode = 9" in text
    assert (bpy.context.scene.frame_start, bpy.context.scene.frame_end) == (1, 9)


def test_blenders_own_menu_exports_every_frame_too(tmp_path: Path) -> None:
    hair = walking()
    bpy.ops.superhelix.bake()
    local, _ = rows_of(hair, range(1, FRAMES + 1))
    bpy.ops.wm.alembic_export(filepath=str(tmp_path / "hair.abc"), start=1, end=FRAMES, selected=True)
    found = imported(tmp_path / "hair.abc")
    for frame in range(1, FRAMES + 1):
        bpy.context.scene.frame_set(frame)
        assert np.array_equal(memory.read(found.evaluated_get(bpy.context.evaluated_depsgraph_get()).data), local[frame - 1])


def test_export_errors_change_nothing(tmp_path: Path) -> None:
    hair = walking(frames=4)
    hair.superhelix.role = "NONE"
    with pytest.raises(RuntimeError, match="curves hair: not simulated"):
        bpy.ops.superhelix.export(filepath=str(tmp_path / "a.abc"))
    hair.superhelix.role = "GUIDES"
    for name, text in (("a.obj", "a.obj: .obj; .abc, "), ("a", "no suffix"), ("none/a.abc", "no folder")):
        with pytest.raises(RuntimeError, match=text):
            bpy.ops.superhelix.export(filepath=str(tmp_path / name))
    hair.hide_set(True)
    with pytest.raises(RuntimeError, match="hidden"):
        bpy.ops.superhelix.export(filepath=str(tmp_path / "a.abc"))
    hair.hide_set(False)
    bpy.context.view_layer.objects.active = hair
    bpy.context.scene.frame_end = 0
    with pytest.raises(RuntimeError, match="ends at"):
        bpy.ops.superhelix.export(filepath=str(tmp_path / "a.abc"))
    assert not list(tmp_path.iterdir())


def test_a_groom_comes_from_alembic(tmp_path: Path) -> None:
    """Curves from an .abc file are simulated as those that were exported; the file's own motion is switched off."""
    carrier, bust, hair = scenes.head_scene(every=8, frames=10)
    scenes.shake(carrier, 10, angle=0.5)
    # A groom that moves in its file, so that Blender reads it frame by frame.
    drawn = memory.read(hair.data)

    def lift(scene: bpy.types.Scene, _: bpy.types.Depsgraph) -> None:
        memory.write(hair.data, drawn + np.float32(0.01 * (scene.frame_current - 1)))

    memory.animate(hair.data, 1, 3)
    bpy.app.handlers.frame_change_post.append(lift)
    bpy.ops.wm.alembic_export(filepath=str(tmp_path / "groom.abc"), start=1, end=3, selected=True)
    bpy.context.scene.frame_set(1)
    bpy.app.handlers.frame_change_post.remove(lift)
    bpy.ops.superhelix.setup()
    shown = [go(frame) for frame in range(1, 11)]
    bpy.data.objects.remove(hair)
    bpy.ops.wm.alembic_import(filepath=str(tmp_path / "groom.abc"), as_background_job=False, set_frame_range=False)
    groom = next(obj for obj in bpy.data.objects if obj.type == "CURVES")
    assert [modifier.type for modifier in groom.modifiers] == ["MESH_SEQUENCE_CACHE"]
    groom.constraints.clear()
    groom.parent = bust
    groom.matrix_parent_inverse.identity()
    groom.matrix_basis.identity()
    bpy.context.view_layer.objects.active = groom
    scenes.attach(groom, bust)
    bpy.context.scene.frame_set(1)
    assert bpy.ops.superhelix.setup() == {"FINISHED"}
    assert not groom.modifiers[0].show_viewport and np.array_equal(memory.drawn(groom.data), drawn)
    again = [go(frame) for frame in range(1, 11)]
    check(groom, State.READY)
    assert all(np.array_equal(one, other) for one, other in zip(again, shown, strict=True))
    assert bpy.ops.superhelix.remove() == {"FINISHED"}
    assert groom.modifiers[0].show_viewport
