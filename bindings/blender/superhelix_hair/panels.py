"""Panels: Physics Properties of hair curves and of colliders."""

from __future__ import annotations

from typing import Any

import bpy

from . import play
from .properties import LOOK, Role


class _Physics:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "physics"


def _lines(layout: bpy.types.UILayout, text: str, icon: str, width: int = 60) -> None:
    """A long text, in lines."""
    words, line = text.split(), ""
    for word in [*words, ""]:
        if line and (not word or len(line) + len(word) >= width):
            layout.label(text=line, icon=icon)
            line, icon = "", "BLANK1"
        line = f"{line} {word}".strip()


class SUPERHELIX_PT_hair(_Physics, bpy.types.Panel):
    """Hair of the active curves."""

    bl_label = "Superhelix Hair"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """For hair curves."""
        return context.object is not None and context.object.type == "CURVES"

    def draw(self, context: bpy.types.Context) -> None:
        """Draws it."""
        layout, obj = self.layout, context.object
        layout.use_property_split = True
        chosen = obj.superhelix
        if chosen.role == Role.NONE.value:
            layout.operator("superhelix.setup", icon="PLAY")
            return
        here = play.playback(obj)
        failed = here.state in (play.State.FAILED, play.State.EDITED)
        _lines(layout, f"{here.state.value}. {here.message}" if here.message else here.state.value, "ERROR" if failed else "INFO")
        for warning in here.warnings:
            _lines(layout, warning, "ERROR")
        if chosen.role == Role.GROWN.value:
            for name in ("guides", *LOOK):
                layout.prop(chosen, name)
            layout.operator("superhelix.export")
            return
        if here.state is play.State.EDITED:
            row = layout.row()
            row.operator("superhelix.rest_as_drawn")
            row.operator("superhelix.discard_edits")
        for name in ("hair_type", "quality", "lock"):
            layout.prop(chosen, name)
        if chosen.lock == "WISP":
            layout.prop(chosen, "hold")
            layout.prop(chosen, "hairs")
        layout.prop(chosen, "wind")
        if chosen.hair_type == "DEFAULT":
            layout.prop(chosen, "air_drag")
        layout.operator("superhelix.remove", icon="X")


class _Sub(_Physics):
    bl_parent_id = "SUPERHELIX_PT_hair"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """For simulated curves."""
        return context.object is not None and context.object.type == "CURVES" and context.object.superhelix.role == Role.GUIDES.value

    def draw(self, context: bpy.types.Context) -> None:
        """Draws it."""
        self.layout.use_property_split = True
        self.fill(self.layout, context.object)

    def fill(self, layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
        """What it shows."""
        raise NotImplementedError


class SUPERHELIX_PT_cache(_Sub, bpy.types.Panel):
    """Frames."""

    bl_label = "Cache"
    bl_options = set()

    def fill(self, layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
        """Folder, bake, free."""
        for name in ("cache_folder", "frame_start", "snapshot_every"):
            layout.prop(obj.superhelix, name)
        here = play.playback(obj)
        if here.frames is not None:
            text = f"Frames {here.frames.first} to {here.frames.last}"
            layout.label(text=f"{text}; {1e3 * here.seconds:.0f} ms for the last new one" if here.seconds else text)
        if here.session is not None and here.session.notes:
            _lines(layout, f"{len(here.session.notes)} notes, the last: {here.session.notes[-1]}", "INFO")
        row = layout.row(align=True)
        for name in ("superhelix.bake", "superhelix.cancel", "superhelix.free"):
            row.operator(name)
        layout.operator("superhelix.simulate_again")
        layout.operator("superhelix.export")


class SUPERHELIX_PT_contact(_Sub, bpy.types.Panel):
    """What hair meets."""

    bl_label = "Colliders"

    def fill(self, layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
        """Surface, collection, friction."""
        for name in ("use_surface", "colliders", "contact_model", "friction", "hair_contact"):
            layout.prop(obj.superhelix, name)


class SUPERHELIX_PT_follow(_Sub, bpy.types.Panel):
    """What hair follows."""

    bl_label = "Follow Rigged Curves"

    def fill(self, layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
        """The rig's curves, and how firmly."""
        layout.prop(obj.superhelix, "target")
        if obj.superhelix.target is not None:
            for name in ("follow_root", "follow_tip", "follow_time"):
                layout.prop(obj.superhelix, name)


class SUPERHELIX_PT_groom(_Sub, bpy.types.Panel):
    """The drawn hair."""

    bl_label = "Groom"

    def fill(self, layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
        """Operators on the drawn hair."""
        for name in ("superhelix.rest_as_drawn", "superhelix.fit", "superhelix.drag", "superhelix.brush"):
            layout.operator(name)


class SUPERHELIX_PT_render(_Sub, bpy.types.Panel):
    """Render hair."""

    bl_label = "Render Hair"

    def fill(self, layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
        """What grows."""
        layout.prop(obj.superhelix, "render_count")
        surface = obj.data.surface
        if surface is not None:
            layout.prop_search(obj.superhelix, "render_density", surface, "vertex_groups")
        for name in ("render_points", *LOOK):
            layout.prop(obj.superhelix, name)
        layout.operator("superhelix.grow")


class SUPERHELIX_PT_advanced(_Sub, bpy.types.Panel):
    """What seldom changes."""

    bl_label = "Advanced"

    def fill(self, layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
        """Numbers of the engine."""
        for name in ("substeps", "element_count", "gravity", "threads"):
            layout.prop(obj.superhelix, name)


class SUPERHELIX_PT_collider(_Physics, bpy.types.Panel):
    """How a mesh keeps hair out."""

    bl_label = "Superhelix Collider"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """For meshes."""
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context: bpy.types.Context) -> None:
        """Draws it."""
        self.layout.use_property_split = True
        options = context.object.superhelix_collider
        for name in ("motion", "sides", "depth", "cell", "thickness", "friction"):
            self.layout.prop(options, name)


CLASSES: tuple[Any, ...] = (
    SUPERHELIX_PT_hair,
    SUPERHELIX_PT_cache,
    SUPERHELIX_PT_contact,
    SUPERHELIX_PT_follow,
    SUPERHELIX_PT_groom,
    SUPERHELIX_PT_render,
    SUPERHELIX_PT_advanced,
    SUPERHELIX_PT_collider,
)
