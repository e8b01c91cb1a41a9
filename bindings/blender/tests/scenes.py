"""Scenes of the tests: Sintel's hair on her bust, which an animated object carries."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import superhelix as shx
from mathutils import Matrix, Quaternion
from mathutils.bvhtree import BVHTree

GROOMS = Path(__file__).resolve().parents[3] / "tests" / "data" / "grooms"
#: Y up to Blender's Z up.
TURN = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def mesh_object(name: str, vertices, faces, uvs: bool = False) -> bpy.types.Object:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(np.asarray(vertices).tolist(), [], np.asarray(faces).tolist())
    if uvs:
        # Each triangle has its own place on the map.
        layer = mesh.uv_layers.new(name="UVMap")
        side = int(np.ceil(np.sqrt(len(faces))))
        rows = np.zeros((len(faces), 3, 2))
        cell = np.stack([np.arange(len(faces)) % side, np.arange(len(faces)) // side], axis=1)
        rows[:] = ((cell[:, None] + np.array([[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]])) / side).astype(np.float32)
        layer.data.foreach_set("uv", rows.astype(np.float32).reshape(-1))
    mesh.update()
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def curves_object(name: str, points, counts) -> bpy.types.Object:
    curves = bpy.data.hair_curves.new(name)
    if len(counts):
        # Blender 5.0 crashes on an empty list.
        curves.add_curves([int(count) for count in counts])
        curves.attributes["position"].data.foreach_set("vector", np.asarray(points, dtype=np.float32).reshape(-1))
    obj = bpy.data.objects.new(name, curves)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def attach(curves: bpy.types.Object, surface: bpy.types.Object, uvs: bool = True) -> None:
    """What Snap to Nearest Surface does, without moving roots."""
    data = curves.data
    data.surface = surface
    if not uvs:
        return
    data.surface_uv_map = "UVMap"
    mesh = surface.data
    corners = np.array([polygon.vertices[:] for polygon in mesh.polygons])
    vertices = np.array([vertex.co[:] for vertex in mesh.vertices])
    flat = np.empty(2 * len(mesh.loops), dtype=np.float32)
    mesh.uv_layers["UVMap"].data.foreach_get("uv", flat)
    uv = flat.reshape(-1, 3, 2)
    tree = BVHTree.FromPolygons(vertices.tolist(), corners.tolist(), all_triangles=True)
    starts = [curve.first_point_index for curve in data.curves]
    found = []
    for start in starts:
        place, _, index, _ = tree.find_nearest(data.points[start].position)
        one, two, three = vertices[corners[index]]
        solved = np.linalg.lstsq(np.stack([two - one, three - one], axis=1), np.array(place) - one, rcond=None)[0]
        solved = np.clip(solved, 0.001, 0.998)
        solved /= max(solved.sum() / 0.999, 1.0)
        found.append(uv[index, 0] + solved[0] * (uv[index, 1] - uv[index, 0]) + solved[1] * (uv[index, 2] - uv[index, 0]))
    attribute = data.attributes.new("surface_uv_coordinate", "FLOAT2", "CURVE")
    attribute.data.foreach_set("vector", np.array(found, dtype=np.float32).reshape(-1))


def sintel(every: int = 1, unit: float = 1.0):
    """Points (m), counts, vertices and faces of Sintel's hair and bust, z up; unit: metres per Blender unit."""
    groom = shx.Groom.read(GROOMS / "sintel_hair_001.tfx", scale=0.01, every=every)
    vertices, faces = shx.read_obj_mesh(GROOMS / "sintel_bust.obj", 0.01)
    return groom.points @ TURN.T / unit, groom.point_counts, vertices @ TURN.T / unit, faces


def head_scene(every: int = 1, unit: float = 1.0, frames: int = 100, fps: int = 24, uvs: bool = True, settings: bool = False):
    """The groom on the bust on an empty object that can be animated: (carrier, bust, hair). settings: keeps those of the user, with extensions."""
    if settings:
        bpy.ops.wm.read_homefile(use_empty=True)
    else:
        bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps = 1, frames, fps
    scene.unit_settings.system, scene.unit_settings.scale_length = "METRIC", unit
    points, counts, vertices, faces = sintel(every, unit)
    bust = mesh_object("bust", vertices, faces, uvs)
    hair = curves_object("hair", points, counts)
    attach(hair, bust, uvs)
    carrier = bpy.data.objects.new("carrier", None)
    scene.collection.objects.link(carrier)
    carrier.rotation_mode = "QUATERNION"
    bust.parent = carrier
    hair.parent = bust
    bpy.context.view_layer.objects.active = hair
    hair.select_set(True)
    scene.frame_set(1)
    return carrier, bust, hair


def walk(carrier: bpy.types.Object, frames: int, unit: float = 1.0, fps: int = 24, ease: float = 0.0) -> None:
    """Keyframes of a recorded head, relative to its first pose, about the head's joint. ease: seconds in which it comes up to speed."""
    times, poses = shx.read_motion(GROOMS / "walk_figure8_head.csv")
    motion = shx.motion_from_samples(times, poses)
    first, joint = motion(0.0), np.array([0.0, 1.55, 0.0])
    for frame in range(1, frames + 1):
        time = (frame - 1) / fps
        time = time**2 / (2.0 * ease) if time < ease else time - 0.5 * ease
        row = shx.carried(first, motion(time), joint)
        matrix = np.eye(4)
        matrix[:3, :3] = TURN @ shx.frames.rotate(row[3:], np.eye(3)).T @ TURN.T
        matrix[:3, 3] = TURN @ row[:3] / unit
        key(carrier, frame, matrix)
    linear(carrier)


def shake(carrier: bpy.types.Object, frames: int, angle: float = 0.45, period: float = 24.0, until: float = 48.0) -> None:
    """Keyframes of a head that turns to and fro about the vertical, and comes to rest."""
    for frame in range(1, frames + 1):
        envelope = np.clip((frame - 1) / 8, 0, 1) * np.clip((until - frame) / 8, 0, 1)
        turn = Quaternion((0.0, 0.0, 1.0), float(angle * envelope * np.sin(2 * np.pi * (frame - 1) / period)))
        key(carrier, frame, np.array(turn.to_matrix().to_4x4()))
    linear(carrier)


def key(obj: bpy.types.Object, frame: int, matrix) -> None:
    place, turn, _ = Matrix(matrix).decompose()
    if obj.rotation_quaternion.dot(turn) < 0:
        turn.negate()
    obj.location, obj.rotation_quaternion = place, turn
    obj.keyframe_insert("location", frame=frame)
    obj.keyframe_insert("rotation_quaternion", frame=frame)


def linear(obj: bpy.types.Object) -> None:
    """Straight lines between keys: a key for each frame needs no curves."""
    action = obj.animation_data.action
    curves = (
        action.fcurves
        if hasattr(action, "fcurves")
        else [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags for curve in bag.fcurves]
    )
    for curve in curves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
