"""Operators: setting up, resting as drawn, fitting, posing, growing. Errors are reports, as Blender shows them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
import superhelix as shx
from bpy.props import FloatProperty, FloatVectorProperty, IntProperty

from . import growing, memory, play
from .core import store
from .core.pose import Posed, Poser
from .core.rig import Rig
from .core.space import transformed
from .properties import Role, settings_of
from .surroundings import Surroundings, metres_per_unit, world_matrix

#: What the engine and this package raise for input that cannot be used.
ERRORS = (ValueError, TypeError, LookupError, OSError, RuntimeError, MemoryError, shx.SuperhelixError)
_MUTED = "superhelix_muted"


def active_curves(context: bpy.types.Context) -> bpy.types.Object | None:
    """The active object, if it is hair curves."""
    obj = context.object
    return obj if obj is not None and obj.type == "CURVES" else None


def _moves(modifier: bpy.types.Modifier) -> bool:
    """Whether a modifier moves curves along with their surface, which simulated curves do by themselves, or as an imported file says."""
    if modifier.type == "MESH_SEQUENCE_CACHE":
        return True
    tree = modifier.node_group if modifier.type == "NODES" else None
    return tree is not None and any(node.bl_idname == "GeometryNodeDeformCurvesOnSurface" for node in tree.nodes)


def _present_positions(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> memory.Positions:
    """The positions that are seen: those of an imported file come from a modifier."""
    if not any(modifier.type == "MESH_SEQUENCE_CACHE" and modifier.show_viewport for modifier in obj.modifiers):
        return memory.read(obj.data)
    seen = memory.read(obj.evaluated_get(depsgraph).data)
    if len(seen) != len(obj.data.points):
        raise ValueError(f"curves {obj.name}: {len(obj.data.points)} points, and their modifiers make {len(seen)} of them; apply the modifiers first")
    return seen


class HairOperator(bpy.types.Operator):
    """Works on the active curves; what is raised becomes an error report."""

    bl_options = {"REGISTER", "UNDO"}
    role: Role | None = Role.GUIDES

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether there are curves for it."""
        obj = active_curves(context)
        if obj is None:
            cls.poll_message_set("Select hair curves")
            return False
        if cls.role is not None and obj.superhelix.role != cls.role.value:
            cls.poll_message_set("Set the curves up for simulation first")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Runs it."""
        try:
            return self.work(context, context.object)
        except ERRORS as error:
            self.report({"ERROR"}, str(error) or type(error).__name__)
            return {"CANCELLED"}

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """What it does."""
        raise NotImplementedError


def _at_start(obj: bpy.types.Object, context: bpy.types.Context) -> None:
    first = obj.superhelix.frame_start
    if context.scene.frame_current != first:
        raise ValueError(f"frame {context.scene.frame_current}: the hair is drawn at frame {first}; go there first")


def _hand_over(obj: bpy.types.Object, context: bpy.types.Context, positions: memory.Positions) -> None:
    """Makes positions the drawn ones. The simulation starts again from them."""
    folder, chosen = play.cache_folder(obj)
    if chosen and store.recorded(folder) is not None:
        raise ValueError(f"cache folder {folder}: holds frames of the hair as it was drawn before; free the cache first")
    play.reset(obj)
    memory.keep_drawn(obj.data, positions)
    memory.write(obj.data, positions)


class SUPERHELIX_OT_setup(HairOperator):
    """Simulate these curves when the frame changes. Their present shape is the drawn one, at which they rest."""

    bl_idname = "superhelix.setup"
    bl_label = "Simulate Hair"
    role = None

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Keeps the drawn positions, and switches off what would move curves twice."""
        curves = obj.data
        if obj.superhelix.role == Role.GROWN.value:
            raise ValueError(f"curves {obj.name}: render hair follows its guides; simulate those")
        if curves.users > 1:
            raise ValueError(f"curves {obj.name}: {curves.users} objects share its data; make it single user (Object > Relations)")
        if len(curves.curves) == 0:
            raise ValueError(f"curves {obj.name}: no curves; draw some first")
        if len(memory.types(curves)) > 1 or "BEZIER" in memory.types(curves):
            raise ValueError(f"curves {obj.name}: of types {', '.join(sorted(memory.types(curves)))}; make all Catmull-Rom or Poly (Curves > Set Curve Type)")
        graph = context.evaluated_depsgraph_get()
        fresh = memory.DRAWN not in curves.attributes
        if fresh:
            memory.keep_drawn(curves, _present_positions(obj, graph))
        try:
            around = Surroundings(obj, context.scene, graph)
        except BaseException:
            if fresh:
                curves.attributes.remove(curves.attributes[memory.DRAWN])
            raise
        around.close()
        muted = [modifier for modifier in obj.modifiers if _moves(modifier)]
        for modifier in muted:
            modifier.show_viewport = modifier.show_render = False
        obj[_MUTED] = [modifier.name for modifier in muted]
        memory.animate(curves, context.scene.frame_start, context.scene.frame_end)
        obj.superhelix.role = Role.GUIDES.value
        obj.superhelix.frame_start = context.scene.frame_current
        for warning in around.warnings:
            self.report({"WARNING"}, warning)
        if muted:
            names = ", ".join(modifier.name for modifier in muted)
            self.report({"INFO"}, f"Switched off {names}: simulated curves move by themselves")
        return {"FINISHED"}


class SUPERHELIX_OT_remove(HairOperator):
    """Stop simulating these curves, and show them as drawn. A cache folder that you chose keeps its frames."""

    bl_idname = "superhelix.remove"
    bl_label = "Remove Simulation"

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Puts everything back."""
        play.reset(obj)
        curves = obj.data
        memory.write(curves, memory.drawn(curves))
        if memory.DRAWN in curves.attributes:
            curves.attributes.remove(curves.attributes[memory.DRAWN])
        for name in obj.get(_MUTED, ()):
            if name in obj.modifiers:
                obj.modifiers[name].show_viewport = obj.modifiers[name].show_render = True
        obj.pop(_MUTED, None)
        memory.forget_animation(curves)
        obj.superhelix.role = Role.NONE.value
        return {"FINISHED"}


class SUPERHELIX_OT_rest_as_drawn(HairOperator):
    """Keep the curves' present shape, as you have combed it, as the shape at which they rest. Works at the start frame."""

    bl_idname = "superhelix.rest_as_drawn"
    bl_label = "Make It Rest as Drawn"

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Makes the present positions the drawn ones."""
        _at_start(obj, context)
        _hand_over(obj, context, memory.read(obj.data))
        return {"FINISHED"}


class SUPERHELIX_OT_discard_edits(HairOperator):
    """Drop what was done to the curves since the simulation wrote them, and show the simulation again"""

    bl_idname = "superhelix.discard_edits"
    bl_label = "Discard Edits"

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Writes the frame again."""
        here = play.playback(obj)
        here.written = None
        memory.write(obj.data, memory.drawn(obj.data))
        play.show(obj, context.scene, context.evaluated_depsgraph_get())
        if here.state is play.State.FAILED:
            raise ValueError(here.message)
        return {"FINISHED"}


class SUPERHELIX_OT_fit(HairOperator):
    """Fit strands to the drawn curves and report how close they come. Errors and elements become attributes of the curves"""

    bl_idname = "superhelix.fit"
    bl_label = "Fit"

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Fits, and writes attributes superhelix_fit_error (mm) and superhelix_elements."""
        _at_start(obj, context)
        around = Surroundings(obj, context.scene, context.evaluated_depsgraph_get())
        try:
            rig = Rig(around.rest, settings_of(obj), context.scene.render.fps_base / context.scene.render.fps)
            try:
                count = len(around.rest.point_counts)
                errors, elements = np.zeros(count, dtype=np.float32), np.zeros(count, dtype=np.int32)
                errors[rig.indices] = 1e3 * rig.fit.strands.max_error
                elements[rig.indices] = rig.fit.strands.element_count
                memory.put_numbers(obj.data, "superhelix_fit_error", "FLOAT", errors)
                memory.put_numbers(obj.data, "superhelix_elements", "INT", elements)
                middle, worst = float(np.median(errors)), float(errors.max())
                text = f"{len(rig.indices)} curves, {int(elements.sum())} elements; the median curve is {middle:.2f} mm off at most, the worst {worst:.2f} mm"
                if len(rig.skipped):
                    self.report({"WARNING"}, f"{len(rig.skipped)} curves without length are not simulated, and follow their roots")
                if rig.stuck:
                    self.report({"WARNING"}, f"{rig.stuck} curves are drawn so deep inside a collider that they stay there")
                if rig.stiffening.max() > 1.0:
                    text += f"; made up to {rig.stiffening.max():.2f} times stiffer to rest as drawn"
                self.report({"INFO"}, text)
            finally:
                rig.close()
        finally:
            around.close()
        return {"FINISHED"}


class PosingOperator(HairOperator):
    """A stroke on the drawn hair, at the start frame."""

    def pose(self, context: bpy.types.Context, obj: bpy.types.Object, stroke: Callable[[Poser, float], Posed]) -> Posed:
        """Does a stroke, and makes what comes of it the drawn hair."""
        _at_start(obj, context)
        before = memory.drawn(obj.data)
        graph = context.evaluated_depsgraph_get()
        around = Surroundings(obj, context.scene, graph)
        try:
            with Poser(around.rest, settings_of(obj)) as poser:
                posed = stroke(poser, metres_per_unit(context.scene))
            if posed.changed:
                changed = np.any(posed.points != around.rest.points, axis=1)
                after = transformed(np.linalg.inv(world_matrix(obj, graph, context.scene)), posed.points).astype(np.float32)
                # A surface that has moved since it was drawn on carries the drawn hair: only strokes on the others can be kept.
                if around.moved_since_drawn:
                    raise ValueError(
                        f"surface {obj.data.surface.name}: deformed at frame {context.scene.frame_current}; pose hair where the surface is as it was drawn on"
                    )
                _hand_over(obj, context, np.where(changed[:, None], after, before))
            return posed
        finally:
            around.close()


class SUPERHELIX_OT_drag(PosingOperator):
    """Drag a point of a curve to a place. The curve keeps its length and stays out of colliders"""

    bl_idname = "superhelix.drag"
    bl_label = "Drag Curve"

    curve: IntProperty(name="Curve", default=0, min=0, description="Index of the curve")
    fraction: FloatProperty(name="At", default=1.0, min=0.0, max=1.0, subtype="FACTOR", description="Which point, as a fraction of the length from the root")
    target: FloatVectorProperty(name="To", size=3, subtype="XYZ", unit="LENGTH", description="Where to, in world space")

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Drags."""
        posed = self.pose(context, obj, lambda poser, scale: poser.drag(self.curve, self.fraction, np.array(self.target) * scale))
        if posed.distance > 1e-3:
            self.report({"INFO"}, f"The point stays {1e3 * posed.distance:.1f} mm from there: the curve is too short, or a collider is in between")
        return {"FINISHED"}


class SUPERHELIX_OT_brush(PosingOperator):
    """Brush curves along with a sphere. They keep their lengths and stay out of colliders"""

    bl_idname = "superhelix.brush"
    bl_label = "Brush Curves"

    centre: FloatVectorProperty(name="Centre", size=3, subtype="XYZ", unit="LENGTH", description="Centre of the brush before the stroke, in world space")
    radius: FloatProperty(name="Radius", default=0.03, min=0.0, unit="LENGTH", description="Radius of the brush")
    displacement: FloatVectorProperty(name="Stroke", size=3, subtype="XYZ", unit="LENGTH", description="How far the brush moves, in world space")
    falloff: FloatProperty(name="Falloff", default=1.0, min=0.0, max=100.0, description="How fast the brush gets weaker towards its edge; 0: not at all")

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Brushes."""
        posed = self.pose(
            context,
            obj,
            lambda poser, scale: poser.brush(np.array(self.centre) * scale, self.radius * scale, np.array(self.displacement) * scale, self.falloff),
        )
        self.report({"INFO"}, f"Brushed {posed.changed} curves")
        return {"FINISHED"}


class SUPERHELIX_OT_grow(HairOperator):
    """Add an object of render hair, which follows these curves"""

    bl_idname = "superhelix.grow"
    bl_label = "Grow Render Hair"

    def work(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        """Grows, and shows the present frame."""
        _at_start(obj, context)
        graph = context.evaluated_depsgraph_get()
        here = play.show(obj, context.scene, graph)
        if here.around is None:
            raise ValueError(here.message)
        grown = growing.create(obj, here.around, context)
        context.view_layer.update()
        play.show_grown(grown, context.scene, context.evaluated_depsgraph_get())
        if play.playback(grown).state is play.State.FAILED:
            message = play.playback(grown).message
            bpy.data.objects.remove(grown)
            raise ValueError(message)
        obj.hide_render = True
        self.report({"INFO"}, f"{len(grown.data.curves)} hairs follow {len(obj.data.curves)} curves, which renders do not show any more")
        return {"FINISHED"}


CLASSES: tuple[Any, ...] = (
    SUPERHELIX_OT_setup,
    SUPERHELIX_OT_remove,
    SUPERHELIX_OT_rest_as_drawn,
    SUPERHELIX_OT_discard_edits,
    SUPERHELIX_OT_fit,
    SUPERHELIX_OT_drag,
    SUPERHELIX_OT_brush,
    SUPERHELIX_OT_grow,
)
