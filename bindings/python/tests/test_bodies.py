"""Bodies, contact and constraints."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import cube, hanging, mass, sphere_mesh

import superhelix as shx


def fallen(definition: shx.BodyDef, **contact: float) -> tuple[shx.Solver, shx.BodyId]:
    """A strand that starts level above a body and has come down on it."""
    solver = shx.Solver()
    body = solver.add_body(definition)
    root = shx.Frame(origin=(-0.1, 0.0, 0.12))
    solver.add_strands(shx.StrandDefs(1, element_count=10, length=0.25, root=root, air_drag=1e-5, internal_friction=1e-9))
    solver.set_strand_contact(shx.StrandContact(**contact))
    for _ in range(60):
        solver.step(1 / 60, 2)
    return solver, body


@pytest.mark.parametrize(
    "definition",
    [
        shx.BodyDef.sphere(0.1),
        shx.BodyDef.capsule((0.0, -0.3, 0.0), (0.0, 0.3, 0.0), 0.1),
        shx.BodyDef.ellipsoid((0.1, 0.1, 0.1)),
        shx.BodyDef.mesh(*sphere_mesh()),
        shx.BodyDef.hull(sphere_mesh()[0]),
        shx.BodyDef.grid(shx.bake_distance_grid(*sphere_mesh(), cell=0.01, band=0.03)),
        shx.BodyDef.mesh(*sphere_mesh(), shx.Sides.FRONT, 0.05),
    ],
    ids=["sphere", "capsule", "ellipsoid", "mesh", "hull", "grid", "front"],
)
def test_every_round_shape_holds_hair_up(definition) -> None:
    solver, body = fallen(definition)
    with solver:
        points = solver.sample_strands(33, dtype=np.float64)[0]
        assert np.hypot(points[:, 0], points[:, 2]).min() > 0.096
        contacts = solver.contacts()
        assert len(contacts) > 0
        assert (contacts.partner == shx.Partner.BODY).all()
        assert contacts.body == shx.BodyIds([body] * len(contacts))
        assert (contacts.normal[:, 2] > 0.0).any()
        assert np.abs(contacts.gap).max() < 1e-3
        forces, _ = solver.body_wrenches()
        np.testing.assert_allclose(forces[0], -contacts.force.sum(axis=0), atol=1e-9)
        assert -2 * 9.81 * mass(0.25) < forces[0, 2] < 0.0


def test_flat_shapes_and_shared_ones() -> None:
    for definition in (shx.BodyDef.half_space(), shx.BodyDef.box((0.5, 0.5, 0.5), pose=shx.Frame(origin=(0.0, 0.0, -0.5)))):
        solver, body = fallen(definition)
        with solver:
            assert solver.sample_strands(33, dtype=np.float64)[0, :, 2].min() > -1e-3
            other = solver.add_body(shx.BodyDef.shared(body, thickness=0.01))
            assert solver.body_count() == 2
            assert solver.body_ids() == shx.BodyIds([body, other])
            solver.remove_bodies(other)
            assert not solver.has_body(other)
            assert solver.has_body(body)


def test_bodies_move_and_deform(solver) -> None:
    vertices, triangles = cube()
    ball, mesh = solver.add_bodies([shx.BodyDef.sphere(0.1), shx.BodyDef.mesh(vertices, triangles)])
    there = shx.frames.frames([[0.0, 0.0, 1.0], [3.0, 0.0, 0.0]])
    solver.add_strands(hanging(1))
    solver.set_body_frames(there, over_seconds=0.1)
    solver.step(0.1, 2)
    np.testing.assert_allclose(solver.body_frames(), there, atol=1e-12)
    solver.teleport_bodies(there[:1] + [0, 0, 1, 0, 0, 0, 0], ball)
    assert solver.body_frames(ball)[0, 2] == 2.0
    solver.set_body_vertices(mesh, vertices * 1.1, 0.1)
    with pytest.raises(shx.UnsupportedError):
        solver.set_body_vertices(ball, vertices)
    solver.set_body_surface(ball, 0.01, friction_scale=0.5)
    solver.set_body_filter(ball, groups=2, mask=4)
    with pytest.raises(ValueError, match="mask: -1"):
        solver.set_body_filter(ball, groups=2, mask=-1)
    solver.step(0.1)


def test_a_body_that_is_none_is_named(solver) -> None:
    with pytest.raises(shx.InvalidArgumentError, match=r"defs\[1\]\.radius"):
        solver.add_bodies([shx.BodyDef.sphere(1.0), shx.BodyDef.sphere(-1.0)])
    with pytest.raises(TypeError, match=r"vertices: an array of int64"):
        shx.BodyDef.hull(np.zeros((4, 3), dtype=np.int64))
    with pytest.raises(ValueError, match="triangles: shape"):
        shx.BodyDef.mesh(np.zeros((4, 3)), [[0, 1]])
    copied = shx.BodyDef.mesh(*cube()).copy(thickness=0.1)
    assert copied.thickness == 0.1
    solver.add_body(copied)


def test_contact_is_said_and_read_back(solver) -> None:
    ids = solver.add_strands(hanging(2))
    assert solver.strand_contact(ids[0]) is None
    contact = shx.StrandContact(radius=1e-4, friction_along=0.4)
    solver.set_strand_contact(contact)
    assert solver.strand_contact(ids[0]) == contact
    solver.set_strand_contact([contact, contact.copy(radius=2e-4)], ids)
    assert solver.strand_contact(ids[1]).radius == 2e-4
    solver.set_strand_contact(None, ids[0])
    assert solver.strand_contact(ids[0]) is None
    options = solver.contact_options()
    assert options.model is shx.ContactModel.COULOMB
    solver.set_contact_options(options.copy(model=shx.ContactModel.PENALTY, stiffness=20.0))
    assert solver.contact_options().stiffness == 20.0
    solver.keep_contact_events(10)
    events, lost = solver.drain_contact_events()
    assert len(events) == 0
    assert lost == 0


def test_contact_at_points_bears_a_strand(solver) -> None:
    floor = solver.add_body(shx.BodyDef.half_space())
    root = shx.Frame(origin=(-0.1, 0.0, 0.02))
    solver.add_strands(shx.StrandDefs(1, element_count=10, length=0.25, root=root, air_drag=1e-5, internal_friction=1e-9))
    solver.set_contact_options(shx.ContactOptions(model=shx.ContactModel.AT_POINTS))
    solver.set_strand_contact(shx.StrandContact())
    for _ in range(240):
        report = solver.step(1 / 60)
    contacts = solver.contacts()
    assert len(contacts) > 0
    assert report.max_penetration < 5e-4
    assert solver.sample_strands(65, dtype=np.float64)[0, :, 2].min() > -5e-4
    forces, _ = solver.body_wrenches(floor)
    np.testing.assert_allclose(forces[0], -contacts.force.sum(axis=0), atol=1e-12)
    assert -2 * 9.81 * mass(0.25) < forces[0, 2] < 0.0


def test_wisps_meet_and_what_overlaps_is_permitted(solver) -> None:
    ids = solver.add_strands(hanging(2, 6, 0.2))
    solver.set_contact_options(shx.ContactOptions(hair_contact=True))
    solver.set_strand_contact(shx.StrandContact(wisp_radius=0.008))
    overlaps = solver.overlaps()
    np.testing.assert_allclose(overlaps.hair_depths, 0.006, rtol=1e-3)
    assert overlaps.strands == ids[[1, 0]]
    assert not any(overlaps.bodies)
    solver.permit_overlaps()
    np.testing.assert_allclose(solver.overlaps().hair_depths, 0.0, atol=1e-9)
    permitted = solver.permitted_overlap(ids[0])
    assert permitted.wisp_fractions.min() == pytest.approx(5 / 8, rel=1e-3)
    solver.set_permitted_overlap(ids[1], *permitted)
    np.testing.assert_array_equal(solver.permitted_overlap(ids[1]).arclengths, permitted.arclengths)
    solver.set_permitted_overlap(ids[1], [], [], [])
    assert len(solver.permitted_overlap(ids[1]).arclengths) == 0
    solver.step(0.01)
    contacts = solver.contacts()
    assert (contacts.partner == shx.Partner.STRAND).all()
    assert set(contacts.strand) | set(contacts.other_strand) <= {*ids}


def test_curves_are_pushed_out(solver) -> None:
    body = solver.add_body(shx.BodyDef.sphere(0.1))
    inside = np.stack([np.linspace(0.1, 0.08, 12), np.zeros(12), np.linspace(0.0, 0.06, 12)], axis=1)
    outside = inside + [0.3, 0.0, 0.0]
    pushed = solver.push_out_curves(body, np.concatenate([inside, outside]), [12, 12], 1e-4)
    assert pushed.depths[0] > 0.0
    assert pushed.depths[1] == 0.0
    assert pushed.displacements[0] > 0.0
    assert not pushed.stuck.any()
    np.testing.assert_array_equal(pushed.points[12:], outside)
    assert np.linalg.norm(pushed.points[1:12], axis=1).min() > 0.1
    assert inside[-1, 0] == 0.08


def test_constraints_hold(solver) -> None:
    ids = solver.add_strands(hanging(2, 8, 0.2))
    tip = solver.sample_strands(2, dtype=np.float64)[0, 1]
    target = shx.Frame(origin=tuple(tip + [0.02, 0.0, 0.03]))
    held = solver.add_constraint(shx.ConstraintDef(strand=ids[0], arclength=0.2, target=target))
    tied = solver.add_constraint(shx.ConstraintDef(kind=shx.ConstraintKind.TIE, strand=ids[0], arclength=0.1, other_strand=ids[1], other_arclength=0.1))
    assert solver.constraint_count() == 2
    assert solver.constraint_ids() == shx.ConstraintIds([held, tied])
    for _ in range(20):
        report = solver.step(0.02, 2)
    assert report.max_constraint_error < 1e-6
    np.testing.assert_allclose(solver.sample_at(ids[0], [0.2])[0], target.origin, atol=1e-6)
    states = solver.constraint_states()
    assert (states.status == shx.ConstraintStatus.SATISFIED).all()
    assert np.linalg.norm(states.force[0]) > 0.0
    frame = solver.constraint_targets(held)
    np.testing.assert_allclose(frame[0, :3], target.origin)
    frame[0, 2] -= 0.01
    solver.set_constraint_targets(frame, held, 0.1)
    solver.step(0.1, 5)
    np.testing.assert_allclose(solver.sample_at(ids[0], [0.2])[0], frame[0, :3], atol=1e-5)
    solver.remove_constraints(tied)
    assert not solver.has_constraint(tied)
    assert solver.has_constraint(held)
    with pytest.raises(shx.InvalidArgumentError, match=r"defs\[0\]\.arclength"):
        solver.add_constraint(shx.ConstraintDef(strand=ids[0], arclength=9.0))


def test_a_hand_feels_hair(solver) -> None:
    ids = solver.add_strands(hanging(4, 5, 0.2))
    solver.set_strand_contact(shx.StrandContact(), ids)
    start = shx.Frame(origin=(-0.05, 0.0, -0.1))
    ball = solver.add_body(shx.BodyDef.sphere(0.02, pose=start))
    with pytest.raises(shx.InvalidArgumentError, match=r"def\.stiffness"):
        shx.Haptic(solver, ball, shx.HapticDef(stiffness=-1.0))
    with pytest.raises(shx.InvalidArgumentError, match=r"def\.explicit_time"):
        shx.Haptic(solver, ball, shx.HapticDef(force_law=shx.HapticForce.EXPLICIT, explicit_time=-1.0))
    with shx.Haptic(solver, ball, shx.HapticDef(max_force=1.0)) as haptic:
        for frame in range(60):
            for tick in range(8):
                along = min((8 * frame + tick) / 400.0, 1.0)
                pose = shx.Frame(origin=(-0.05 + 0.08 * along, 0.0, -0.1))
                felt = haptic.update(pose, (0.16 if along < 1.0 else 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), dt=1e-3)
            haptic.before_step(solver, 8e-3)
            solver.step(8e-3)
            haptic.after_step(solver)
        assert felt.force[0] < 0.0
        assert felt.state.model_count == 59
        assert felt.state.pressing > 0
        assert felt.state.energy_given > 0.0
        assert felt.state.max_energy_excess <= 1e-3
        np.testing.assert_allclose(solver.body_frames(ball)[0, :3], felt.state.proxy.origin, atol=1e-6)
        with pytest.raises(ValueError, match="velocity"):
            haptic.update(pose, (0.0, 0.0), dt=1e-3)
