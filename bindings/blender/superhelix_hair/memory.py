"""The memory of curves: positions in, positions out."""

from __future__ import annotations

import ctypes

import bpy
import numpy as np
import numpy.typing as npt

Positions = npt.NDArray[np.float32]

DRAWN = "superhelix_drawn"
_TICK = "superhelix_tick"
_TYPES = ("CATMULL_ROM", "POLY", "BEZIER", "NURBS")


def point_counts(curves: bpy.types.Curves) -> npt.NDArray[np.uint32]:
    """The number of points of each curve."""
    offsets = np.empty(len(curves.curves) + 1, dtype=np.int32)
    curves.curve_offset_data.foreach_get("value", offsets)
    return np.diff(offsets).astype(np.uint32)


def read(curves: bpy.types.Curves, name: str = "position") -> Positions:
    """A copy of a vector attribute of the points."""
    rows = np.empty((len(curves.points), 3), dtype=np.float32)
    curves.attributes[name].data.foreach_get("vector", rows.reshape(-1))
    return rows


def view(curves: bpy.types.Curves) -> Positions:
    """The memory of the positions. Blender moves it when it likes: take a view each time, and use it at once."""
    first = curves.attributes["position"].data[0].as_pointer()
    address = ctypes.cast(first, ctypes.POINTER(ctypes.c_float))
    return np.ctypeslib.as_array(address, shape=(len(curves.points), 3))


def write(curves: bpy.types.Curves, positions: Positions) -> None:
    """Writes positions through the attribute's memory, and says so to Blender."""
    if positions.shape != (len(curves.points), 3):
        raise ValueError(f"curves {curves.name}: {len(curves.points)} points, where the simulation has {len(positions)}; reset it")
    if len(positions):
        np.copyto(view(curves), positions)
        _forget_caches(curves)
    curves.update_tag()


def types(curves: bpy.types.Curves) -> set[str]:
    """The types of the curves."""
    attribute = curves.attributes.get("curve_type")
    if attribute is None:
        return {"CATMULL_ROM"}
    numbers = np.empty(len(curves.curves), dtype=np.int8)
    attribute.data.foreach_get("value", numbers)
    return {_TYPES[number] for number in np.unique(numbers).tolist()}


def _forget_caches(curves: bpy.types.Curves) -> None:
    """Makes Blender compute bounds and splines again: whatever Python writes to positions, it keeps those of older ones, until types are set."""
    present = types(curves)
    if len(present) == 1:
        curves.set_types(type=present.pop())


def drawn(curves: bpy.types.Curves) -> Positions:
    """The positions as drawn."""
    return read(curves, DRAWN if DRAWN in curves.attributes else "position")


def keep_drawn(curves: bpy.types.Curves, positions: Positions) -> None:
    """Keeps positions as the drawn ones."""
    put_vectors(curves, DRAWN, positions)


def put_numbers(curves: bpy.types.Curves, name: str, kind: str, values: npt.NDArray[np.generic]) -> None:
    """Writes an attribute of the curves: a FLOAT or an INT each."""
    attribute = curves.attributes.get(name) or curves.attributes.new(name, kind, "CURVE")
    attribute.data.foreach_set("value", values)


def put_vectors(curves: bpy.types.Curves, name: str, vectors: Positions) -> None:
    """Writes a vector attribute of the points."""
    attribute = curves.attributes.get(name) or curves.attributes.new(name, "FLOAT_VECTOR", "POINT")
    attribute.data.foreach_set("vector", np.ascontiguousarray(vectors, dtype=np.float32).reshape(-1))


def animate(curves: bpy.types.Curves, first: int, last: int) -> None:
    """Keys a custom property: exporters of Alembic and USD write a single frame of curves that nothing animates."""
    curves[_TICK] = 0.0
    for frame in (first, last):
        curves.keyframe_insert(f'["{_TICK}"]', frame=frame)


def forget_animation(curves: bpy.types.Curves) -> None:
    """Takes that property and its keys away."""
    action = curves.animation_data.action if curves.animation_data is not None else None
    if action is not None:
        # Blender 5 has no list of all of an action's curves.
        bags = [action] if hasattr(action, "fcurves") else [bag for layer in action.layers for strip in layer.strips for bag in strip.channelbags]
        for bag in bags:
            for line in [line for line in bag.fcurves if line.data_path == f'["{_TICK}"]']:
                bag.fcurves.remove(line)
    curves.pop(_TICK, None)
