#!/usr/bin/env python3
"""The pictures of docs/guide/blender.md: Sintel's hair, drawn wavy and curly, simulated and rendered by the extension and Cycles.

Usage: pictures.py walk|shake OUT.jpg [--hairs N] [--size N] [--samples N]. Needs the module bpy; about two minutes each on two cores.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE / "tests")]

import bpy  # noqa: E402
import numpy as np  # noqa: E402
import scenes  # noqa: E402
from mathutils import Vector  # noqa: E402

import superhelix_hair  # noqa: E402
from superhelix_hair import play  # noqa: E402


def coiled(curve: np.ndarray, radius: float, wavelength: float, phase: float, count: int) -> np.ndarray:
    """A curve wound about itself: radius and wavelength in m, straight at the root."""
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    at = np.linspace(0.0, along[-1], count)
    points = np.stack([np.interp(at, along, curve[:, axis]) for axis in range(3)], axis=1)
    tangents = np.gradient(points, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    side = np.cross(tangents[0], [0.3, 0.5, 0.8])
    turn = 2.0 * np.pi * at / wavelength + phase
    swell = radius * np.clip(at / 0.035, 0.0, 1.0) ** 2
    rows = np.empty_like(points)
    for place, tangent in enumerate(tangents):
        side -= tangent * (side @ tangent)
        side /= np.linalg.norm(side)
        other = np.cross(tangent, side)
        rows[place] = points[place] + swell[place] * (np.cos(turn[place]) * side + np.sin(turn[place]) * other)
    return rows


def material(name: str, kind: str, **inputs: object) -> bpy.types.Material:
    """A material of one shader."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    shader, output = tree.nodes.new(kind), tree.nodes.new("ShaderNodeOutputMaterial")
    if kind == "ShaderNodeBsdfHairPrincipled":
        shader.parametrization = "MELANIN"
    for key, value in inputs.items():
        shader.inputs[key.replace("_", " ")].default_value = value
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return made


def light(place: tuple[float, float, float], aim: Vector, power: float, size: float) -> None:
    """An area light."""
    lamp = bpy.data.lights.new("light", "AREA")
    lamp.energy, lamp.size = power, size
    obj = bpy.data.objects.new("light", lamp)
    obj.location = place
    obj.rotation_euler = (aim - Vector(place)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(obj)


def with_eyes(bust: bpy.types.Object) -> bpy.types.Object:
    """A copy of a bust to render: the holes where its eyes should be are filled, a little behind their rims."""
    # There only once bpy is.
    import bmesh

    build = bmesh.new()
    build.from_mesh(bust.data)
    rims = [edge for edge in build.edges if edge.is_boundary]
    eyes = [edge for edge in rims if all(vertex.co.y < -0.02 and vertex.co.z > 0.26 and 0.008 < abs(vertex.co.x) < 0.06 for vertex in edge.verts)]
    faces = bmesh.ops.holes_fill(build, edges=eyes, sides=200)["faces"]
    faces = bmesh.ops.inset_region(build, faces=faces, thickness=0.001, depth=-0.002)["faces"] or faces
    mesh = bpy.data.meshes.new("bust with eyes")
    build.to_mesh(mesh)
    build.free()
    obj = bpy.data.objects.new(mesh.name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    obj.parent = bust
    bust.hide_render = True
    return obj


def main() -> None:
    """Simulates and renders."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("walk", "shake"))
    parser.add_argument("out", type=Path)
    parser.add_argument("--hairs", type=int, default=30_000)
    parser.add_argument("--size", type=int, default=640)
    parser.add_argument("--samples", type=int, default=24)
    parser.add_argument("--frame", type=int, default=0)
    given = parser.parse_args()
    curly = given.what == "shake"
    last = given.frame or (44 if curly else 62)
    superhelix_hair.register()
    carrier, bust, hair = scenes.head_scene(frames=last)
    points, counts, _, _ = scenes.sintel()
    rng = np.random.default_rng(7)
    count = 96 if curly else 48
    shapes = [coiled(curve, *((0.006, 0.03) if curly else (0.0035, 0.05)), rng.uniform(0, 1.5), count) for curve in np.split(points, np.cumsum(counts)[:-1])]
    bpy.data.objects.remove(hair)
    hair = scenes.curves_object("hair", np.concatenate(shapes), [count] * len(shapes))
    scenes.attach(hair, bust)
    hair.parent = bust
    bpy.context.view_layer.objects.active = hair
    if curly:
        scenes.shake(carrier, last, angle=0.6, period=16.0, until=38.0)
    else:
        scenes.walk(carrier, last)
    hair.data.materials.append(material("hair", "ShaderNodeBsdfHairPrincipled", Melanin=0.75 if curly else 0.55, Melanin_Redness=0.75, Roughness=0.28))
    chosen = hair.superhelix
    chosen.render_count, chosen.render_points = given.hairs, 64 if curly else 40
    chosen.curliness, chosen.follow = (0.85, "CURVATURE") if curly else (0.55, "CURVATURE")
    # Half as many hairs as a head has there, twice as thick.
    chosen.hair_radius = 0.075
    bpy.ops.superhelix.setup()
    bpy.context.scene.frame_set(1)
    bpy.ops.superhelix.fit()
    began = time.perf_counter()
    bpy.ops.superhelix.bake()
    print(f"{last} frames in {time.perf_counter() - began:.1f} s")
    bpy.context.scene.frame_set(1)
    bpy.ops.superhelix.grow()
    # Guides are for the simulation; render hair is for the picture.
    hair.hide_render = True
    began = time.perf_counter()
    bpy.context.scene.frame_set(last)
    print(f"{given.hairs} hairs in {time.perf_counter() - began:.2f} s: {play.playback(hair).state.value}")

    scene = bpy.context.scene
    seen = with_eyes(bust)
    seen.data.materials.append(material("skin", "ShaderNodeBsdfPrincipled", Base_Color=(0.58, 0.42, 0.34, 1.0), Roughness=0.5))
    seen.data.polygons.foreach_set("use_smooth", [True] * len(seen.data.polygons))
    centre = bust.matrix_world @ Vector((0.0, 0.01, 0.325))
    light(tuple(centre + Vector((0.9, -1.1, 0.9))), centre, 26.0, 0.5)
    light(tuple(centre + Vector((-1.3, -0.6, 0.2))), centre, 8.0, 1.0)
    light(tuple(centre + Vector((-0.4, 1.2, 0.9))), centre, 11.0, 0.5)
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (0.75, 0.77, 0.8, 1.0)
    world.node_tree.nodes["Background"].inputs[1].default_value = 0.5
    scene.world = world
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens = 70.0
    camera.location = centre + Vector((0.36, -0.72, 0.08))
    camera.rotation_euler = (centre - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    render = scene.render
    render.engine, render.resolution_x, render.resolution_y = "CYCLES", given.size, given.size
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", given.samples, True
    scene.cycles_curves.shape = "RIBBONS"
    scene.view_settings.view_transform = "AgX"
    render.image_settings.file_format, render.image_settings.quality = "JPEG", 88
    render.filepath = str(given.out.resolve())
    began = time.perf_counter()
    bpy.ops.render.render(write_still=True)
    print(f"rendered in {time.perf_counter() - began:.1f} s")
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
