"""The timeline: what each object of curves shows at a frame."""

from __future__ import annotations

import contextlib
import time
import traceback
from collections.abc import Iterator
from enum import Enum
from pathlib import Path

import bpy
import numpy as np
import superhelix as shx
from bpy.app.handlers import persistent

from . import memory
from .core import store
from .core.session import CancelledError, Session
from .growing import Grown
from .properties import LOOK_LISTENERS, Role, settings_of
from .surroundings import Surroundings


class State(Enum):
    """Where the playback of an object is."""

    IDLE = "Not simulated yet"
    READY = "Simulated"
    WAITING = "This frame is not simulated yet"
    RECORDED = "Shows a cache"
    EDITED = "The curves were edited"
    CANCELLED = "Cancelled"
    FAILED = "Failed"


class Playback:
    """What belongs to one object while Blender runs."""

    def __init__(self) -> None:
        self.state = State.IDLE
        #: Why it failed, or what the user should know.
        self.message = ""
        self.session: Session | None = None
        self.around: Surroundings | None = None
        self.recorded: store.FrameStore | None = None
        self.cancel = shx.Cancel()
        self.written: memory.Positions | None = None
        self.warnings: list[str] = []
        self._digest = ""
        #: Seconds that the last new frame took.
        self.seconds = 0.0

    def close(self) -> None:
        """Forgets the simulation. Frames in the cache stay."""
        if self.session is not None:
            self.session.close()
        if self.around is not None:
            self.around.close()
        self.session = self.around = self.recorded = None
        self.state, self.message = State.IDLE, ""

    @property
    def frames(self) -> store.FrameStore | None:
        """The frames that there are."""
        return self.session.store if self.session is not None else self.recorded

    def fail(self, error: Exception) -> None:
        """Keeps an error, for the panel and for operators."""
        self.state, self.message = State.FAILED, str(error) or type(error).__name__

    def start(self, obj: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        """Builds the simulation, unless the one that there is starts alike. The scene is at its first frame."""
        around = Surroundings(obj, scene, depsgraph)
        try:
            if self.session is not None and not self.is_stale(obj, scene) and around.rest.digest() == self.session.rest.digest():
                around.close()
                return
            self.close()
            self.session = self._open(obj, scene, around)
        except BaseException:
            around.close()
            raise
        self.around, self.warnings = around, list(around.warnings)
        self._digest = self._digest_of(obj, scene)

    @staticmethod
    def _open(obj: bpy.types.Object, scene: bpy.types.Scene, around: Surroundings) -> Session:
        """A session in the cache folder."""
        folder, keep = cache_folder(obj)
        options, frame_time = obj.superhelix, scene.render.fps_base / scene.render.fps

        def session() -> Session:
            first, every = options.frame_start, options.snapshot_every
            return Session(around.rest, settings_of(obj), folder=folder, frame_time=frame_time, first=first, snapshot_every=every)

        try:
            return session()
        except store.CacheMismatchError:
            if keep:
                raise
            # Nobody chose this folder: its frames are of no use any more.
            store.free(folder)
            return session()

    @staticmethod
    def _digest_of(obj: bpy.types.Object, scene: bpy.types.Scene) -> str:
        options = obj.superhelix
        rest = (
            options.frame_start,
            options.snapshot_every,
            options.cache_folder,
            options.use_surface,
            options.colliders.name_full if options.colliders is not None else "",
            scene.render.fps,
            scene.render.fps_base,
        )
        return f"{settings_of(obj).digest()} {rest}"

    def is_stale(self, obj: bpy.types.Object, scene: bpy.types.Scene) -> bool:
        """Whether the options have changed since the simulation started."""
        return self.session is not None and self._digest != self._digest_of(obj, scene)

    def show(self, obj: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        """Shows the present frame, which is simulated now if it is the next."""
        frame, first = scene.frame_current, obj.superhelix.frame_start
        if self.written is not None and len(self.written) == len(obj.data.points) and not np.array_equal(memory.read(obj.data), self.written):
            self.state, self.message = State.EDITED, "Make It Rest as Drawn keeps the edit, Discard Edits drops it"
            return
        if frame < first:
            self.state, self.message = State.READY, ""
            self._write(obj, memory.drawn(obj.data))
            return
        if frame == first and scene.frame_subframe == 0.0:
            self.start(obj, scene, depsgraph)
        if self.session is None and self.recorded is None:
            folder, _ = cache_folder(obj)
            self.recorded = store.recorded(folder)
            if self.recorded is not None and self.recorded.point_count != len(obj.data.points):
                self.recorded = None
        frames = self.frames
        if frames is None:
            self.state, self.message = State.IDLE, f"Go to frame {first}, or bake"
            return
        self.state, self.message = (State.READY if self.session is not None else State.RECORDED), ""
        if self.session is not None and self.around is not None and frame == self.session.last + 1 and scene.frame_subframe == 0.0:
            if self.is_stale(obj, scene):
                self.state, self.message = State.WAITING, f"The options have changed: go to frame {first}"
                return
            self._advance(obj, scene, depsgraph)
        positions = _between(frames, max(frame + scene.frame_subframe, frames.first))
        if positions is None:
            self.state, self.message = State.WAITING, f"Frames {frames.first} to {frames.last} are simulated: play on from there, or bake"
            positions = frames.read(frames.last)
        if positions is not None:
            self._write(obj, positions)

    def _advance(self, obj: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        assert self.session is not None and self.around is not None
        before = time.perf_counter()
        self.session.advance(self.around.inputs(obj, scene, depsgraph), self.cancel)
        self.seconds = time.perf_counter() - before

    def _write(self, obj: bpy.types.Object, positions: memory.Positions) -> None:
        memory.write(obj.data, positions)
        self.written = positions


def _between(frames: store.FrameStore, moment: float) -> memory.Positions | None:
    """Positions at a moment: linear between frames, those of the frame before where the next is missing."""
    frame = int(np.floor(moment))
    before, fraction = frames.read(frame), np.float32(moment - frame)
    after = frames.read(frame + 1) if fraction > 0.0 else None
    if before is None or after is None:
        return before
    return np.asarray(before + fraction * (after - before), dtype=np.float32)


_PLAYBACKS: dict[int, Playback] = {}
_GROWN: dict[int, Grown] = {}


def playback(obj: bpy.types.Object) -> Playback:
    """The playback of an object."""
    return _PLAYBACKS.setdefault(obj.session_uid, Playback())


def cache_folder(obj: bpy.types.Object) -> tuple[Path, bool]:
    """The folder of an object's frames, and whether the user chose it."""
    chosen = obj.superhelix.cache_folder
    if chosen:
        return Path(bpy.path.abspath(chosen)), True
    return Path(bpy.app.tempdir) / f"superhelix_hair_{obj.session_uid}", False


def simulated(scene: bpy.types.Scene, role: Role = Role.GUIDES) -> list[bpy.types.Object]:
    """The objects of a scene that have a role."""
    return [obj for obj in scene.objects if obj.type == "CURVES" and obj.superhelix.role == role.value]


def show(obj: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> Playback:
    """Shows an object's present frame, and keeps errors in its playback."""
    here = playback(obj)
    if here.state in (State.FAILED, State.CANCELLED) and scene.frame_current != obj.superhelix.frame_start:
        return here
    if here.state is State.CANCELLED:
        here.cancel.clear()
    try:
        here.show(obj, scene, depsgraph)
    except CancelledError as error:
        here.state, here.message = State.CANCELLED, f"{error}; go to frame {obj.superhelix.frame_start} to continue"
    except (ValueError, TypeError, LookupError, OSError, RuntimeError, MemoryError, shx.SuperhelixError) as error:
        here.fail(error)
    return here


def show_grown(obj: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Puts render hair where its guides are."""
    guides = obj.superhelix.guides
    if guides is None or guides.superhelix.role != Role.GUIDES.value:
        return
    here = playback(obj)
    try:
        grown = _GROWN.get(obj.session_uid)
        source = playback(guides)
        if source.around is None:
            here.state, here.message = State.WAITING, f"Go to frame {guides.superhelix.frame_start}: render hair starts there"
            return
        if grown is None or not grown.is_current(obj, source.around):
            if grown is not None:
                grown.close()
            grown = _GROWN[obj.session_uid] = Grown(obj, guides, source.around)
        grown.show(obj, guides, scene, depsgraph)
        here.state, here.message = State.READY, ""
    except (ValueError, TypeError, LookupError, OSError, RuntimeError, MemoryError, shx.SuperhelixError) as error:
        here.fail(error)


def _show_look(obj: bpy.types.Object) -> None:
    """Shows render hair whose options have changed, unless its guides are not simulated yet."""
    if obj.superhelix.guides is not None and playback(obj.superhelix.guides).around is not None:
        show_grown(obj, bpy.context.scene, bpy.context.evaluated_depsgraph_get())


def reset(obj: bpy.types.Object) -> None:
    """Forgets the simulation of an object, and what was written; a folder that nobody chose goes too."""
    here = playback(obj)
    here.close()
    here.written = None
    here.cancel.clear()
    folder, keep = cache_folder(obj)
    if not keep:
        store.free(folder)


def _tell(obj: bpy.types.Object, here: Playback) -> None:
    """Shows an error once, as Blender does outside of operators."""
    print(f"superhelix: {obj.name}: {here.message}")
    if bpy.app.background or bpy.context.window is None:
        return
    with contextlib.suppress(RuntimeError):
        bpy.context.window_manager.popup_menu(lambda menu, _: menu.layout.label(text=here.message), title=f"Hair of {obj.name}", icon="ERROR")


@persistent
def on_frame(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph | None = None) -> None:
    """Handler: after the frame has changed, and everything around the hair is evaluated."""
    try:
        graph = depsgraph if depsgraph is not None else bpy.context.evaluated_depsgraph_get()
        for obj in simulated(scene):
            before = playback(obj).state
            here = show(obj, scene, graph)
            if here.state is State.FAILED and before is not State.FAILED:
                _tell(obj, here)
        for obj in simulated(scene, Role.GROWN):
            before = playback(obj).state
            show_grown(obj, scene, graph)
            if playback(obj).state is State.FAILED and before is not State.FAILED:
                _tell(obj, playback(obj))
    except Exception:
        # Nothing may escape into Blender's frame change.
        traceback.print_exc()


@persistent
def on_load(*_: object) -> None:
    """Handler: another file."""
    forget_all()


@persistent
def on_undo(*_: object) -> None:
    """Handler: Blender put older curves in place, which nobody edited."""
    for here in _PLAYBACKS.values():
        here.written = None


def forget_all() -> None:
    """Closes every simulation."""
    for here in _PLAYBACKS.values():
        here.close()
    for grown in _GROWN.values():
        grown.close()
    _PLAYBACKS.clear()
    _GROWN.clear()


_HANDLERS = (("frame_change_post", on_frame), ("load_pre", on_load), ("undo_post", on_undo), ("redo_post", on_undo))


@contextlib.contextmanager
def paused() -> Iterator[None]:
    """Frames change without the extension."""
    handlers = bpy.app.handlers.frame_change_post
    handlers.remove(on_frame)
    try:
        yield
    finally:
        handlers.append(on_frame)


def register() -> None:
    """Adds the handlers."""
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)
    LOOK_LISTENERS.append(_show_look)


def unregister() -> None:
    """Takes them away."""
    LOOK_LISTENERS.remove(_show_look)
    for name, handler in _HANDLERS:
        with contextlib.suppress(ValueError):
            getattr(bpy.app.handlers, name).remove(handler)
    forget_all()
