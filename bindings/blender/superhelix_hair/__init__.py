"""Superhelix Hair: hair curves of Blender, simulated as Super-Helices.

core/                   a simulation in a timeline, without Blender
memory.py               the memory of curves
surroundings.py         surfaces and colliders, read from the dependency graph
properties.py           what the user chooses
play.py                 what an object shows at a frame
growing.py              render hair
operators.py            operators: setting up, resting as drawn, fitting, posing, growing
cache_operators.py      operators on the cache
exchange_operators.py   operators that write Alembic and USD
panels.py               panels

docs/guide/blender.md is the guide.
"""

from __future__ import annotations

import bpy

from . import cache_operators, exchange_operators, operators, panels, play, properties

_CLASSES = (*properties.CLASSES, *operators.CLASSES, *cache_operators.CLASSES, *exchange_operators.CLASSES, *panels.CLASSES)


def register() -> None:
    """Called by Blender when the extension is enabled."""
    for item in _CLASSES:
        bpy.utils.register_class(item)
    properties.register()
    play.register()


def unregister() -> None:
    """Called by Blender when it is disabled."""
    play.unregister()
    properties.unregister()
    for item in reversed(_CLASSES):
        bpy.utils.unregister_class(item)
