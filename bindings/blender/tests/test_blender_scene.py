"""Operators, their errors, colliders, surfaces that deform, render hair."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from test_blender_play import check, go

from superhelix_hair import memory, play
from superhelix_hair.play import State


def still_head(every: int = 8, frames: int = 24) -> tuple[bpy.types.Object, bpy.types.Object]:
    _, bust, hair = scenes.head_scene(every=every, frames=frames)
    assert bpy.ops.superhelix.setup() == {"FINISHED"}
    return bust, hair


def lengths(hair: bpy.types.Object, points: np.ndarray) -> np.ndarray:
    ends = np.cumsum(memory.point_counts(hair.data))[:-1]
    return np.array([np.linalg.norm(np.diff(curve, axis=0), axis=1).sum() for curve in np.split(points.astype(np.float64), ends)])


def collide(hair: bpy.types.Object, body: bpy.types.Object) -> None:
    """Makes a mesh the hair's only collider."""
    group = bpy.data.collections.new("colliders")
    bpy.context.scene.collection.children.link(group)
    group.objects.link(body)
    hair.superhelix.colliders = group


def test_rests_as_drawn_with_no_option_set() -> None:
    _, hair = still_head()
    first = go(1)
    drawn = memory.drawn(hair.data)
    assert np.linalg.norm(first - drawn, axis=1).mean() < 3e-4
    for frame in range(2, 25):
        shown = go(frame)
    assert np.abs(shown - first).max() < 2e-5
    check(hair)


def test_hair_follows_rigged_curves() -> None:
    _, bust, hair = scenes.head_scene(every=8, frames=24)
    points, counts, _, _ = scenes.sintel(8)
    rig = scenes.curves_object("rig", points, counts)
    rig.parent = bust
    # The rig is swept sideways by an animated turn about the head's axis.
    rig.rotation_mode = "XYZ"
    for frame, angle in ((1, 0.0), (12, 0.1)):
        rig.rotation_euler[2] = angle
        rig.keyframe_insert("rotation_euler", index=2, frame=frame)
    bpy.context.view_layer.objects.active = hair
    hair.superhelix.target, hair.superhelix.follow_root, hair.superhelix.follow_tip = rig, 0.0, 1.0
    assert bpy.ops.superhelix.setup() == {"FINISHED"}
    for frame in range(1, 19):
        shown = go(frame)
    check(hair)
    ends = np.cumsum(counts).astype(int) - 1
    now = np.array(rig.matrix_world)
    tips = points[ends] @ now[:3, :3].T + now[:3, 3]
    moved = np.linalg.norm(points[ends] - tips, axis=1)
    left = np.linalg.norm(shown[ends] - tips, axis=1)
    assert moved.mean() > 5e-3 and left.mean() < 0.3 * moved.mean(), (moved.mean(), left.mean())
    # Others than the first frame had.
    hair.superhelix.target = scenes.curves_object("fewer", points[: counts[0]], counts[:1])
    bpy.context.scene.frame_set(19)
    check(hair, State.FAILED)
    assert "rigged curves fewer: 1 curves; 29 expected" in play.playback(hair).message


def test_edits_are_never_overwritten() -> None:
    _, hair = still_head()
    go(1)
    edited = memory.read(hair.data)
    edited[5:30] += (0.002, 0.0, 0.003)
    memory.view(hair.data)[:] = edited
    bpy.context.scene.frame_set(2)
    check(hair, State.EDITED)
    assert np.array_equal(memory.read(hair.data), edited)
    with pytest.raises(RuntimeError, match="frame 2: the hair is drawn at frame 1"):
        bpy.ops.superhelix.rest_as_drawn()
    bpy.context.scene.frame_set(1)
    check(hair, State.EDITED)
    assert bpy.ops.superhelix.rest_as_drawn() == {"FINISHED"}
    assert np.array_equal(memory.drawn(hair.data), edited)
    first = go(1)
    for frame in range(2, 13):
        shown = go(frame)
    assert np.abs(shown - first).max() < 2e-5
    # And the other choice.
    memory.view(hair.data)[:] = edited + 1
    bpy.context.scene.frame_set(3)
    check(hair, State.EDITED)
    assert bpy.ops.superhelix.discard_edits() == {"FINISHED"}
    assert np.array_equal(go(12), shown)


def test_setup_and_remove() -> None:
    _, hair = still_head()
    drawn = memory.drawn(hair.data)
    for frame in range(1, 4):
        go(frame)
    assert bpy.ops.superhelix.setup.poll()
    assert bpy.ops.superhelix.remove() == {"FINISHED"}
    assert np.array_equal(memory.read(hair.data), drawn)
    assert hair.superhelix.role == "NONE" and memory.DRAWN not in hair.data.attributes
    assert not bpy.ops.superhelix.bake.poll()
    bpy.context.scene.frame_set(4)
    assert np.array_equal(memory.read(hair.data), drawn)


def test_what_moves_curves_twice_is_switched_off() -> None:
    _, _, hair = scenes.head_scene(every=8)
    group = bpy.data.node_groups.new("Surface Deform", "GeometryNodeTree")
    group.nodes.new("GeometryNodeDeformCurvesOnSurface")
    modifier = hair.modifiers.new("Surface Deform", "NODES")
    modifier.node_group = group
    bpy.ops.superhelix.setup()
    assert not modifier.show_viewport and not modifier.show_render
    bpy.ops.superhelix.remove()
    assert modifier.show_viewport and modifier.show_render


def test_fit() -> None:
    _, hair = still_head()
    assert bpy.ops.superhelix.fit() == {"FINISHED"}
    errors, elements = np.zeros(29, dtype=np.float32), np.zeros(29, dtype=np.int32)
    hair.data.attributes["superhelix_fit_error"].data.foreach_get("value", errors)
    hair.data.attributes["superhelix_elements"].data.foreach_get("value", elements)
    assert 0 < errors.max() < 2 and elements.min() >= 10
    hair.superhelix.element_count = 3
    bpy.ops.superhelix.fit()
    coarse = np.zeros(29, dtype=np.float32)
    hair.data.attributes["superhelix_fit_error"].data.foreach_get("value", coarse)
    assert coarse.mean() > 1.5 * errors.mean()


def test_drag_and_brush() -> None:
    _, hair = still_head()
    before = memory.drawn(hair.data)
    was = lengths(hair, before)
    curve = int(np.argmax(was))
    points = hair.data.curves[curve]
    tip = points.first_point_index + points.points_length - 1
    target = np.array(before[tip]) + [0.0, -0.03, 0.01]
    assert bpy.ops.superhelix.drag(curve=curve, fraction=1.0, target=target) == {"FINISHED"}
    after = memory.drawn(hair.data)
    assert np.linalg.norm(after[tip] - target) < 1e-3
    assert lengths(hair, after)[curve] == pytest.approx(was[curve], rel=0.01)
    others = np.ones(len(after), dtype=bool)
    others[points.first_point_index : tip + 1] = False
    assert np.array_equal(after[others], before[others])
    # It rests there.
    first = go(1)
    for frame in range(2, 13):
        shown = go(frame)
    assert np.abs(shown - first).max() < 2e-5
    go(1)
    centre = memory.drawn(hair.data)[tip]
    assert bpy.ops.superhelix.brush(centre=centre, radius=0.04, displacement=(0.0, 0.0, 0.02)) == {"FINISHED"}
    assert memory.drawn(hair.data)[tip, 2] > centre[2] + 0.01


def test_posing_in_centimetres() -> None:
    scenes.head_scene(every=8, unit=0.01)
    bpy.ops.superhelix.setup()
    hair = bpy.context.object
    tip = hair.data.curves[3].first_point_index + hair.data.curves[3].points_length - 1
    target = memory.drawn(hair.data)[tip] + [0.0, -1.0, 1.0]
    bpy.ops.superhelix.drag(curve=3, target=target)
    assert np.linalg.norm(memory.drawn(hair.data)[tip] - target) < 0.1


def test_operators_report_errors(tmp_path: Path) -> None:
    bust, hair = still_head()
    cases = [
        (lambda: bpy.ops.superhelix.drag(curve=99, target=(0, 0, 0)), "curve: 99"),
        (lambda: bpy.ops.superhelix.drag(curve=0, fraction=0.0, target=(0, 0, 0)), "fraction: 0"),
        (lambda: bpy.ops.superhelix.brush(radius=0.0), "radius"),
        (lambda: bpy.ops.superhelix.simulate_again(), "no simulation runs"),
    ]
    for call, text in cases:
        before = memory.drawn(hair.data)
        with pytest.raises(RuntimeError, match=text):
            call()
        assert np.array_equal(memory.drawn(hair.data), before)
    bpy.context.scene.frame_end = 0
    with pytest.raises(RuntimeError, match="the scene ends at 0"):
        bpy.ops.superhelix.bake()
    bpy.context.scene.frame_end = 24
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    hair.superhelix.cache_folder = str(blocked)
    with pytest.raises(RuntimeError, match="file"):
        bpy.ops.superhelix.bake()
    assert check(hair, State.FAILED).message
    hair.superhelix.cache_folder = ""
    # A surface whose faces change while it plays.
    go(1)
    modifier = bust.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = 1
    bpy.context.scene.frame_set(2)
    assert "surface bust" in check(hair, State.FAILED).message
    before = memory.read(hair.data)
    bpy.context.scene.frame_set(3)
    assert np.array_equal(memory.read(hair.data), before)
    bust.modifiers.remove(modifier)
    go(1)
    go(2)
    check(hair)
    bust.scale = (1, 1, 1.2)
    bpy.context.scene.frame_set(3)
    assert "collider bust: its scale changes" in check(hair, State.FAILED).message
    bust.scale = (1, 1, -1)
    bpy.context.scene.frame_set(1)
    assert "collider bust: scale: the matrix mirrors" in check(hair, State.FAILED).message


def test_setup_errors() -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    empty = scenes.curves_object("empty", np.zeros((0, 3)), [])
    bpy.context.view_layer.objects.active = empty
    with pytest.raises(RuntimeError, match="curves empty: no curves"):
        bpy.ops.superhelix.setup()
    cube = scenes.mesh_object("cube", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    bpy.context.view_layer.objects.active = cube
    assert not bpy.ops.superhelix.setup.poll()
    _, _, hair = scenes.head_scene(every=8)
    twin = bpy.data.objects.new("twin", hair.data)
    bpy.context.scene.collection.objects.link(twin)
    with pytest.raises(RuntimeError, match="2 objects share its data"):
        bpy.ops.superhelix.setup()
    bpy.data.objects.remove(twin)
    hair.data.set_types(type="BEZIER")
    with pytest.raises(RuntimeError, match="of types BEZIER; make all"):
        bpy.ops.superhelix.setup()
    hair.data.set_types(type="CATMULL_ROM")
    hair.data.attributes["position"].data[0].vector = (np.nan, 0, 0)
    with pytest.raises(RuntimeError, match="not finite"):
        bpy.ops.superhelix.setup()


def test_wrong_uv_map_warns() -> None:
    _, _, hair = scenes.head_scene(every=8)
    uvs = np.empty(2 * len(hair.data.curves), dtype=np.float32)
    attribute = hair.data.attributes["surface_uv_coordinate"]
    attribute.data.foreach_get("vector", uvs)
    attribute.data.foreach_set("vector", uvs.reshape(-1, 2)[::-1].reshape(-1).copy())
    bpy.ops.superhelix.setup()
    go(1)
    assert "from their place on bust" in check(hair).warnings[0]
    attribute.data.foreach_set("vector", uvs + np.float32(3.0))
    bpy.context.scene.frame_set(1)
    assert "curves hair: " in check(hair, State.FAILED).message and "Snap to Nearest Surface" in play.playback(hair).message


def ball(name: str, radius: float, place: tuple[float, float, float]) -> bpy.types.Object:
    import bmesh

    mesh = bpy.data.meshes.new(name)
    build = bmesh.new()
    bmesh.ops.create_icosphere(build, subdivisions=3, radius=radius)
    build.to_mesh(mesh)
    build.free()
    obj = bpy.data.objects.new(name, mesh)
    obj.location = place
    bpy.context.scene.collection.objects.link(obj)
    return obj


def test_a_deforming_collider() -> None:
    """A ball that swells by a shape key under a fringe of level hair."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 40
    along = np.linspace(0.0, 0.2, 24)
    points = np.stack([np.broadcast_to(along, (9, 24)), np.broadcast_to(0.01 * np.arange(-4, 5)[:, None], (9, 24)), np.zeros((9, 24))], axis=-1)
    hair = scenes.curves_object("hair", points, [24] * 9)
    body = ball("ball", 0.05, (0.13, 0.0, -0.08))
    body.shape_key_add(name="Basis")
    swollen = body.shape_key_add(name="Swollen")
    for point in swollen.data:
        point.co *= 2.0
    swollen.value = 0.0
    swollen.keyframe_insert("value", frame=5)
    swollen.value = 1.0
    swollen.keyframe_insert("value", frame=30)
    collide(hair, body)
    bpy.context.view_layer.objects.active = hair
    bpy.ops.superhelix.setup()
    for frame in range(1, 41):
        shown = go(frame)
    here = check(hair)
    assert here.around.colliders[0].motion.value == "DEFORMING"
    distance = np.linalg.norm(shown - np.array([0.13, 0.0, -0.08]), axis=1)
    # The faces of the ball lie up to 1.3 % inside it.
    assert distance.min() > 0.1 * 0.985
    assert shown[:, 2].max() > 0.015
    # Without it, hair stays level.
    hair.superhelix.colliders = None
    for frame in range(1, 41):
        shown = go(frame)
    assert np.abs(shown[:, 2]).max() < 1e-4


def test_a_head_that_may_deform() -> None:
    """The open bust as a mesh whose vertices move: hair goes where it goes on the rigid one, nearly."""
    rows = []
    for deforming in (False, True):
        carrier, bust, hair = scenes.head_scene(every=8, frames=12)
        scenes.walk(carrier, 12)
        if deforming:
            bust.shape_key_add(name="Basis")
        bpy.ops.superhelix.setup()
        for frame in range(1, 13):
            shown = go(frame)
        assert check(hair).around.colliders[0].motion.value == ("DEFORMING" if deforming else "RIGID")
        rows.append(shown)
    apart = np.linalg.norm(rows[0] - rows[1], axis=1)
    assert np.median(apart) < 3e-4 and apart.max() < 0.02


def test_a_rigid_collider_is_stretched_by_its_scale() -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_end = 40
    along = np.linspace(0.0, 0.2, 24)
    points = np.stack([along, np.zeros(24), np.zeros(24)], axis=-1)
    hair = scenes.curves_object("hair", points, [24])
    body = ball("ball", 1.0, (0.14, 0.0, -0.15))
    body.scale = (0.03, 0.2, 0.06)
    body.superhelix_collider.cell = 3.0
    for frame, height in ((5, -0.15), (30, -0.02)):
        body.location[2] = height
        body.keyframe_insert("location", frame=frame)
    collide(hair, body)
    bpy.context.view_layer.objects.active = hair
    bpy.ops.superhelix.setup()
    for frame in range(1, 41):
        shown = go(frame)
    assert check(hair).around.colliders[0].motion.value == "RIGID"
    inside = np.linalg.norm((shown - [0.14, 0.0, -0.02]) / [0.03, 0.2, 0.06], axis=1)
    assert inside.min() > 0.93
    assert shown[:, 2].max() > 0.03


def test_roots_follow_a_surface_that_deforms() -> None:
    """A sheet that an armature's bone bends: roots and directions follow it; hair drawn on the flat sheet stands on the bent one at the start."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    n = 11
    x, y = np.meshgrid(np.linspace(-0.1, 0.1, n), np.linspace(-0.1, 0.1, n))
    vertices = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    faces = []
    for i in range(n - 1):
        for j in range(n - 1):
            a = i * n + j
            faces += [(a, a + 1, a + n + 1), (a, a + n + 1, a + n)]
    sheet = scenes.mesh_object("sheet", vertices, faces, uvs=True)
    sheet.add_rest_position_attribute = True
    sheet.shape_key_add(name="Basis")
    bent = sheet.shape_key_add(name="Bent")
    angle = vertices[:, 0] / 0.1
    rows = np.stack([0.1 * np.sin(angle), vertices[:, 1], 0.1 * (1 - np.cos(angle))], axis=1)
    for point, row in zip(bent.data, rows):
        point.co = row
    bent.value = 0.5
    bent.keyframe_insert("value", frame=1)
    bent.value = 1.0
    bent.keyframe_insert("value", frame=20)
    roots = np.array([[-0.055, 0.013, 0], [0.003, 0.001, 0], [0.065, -0.033, 0]])
    along = np.linspace(0, 0.06, 12)
    points = roots[:, None] + along[:, None] * np.array([0, 0, 1.0])
    hair = scenes.curves_object("hair", points, [12] * 3)
    hair.superhelix.hold = 1.0
    hair.superhelix.use_surface = False
    scenes.attach(hair, sheet)
    bpy.context.view_layer.objects.active = hair
    bpy.ops.superhelix.setup()
    drawn = memory.drawn(hair.data)

    def surface_at(frame: int) -> tuple[np.ndarray, np.ndarray]:
        graph = bpy.context.evaluated_depsgraph_get()
        mesh = sheet.evaluated_get(graph).to_mesh()
        now = np.array([vertex.co[:] for vertex in mesh.vertices])
        tree = scenes.BVHTree.FromPolygons(vertices.tolist(), faces, all_triangles=True)
        places, normals = [], []
        for root in roots:
            _, _, index, _ = tree.find_nearest(root)
            one, two, three = vertices[list(faces[index])]
            solved = np.linalg.lstsq(np.stack([two - one, three - one], axis=1), root - one, rcond=None)[0]
            a, b, c = now[list(faces[index])]
            places.append(a + solved[0] * (b - a) + solved[1] * (c - a))
            normal = np.cross(b - a, c - a)
            normals.append(normal / np.linalg.norm(normal))
        return np.array(places), np.array(normals)

    for frame in range(1, 31):
        shown = go(frame).reshape(3, 12, 3)
        if frame in (1, 10, 30):
            places, normals = surface_at(frame)
            assert np.abs(shown[:, 0] - places).max() < 1e-5
            if frame != 10:
                directions = shown[:, -1] - shown[:, 0]
                directions /= np.linalg.norm(directions, axis=1, keepdims=True)
                assert np.sum(directions * normals, axis=1).min() > np.cos(np.radians(9))
    check(hair)
    assert np.array_equal(memory.drawn(hair.data), drawn)
    go(1)
    with pytest.raises(RuntimeError, match="surface sheet: deformed at frame 1"):
        bpy.ops.superhelix.drag(curve=0, target=(0, 0, 0.05))


def test_every_option_says_what_it_is() -> None:
    """Panels and tooltips: each option has a description, and each panel draws only options and operators that exist."""
    from superhelix_hair import cache_operators, exchange_operators, operators, panels, properties

    for group in properties.CLASSES:
        for prop in group.bl_rna.properties:
            if prop.identifier in group.__annotations__ and prop.identifier != "role":
                assert prop.description and not prop.description.endswith("."), prop.identifier
    for operator in (*operators.CLASSES, *cache_operators.CLASSES, *exchange_operators.CLASSES):
        assert operator.__doc__ and hasattr(bpy.types, operator.__name__), operator

    class Layout:
        """Stands for UILayout: Blender has none without a window."""

        def __getattr__(self, name: str):
            return lambda *args, **kwargs: Layout()

        def prop(self, data, name: str) -> None:
            assert name in data.bl_rna.properties, name
            drawn.add(name)

        def prop_search(self, data, name: str, where, collection: str) -> None:
            assert collection in where.bl_rna.properties
            self.prop(data, name)

        def operator(self, name: str, **_: object) -> None:
            assert hasattr(bpy.ops.superhelix, name.split(".")[1]) and name.split(".")[1] in dir(bpy.ops.superhelix), name

    bust, hair = still_head()
    go(1)
    drawn: set[str] = set()
    # How firmly hair follows is drawn if it follows something.
    hair.superhelix.target = hair

    class Context:
        object = hair

    for panel in panels.CLASSES:
        Context.object = bust if panel is panels.SUPERHELIX_PT_collider else hair
        assert panel.poll(Context)

        functions = {name: item for base in reversed(panel.__mro__) for name, item in vars(base).items() if name in ("draw", "fill")}
        type("Drawn", (), {**functions, "layout": Layout()})().draw(Context)
    known = set(properties.HairOptions.__annotations__) | set(properties.ColliderOptions.__annotations__)
    assert known - drawn == {"role", "guides"}


def test_types_and_presets_run() -> None:
    _, hair = still_head(every=24)
    shown = []
    for options in ({"hair_type": "AFRICAN"}, {"hair_type": "H1", "lock": "HAIR"}, {"quality": "PREVIEW"}, {"quality": "FINAL", "hair_contact": True}):
        for name, value in options.items():
            setattr(hair.superhelix, name, value)
        hair.superhelix.wind = (3.0, 0.0, 0.0)
        for frame in range(1, 7):
            rows = go(frame)
        check(hair)
        shown.append(rows.tobytes())
    assert len(set(shown)) == len(shown)
