"""What the user chooses, kept in the file."""

from __future__ import annotations

import os
from collections.abc import Callable
from enum import Enum

import bpy
import numpy as np
import superhelix as shx
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty, StringProperty

from .core.settings import HAIR_TYPES, HairSettings, Quality


class Role(Enum):
    """What curves are to the extension."""

    NONE = "NONE"
    GUIDES = "GUIDES"
    GROWN = "GROWN"


_ROLES = [
    ("NONE", "None", "Curves that are not simulated"),
    ("GUIDES", "Guides", "Curves that are simulated"),
    ("GROWN", "Render Hair", "Curves that follow simulated ones"),
]
_TYPES = [("DEFAULT", "Default", "Hair 0.1 mm thick, 2 GPa stiff, of 1300 kg/m³")] + [
    (name.upper(), name.upper() if len(name) < 4 else name.replace("1", " 1").replace("2", " 2").title(), f"Measured hair: {name}") for name in HAIR_TYPES
]
_QUALITIES = [
    ("PREVIEW", "Preview", "For interactive work: the character of the motion is right, its course is not"),
    ("STANDARD", "Standard", "Ten elements a curve, more for curls; two substeps a frame"),
    ("FINAL", "Final", "For final animation: errors should not be visible"),
    ("ACCURATE", "Accurate", "For measurements"),
]
_MOTIONS = [
    ("AUTO", "Automatic", "Deforming if the object has shape keys, or a modifier that may deform it"),
    ("RIGID", "Rigid", "The object moves and turns; the first time its distance grid is baked, which takes seconds"),
    ("DEFORMING", "Deforming", "Vertices move. Costs more for each frame"),
]
_SIDES = [
    ("AUTO", "Automatic", "Solid if the mesh is closed, else front"),
    ("SOLID", "Solid", "A closed mesh: hair is pushed out from any depth"),
    ("FRONT", "Front", "Hair stays in front of the faces; for an open bust"),
    ("BOTH", "Both", "A sheet: hair stays on the side where it is"),
]


#: Options of render hair that the object that has grown keeps, and that take effect at once.
LOOK = (
    *("curliness", "follow", "render_seed", "render_wisps", "wisp_profile", "parting", "length_variation", "frizz", "flyaways", "flyaway_distance"),
    "hair_radius",
)


#: Called with an object of render hair whose look has changed; layers above add themselves.
LOOK_LISTENERS: list[Callable[[bpy.types.Object], None]] = []


def _look_changed(options: bpy.types.PropertyGroup, _: bpy.types.Context) -> None:
    if options.role == Role.GROWN.value:
        for listener in LOOK_LISTENERS:
            listener(options.id_data)


class ColliderOptions(bpy.types.PropertyGroup):
    """How an object keeps hair out."""

    motion: EnumProperty(name="Motion", items=_MOTIONS, default="AUTO", description="How the object moves")
    sides: EnumProperty(name="Sides", items=_SIDES, default="AUTO", description="Which sides of a deforming mesh keep hair out")
    cell: FloatProperty(
        name="Cell (mm)", default=0.0, min=0.0, max=1000.0, description="Cells of a rigid object's distance grid, mm. 0: 5 mm, or a 128th of a large object"
    )
    thickness: FloatProperty(name="Thickness (mm)", default=0.0, min=0.0, max=1000.0, description="Distance of the surface outside the mesh, mm")
    depth: FloatProperty(
        name="Depth (mm)", default=20.0, min=0.1, max=1000.0, description="Of sides in front: how far behind the faces hair is still pushed out, mm"
    )
    friction: FloatProperty(name="Friction", default=1.0, min=0.0, max=100.0, description="Factor on the friction of hair")


class HairOptions(bpy.types.PropertyGroup):
    """How curves are simulated, or grown."""

    role: EnumProperty(name="Role", items=_ROLES, default="NONE", options={"HIDDEN"})
    hair_type: EnumProperty(
        name="Hair Type", items=_TYPES, default="DEFAULT", description="Thickness, stiffness, drag and friction of one hair. Shapes stay as drawn"
    )
    quality: EnumProperty(name="Quality", items=_QUALITIES, default="STANDARD", description="How finely to simulate")
    lock: EnumProperty(
        name="Curve Is",
        items=[
            ("WISP", "A Lock", "Each curve stands for a lock of many hairs, which keeps its style"),
            ("HAIR", "One Hair", "Each curve is a single hair, which is limp and loses its style"),
        ],
        default="WISP",
        description="What a curve stands for",
    )
    hold: FloatProperty(
        name="Hold",
        default=0.6,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
        description="How firmly locks keep their style: 0 clean loose hair, 0.4 soft, 0.6 styled, 0.7 with product, 1 lacquered",
    )
    hairs: FloatProperty(
        name="Hairs per Lock", default=200.0, min=1.0, max=1e6, precision=0, description="How many hairs a curve stands for: weight and thickness"
    )
    substeps: IntProperty(name="Substeps", default=0, min=0, max=1000, description="Steps per frame. 0: as the quality says")
    element_count: IntProperty(name="Elements", default=0, min=0, max=1000, description="Helical elements of a curve; curls get more. 0: as the quality says")
    contact_model: EnumProperty(
        name="Contact",
        items=[
            ("COULOMB", "Exact", "Surfaces do not overlap, and hair sticks and slides. For final animation"),
            ("PENALTY", "Fast", "Springs: hair overlaps by millimetres, and always creeps. Half the time"),
        ],
        default="COULOMB",
        description="How contact is solved",
    )
    hair_contact: BoolProperty(name="Hair on Hair", default=False, description="Locks collide with each other. Costs several times more")
    friction: FloatProperty(name="Friction", default=1.0, min=0.0, max=100.0, description="Factor on the friction of hair on colliders")
    air_drag: FloatProperty(
        name="Air Drag",
        default=5.0,
        min=0.0,
        max=1000.0,
        description="Drag of one hair of the default type, 10⁻⁶ kg/(m s): 5 disciplined, 50 fuzzy, 0 does not feel wind",
    )
    gravity: FloatVectorProperty(name="Gravity (m/s²)", default=(0.0, 0.0, -9.81), size=3, description="Gravity, m/s², whatever the scene's unit scale")
    wind: FloatVectorProperty(name="Wind (m/s)", default=(0.0, 0.0, 0.0), size=3, description="Wind, m/s. It can be animated")
    threads: IntProperty(name="Threads", default=0, min=0, max=256, description="Processor threads; results do not depend on them. 0: all")
    use_surface: BoolProperty(name="Collide with Surface", default=True, description="Keep hair out of the surface that it is attached to")
    colliders: PointerProperty(type=bpy.types.Collection, name="Colliders", description="Mesh objects in this collection keep hair out")
    target: PointerProperty(
        type=bpy.types.Object,
        name="Rigged Curves",
        poll=lambda _self, obj: obj.type == "CURVES",
        description="Hair curves that a rig moves, one for each simulated curve in the same order. Simulated curves are drawn to them",
    )
    follow_root: FloatProperty(
        name="At Root", default=1.0, min=0.0, max=1.0, subtype="FACTOR", description="How firmly curves follow the rig at their roots: 0 free, 1 on the rig"
    )
    follow_tip: FloatProperty(
        name="At Tip", default=0.0, min=0.0, max=1.0, subtype="FACTOR", description="How firmly curves follow the rig at their tips: 0 free, 1 on the rig"
    )
    follow_time: FloatProperty(
        name="Time (s)", default=0.1, min=0.0001, max=100.0, description="Time constant with which a point comes to the rig where the weight is one half"
    )
    frame_start: IntProperty(name="Start", default=1, min=0, description="Frame at which the hair is as drawn")
    cache_folder: StringProperty(
        name="Cache Folder",
        subtype="DIR_PATH",
        default="",
        description="Frames are kept here, and are there when Blender starts again. Empty: a temporary folder, gone when Blender ends",
    )
    snapshot_every: IntProperty(
        name="Snapshot Every", default=10, min=1, max=1000, description="Frames between states of the engine in the cache, from which a simulation continues"
    )
    guides: PointerProperty(type=bpy.types.Object, name="Guides", description="The simulated curves that these follow")
    render_seed: IntProperty(name="Seed", default=0, min=0, description="Another seed gives other render hair", update=_look_changed)
    render_count: IntProperty(name="Count", default=5000, min=1, max=1_000_000, description="Number of render hairs")
    render_points: IntProperty(name="Points", default=16, min=2, max=256, description="Points of a render hair. Curls need 8 a turn")
    curliness: FloatProperty(
        name="Clumping",
        default=0.5,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
        description="0: spread between guides; 0.5: wisps at the tips; 1: separate locks",
        update=_look_changed,
    )
    follow: EnumProperty(
        name="Follow",
        items=[
            ("POSITION", "Positions", "Hairs stay between guides; curls may cancel"),
            ("CURVATURE", "Curvatures", "Curls and lengths stay; twice the time"),
        ],
        default="POSITION",
        description="What render hair takes from its guides",
        update=_look_changed,
    )
    render_density: StringProperty(
        name="Density",
        default="",
        description="Vertex group of the surface: how densely render hair grows. Empty: evenly wherever guides cover the surface",
    )
    render_wisps: IntProperty(name="Wisps", default=4, min=1, max=10_000, description="Wisps that the hairs of a guide gather in", update=_look_changed)
    wisp_profile: FloatVectorProperty(
        name="Wisp Profile",
        default=(1.0, 0.6, 0.08),
        min=0.0,
        max=100.0,
        size=3,
        description="Radius of a wisp at root, middle and tip, relative to the spacing of roots",
        update=_look_changed,
    )
    parting: FloatProperty(
        name="Parting (mm)",
        default=0.0,
        min=0.0,
        max=1000.0,
        description="Hairs do not mix guides whose tips are farther apart than their roots by more than this, mm. 0: no limit",
        update=_look_changed,
    )
    length_variation: FloatProperty(
        name="Length Variation",
        default=0.25,
        min=0.0,
        max=0.99,
        subtype="FACTOR",
        description="Largest part by which hairs are cut short, at random",
        update=_look_changed,
    )
    frizz: FloatProperty(
        name="Frizz (mm)", default=0.0, min=0.0, max=100.0, description="How far hairs leave their paths at the tips, mm", update=_look_changed
    )
    flyaways: FloatProperty(
        name="Flyaways", default=0.02, min=0.0, max=1.0, subtype="FACTOR", description="Fraction of hairs that leave their wisps", update=_look_changed
    )
    flyaway_distance: FloatProperty(
        name="Flyaway Distance (mm)", default=5.0, min=0.0, max=1000.0, description="How far these leave them at the tips, mm", update=_look_changed
    )
    hair_radius: FloatProperty(
        name="Radius (mm)", default=0.04, min=0.001, max=10.0, precision=3, description="Radius of a hair at its root, mm", update=_look_changed
    )


def exact(number: float) -> float:
    """The decimal that was typed: Blender keeps 0.6 as the nearest float32, which is 0.60000002."""
    return float(str(np.float32(number)))


def settings_of(obj: bpy.types.Object) -> HairSettings:
    """The engine's settings that an object's options say."""
    chosen = obj.superhelix
    return HairSettings(
        hair_type="" if chosen.hair_type == "DEFAULT" else chosen.hair_type.lower(),
        air_drag=1e-6 * exact(chosen.air_drag) if chosen.hair_type == "DEFAULT" else None,
        hairs=exact(chosen.hairs),
        hold=exact(chosen.hold),
        bare=chosen.lock == "HAIR",
        quality=Quality(chosen.quality),
        substeps=chosen.substeps,
        element_count=chosen.element_count,
        hair_contact=chosen.hair_contact,
        contact_model=shx.ContactModel[chosen.contact_model],
        friction=exact(chosen.friction),
        follow_root=exact(chosen.follow_root),
        follow_tip=exact(chosen.follow_tip),
        follow_time=exact(chosen.follow_time),
        gravity=(exact(chosen.gravity[0]), exact(chosen.gravity[1]), exact(chosen.gravity[2])),
        worker_count=chosen.threads or min(os.cpu_count() or 1, 256),
    )


CLASSES = (ColliderOptions, HairOptions)


def register() -> None:
    """Adds the options to objects."""
    bpy.types.Object.superhelix = PointerProperty(type=HairOptions)
    bpy.types.Object.superhelix_collider = PointerProperty(type=ColliderOptions)


def unregister() -> None:
    """Takes them away."""
    del bpy.types.Object.superhelix
    del bpy.types.Object.superhelix_collider
