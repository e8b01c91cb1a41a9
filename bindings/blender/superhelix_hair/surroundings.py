"""What is around hair in a scene: the surface that carries it, and colliders, as the dependency graph has them now."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np
import numpy.typing as npt
import superhelix as shx
from mathutils.bvhtree import BVHTree

from . import memory
from .core.rest import Collider, FrameInputs, Motion, Rest
from .core.space import Attachment, Numbers, polar, relative, transformed
from .properties import exact

#: Modifiers that keep a mesh in one shape. Any other may deform it.
_KEEP_SHAPE = {
    *("ARRAY", "BEVEL", "BOOLEAN", "BUILD", "DECIMATE", "EDGE_SPLIT", "MASK", "MIRROR", "MULTIRES", "NORMAL_EDIT", "REMESH", "SCREW", "SKIN", "SOLIDIFY"),
    *("SUBSURF", "TRIANGULATE", "UV_PROJECT", "UV_WARP", "VERTEX_WEIGHT_EDIT", "VERTEX_WEIGHT_MIX", "VERTEX_WEIGHT_PROXIMITY", "WEIGHTED_NORMAL", "WELD"),
    *("WIREFRAME", "DATA_TRANSFER", "COLLISION", "PARTICLE_SYSTEM"),
}
#: A surface farther from a root than this, m, is a wrong one or a wrong UV map.
FAR = 0.03


def metres_per_unit(scene: bpy.types.Scene) -> float:
    """Metres per Blender unit. Scenes without a unit system have metres."""
    settings = scene.unit_settings
    return 1.0 if settings.system == "NONE" else exact(settings.scale_length)


def world_matrix(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph, scene: bpy.types.Scene) -> Numbers:
    """From an object's space to world space in metres, 4x4."""
    matrix = np.array(obj.evaluated_get(depsgraph).matrix_world, dtype=np.float64)
    matrix[:3] *= metres_per_unit(scene)
    return matrix


@dataclass
class MeshNow:
    """An evaluated mesh: vertices in the object's space and, where there is one, the attribute rest_position; triangles; loops of their corners."""

    vertices: Numbers
    rest: Numbers | None
    triangles: npt.NDArray[np.uint32]
    uvs: Numbers | None


def evaluated_mesh(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph, uv_map: str = "", *, topology: bool = True) -> MeshNow:
    """The mesh of an object now. uv_map: also the texture coordinates of the triangles' corners."""
    evaluated = obj.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        rows = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        mesh.vertices.foreach_get("co", rows)
        vertices, rest, uvs = rows.reshape(-1, 3).astype(np.float64), None, None
        if not topology:
            # Only the number is wanted.
            return MeshNow(vertices, None, np.zeros((_triangle_count(mesh), 3), dtype=np.uint32), None)
        corners = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
        mesh.loop_triangles.foreach_get("vertices", corners)
        attribute = mesh.attributes.get("rest_position")
        if attribute is not None and attribute.domain == "POINT" and attribute.data_type == "FLOAT_VECTOR":
            attribute.data.foreach_get("vector", rows)
            rest = rows.reshape(-1, 3).astype(np.float64)
        if uv_map and uv_map in mesh.uv_layers:
            loops = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
            mesh.loop_triangles.foreach_get("loops", loops)
            flat = np.empty(2 * len(mesh.loops), dtype=np.float32)
            mesh.uv_layers[uv_map].data.foreach_get("uv", flat)
            uvs = flat.reshape(-1, 2).astype(np.float64)[loops].reshape(-1, 3, 2)
        return MeshNow(vertices, rest, corners.reshape(-1, 3).astype(np.uint32), uvs)
    finally:
        evaluated.to_mesh_clear()


def _triangle_count(mesh: bpy.types.Mesh) -> int:
    return len(mesh.loops) - 2 * len(mesh.polygons)


def deforms(obj: bpy.types.Object) -> bool:
    """Whether an object's mesh may change its shape."""
    return obj.data.shape_keys is not None or any(modifier.show_viewport and modifier.type not in _KEEP_SHAPE for modifier in obj.modifiers)


def _collider_objects(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """The colliders of curves, each once, by name, so that their order does not depend on a collection's."""
    chosen, surface = obj.superhelix, obj.data.surface
    found = {body.name_full: body for body in (chosen.colliders.all_objects if chosen.colliders is not None else ()) if body.type == "MESH"}
    if chosen.use_surface and surface is not None:
        found[surface.name_full] = surface
    return [found[name] for name in sorted(found)]


class Surroundings:
    """Reads the inputs of frames for one object of curves."""

    def __init__(self, obj: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        # Blender replaces objects when it undoes: none is kept, and their names find them.
        self.warnings: list[str] = []
        curves = obj.data
        if len(curves.points) == 0:
            raise ValueError(f"curves {obj.name}: no points; draw some first")
        self._attachment: Attachment | None = None
        #: Whether the surface is not as it was drawn on (attribute rest_position).
        self.moved_since_drawn = False
        #: The surface at the first frame: vertices, m, and triangles.
        self.surface_at_start: tuple[Numbers, npt.NDArray[np.uint32]] | None = None
        self._count = len(curves.curves)
        matrix = world_matrix(obj, depsgraph, scene)
        self._stretch = np.eye(3) if curves.surface is not None else self._polar(f"curves {obj.name}", matrix)[1]
        points = transformed(matrix, memory.drawn(curves))
        counts = memory.point_counts(curves)
        if curves.surface is not None:
            points = self._attach(obj, scene, points, counts, depsgraph)
        self._stretches: dict[str, Numbers] = {}
        self.colliders = [self._collider(body, scene, depsgraph) for body in _collider_objects(obj)]
        rig = self._rigged(obj, depsgraph)
        target_counts = None if rig is None else memory.point_counts(rig)
        self.rest = Rest(points, counts, self.colliders, self.inputs(obj, scene, depsgraph), target_counts)
        length = self.rest.median_length()
        if not 0.005 <= length <= 1.2:
            self.warnings.append(
                f"the median curve is {length:.3g} m long, and hair is 0.005 to 1.2 m: set Unit Scale (Scene Properties > Units), so that the head has its size"
            )

    def _attach(
        self, obj: bpy.types.Object, scene: bpy.types.Scene, points: Numbers, counts: npt.NDArray[np.uint32], depsgraph: bpy.types.Depsgraph
    ) -> Numbers:
        """Puts the roots on the surface; returns the points as the surface of this frame carries them."""
        curves, surface = obj.data, obj.data.surface
        if surface.type != "MESH":
            raise ValueError(f"surface {surface.name}: a {surface.type}; a mesh expected")
        uv_map = curves.surface_uv_map
        now = evaluated_mesh(surface, depsgraph, uv_map)
        if len(now.triangles) == 0:
            raise ValueError(f"surface {surface.name}: a mesh without faces")
        matrix = world_matrix(surface, depsgraph, scene)
        vertices = transformed(matrix, now.vertices)
        self.surface_at_start = vertices, now.triangles
        drawn_on = vertices if now.rest is None else transformed(matrix, now.rest)
        roots = points[np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.int64)]
        attribute = curves.attributes.get("surface_uv_coordinate")
        if attribute is not None and now.uvs is not None:
            uvs = np.empty(2 * self._count, dtype=np.float32)
            attribute.data.foreach_get("vector", uvs)
            try:
                self._attachment = Attachment.by_uvs(surface.name, drawn_on, now.triangles, now.uvs, uvs.reshape(-1, 2).astype(np.float64))
            except shx.InvalidArgumentError as error:
                raise ValueError(f"curves {obj.name}: {error}; Curves > Snap to Nearest Surface attaches them again") from None
        else:
            # Without texture coordinates: the nearest triangles.
            tree = BVHTree.FromPolygons(drawn_on.tolist(), now.triangles.tolist(), all_triangles=True)
            hits = [tree.find_nearest(root) for root in roots.tolist()]
            self._attachment = Attachment.by_places(surface.name, drawn_on, now.triangles, [hit[2] for hit in hits], [tuple(hit[0]) for hit in hits])
        before = self._attachment.frames(drawn_on, len(now.triangles))
        far = np.linalg.norm(before[:, :3] - roots, axis=1)
        if np.any(far > FAR):
            self.warnings.append(
                f"{int((far > FAR).sum())} roots are more than {100 * FAR:.0f} cm from their place on {surface.name} (the farthest {100 * far.max():.1f} cm): "
                "does its UV map overlap itself, or did the surface change? Snap to Nearest Surface attaches them again"
            )
        if np.array_equal(drawn_on, vertices):
            return points
        self.moved_since_drawn = True
        after = self._attachment.frames(vertices, len(now.triangles))
        owners = np.repeat(np.arange(self._count), counts)
        local = relative(before[owners], shx.frames.frames(points))
        return shx.frames.moved(after[owners], local)[:, :3]

    def _collider(self, body: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> Collider:
        options = body.superhelix_collider
        motion = Motion(options.motion) if options.motion != "AUTO" else Motion.DEFORMING if deforms(body) else Motion.RIGID
        now = evaluated_mesh(body, depsgraph)
        matrix = world_matrix(body, depsgraph, scene)
        sides = None if options.sides == "AUTO" else shx.Sides[options.sides]
        triangles = now.triangles
        if motion is Motion.RIGID:
            self._stretches[body.name_full] = self._polar(f"collider {body.name}", matrix)[1]
            vertices = now.vertices @ self._stretches[body.name_full].T
        else:
            vertices = transformed(matrix, now.vertices)
            if np.linalg.det(matrix[:3, :3]) < 0.0:
                triangles = np.ascontiguousarray(triangles[:, ::-1])
        lengths = {name: 1e-3 * exact(getattr(options, name)) for name in ("cell", "thickness", "depth")}
        return Collider(body.name_full, motion, vertices, triangles, sides, friction=exact(options.friction), **lengths)

    def inputs(self, obj: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> FrameInputs:
        """What moves hair, as it is now."""
        matrix = world_matrix(obj, depsgraph, scene)
        if abs(np.linalg.det(matrix[:3, :3])) < 1e-30:
            raise ValueError(f"curves {obj.name}: scaled to nothing")
        if self._attachment is not None:
            surface = obj.data.surface
            if surface is None:
                raise ValueError(f"curves {obj.name}: the surface is gone; reset the simulation")
            now = evaluated_mesh(surface, depsgraph, topology=False)
            carriers = self._attachment.frames(transformed(world_matrix(surface, depsgraph, scene), now.vertices), len(now.triangles))
        else:
            frame, stretch = self._polar(f"curves {obj.name}", matrix)
            self._check_stretch(f"curves {obj.name}", stretch, self._stretch)
            carriers = np.tile(frame, (self._count, 1))
        objects = _collider_objects(obj)
        if [body.name_full for body in objects] != [collider.name for collider in self.colliders]:
            raise ValueError(f"colliders of {obj.name}: others than at the first frame; go there to start with them")
        bodies = [self._body(collider, body, scene, depsgraph) for collider, body in zip(self.colliders, objects, strict=True)]
        rig = self._rigged(obj, depsgraph)
        targets = None if rig is None else transformed(world_matrix(obj.superhelix.target, depsgraph, scene), memory.read(rig).astype(np.float64))
        return FrameInputs(carriers, bodies, np.asarray(np.linalg.inv(matrix), dtype=np.float64), tuple(obj.superhelix.wind), targets)

    @staticmethod
    def _rigged(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bpy.types.Curves | None:
        """The rigged curves that hair follows, as its modifiers leave them now."""
        target = obj.superhelix.target
        if target is None:
            return None
        if target == obj:
            raise ValueError(f"curves {obj.name}: they cannot follow themselves")
        curves = target.evaluated_get(depsgraph).data
        if len(curves.curves) != len(obj.data.curves):
            raise ValueError(f"rigged curves {target.name}: {len(curves.curves)} curves; {len(obj.data.curves)} expected, as {obj.name} has")
        return curves

    def _body(self, collider: Collider, body: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> Numbers:
        matrix = world_matrix(body, depsgraph, scene)
        if collider.motion is Motion.DEFORMING:
            return transformed(matrix, evaluated_mesh(body, depsgraph, topology=False).vertices)
        frame, stretch = self._polar(f"collider {body.name}", matrix)
        self._check_stretch(f"collider {body.name}", stretch, self._stretches[body.name_full])
        return frame

    @staticmethod
    def _polar(what: str, matrix: Numbers) -> tuple[Numbers, Numbers]:
        try:
            return polar(matrix)
        except ValueError as error:
            raise ValueError(f"{what}: {error}") from None

    @staticmethod
    def _check_stretch(what: str, now: Numbers, first: Numbers) -> None:
        if not np.allclose(now, first, rtol=1e-4, atol=1e-5 * np.abs(first).max()):
            raise ValueError(f"{what}: its scale changes; a collider can be set to Deforming")

    def close(self) -> None:
        """Frees what it holds."""
        if self._attachment is not None:
            self._attachment.close()
