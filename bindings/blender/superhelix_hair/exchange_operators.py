"""Operators that write simulated hair for other programs: Alembic by superhelix.alembic, USD by Blender's exporter.

Blender 5.0 writes no velocities of curves to Alembic; superhelix.alembic does, in world space, where they include what carries the curves.
"""

from __future__ import annotations

import contextlib
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import numpy.typing as npt
from bpy.props import StringProperty
from superhelix import alembic

from . import memory, play
from .core.space import transformed
from .operators import HairOperator
from .properties import Role

_SUFFIXES = (".abc", ".usd", ".usda", ".usdc")
_VELOCITY = "velocity"


class _Recording:
    """Positions of the frames of one object, on disk, and velocities from them."""

    def __init__(self, folder: Path, first: int, last: int, frame_time: float) -> None:
        self._folder, self.first, self.last, self._frame_time = folder, first, last, frame_time

    def path(self, frame: int) -> Path:
        """The file of a frame."""
        return self._folder / f"{min(max(frame, self.first), self.last):06d}.npy"

    def positions(self, frame: int) -> memory.Positions:
        """Those of a frame."""
        return np.asarray(np.load(self.path(frame)))

    def velocities(self, frame: int) -> memory.Positions:
        """Per second, by central differences; at both ends by one-sided ones."""
        before, after = max(frame - 1, self.first), min(frame + 1, self.last)
        span = np.float32(max(after - before, 1) * self._frame_time)
        return np.asarray((self.positions(after) - self.positions(before)) / span, dtype=np.float32)


def _go(obj: bpy.types.Object, scene: bpy.types.Scene, frame: int) -> None:
    """Changes the frame, which simulates it if it is new."""
    scene.frame_set(frame)
    here = play.playback(obj)
    if here.state not in (play.State.READY, play.State.RECORDED):
        raise ValueError(f"frame {frame}: {here.message or here.state.value}")


def _in_world(obj: bpy.types.Object) -> npt.NDArray[np.float64]:
    """The points in world space, in the scene's units."""
    matrix = np.array(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world, dtype=np.float64)
    return transformed(matrix, memory.read(obj.data))


def _widths(obj: bpy.types.Object) -> npt.NDArray[np.float64] | None:
    """Diameters of the points, in the scene's units; None if the curves state none."""
    attribute = obj.data.attributes.get("radius")
    if attribute is None:
        return None
    radii = np.empty(len(obj.data.points), dtype=np.float32)
    attribute.data.foreach_get("value", radii)
    scale = float(np.cbrt(abs(obj.matrix_world.determinant())))
    return 2.0 * scale * radii.astype(np.float64)


def _write_alembic(path: Path, obj: bpy.types.Object, scene: bpy.types.Scene, first: int, last: int) -> None:
    """Writes each frame when the one after it is known, for velocities by central differences."""
    frame_time = scene.render.fps_base / scene.render.fps
    with alembic.HairWriter(path, memory.point_counts(obj.data), widths=_widths(obj), name=obj.name.replace("/", "_")) as writer:
        _go(obj, scene, first)
        before = here = _in_world(obj)
        for frame in range(first, last + 1):
            after = here
            if frame < last:
                _go(obj, scene, frame + 1)
                after = _in_world(obj)
            span = frame_time * max(min(frame + 1, last) - max(frame - 1, first), 1)
            writer.write(frame * frame_time, here, (after - before) / span)
            before, here = here, after


def _record(obj: bpy.types.Object, scene: bpy.types.Scene, recording: _Recording) -> None:
    """Goes through the frames."""
    for frame in range(recording.first, recording.last + 1):
        _go(obj, scene, frame)
        np.save(recording.path(frame), memory.read(obj.data))


@contextlib.contextmanager
def _shown(obj: bpy.types.Object, recording: _Recording) -> Iterator[None]:
    """While exporters change frames, the curves show what was recorded, with the attribute velocity."""
    name, curves = obj.name_full, obj.data

    def show(scene: bpy.types.Scene, _: bpy.types.Depsgraph | None = None) -> None:
        curves = bpy.data.objects[name].data
        memory.put_vectors(curves, _VELOCITY, recording.velocities(scene.frame_current))
        memory.write(curves, recording.positions(scene.frame_current))

    handlers = bpy.app.handlers.frame_change_post
    with play.paused():
        handlers.append(show)
        try:
            yield
        finally:
            handlers.remove(show)
            curves.attributes.remove(curves.attributes[_VELOCITY])


@contextlib.contextmanager
def _alone(context: bpy.types.Context, obj: bpy.types.Object) -> Iterator[None]:
    """The object is all that is selected."""
    selected = list(context.selected_objects)
    for other in selected:
        other.select_set(False)
    obj.select_set(True)
    try:
        yield
    finally:
        obj.select_set(False)
        for other in selected:
            other.select_set(True)


def _write_usd(path: Path, obj: bpy.types.Object, context: bpy.types.Context, first: int, last: int) -> None:
    """Records all frames, then lets Blender export them."""
    scene, folder = context.scene, Path(tempfile.mkdtemp(dir=bpy.app.tempdir))
    whole = scene.frame_start, scene.frame_end
    try:
        recording = _Recording(folder, first, last, scene.render.fps_base / scene.render.fps)
        _record(obj, scene, recording)
        memory.animate(obj.data, first, last)
        scene.frame_start, scene.frame_end = first, last
        with _shown(obj, recording), _alone(context, obj):
            done = bpy.ops.wm.usd_export(
                filepath=str(path), selected_objects_only=True, export_animation=True, evaluation_mode="VIEWPORT", export_materials=False
            )
    finally:
        scene.frame_start, scene.frame_end = whole
        shutil.rmtree(folder, ignore_errors=True)
    if done != {"FINISHED"} or not path.is_file():
        raise ValueError(f"file {path}: Blender could not write it")


class SUPERHELIX_OT_export(HairOperator):
    """Write these curves, simulated or render hair, to an Alembic or USD file: every frame from Start to the end of the scene. Simulates what is missing"""

    bl_idname = "superhelix.export"
    bl_label = "Export Frames"
    bl_options = {"REGISTER"}
    role = None

    filepath: StringProperty(name="File", subtype="FILE_PATH", description="Where to: .abc, .usd, .usda or .usdc")
    filter_glob: StringProperty(default="*.abc;*.usd;*.usda;*.usdc", options={"HIDDEN"})

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Asks for the file."""
        if not self.filepath:
            self.filepath = f"{context.object.name}.abc"
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Checks what it was asked for, and writes."""
        path = Path(bpy.path.abspath(self.filepath))
        if path.suffix.lower() not in _SUFFIXES:
            raise ValueError(f"file {path}: {path.suffix or 'no suffix'}; {', '.join(_SUFFIXES)} expected")
        if not path.parent.is_dir():
            raise ValueError(f"file {path}: no folder {path.parent}")
        guides = obj.superhelix.guides if obj.superhelix.role == Role.GROWN.value else obj
        if guides is None or guides.superhelix.role != Role.GUIDES.value:
            raise ValueError(f"curves {obj.name}: not simulated, and no render hair of simulated curves")
        if not obj.visible_get():
            raise ValueError(f"curves {obj.name}: hidden in the viewport; exporters leave them out")
        scene, first = context.scene, guides.superhelix.frame_start
        if scene.frame_end < first:
            raise ValueError(f"frames: the scene ends at {scene.frame_end}, before the hair starts at {first}")
        last, shown = scene.frame_end, scene.frame_current
        try:
            if path.suffix.lower() == ".abc":
                _write_alembic(path, obj, scene, first, last)
            else:
                _write_usd(path, obj, context, first, last)
        finally:
            scene.frame_set(shown)
        self.report({"INFO"}, f"Frames {first} to {last} of {len(obj.data.curves)} curves are in {path}")
        return {"FINISHED"}


CLASSES: tuple[Any, ...] = (SUPERHELIX_OT_export,)
