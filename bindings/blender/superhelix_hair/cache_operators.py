"""Operators on the cache: baking, cancelling, freeing, simulating again."""

from __future__ import annotations

from typing import Any

import bpy

from . import play
from .core import store
from .operators import ERRORS, HairOperator


class SUPERHELIX_OT_bake(HairOperator):
    """Simulate all frames to the end of the scene into the cache. A bake that was interrupted continues. Escape cancels"""

    bl_idname = "superhelix.bake"
    bl_label = "Bake"
    bl_options = {"REGISTER"}

    def _prepare(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        scene, here = context.scene, play.playback(obj)
        if scene.frame_end < obj.superhelix.frame_start:
            raise ValueError(f"frames: the scene ends at {scene.frame_end}, before the hair starts at {obj.superhelix.frame_start}")
        here.cancel.clear()
        self._return_to = scene.frame_current
        if here.session is None or here.is_stale(obj, scene) or here.state in (play.State.FAILED, play.State.CANCELLED):
            here.close()
            self._go(context, obj, obj.superhelix.frame_start)

    def _go(self, context: bpy.types.Context, obj: bpy.types.Object, frame: int) -> None:
        """Changes the frame; the handler simulates. Raises what failed."""
        context.scene.frame_set(frame)
        here = play.playback(obj)
        if here.state in (play.State.FAILED, play.State.EDITED, play.State.WAITING, play.State.IDLE):
            raise ValueError(here.message)

    def _next(self, context: bpy.types.Context, obj: bpy.types.Object) -> bool:
        """Simulates one more frame; whether there are more."""
        here = play.playback(obj)
        if here.session is None or here.cancel.is_set() or here.session.last >= context.scene.frame_end:
            return False
        self._go(context, obj, here.session.last + 1)
        return not here.cancel.is_set()

    def _finish(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        here = play.playback(obj)
        cancelled = here.cancel.is_set()
        here.cancel.clear()
        if cancelled and here.session is not None:
            here.state = play.State.READY
        context.scene.frame_set(self._return_to)
        last = here.session.last if here.session is not None else self._return_to
        if cancelled:
            self.report({"WARNING"}, f"Cancelled after frame {last}; Bake continues from there")
            return {"CANCELLED"}
        self.report({"INFO"}, f"Frames {obj.superhelix.frame_start} to {last} are in {play.cache_folder(obj)[0]}")
        return {"FINISHED"}

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Bakes all frames in one go."""
        self._prepare(context, obj)
        manager = context.window_manager
        manager.progress_begin(obj.superhelix.frame_start, context.scene.frame_end)
        try:
            while self._next(context, obj):
                manager.progress_update(context.scene.frame_current)
        finally:
            manager.progress_end()
        return self._finish(context, obj)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """In a window: a frame at a time, so that Blender stays usable and Escape cancels."""
        obj = context.object
        if context.window is None:
            return self.execute(context)
        try:
            self._prepare(context, obj)
        except ERRORS as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self._obj = obj
        self._timer = context.window_manager.event_timer_add(0.001, window=context.window)
        context.window_manager.progress_begin(obj.superhelix.frame_start, context.scene.frame_end)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Bakes a frame at each tick."""
        if event.type == "ESC":
            play.playback(self._obj).cancel.set()
        elif event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            if self._next(context, self._obj):
                context.window_manager.progress_update(context.scene.frame_current)
                return {"RUNNING_MODAL"}
            result = self._finish(context, self._obj)
        except ERRORS as error:
            self.report({"ERROR"}, str(error))
            result = {"CANCELLED"}
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        return result


class SUPERHELIX_OT_cancel(HairOperator):
    """Cancel a bake: the frame that is being simulated is dropped, those before it stay"""

    bl_idname = "superhelix.cancel"
    bl_label = "Cancel"
    bl_options = {"REGISTER"}

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Sets the flag that the engine looks at."""
        play.playback(obj).cancel.set()
        return {"FINISHED"}


class SUPERHELIX_OT_free(HairOperator):
    """Remove all frames from the cache"""

    bl_idname = "superhelix.free"
    bl_label = "Free Cache"
    bl_options = {"REGISTER"}

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Removes the files that the cache wrote."""
        play.playback(obj).close()
        folder, _ = play.cache_folder(obj)
        self.report({"INFO"}, f"Removed {store.free(folder)} frames from {folder}")
        return {"FINISHED"}


class SUPERHELIX_OT_simulate_again(HairOperator):
    """Forget the frames after the present one, and simulate them again as the scene is now"""

    bl_idname = "superhelix.simulate_again"
    bl_label = "Simulate Again from Here"
    bl_options = {"REGISTER"}

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Drops frames."""
        here = play.playback(obj)
        if here.session is None:
            raise ValueError(f"curves {obj.name}: no simulation runs; go to frame {obj.superhelix.frame_start}")
        frame = here.session.go_back(min(context.scene.frame_current, here.session.last))
        self.report({"INFO"}, f"Frame {frame + 1} is simulated next")
        return {"FINISHED"}


CLASSES: tuple[Any, ...] = (SUPERHELIX_OT_bake, SUPERHELIX_OT_cancel, SUPERHELIX_OT_free, SUPERHELIX_OT_simulate_again)
