"""The same in Blender, by the extension that was installed from its .zip: blender_walk.py ZIP FOLDER, or blender_walk.py FILE FOLDER for a cache to draw.

Prints the seconds of each step, and those of the processor.
"""

from __future__ import annotations

import os
import random
import sys
import time
from pathlib import Path

target, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
os.environ["BLENDER_USER_RESOURCES"] = str(folder / "settings")
os.environ.pop("SUPERHELIX_LIBRARY", None)

import bpy  # noqa: E402
import numpy as np  # noqa: E402

sys.path.append(str(Path(__file__).resolve().parents[2] / "bindings" / "blender" / "tests"))
FRAMES = 100
_began = (time.perf_counter(), time.process_time())


def step(name: str) -> None:
    """Says how long a step took."""
    global _began
    now = (time.perf_counter(), time.process_time())
    print(f"STEP {name} {now[0] - _began[0]:.2f} {now[1] - _began[1]:.2f}", flush=True)
    _began = now


def draw() -> None:
    """Renders the present frame, small, by Cycles."""
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (0.0, -1.4, 0.3), (np.pi / 2, 0.0, 0.0)
    scene.collection.objects.link(camera)
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.rotation_euler = 4.0, (0.8, 0.3, 0.0)
    scene.collection.objects.link(sun)
    scene.camera = camera
    scene.render.engine, scene.cycles.device, scene.cycles.samples = "CYCLES", "CPU", 16
    scene.render.resolution_x = scene.render.resolution_y = 256
    scene.render.filepath = str(folder / "walk.png")
    bpy.ops.render.render(write_still=True)


if target.suffix == ".zip":
    bpy.ops.preferences.addon_enable(module="bl_pkg")
    bpy.ops.extensions.package_install_files(filepath=str(target), repo="user_default", enable_on_install=True)
    step("install")
    import scenes

    carrier, _, hair = scenes.head_scene(frames=FRAMES, settings=True)
    scenes.walk(carrier, FRAMES)
    scene = bpy.context.scene
    step("scene")
    bpy.ops.superhelix.setup()
    for frame in (1, 2):
        scene.frame_set(frame)
    step("first")
    bpy.ops.superhelix.bake()
    step("bake")
    order = random.Random(1).sample(range(1, FRAMES + 1), 20)
    for frame in order:
        scene.frame_set(frame)
    step("scrub")
    hair.superhelix.render_count = 5000
    scene.frame_set(1)
    bpy.ops.superhelix.grow()
    scene.frame_set(60)
    draw()
    step("draw")
    for name in ("hair.abc", "hair.usdc"):
        bpy.context.view_layer.objects.active = hair
        bpy.ops.superhelix.export(filepath=str(folder / name))
        step(f"export_{name[5:]}")
else:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if target.suffix == ".abc":
        bpy.ops.wm.alembic_import(filepath=str(target), as_background_job=False)
    else:
        bpy.ops.wm.usd_import(filepath=str(target))
    bpy.context.scene.frame_set(60)
    draw()
    step("draw")
sys.stdout.flush()
# Blender 4.x hangs when Python ends after a handler has run.
os._exit(0)
