"""Shapes: curvatures, elements, rest, stability; posing."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import hanging

import superhelix as shx


def test_curvatures_are_set_and_read(solver, rng) -> None:
    ids = solver.add_strands(hanging(2, 4))
    rows, rates = rng.normal(size=(4, 3)), rng.normal(size=(4, 3))
    solver.set_curvatures(ids[1], rows, rates)
    found, speeds = solver.curvatures(ids[1])
    np.testing.assert_array_equal(found, rows)
    np.testing.assert_array_equal(speeds, rates)
    solver.set_curvatures(ids[1], rows)
    np.testing.assert_array_equal(solver.curvatures(ids[1])[1], 0.0)
    shapes = solver.shapes()
    assert shapes.shape == (8, 3)
    solver.set_shapes(shapes[::-1])
    np.testing.assert_array_equal(solver.shapes(), shapes[::-1])
    with pytest.raises(shx.InvalidArgumentError):
        solver.set_shapes(shapes[1:])


def test_level_of_detail_keeps_the_curve(solver) -> None:
    ids = solver.add_strands(shx.StrandDefs(2, element_count=4, length=0.2, natural_curvatures=[[0, 20, 3]] * 4))
    assert solver.set_element_count(8).max() < 1e-9
    assert solver.element_counts().tolist() == [8, 8]
    assert solver.set_element_count(4, ids[0])[0] < 1e-9
    assert solver.set_element_lengths(ids[0], [0.05, 0.15]) < 1e-6
    np.testing.assert_allclose(solver.element_lengths(ids[0]), [0.05, 0.15])


def test_strands_settle_where_gravity_holds_them(solver) -> None:
    ids = solver.add_strands(shx.StrandDefs(3, element_count=8, length=0.25))
    settled = solver.settle(ids, shx.SettleDef(max_steps=200))
    assert settled.report.unconverged == 0
    assert (settled.status == shx.StrandStatus.CONVERGED).all()
    assert (settled.eigenvalues > 0.0).all()
    assert (settled.residuals <= 1e-10).all()
    before = solver.sample_strands(5, dtype=np.float64)
    solver.step(0.1, 4)
    np.testing.assert_allclose(solver.sample_strands(5, dtype=np.float64), before, atol=1e-7)


def test_shapes_that_are_adopted_rest_stay(solver) -> None:
    """A strand that stands up sideways keeps its shape once that is its rest shape and it is stiff enough."""
    ids = solver.add_strands(shx.StrandDefs(1, element_count=6, length=0.1, natural_curvatures=[[0, 5, 2]] * 6, radius=(1e-4, 1e-4)))
    drawn = solver.sample_strands(9, dtype=np.float64)
    found = solver.shape_stability(margin=0.3)
    scales = solver.stiffen_strands(0.3, ids)
    assert scales[0] == pytest.approx(found.youngs_scales[0], rel=1e-6)
    assert solver.shape_stability().eigenvalues[0] >= 0.3 - 1e-6
    for _ in range(10):
        solver.step(0.05, 2)
    np.testing.assert_allclose(solver.sample_strands(9, dtype=np.float64), drawn, atol=1e-6)
    assert found.radius_scales[0] >= 1.0


def test_natural_and_rest_shapes_are_adopted(solver) -> None:
    ids = solver.add_strands(hanging(1, 3))
    rows = np.array([[0.0, 4.0, 0.0]] * 3)
    solver.set_curvatures(ids[0], rows)
    solver.adopt_natural_shapes()
    np.testing.assert_array_equal(solver.natural_curvatures(ids[0]), rows)
    solver.adopt_rest_shapes(ids)
    assert np.abs(solver.natural_curvatures(ids[0]) - rows).max() > 1e-3
    solver.set_natural_curvatures(ids[0], rows)
    np.testing.assert_array_equal(solver.natural_curvatures(ids[0]), rows)


def test_a_dragged_tip_arrives(solver) -> None:
    ids = solver.add_strands(hanging(2, 8, 0.2))
    tips = solver.sample_strands(2, dtype=np.float64)[:, 1]
    targets = tips + [0.03, 0.0, 0.05]
    distances = solver.drag_strands(targets, [0.2, 0.2])
    assert distances.max() < 1e-5
    np.testing.assert_allclose(solver.sample_strands(2, dtype=np.float64)[:, 1], targets, atol=2e-5)
    fixed = solver.shapes()
    solver.drag_strands(tips, [0.2, 0.2], options=shx.PoseOptions(natural_pull=0.5), movable=[0] * 4 + [1] * 12)
    np.testing.assert_array_equal(solver.shapes()[:4], fixed[:4])
    with pytest.raises(ValueError, match="arclengths: 1 numbers; 2 expected"):
        solver.drag_strands(tips, [0.2], ids)


def test_a_brush_takes_what_lies_in_it_along(solver) -> None:
    solver.add_strands(hanging(5, 6, 0.2))
    far = solver.shapes()[-6:]
    brush = shx.Brush(centre=(0.0, 0.0, -0.15), radius=0.025, displacement=(0.0, 0.02, 0.0))
    brushed = solver.brush_strands(brush)
    assert brushed.touched.tolist() == [True, True, True, False, False]
    assert brushed.distances[0] < 0.02
    np.testing.assert_array_equal(solver.shapes()[-6:], far)


def test_strands_are_changed_cut_grown_and_mirrored(solver) -> None:
    ids = solver.add_strands(hanging(2, 4, 0.2))
    solver.change_elements(shx.ElementChange(element=1, bend=(0.3, 0.0), length_scale=1.5))
    np.testing.assert_allclose(solver.element_lengths(ids[1]), [0.05, 0.075, 0.05, 0.05])
    solver.cut_strands([0.1, 0.2], ids)
    np.testing.assert_allclose([solver.element_lengths(one).sum() for one in ids], [0.1, 0.2])
    solver.grow_strands(0.05, ids[0], element_count=2, curvatures=(0.0, 1.0, 0.0))
    assert solver.element_lengths(ids[0]).sum() == pytest.approx(0.15)
    images = solver.mirror_strands((0.0, -1.0, 0.0), (0.0, 1.0, 0.0))
    assert solver.strand_count() == 4
    points, mirrored = (solver.sample_strands(4, one, dtype=np.float64) for one in (ids, images))
    np.testing.assert_allclose(mirrored[..., 1], -2.0 - points[..., 1], atol=1e-9)
    np.testing.assert_allclose(mirrored[..., [0, 2]], points[..., [0, 2]], atol=1e-9)
