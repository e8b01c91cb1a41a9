"""Render hair: it follows its guides, where it grows, and looks that change at once."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
import scenes
from test_blender_play import check, go

from superhelix_hair import memory
from superhelix_hair.play import State


def test_render_hair() -> None:
    carrier, bust, hair = scenes.head_scene(every=4, frames=20)
    scenes.shake(carrier, 20, angle=0.5)
    hair.superhelix.render_count = 1500
    bpy.ops.superhelix.setup()
    go(1)
    assert bpy.ops.superhelix.grow() == {"FINISHED"}
    grown = next(obj for obj in bpy.data.objects if obj.superhelix.role == "GROWN")
    assert len(grown.data.curves) == 1500

    def hairs(frame: int) -> np.ndarray:
        go(frame)
        check(grown)
        points = memory.read(grown.data).reshape(1500, -1, 3)
        matrix = np.array(bust.matrix_world)
        return (points - matrix[:3, 3]) @ matrix[:3, :3]

    rows = [hairs(frame) for frame in range(1, 21)]
    assert np.isfinite(rows[-1]).all()
    # Roots stay on the head, tips lag behind; scrubbing shows the same hair.
    assert np.abs(rows[14][:, 0] - rows[0][:, 0]).max() < 1e-5
    assert np.linalg.norm(rows[14][:, -1] - rows[0][:, -1], axis=1).max() > 0.002
    for frame in (7, 15, 3):
        assert np.array_equal(hairs(frame), rows[frame - 1])
    radius = np.empty(len(grown.data.points), dtype=np.float32)
    grown.data.attributes["radius"].data.foreach_get("value", radius)
    assert 30e-6 < radius.max() < 50e-6
    with pytest.raises(RuntimeError, match="follows its guides"):
        bpy.context.view_layer.objects.active = grown
        bpy.ops.superhelix.setup()
    hair.data.surface = None
    bpy.context.view_layer.objects.active = hair
    bpy.ops.superhelix.remove()
    bpy.ops.superhelix.setup()
    with pytest.raises(RuntimeError, match="no surface"):
        bpy.ops.superhelix.grow()


def grown_head(**options: object) -> tuple[bpy.types.Object, bpy.types.Object, bpy.types.Object]:
    """Render hair on a head that shakes: (bust, hair, grown), at frame 8 of 8."""
    carrier, bust, hair = scenes.head_scene(every=6, frames=8)
    scenes.shake(carrier, 8, angle=0.5)
    hair.superhelix.render_count, hair.superhelix.render_points = 400, 12
    for name, value in options.items():
        setattr(hair.superhelix, name, value)
    bpy.ops.superhelix.setup()
    go(1)
    assert bpy.ops.superhelix.grow() == {"FINISHED"}
    grown = next(obj for obj in bpy.data.objects if obj.superhelix.role == "GROWN")
    for frame in range(2, 9):
        go(frame)
    check(grown)
    return bust, hair, grown


def lengths(grown: bpy.types.Object) -> np.ndarray:
    points = memory.read(grown.data).reshape(len(grown.data.curves), -1, 3).astype(np.float64)
    return np.linalg.norm(np.diff(points, axis=1), axis=2).sum(axis=1)


def test_looks_change_at_once() -> None:
    """Each option of the look changes the hair that is seen, without another frame; back again gives the same hair to the bit."""
    _, _, grown = grown_head()
    first = memory.read(grown.data)
    radius = np.empty(len(first), dtype=np.float32)
    for name, value in (
        *(("curliness", 1.0), ("follow", "CURVATURE"), ("render_seed", 7), ("render_wisps", 1), ("wisp_profile", (1.0, 0.2, 2.0)), ("parting", 1.0)),
        *(("length_variation", 0.8), ("frizz", 2.0), ("flyaways", 0.9), ("flyaway_distance", 50.0)),
    ):
        before = getattr(grown.superhelix, name)
        before = tuple(before) if name == "wisp_profile" else before
        setattr(grown.superhelix, name, value)
        check(grown)
        assert not np.array_equal(memory.read(grown.data), first), name
        setattr(grown.superhelix, name, before)
        assert np.array_equal(memory.read(grown.data), first), name
    grown.superhelix.hair_radius = 0.08
    grown.data.attributes["radius"].data.foreach_get("value", radius)
    assert 70e-6 < radius.max() < 90e-6
    before = lengths(grown)
    grown.superhelix.length_variation = 0.8
    assert lengths(grown).mean() < 0.85 * before.mean()


def test_guides_are_not_rendered_any_more() -> None:
    _, hair, grown = grown_head()
    assert hair.hide_render and not grown.hide_render


def test_density() -> None:
    """A vertex group says where hair grows; names that do not exist are errors."""
    _, bust, hair = scenes.head_scene(every=6, frames=8)
    group = bust.vertex_groups.new(name="left")
    bust.vertex_groups.new(name="empty")
    heights = {vertex.index: vertex.co.x for vertex in bust.data.vertices if vertex.co.z > 0.38}
    group.add([index for index, across in heights.items() if across > 0.0], 1.0, "REPLACE")
    hair.superhelix.render_count = 300
    bpy.ops.superhelix.setup()
    go(1)
    for name, text in (("right", "no vertex group right"), ("empty", "group empty has no weights")):
        hair.superhelix.render_density = name
        with pytest.raises(RuntimeError, match=text):
            bpy.ops.superhelix.grow()
        assert not any(obj.superhelix.role == "GROWN" for obj in bpy.data.objects)
    hair.superhelix.render_density = "left"
    assert bpy.ops.superhelix.grow() == {"FINISHED"}
    grown = next(obj for obj in bpy.data.objects if obj.superhelix.role == "GROWN")
    roots = memory.read(grown.data).reshape(300, -1, 3)[:, 0]
    # Weights fall to nothing over a triangle, of up to 3 cm there.
    assert roots[:, 0].min() > -0.015 and roots[:, 2].min() > 0.35


def test_render_hair_waits_for_its_guides() -> None:
    """A look that is changed while the guides are not simulated shows with them."""
    _, hair, grown = grown_head()
    bpy.context.view_layer.objects.active = hair
    hair.superhelix.hold = 0.9
    assert bpy.ops.superhelix.free() == {"FINISHED"}
    shown = memory.read(grown.data)
    grown.superhelix.frizz = 3.0
    assert np.array_equal(memory.read(grown.data), shown)
    go(2)
    check(grown, State.WAITING)
    go(1)
    go(2)
    check(grown)
    assert not np.array_equal(memory.read(grown.data), shown)
