"""Strands: definitions, adding, reading, materials, roots."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import hanging, mass

import superhelix as shx


def test_definitions_take_values_for_all_or_for_each(solver, rng) -> None:
    lengths = np.array([0.1, 0.2, 0.3])
    natural = rng.normal(size=(3, 4, 3))
    defs = shx.StrandDefs(3, length=lengths, natural_curvatures=natural, density=1200.0, user_data=[5, 6, 7])
    ids = solver.add_strands(defs)
    assert solver.strand_count() == len(solver.strand_ids()) == 3
    assert [solver.user_data(one) for one in ids] == [5, 6, 7]
    for place, one in enumerate(ids):
        np.testing.assert_array_equal(solver.natural_curvatures(one), natural[place])
        np.testing.assert_allclose(solver.element_lengths(one).sum(), lengths[place])
    assert solver.material(ids[0]).density == 1200.0


def test_definitions_with_different_numbers_of_elements(solver, rng) -> None:
    rows = rng.normal(size=(9, 3))
    lengths = rng.uniform(0.01, 0.02, size=9)
    defs = shx.StrandDefs(3, element_count=[2, 4, 3], natural_curvatures=rows, element_lengths=lengths)
    ids = solver.add_strands(defs)
    assert solver.element_counts().tolist() == [2, 4, 3]
    np.testing.assert_array_equal(solver.natural_curvatures(ids[1]), rows[2:6])
    np.testing.assert_allclose(solver.element_lengths(ids[2]), lengths[6:])
    some = solver.add_strands(defs[1:])
    np.testing.assert_array_equal(solver.natural_curvatures(some[1]), rows[6:])


def test_more_rows_than_there_are_are_never_read(solver) -> None:
    defs = shx.StrandDefs(2, length=0.1, natural_curvatures=np.zeros((2, 4, 3)))
    defs.data["element_count"] = 5
    with pytest.raises(ValueError, match="element_count: changed after rows"):
        solver.add_strands(defs)
    plain = shx.StrandDefs(2, length=0.1)
    plain.data["element_count"] = 5
    assert solver.element_counts(solver.add_strands(plain)).tolist() == [5, 5]


def test_one_row_of_elements_serves_all_strands(solver) -> None:
    ids = solver.add_strands(shx.StrandDefs(5, length=0.1, natural_curvatures=[[0, 1, 0], [0, 2, 0]]))
    np.testing.assert_array_equal(solver.natural_curvatures(ids[4]), [[0, 1, 0], [0, 2, 0]])


@pytest.mark.parametrize(
    ("make", "error", "text"),
    [
        (lambda: shx.StrandDefs(2, element_count=3, natural_curvatures=np.zeros((2, 4, 3))), ValueError, "natural_curvatures: shape"),
        (lambda: shx.StrandDefs(2, element_count=3, natural_curvatures=np.zeros((2, 3))), ValueError, "natural_curvatures: shape"),
        (lambda: shx.StrandDefs(2, element_count=[3, 4], natural_curvatures=np.zeros((6, 3))), ValueError, "7 rows in all expected"),
        (lambda: shx.StrandDefs(2, length=[1.0, 2.0, 3.0]), ValueError, r"length: shape \(3,\)"),
        (lambda: shx.StrandDefs(2, element_count=2.5), TypeError, "element_count: float64; numbers of uint32 expected"),
        (lambda: shx.StrandDefs(2, element_count=-1), ValueError, "element_count: -1"),
        (lambda: shx.StrandDefs(2, root=np.zeros((3, 7))), ValueError, "root: 3 frames; 1 or 2 expected"),
        (lambda: shx.StrandDefs(-1), ValueError, "count: -1"),
    ],
)
def test_wrong_definitions_are_named(make, error, text) -> None:
    with pytest.raises(error, match=text):
        make()


def test_the_library_names_what_it_refuses(solver) -> None:
    defs = hanging(3)
    defs.data["length"][2] = -1.0
    with pytest.raises(shx.InvalidArgumentError, match=r"defs\[2\]\.length") as caught:
        solver.add_strands(defs)
    assert isinstance(caught.value, ValueError)
    assert caught.value.name == "SHX_ERROR_INVALID_ARGUMENT"
    assert solver.strand_count() == 0


def test_removed_and_foreign_ids_are_refused(solver) -> None:
    ids = solver.add_strands(hanging(3))
    solver.remove_strands(ids[1])
    assert [solver.has_strand(one) for one in ids] == [True, False, True]
    assert solver.strand_ids() == ids[[0, 2]]
    with pytest.raises(shx.InvalidIdError):
        solver.strand_status(ids)
    with shx.Solver() as other:
        with pytest.raises(LookupError):
            other.element_count(ids[0])
    with pytest.raises(TypeError, match="BodyIds; StrandIds or StrandId expected"):
        solver.strand_status(shx.BodyIds())
    with pytest.raises(TypeError, match="id: int; StrandId expected"):
        solver.element_count(3)


def test_a_strand_that_hangs_pulls_by_its_weight(solver) -> None:
    solver.add_strands(hanging(3))
    report = solver.step(1 / 60, 2)
    assert report.substeps == 2
    assert report.unconverged == 0
    assert (solver.strand_status() == shx.StrandStatus.CONVERGED).all()
    forces, torques = solver.root_wrenches()
    np.testing.assert_allclose(forces, [[0.0, 0.0, -9.81 * mass()]] * 3, rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(torques, 0.0, atol=1e-9)
    assert solver.strand_iterations().shape == (3,)
    points, errors = solver.strand_quadrature()
    assert (points > 0).all()
    assert (errors <= 1e-4).all()
    assert (solver.strand_turning_angles() < 0.1).all()


def test_energies_are_those_of_a_falling_pendulum(solver) -> None:
    ids = solver.add_strands(shx.StrandDefs(1, element_count=6, length=0.3))
    before = solver.strand_energies(ids)
    assert before.gravity[0] == pytest.approx(0.0, abs=1e-12)
    report = solver.step(0.1, 50)
    after = solver.strand_energies()
    total = report.kinetic_energy + report.elastic_energy + report.gravity_energy
    assert total == pytest.approx(sum(numbers[0] for numbers in after))
    assert after.kinetic[0] > 0.0
    assert total == pytest.approx(0.0, abs=0.05 * after.kinetic[0])


def test_materials_are_changed_and_read_back(solver) -> None:
    ids = solver.add_strands(hanging(2))
    solver.set_materials(shx.Material(density=900.0))
    assert [solver.material(one).density for one in ids] == [900.0, 900.0]
    solver.set_materials([shx.Material(density=1.0), shx.Material(density=2.0)], ids)
    assert [solver.material(one).density for one in ids] == [1.0, 2.0]
    with pytest.raises(ValueError, match="materials: 1 Material; 2 expected"):
        solver.set_materials([shx.Material()], ids)
    with pytest.raises(TypeError, match=r"materials\[1\]"):
        solver.set_materials([shx.Material(), 3], ids)


def test_roots_move_over_time_or_at_once(solver) -> None:
    solver.add_strands(hanging(2))
    frames = solver.root_frames()
    there = frames.copy()
    there[:, 0] += 0.01
    solver.set_root_frames(there, over_seconds=0.1)
    solver.step(0.05)
    half = solver.root_frames()
    assert ((half[:, 0] > frames[:, 0]) & (half[:, 0] < there[:, 0])).all()
    solver.step(0.05)
    np.testing.assert_allclose(solver.root_frames(), there, atol=1e-12)
    solver.teleport_roots(frames)
    np.testing.assert_allclose(solver.root_frames(), frames)
    solver.reset_strands()
    assert not any(solver.curvatures(one)[1].any() for one in solver.strand_ids())


def test_strands_follow_targets(solver) -> None:
    ids = solver.add_strands(hanging(3))
    curves = solver.sample_strands(9).astype(np.float64)
    curves[:, :, 1] += np.linspace(0.0, 0.02, 9) ** 1.5
    assert (solver.target_distances() == -1).all()
    solver.set_targets(curves[:2], ids[:2], weights=[(0, 1)], strand_weights=[1.0, 0.0], over_seconds=0.1)
    for _ in range(10):
        solver.step(0.01)
    distances = solver.target_distances()
    assert 0.0 <= distances[0] < 1e-4
    assert (distances[1:] == -1).all()
    # The same, curve by curve, from half-way on.
    solver.set_targets(
        curves[:2].reshape(-1, 3), ids[:2], point_counts=[9, 9], arclengths=np.tile(np.linspace(0.0, 0.2, 9), 2), weights=[(0.5, 0), (1, 1)], time_constant=0.02
    )
    followed, free = solver.target_distances(ids[:2])
    assert 0.0 <= followed < 1e-3 < free
    solver.clear_targets()
    assert (solver.target_distances() == -1).all()
    with pytest.raises(shx.InvalidArgumentError, match=r"def\.curve_count"):
        solver.set_targets(curves[:2], ids)
    with pytest.raises(shx.InvalidArgumentError, match=r"def\.weights\[0\]"):
        solver.set_targets(curves, ids, weights=[(0, 2)])
    with pytest.raises(ValueError, match="weights: shape"):
        solver.set_targets(curves, ids, weights=[0, 1])
    with pytest.raises(ValueError, match="points: shape"):
        solver.set_targets(curves[0], ids)


def test_sampling_at_arclengths(solver) -> None:
    ids = solver.add_strands(hanging(1, length=0.2))
    points = solver.sample_at(ids[0], [0.0, 0.1, 0.2])
    np.testing.assert_allclose(points[:, 2], [0.0, -0.1, -0.2], atol=1e-12)
    with pytest.raises(shx.InvalidArgumentError, match="arclengths"):
        solver.sample_at(ids[0], [0.3])


def test_gravity_wind_and_memory(solver) -> None:
    solver.add_strands(hanging(2, air_drag=1e-5))
    solver.set_gravity([0.0, 0.0, 0.0])
    solver.set_wind((3.0, 0.0, 0.0))
    before = solver.sample_strands(4, dtype=np.float64)
    solver.step(0.1, 4)
    assert (solver.sample_strands(4, dtype=np.float64)[:, -1, 0] > before[:, -1, 0]).all()
    assert solver.memory_usage() > 1000
    with pytest.raises(ValueError, match="gravity: 2 numbers; 3 expected"):
        solver.set_gravity([0.0, 1.0])


def test_snapshots_give_the_same_bits(solver) -> None:
    ids = solver.add_strands(shx.StrandDefs(3, element_count=4, length=0.2))
    solver.step(0.02)
    image, before = solver.snapshot(), solver.state_hash()
    solver.step(0.02)
    after = solver.state_hash()
    solver.remove_strands(ids[0])
    solver.restore(image)
    assert solver.strand_ids() == ids
    assert solver.state_hash() == before != after
    solver.step(0.02)
    assert solver.state_hash() == after
    with pytest.raises(shx.SnapshotError):
        solver.restore(image[:50])


def test_snapshots_refer_to_shapes_and_keep_options(solver) -> None:
    ids = solver.add_strands(shx.StrandDefs(2, element_count=4, length=0.2))
    corners = np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]], dtype=float)
    body = solver.add_body(shx.BodyDef.hull(corners, user_data=12))
    solver.step(0.02)
    whole, small, shapes = solver.snapshot(), solver.snapshot(include_shapes=False), solver.snapshot_shapes()
    assert len(small) < len(whole)
    state = solver.state_hash()
    solver.step(0.02)
    solver.restore(small)
    assert solver.state_hash() == state
    other = shx.Solver(gravity=(0, 1, 0))
    with pytest.raises(shx.SnapshotError, match="neither in the solver nor in the shapes"):
        other.restore(small)
    other.restore(small, shapes=shapes, keep_options=True)
    assert list(other.options().gravity) == [0, 1, 0]
    assert other.strand_ids() == ids
    assert other.body_user_data(body) == 12
    other.restore(small, shapes=shapes)
    assert other.state_hash() == state


def test_options_change_while_a_solver_lives(solver) -> None:
    options = solver.options()
    assert options.integrator == shx.Integrator.SECOND_ORDER
    solver.set_options(options.copy(integrator=shx.Integrator.IMPLICIT_EULER, gravity=(0, -9.81, 0), max_work=1000))
    assert solver.options().integrator == shx.Integrator.IMPLICIT_EULER
    assert solver.options().max_work == 1000
    with pytest.raises(shx.UnsupportedError, match="options.worker_count"):
        solver.set_options(options.copy(worker_count=3))
    assert solver.own_user_data == 0
    solver.own_user_data = 2**64 - 1
    assert solver.own_user_data == 2**64 - 1


def test_samples_come_in_the_host_s_space(solver) -> None:
    ids = solver.add_strands(shx.StrandDefs(2, element_count=4, length=0.2))
    solver.step(0.02)
    own = solver.sample_strands(5, ids, dtype=np.float64)
    # Centimetres, y up, left-handed, and somewhere else.
    matrix = np.array([[100.0, 0, 0, 7], [0, 0, 100, 0], [0, 100, 0, -1], [0, 0, 0, 1]])
    expected = own @ matrix[:3, :3].T + matrix[:3, 3]
    assert np.allclose(solver.sample_strands(5, ids, dtype=np.float64, transform=matrix), expected)
    assert np.allclose(solver.sample_strands(5, ids, transform=matrix[:3]), expected, atol=1e-4)
    along = [0.0, 0.1, 0.2]
    assert np.allclose(solver.sample_at(ids[1], along, transform=matrix), expected[1, ::2])
    assert np.allclose(solver.sample_at(ids[1], along, transform=matrix[:3, :3], origin=[0, 0, 1]), expected[1, ::2] - [7, 100, -1])
    with pytest.raises(ValueError, match="def.y_axis"):
        solver.sample_strands(5, ids, transform=np.diag([1.0, 2.0, 1.0]))
    with pytest.raises(ValueError, match="transform: shape"):
        solver.sample_strands(5, ids, transform=np.eye(2))
    with pytest.raises(ValueError, match="last row"):
        solver.sample_strands(5, ids, transform=2 * np.eye(4))
    tip = solver.add_constraint(shx.ConstraintDef(strand=ids[0], arclength=0.2, user_data=44))
    assert solver.constraint_user_data(tip) == 44


def test_one_call_moves_what_is_attached(solver) -> None:
    ids = solver.add_strands(shx.StrandDefs(3, element_count=4, length=0.2))
    assert np.allclose(solver.strand_lengths(ids), 0.2)
    body = solver.add_body(shx.BodyDef.sphere(0.05))
    pose = [0, 0, 0, 0, 0, 0, 1]
    head = shx.Attachment(solver, pose)
    half = np.sqrt(0.5)
    head.move(solver, [1, 0, 0, 0, 0, half, half], 0.02)
    solver.step(0.02)
    assert np.allclose(solver.root_frames(ids)[:, :3], [1, 0, 0])
    assert np.allclose(solver.body_frames(body)[0], [1, 0, 0, 0, 0, half, half])
    head.teleport(solver, pose)
    assert np.allclose(solver.root_frames(ids)[:, :3], 0)
    solver.remove_strands(ids[1])
    with pytest.raises(shx.InvalidIdError, match=r"strand_ids\[1\]"):
        head.move(solver, pose)
    head.close()


def test_a_closed_solver_says_so() -> None:
    solver = shx.Solver(worker_count=2)
    with solver:
        assert not solver.closed
    assert solver.closed
    solver.close()
    assert repr(solver) == "Solver(closed)"
    with pytest.raises(ValueError, match="this Solver is closed"):
        solver.step(0.1)
    with pytest.raises(ValueError, match="closed"):
        with solver:
            pass


def test_solver_options() -> None:
    options = shx.SolverDef(gravity=(0.0, -9.81, 0.0))
    with shx.Solver(options, integrator=shx.Integrator.IMPLICIT_EULER, max_iterations=3) as solver:
        solver.add_strands(shx.StrandDefs(1, element_count=3, length=0.2))
        solver.step(0.05)
        assert solver.sample_strands(2)[0, 1, 1] < 0.0
    with pytest.raises(TypeError, match="SolverDef has no field 'graviti'"):
        shx.Solver(graviti=3)
    with pytest.raises(shx.InvalidArgumentError, match="tolerance"):
        shx.Solver(tolerance=-1.0)
    with pytest.raises(shx.InvalidArgumentError, match="dt"):
        with shx.Solver() as solver:
            solver.step(-1.0)
