"""Operators that write simulated hair for other programs, by Blender's exporters of Alembic and USD."""

from __future__ import annotations

import contextlib
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from bpy.props import StringProperty

from . import memory, play
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


def _record(obj: bpy.types.Object, scene: bpy.types.Scene, recording: _Recording) -> None:
    """Goes through the frames."""
    for frame in range(recording.first, recording.last + 1):
        scene.frame_set(frame)
        here = play.playback(obj)
        if here.state not in (play.State.READY, play.State.RECORDED):
            raise ValueError(f"frame {frame}: {here.message or here.state.value}")
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
        """Records all frames, then exports."""
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
        shown, folder = scene.frame_current, Path(tempfile.mkdtemp(dir=bpy.app.tempdir))
        recording = _Recording(folder, first, scene.frame_end, scene.render.fps_base / scene.render.fps)
        memory.animate(obj.data, recording.first, recording.last)
        try:
            _record(obj, scene, recording)
            with _shown(obj, recording), _alone(context, obj):
                self._write(path, recording)
        finally:
            shutil.rmtree(folder, ignore_errors=True)
            scene.frame_set(shown)
        self.report({"INFO"}, f"Frames {recording.first} to {recording.last} of {len(obj.data.curves)} curves are in {path}")
        return {"FINISHED"}

    @staticmethod
    def _write(path: Path, recording: _Recording) -> None:
        if path.suffix.lower() == ".abc":
            done = bpy.ops.wm.alembic_export(
                filepath=str(path), start=recording.first, end=recording.last, selected=True, evaluation_mode="VIEWPORT", as_background_job=False
            )
        else:
            scene = bpy.context.scene
            whole = scene.frame_start, scene.frame_end
            scene.frame_start, scene.frame_end = recording.first, recording.last
            try:
                done = bpy.ops.wm.usd_export(
                    filepath=str(path), selected_objects_only=True, export_animation=True, evaluation_mode="VIEWPORT", export_materials=False
                )
            finally:
                scene.frame_start, scene.frame_end = whole
        if done != {"FINISHED"} or not path.is_file():
            raise ValueError(f"file {path}: Blender could not write it")


CLASSES: tuple[Any, ...] = (SUPERHELIX_OT_export,)
