"""Render hair in a scene: an object of curves that follows simulated ones."""

from __future__ import annotations

import bpy
import numpy as np
import superhelix as shx

from . import memory
from .core.growth import Growth
from .core.space import Attachment, Numbers, transformed
from .properties import LOOK, Role, exact, settings_of
from .surroundings import Surroundings, evaluated_mesh, world_matrix

TRIANGLE, WEIGHTS = "superhelix_triangle", "superhelix_weights"


def look_of(obj: bpy.types.Object, points_per_strand: int, worker_count: int = 1) -> shx.RenderSettings:
    """The engine's settings that an object's options say."""
    chosen = obj.superhelix
    radius = 1e-3 * exact(chosen.hair_radius)
    return shx.RenderSettings(
        points_per_strand=points_per_strand,
        curliness=exact(chosen.curliness),
        interpolation=shx.Interpolation[chosen.follow],
        wisps_per_guide=chosen.render_wisps,
        wisp_profile=[exact(number) for number in chosen.wisp_profile],
        max_tip_distance=1e-3 * exact(chosen.parting),
        length_variation=exact(chosen.length_variation),
        frizz=1e-3 * exact(chosen.frizz),
        flyaway_fraction=exact(chosen.flyaways),
        flyaway_distance=1e-3 * exact(chosen.flyaway_distance),
        seed=chosen.render_seed,
        radius=radius,
        tip_radius=radius * 15 / 40,
        worker_count=worker_count,
    )


def _density(surface: bpy.types.Object, name: str, depsgraph: bpy.types.Depsgraph) -> Numbers:
    """The weights of a vertex group, for each vertex of the evaluated mesh."""
    group = surface.vertex_groups.get(name)
    if group is None:
        raise ValueError(f"surface {surface.name}: no vertex group {name}; Density names one, or nothing")
    evaluated = surface.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        weights = np.zeros(len(mesh.vertices))
        for number, vertex in enumerate(mesh.vertices):
            for item in vertex.groups:
                if item.group == group.index:
                    weights[number] = item.weight
    finally:
        evaluated.to_mesh_clear()
    if not weights.any():
        raise ValueError(f"surface {surface.name}: vertex group {name} has no weights")
    return weights


def scatter(guides: bpy.types.Object, scene: bpy.types.Scene, around: Surroundings, count: int, seed: int) -> shx.records.FollicleTable:
    """Follicles on the surface, where the density says, or else where the guides cover it."""
    surface = guides.data.surface
    if surface is None:
        raise ValueError(f"curves {guides.name}: no surface; render hair grows on the surface that its guides are attached to (Object Data > Surface)")
    graph = bpy.context.evaluated_depsgraph_get()
    now = evaluated_mesh(surface, graph)
    vertices = transformed(world_matrix(surface, graph, scene), now.vertices)
    with shx.Scalp(vertices, now.triangles) as scalp:
        if guides.superhelix.render_density:
            return scalp.scatter(count, density=_density(surface, guides.superhelix.render_density, graph), seed=seed)
        starts = np.concatenate([[0], np.cumsum(around.rest.point_counts)[:-1]]).astype(np.int64)
        return scalp.scatter(count, guide_roots=around.rest.points[starts], seed=seed)


def create(guides: bpy.types.Object, around: Surroundings, context: bpy.types.Context) -> bpy.types.Object:
    """Makes an object of render hair, on follicles that its curves remember."""
    chosen = guides.superhelix
    follicles = scatter(guides, context.scene, around, chosen.render_count, chosen.render_seed)
    if len(follicles) == 0:
        raise ValueError(f"curves {guides.name}: no follicle lies near a guide")
    curves = bpy.data.hair_curves.new(f"{guides.name} Render Hair")
    curves.add_curves([chosen.render_points] * len(follicles))
    memory.put_numbers(curves, TRIANGLE, "INT", follicles.triangle.astype(np.int32))
    weights = curves.attributes.new(WEIGHTS, "FLOAT2", "CURVE")
    weights.data.foreach_set("vector", follicles.barycentric.astype(np.float32).reshape(-1))
    curves.attributes.new("radius", "FLOAT", "POINT")
    for material in guides.data.materials:
        curves.materials.append(material)
    obj = bpy.data.objects.new(curves.name, curves)
    (guides.users_collection or (context.scene.collection,))[0].objects.link(obj)
    for name in LOOK:
        setattr(obj.superhelix, name, getattr(chosen, name))
    obj.superhelix.guides = guides
    obj.superhelix.role = Role.GROWN.value
    memory.animate(curves, context.scene.frame_start, context.scene.frame_end)
    return obj


def _choice(obj: bpy.types.Object) -> tuple[object, ...]:
    """The options of the look, to compare."""
    return tuple(tuple(value) if name == "wisp_profile" else value for name in LOOK if (value := getattr(obj.superhelix, name)) is not None)


class Grown:
    """Render hair that is bound to its guides."""

    def __init__(self, obj: bpy.types.Object, guides: bpy.types.Object, around: Surroundings) -> None:
        curves = obj.data
        surface = guides.data.surface
        if surface is None:
            raise ValueError(f"curves {guides.name}: the surface is gone")
        count = len(curves.curves)
        table = np.zeros(count, dtype=np.dtype(shx.records.FollicleTable._STRUCT))
        triangles, weights = np.empty(count, dtype=np.int32), np.empty(2 * count, dtype=np.float32)
        curves.attributes[TRIANGLE].data.foreach_get("value", triangles)
        curves.attributes[WEIGHTS].data.foreach_get("vector", weights)
        table["triangle"], table["barycentric"] = triangles, np.clip(weights.reshape(-1, 2), 0.0, 1.0)
        if around.surface_at_start is None:
            raise ValueError(f"curves {guides.name}: attached to no surface when the simulation started; reset it")
        vertices, faces = around.surface_at_start
        if triangles.max(initial=0) >= len(faces):
            raise ValueError(f"render hair {obj.name}: the surface has lost faces; grow it again")
        self._attachment = Attachment(surface.name, vertices, faces, shx.records.FollicleTable(table))
        look = look_of(obj, len(curves.points) // count, settings_of(guides).worker_count)
        self._around = around
        self._look = _choice(obj)
        self._growth = Growth(around.rest, self._attachment.frames(vertices, len(faces)), look)

    def is_current(self, obj: bpy.types.Object, around: Surroundings) -> bool:
        """Whether this follows guides that are still there, and looks as the options say."""
        return self._around is around and self._look == _choice(obj)

    def show(self, obj: bpy.types.Object, guides: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        """Puts the hair where the guides are now."""
        surface = guides.data.surface
        points = transformed(world_matrix(guides, depsgraph, scene), memory.read(guides.data))
        now = evaluated_mesh(surface, depsgraph, topology=False)
        roots = self._attachment.frames(transformed(world_matrix(surface, depsgraph, scene), now.vertices), len(now.triangles))
        inputs = self._around.inputs(guides, scene, depsgraph)
        hair = self._growth.evaluate(points, inputs, roots).reshape(-1, 4)
        matrix = world_matrix(obj, depsgraph, scene)
        memory.write(obj.data, transformed(np.linalg.inv(matrix), hair[:, :3]).astype(np.float32))
        scale = float(np.cbrt(abs(np.linalg.det(matrix[:3, :3]))))
        obj.data.attributes["radius"].data.foreach_set("value", hair[:, 3] / np.float32(scale))

    def close(self) -> None:
        """Frees it."""
        self._growth.close()
        self._attachment.close()
