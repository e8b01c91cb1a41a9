#!/usr/bin/env python3
"""The pictures of docs/guide/blender.md: hair drawn on Sintel's bust, simulated and rendered by the extension and Cycles.

Usage: pictures.py walk|shake OUT.jpg [--hairs N] [--width N] [--samples N] [--frame N]. Needs the module bpy.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE / "tests"), str(HERE.parents[1] / "docs" / "figures")]

import bpy  # noqa: E402
import numpy as np  # noqa: E402
import scenes  # noqa: E402
import superhelix as shx  # noqa: E402
from hair_files import round_openings  # noqa: E402
from mathutils import Matrix, Vector  # noqa: E402

import drawn  # noqa: E402
import superhelix_hair  # noqa: E402
from superhelix_hair import play  # noqa: E402

GUIDES = 420
#: Of the shirt, m from the middle of the neck.
NECKLINE = 0.1
#: Where they end on an eye, degrees from its axis.
PUPIL, IRIS = 11.0, 25.0


@dataclass(frozen=True)
class Look:
    """What differs between the pictures."""

    #: Frame that is drawn.
    frame: int
    #: Points of a guide, and of a hair.
    drawn_points: int
    render_points: int
    melanin: float
    redness: float
    #: Where the camera is, from the middle of the head, m; and where it looks: to its right and above the middle.
    camera: tuple[float, float, float]
    aim: tuple[float, float]
    options: dict[str, object]


LOOKS = {
    "walk": Look(
        frame=46,
        drawn_points=56,
        render_points=56,
        melanin=0.62,
        redness=0.55,
        camera=(0.47, -1.16, 0.07),
        aim=(-0.023, -0.038),
        options={
            "follow": "CURVATURE",
            "curliness": 0.55,
            "render_wisps": 5,
            "wisp_profile": (1.0, 0.75, 0.3),
            "parting": 40.0,
            "length_variation": 0.2,
            "frizz": 0.7,
            "flyaways": 0.015,
            "flyaway_distance": 4.0,
            "hold": 0.75,
        },
    ),
    "shake": Look(
        frame=44,
        drawn_points=96,
        render_points=80,
        melanin=0.8,
        redness=0.6,
        camera=(-0.46, -1.13, 0.07),
        aim=(0.0, -0.014),
        options={
            "follow": "CURVATURE",
            "curliness": 0.8,
            "render_wisps": 3,
            "wisp_profile": (1.0, 0.45, 0.16),
            "parting": 60.0,
            "length_variation": 0.15,
            "frizz": 1.2,
            "flyaways": 0.02,
            "flyaway_distance": 4.0,
            "hold": 0.5,
        },
    ),
}


def draw(what: str, vertices: np.ndarray, faces: np.ndarray, count: int) -> np.ndarray:
    """Guides, (guides, count, 3)."""
    random = np.random.default_rng(5)
    skin = drawn.Skin(vertices, faces)
    with shx.Scalp(vertices, faces) as scalp:
        follicles = scalp.scatter(GUIDES, density=drawn.density(vertices), seed=3)
        frames = scalp.root_frames(follicles)
    roots, normals = frames[:, :3], shx.frames.rotate(frames[:, 3:], np.tile([1.0, 0.0, 0.0], (len(frames), 1)))
    # Neighbours swing alike, and not quite.
    phases = 3.0 * roots[:, 1] / 0.1 + 0.18 * random.standard_normal(len(roots))
    if what == "walk":
        ways = drawn.combed(roots, normals, skin, drawn.Style(part=0.022, lie=0.014, lift=0.55, back=0.5), random)
        lengths = drawn.lengths_to(ways, 0.135, 0.42, 0.14, random)
        return drawn.wound(drawn.cut(ways, lengths, count), lengths, skin, across=0.0085, off=0.0045, wavelength=0.075, start=0.11, phases=phases)
    ways = drawn.combed(roots, normals, skin, drawn.Style(part=-0.015, lie=0.03, lift=0.9, back=0.35), random)
    lengths = drawn.lengths_to(ways, 0.2, 0.32, 0.16, random)
    turns = random.random(len(roots))
    return drawn.wound(drawn.cut(ways, lengths, count), lengths, skin, across=0.0095, off=0.0085, wavelength=0.04, start=0.07, phases=turns)


def scene_of(what: str, look: Look) -> tuple[bpy.types.Object, bpy.types.Object]:
    """The bust on a carrier that moves, with hair: (bust, hair)."""
    carrier, bust, old = scenes.head_scene(every=100, frames=look.frame)
    bpy.data.objects.remove(old)
    _, _, vertices, faces = scenes.sintel(every=100)
    guides = draw(what, vertices, faces, look.drawn_points)
    hair = scenes.curves_object("hair", guides.reshape(-1, 3), [look.drawn_points] * len(guides))
    scenes.attach(hair, bust)
    hair.parent = bust
    bpy.context.view_layer.objects.active = hair
    group = bust.vertex_groups.new(name="scalp")
    for number, weight in enumerate(drawn.density(vertices).tolist()):
        if weight > 0.0:
            group.add([number], weight, "REPLACE")
    if what == "shake":
        scenes.shake(carrier, look.frame, angle=0.55, period=18.0, until=40.0)
    else:
        scenes.walk(carrier, look.frame, ease=1.5)
    return bust, hair


def simulate(hair: bpy.types.Object, look: Look, hairs: int) -> None:
    """What a user does with the extension's buttons."""
    chosen = hair.superhelix
    chosen.render_count, chosen.render_points, chosen.render_density = hairs, look.render_points, "scalp"
    # A third of the hairs of a head, so thicker ones.
    chosen.hair_radius = 0.07
    for name, value in look.options.items():
        setattr(chosen, name, value)
    bpy.ops.superhelix.setup()
    bpy.context.scene.frame_set(1)
    bpy.ops.superhelix.fit()
    began = time.perf_counter()
    bpy.ops.superhelix.bake()
    print(f"{look.frame} frames in {time.perf_counter() - began:.1f} s")
    bpy.context.scene.frame_set(1)
    bpy.ops.superhelix.grow()
    began = time.perf_counter()
    bpy.context.scene.frame_set(look.frame)
    here = play.playback(hair)
    print(f"{hairs} hairs in {time.perf_counter() - began:.2f} s: {here.state.value}{here.message}; {here.warnings}")


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


def light(place: Vector, aim: Vector, power: float, size: float, tint: tuple[float, float, float]) -> None:
    """An area light."""
    lamp = bpy.data.lights.new("light", "AREA")
    lamp.energy, lamp.size, lamp.color = power, size, tint
    obj = bpy.data.objects.new("light", lamp)
    obj.location = place
    obj.rotation_euler = (aim - place).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(obj)


def dress(bust: bpy.types.Object) -> None:
    """Skin, with a shade of the hair on the scalp as make-up artists paint it; a shirt; and the missing eyes."""
    skin = material("skin", "ShaderNodeBsdfPrincipled", Roughness=0.5, Subsurface_Weight=0.12, Subsurface_Scale=0.01, Specular_IOR_Level=0.3)
    white, iris, pupil = (
        material(name, "ShaderNodeBsdfPrincipled", Base_Color=(*colour, 1.0), Roughness=0.15)
        for name, colour in (("white", (0.6, 0.5, 0.45)), ("iris", (0.06, 0.075, 0.04)), ("pupil", (0.004, 0.004, 0.004)))
    )
    tree = skin.node_tree
    paint, mix = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeMix")
    paint.attribute_name, mix.data_type = "scalp", "RGBA"
    mix.inputs[6].default_value, mix.inputs[7].default_value = (0.64, 0.4, 0.29, 1.0), (0.11, 0.055, 0.035, 1.0)
    tree.links.new(paint.outputs["Fac"], mix.inputs[0])
    shirt, edge, wear = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeMath"), tree.nodes.new("ShaderNodeMix")
    shirt.attribute_name, edge.operation, wear.data_type = "off_neck", "GREATER_THAN", "RGBA"
    edge.inputs[1].default_value, wear.inputs[7].default_value = NECKLINE, (0.035, 0.06, 0.075, 1.0)
    tree.links.new(shirt.outputs["Fac"], edge.inputs[0])
    tree.links.new(edge.outputs[0], wear.inputs[0])
    tree.links.new(mix.outputs[2], wear.inputs[6])
    tree.links.new(wear.outputs[2], tree.nodes["Principled BSDF"].inputs["Base Color"])
    mesh = bust.data
    mesh.materials.append(skin)
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    vertices = np.array([vertex.co[:] for vertex in mesh.vertices])
    off_neck = np.where(vertices[:, 2] < drawn.NECK[2], np.linalg.norm((vertices - drawn.NECK)[:, :2], axis=1), 0.0)
    mesh.attributes.new("off_neck", "FLOAT", "POINT").data.foreach_set("value", off_neck)
    for centre, radius in round_openings(vertices, np.array([polygon.vertices[:] for polygon in mesh.polygons])):
        # A pole looks ahead; rings around it are pupil and iris.
        bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=60, radius=radius, location=tuple(centre), rotation=(np.pi / 2, 0.0, 0.0))
        ball = bpy.context.object
        ball.parent = bust
        ball.data.polygons.foreach_set("use_smooth", [True] * len(ball.data.polygons))
        for part in (white, iris, pupil):
            ball.data.materials.append(part)
        for polygon in ball.data.polygons:
            off = np.degrees(np.arccos(polygon.center.z / polygon.center.length))
            polygon.material_index = 2 if off < PUPIL else 1 if off < IRIS else 0


def stage(bust: bpy.types.Object, look: Look) -> None:
    """Backdrop, warm key light, rim light, fill, camera."""
    scene = bpy.context.scene
    middle = bust.matrix_world @ Vector(drawn.MIDDLE)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens = 100.0
    # With the head as it faces.
    facing = Matrix.Rotation(bust.matrix_world.to_euler("XYZ").z, 4, "Z")
    camera.location = middle + facing @ Vector(look.camera)
    right = (middle - camera.location).cross(Vector((0.0, 0.0, 1.0))).normalized()
    aim = middle + look.aim[0] * right + Vector((0.0, 0.0, look.aim[1]))
    camera.rotation_euler = (aim - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    side = 1.0 if look.camera[0] > 0.0 else -1.0
    light(middle + facing @ Vector((-0.75 * side, -0.95, 0.75)), middle, 24.0, 0.45, (1.0, 0.86, 0.7))
    light(middle + facing @ Vector((0.95 * side, 0.75, 0.6)), middle, 38.0, 0.4, (1.0, 0.93, 0.84))
    light(middle + facing @ Vector((-0.9 * side, 0.8, 0.35)), middle, 8.0, 0.5, (0.85, 0.92, 1.0))
    light(middle + facing @ Vector((1.2 * side, -1.1, -0.1)), middle, 7.0, 1.2, (0.9, 0.95, 1.0))
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (0.7, 0.78, 0.9, 1.0)
    world.node_tree.nodes["Background"].inputs[1].default_value = 0.12
    scene.world = world
    forward = (aim - camera.location).normalized()
    bpy.ops.mesh.primitive_plane_add(size=8.0, location=aim + 1.6 * forward)
    wall = bpy.context.object
    wall.rotation_euler = forward.to_track_quat("Z", "Y").to_euler()
    wall.data.materials.append(material("wall", "ShaderNodeBsdfPrincipled", Base_Color=(0.12, 0.105, 0.095, 1.0), Roughness=0.9))
    light(aim + 1.1 * forward + Vector((0.0, 0.0, -0.7)), aim + 1.6 * forward, 9.0, 0.3, (1.0, 0.9, 0.8))


def render(out: Path, width: int, samples: int) -> None:
    """By Cycles."""
    scene = bpy.context.scene
    render = scene.render
    render.engine, render.resolution_x, render.resolution_y = "CYCLES", width, width * 9 // 8
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", samples, True
    scene.cycles.use_adaptive_sampling, scene.cycles.adaptive_threshold = True, 0.02
    scene.cycles.max_bounces, scene.cycles.transparent_max_bounces = 10, 16
    scene.cycles_curves.shape = "RIBBONS"
    scene.view_settings.view_transform, scene.view_settings.look = "AgX", "AgX - Medium High Contrast"
    render.image_settings.file_format = "PNG" if out.suffix == ".png" else "JPEG"
    render.image_settings.quality = 90
    render.filepath = str(out.resolve())
    began = time.perf_counter()
    bpy.ops.render.render(write_still=True)
    print(f"rendered in {time.perf_counter() - began:.1f} s")


def main() -> None:
    """Draws, simulates and renders."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=tuple(LOOKS))
    parser.add_argument("out", type=Path)
    parser.add_argument("--hairs", type=int, default=30_000)
    parser.add_argument("--width", type=int, default=900)
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--frame", type=int, default=0)
    given = parser.parse_args()
    look = LOOKS[given.what]
    superhelix_hair.register()
    bust, hair = scene_of(given.what, look)
    tint = {"Melanin": look.melanin, "Melanin_Redness": look.redness, "Roughness": 0.25, "Radial_Roughness": 0.35, "Random_Color": 0.15}
    hair.data.materials.append(material("hair", "ShaderNodeBsdfHairPrincipled", **tint))
    simulate(hair, look, given.hairs)
    bpy.context.scene.frame_set(given.frame or look.frame)
    dress(bust)
    stage(bust, look)
    render(given.out, given.width, given.samples)
    sys.stdout.flush()
    # Blender 4.x hangs when Python ends after a handler has run.
    os._exit(0)


if __name__ == "__main__":
    main()
