"""Fitting, splines, settings, elements, friction, hair types, wisps."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import hanging

import superhelix as shx
from superhelix import _capi


def helix(radius: float = 0.01, pitch: float = 0.03, turns: float = 2.0, points: int = 60) -> np.ndarray:
    angle = np.linspace(0.0, 2 * np.pi * turns, points)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), -pitch * angle / (2 * np.pi)], axis=1)


def test_a_polyline_is_fitted() -> None:
    curve = helix()
    strand = shx.fit_polyline(curve, 10)
    assert strand.fit.length == pytest.approx(np.linalg.norm(np.diff(curve, axis=0), axis=1).sum())
    assert strand.fit.rms_error < 1e-3 * strand.fit.length
    assert strand.element_lengths.sum() == pytest.approx(strand.fit.length)
    np.testing.assert_allclose(strand.fit.root.origin, curve[0])
    with pytest.raises(shx.InvalidArgumentError, match="element_count"):
        shx.fit_polyline(curve, 0)
    with pytest.raises(shx.InvalidArgumentError, match="element_count"):
        shx.fit_polyline(curve, 10**9)


def test_many_curves_are_fitted_and_simulated(solver) -> None:
    curves = np.stack([helix(0.01 + 0.001 * number) for number in range(5)])
    fit = shx.fit_strands(curves, options=shx.FitOptions(element_count=12))
    assert fit.fitted.all()
    assert (fit.strands.rms_error < 1e-3 * fit.strands.length).all()
    ids = solver.add_strands(shx.StrandDefs.from_fit(fit, material=shx.Material(radius=(1e-4, 1e-4))))
    assert solver.material(ids[0]).radius == (1e-4, 1e-4)
    points = solver.sample_strands(60, dtype=np.float64)
    distances = np.linalg.norm(points[:, [0, -1]] - curves[:, [0, -1]], axis=-1)
    assert distances.max() < 1e-3
    np.testing.assert_allclose(solver.root_frames(), fit.strands.root, atol=1e-12)


def test_curves_of_different_lengths_widths_and_bad_ones() -> None:
    good, bad = helix(points=20), np.zeros((7, 3))
    points, counts = np.concatenate([good, bad]), [20, 7]
    fit = shx.fit_strands(points, counts, shx.FitOptions(element_count=6), widths=np.full(27, 2e-4))
    assert fit.fitted.tolist() == [True, False]
    assert fit.strands.radius[0] == pytest.approx(1e-4)
    chosen = fit.select(fit.fitted)
    assert len(chosen) == 1
    assert shx.StrandDefs.from_fit(chosen).data["radius"][0, 0] == pytest.approx(1e-4)
    with pytest.raises(shx.InvalidArgumentError):
        shx.StrandDefs.from_fit(fit)
    with pytest.raises(ValueError, match="point_counts"):
        shx.fit_strands(points)
    with pytest.raises(ValueError, match="points: 27 items; 26 expected"):
        shx.fit_strands(points, [20, 6])


def test_roots_frames_and_a_parallel_loop_are_heeded() -> None:
    curves = np.stack([helix()] * 8)
    frames = shx.frames.frames_along(curves, np.gradient(curves, axis=1), (0.0, 0.0, 1.0))
    used = []

    def loop(count, min_range, run):
        used.append(count)
        run(0, count, 0)

    options = shx.FitOptions(element_count=10, worker_count=2)
    plain = shx.fit_strands(curves, options=options, frames=frames, roots=frames[:, 0])
    fit = shx.fit_strands(curves, options=options, frames=frames, roots=frames[:, 0], parallel_for=loop)
    np.testing.assert_array_equal(fit.curvatures, plain.curvatures)
    np.testing.assert_allclose(fit.strands.root[:, 3:], frames[:, 0, 3:], atol=1e-9)
    assert used

    def broken(count, min_range, run):
        raise OverflowError("loop")

    with pytest.raises(OverflowError):
        shx.fit_strands(curves, options=options, parallel_for=broken)


def test_sag_free_curvatures_rest(solver) -> None:
    rows = np.array([[0.0, 3.0, 1.0]] * 6)
    defs = hanging(2, 6, 0.1, initial_curvatures=rows)
    natural = shx.sag_free_curvatures(defs, np.tile(rows, (2, 1)))
    assert natural.shape == (12, 3)
    solver.add_strands(hanging(2, 6, 0.1, initial_curvatures=rows, natural_curvatures=natural.reshape(2, 6, 3)))
    before = solver.sample_strands(5, dtype=np.float64)
    solver.step(0.1, 3)
    np.testing.assert_allclose(solver.sample_strands(5, dtype=np.float64), before, atol=1e-8)


def test_spline_points_go_through_the_controls() -> None:
    controls = helix(points=7)
    points, arclengths = shx.spline_points(controls, points_per_span=10)
    assert points.shape == (61, 3)
    np.testing.assert_allclose(points[::10], controls, atol=1e-12)
    assert (np.diff(arclengths) > 0.0).all()
    bezier, _ = shx.spline_points(controls, shx.SplineKind.BEZIER, points_per_span=4, dtype=np.float32)
    assert bezier.dtype == np.float32
    fit = shx.fit_strands(points, [len(points)], arclengths=arclengths)
    assert fit.strands.length[0] == pytest.approx(arclengths[-1])


def test_settings_by_preset_and_by_error() -> None:
    shape = {"curvature": 30.0, "length": 0.3, "frame_time": 1 / 30}
    preview = shx.preset_settings(shx.Preset.PREVIEW, **shape)
    accurate = shx.preset_settings(shx.Preset.ACCURATE, **shape)
    assert accurate.element_count > preview.element_count
    suggested = shx.suggest_settings(0.03, **shape)
    assert 0.0 < suggested.rms_error <= 0.03
    with shx.Solver(settings=suggested) as solver:
        solver.add_strands(hanging(1, suggested.element_count))
        solver.step(1 / 30, suggested.substeps)
    with pytest.raises(shx.InvalidArgumentError, match="target_error"):
        shx.suggest_settings(-1.0, **shape)


def test_the_number_of_elements_is_suggested() -> None:
    curl = shx.StrandDefs(1, length=0.2, natural_curvatures=[[5.0, 60.0, 0.0]])
    found = shx.suggest_elements(curl, shx.SuggestDef(tolerance=2e-3))
    assert found.meets_tolerance
    assert 4 <= found.element_count <= 100
    straight = shx.StrandDefs(1, length=0.2, natural_curvatures=[[0.0, 0.0, 0.0]])
    assert shx.suggest_elements(straight, shx.SuggestDef(tolerance=2e-3)).element_count < found.element_count
    moving = shx.frames.frames(np.stack([[0.02 * np.sin(0.3 * t), 0.0, 0.0] for t in range(20)]))
    assert shx.suggest_elements(straight, motion=moving).motion_error > 0.0
    with pytest.raises(ValueError, match="strand: 2 definitions; 1 expected"):
        shx.suggest_elements(hanging(2))


def test_friction_is_found_again() -> None:
    """A strand that is let go swings with a known drag; the fit finds it."""
    drag, times = 3e-5, np.arange(0, 1.0, 1 / 60)
    definition = {"element_count": 4, "length": 0.15}
    root = shx.frames.frames_along([[0.0, 0.0, 0.0]], [[0.0, 0.0, -1.0]], (1.0, 0.0, 0.0))
    bent = [[0.0, 0.0, 4.0]] * 4
    values = []
    with shx.Solver() as solver:
        solver.add_strands(shx.StrandDefs(1, air_drag=drag, root=root, initial_curvatures=bent, **definition))
        for place in range(len(times)):
            if place:
                solver.step(1 / 60, 8)
            points = solver.sample_strands(2, dtype=np.float64)[0]
            values.append(np.linalg.norm(points[1] - points[0]))
    strand = shx.StrandDefs(1, root=root, initial_curvatures=bent, **definition)
    wanted = shx.FrictionFitDef(
        coefficients=shx.FrictionCoefficient.AIR_DRAG,
        start=shx.FrictionStart.AS_DEFINED,
        observable=shx.Observable.SPAN,
        time_step=1 / 480,
        grid_points=4,
        air_drag_range=(1e-6, 1e-3),
    )
    found = shx.fit_friction(strand, wanted, times, values)
    assert found.report.air_drag.value == pytest.approx(drag, rel=0.05)
    assert found.report.air_drag.status is shx.CoefficientStatus.DETERMINED
    assert found.report.viscosity.status is shx.CoefficientStatus.NOT_FITTED
    np.testing.assert_allclose(found.curve, values, atol=1e-3)
    still = shx.frames.frames(np.zeros((2, 3)), root[0, 3:])
    again = shx.fit_friction(strand, wanted, times, values, root_times=[0.0, 1.0], root_frames=still, solver=shx.SolverDef())
    assert again.report.air_drag.value == pytest.approx(drag, rel=0.05)
    with pytest.raises(ValueError, match="give both or neither"):
        shx.fit_friction(strand, wanted, times, values, root_times=[0.0, 1.0])


def test_hair_types_and_their_strands(solver) -> None:
    african, asian = shx.hair_type("african"), shx.hair_type("asian")
    assert african.helix_radius < asian.helix_radius or asian.helix_radius == 0.0
    varied = african.copy(variation_between=0.1, seed=4)
    counts, lengths = [10, 12], np.full(22, 0.005)
    made = shx.hair_strands(varied, counts, lengths)
    assert made.natural_curvatures.shape == (22, 3)
    assert made.strands.density[0] == african.density
    second = shx.hair_strands(varied, counts[1:], lengths[10:], first_strand=1)
    np.testing.assert_array_equal(second.natural_curvatures, made.natural_curvatures[10:])
    curlier = shx.hair_strands(varied, counts, lengths, sliders=shx.HairSliders(curliness=0.5))
    assert np.linalg.norm(curlier.natural_curvatures) > np.linalg.norm(made.natural_curvatures)
    solver.add_strands(shx.StrandDefs(2, element_count=counts, element_lengths=lengths, natural_curvatures=made.natural_curvatures, material=made.strands))
    assert solver.material(solver.strand_ids()[1]).youngs_modulus == pytest.approx(made.strands.youngs_modulus[1])
    with pytest.raises(shx.InvalidArgumentError, match="name"):
        shx.hair_type("martian")


def test_a_wisp_is_stiffer_for_its_weight() -> None:
    hair = shx.Material()
    rod = shx.wisp_material(shx.Wisp(hairs=200.0, hold=0.6), hair)
    area, single = rod.material.radius[0] ** 2, hair.radius[0] ** 2
    assert area / single == pytest.approx(200.0)
    stiffness = rod.material.youngs_modulus * area**2 / (hair.youngs_modulus * single**2)
    assert stiffness / 200.0 == pytest.approx(200.0**0.6)
    assert rod.margin == pytest.approx(0.54)
    assert rod.radius > rod.material.radius[0]
    assert shx.wisp_material() == shx.wisp_material(shx.Wisp(), shx.Material())
    assert _capi.SHX_OK == 0
