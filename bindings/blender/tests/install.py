"""Installs the .zip as a user does, in a Blender with no settings, and simulates: install.py ZIP. Prints seconds from install to first frame."""

from __future__ import annotations

import os
import sys
import tempfile
import time
from pathlib import Path

# A folder of settings of its own, before Blender starts.
os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp()
os.environ.pop("SUPERHELIX_LIBRARY", None)
os.environ.pop("PYTHONPATH", None)
sys.path = [place for place in sys.path if "bindings" not in place]

import bpy  # noqa: E402

began = time.perf_counter()
# The module bpy starts without its add-ons; the program has them.
bpy.ops.preferences.addon_enable(module="bl_pkg")
assert bpy.ops.extensions.package_install_files(filepath=os.path.abspath(sys.argv[1]), repo="user_default", enable_on_install=True) == {"FINISHED"}
installed = time.perf_counter()

import superhelix  # noqa: E402

assert "extensions" in superhelix.__file__, superhelix.__file__
assert "bl_ext.user_default.superhelix_hair" in bpy.context.preferences.addons

sys.path.append(str(Path(__file__).resolve().parent))
import scenes  # noqa: E402

carrier, _, hair = scenes.head_scene(frames=10, settings=True)
scenes.walk(carrier, 10)
started = time.perf_counter()
assert bpy.ops.superhelix.setup() == {"FINISHED"}
bpy.context.scene.frame_set(1)
bpy.context.scene.frame_set(2)
first = time.perf_counter()
assert bpy.ops.superhelix.bake() == {"FINISHED"}
from bl_ext.user_default.superhelix_hair import play  # noqa: E402

here = play.playback(hair)
assert here.state is play.State.READY and here.session.last == 10, here.message
bpy.ops.preferences.addon_disable(module="bl_ext.user_default.superhelix_hair")
assert not hasattr(bpy.types.Object, "superhelix")
print(f"installed in {installed - began:.1f} s; from Simulate Hair to the first simulated frame {first - started:.1f} s")
sys.stdout.flush()
# Blender 4.x hangs when Python ends after a handler has run.
os._exit(0)
