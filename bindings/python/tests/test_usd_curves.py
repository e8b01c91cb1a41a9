"""Curves of USD against their definitions: de Casteljau, de Boor, Hermite, circles."""

from __future__ import annotations

import numpy as np
import pytest
import usd_stages as make
from pxr import UsdGeom, Vt

from superhelix import usd


def casteljau(controls: np.ndarray, u: float) -> np.ndarray:
    while len(controls) > 1:
        controls = (1 - u) * controls[:-1] + u * controls[1:]
    return controls[0]


def de_boor(controls: np.ndarray, knots: np.ndarray, degree: int, t: float) -> np.ndarray:
    span = min(max(np.searchsorted(knots, t, side="right") - 1, degree), len(controls) - 1)
    rows = [controls[place + span - degree] for place in range(degree + 1)]
    for level in range(1, degree + 1):
        for place in range(degree, level - 1, -1):
            low, high = knots[place + span - degree], knots[place + 1 + span - level]
            share = (t - low) / (high - low)
            rows[place] = (1 - share) * rows[place - 1] + share * rows[place]
    return rows[degree]


def hermite(p: np.ndarray, u: float) -> np.ndarray:
    """Between the second and third of four points, with Catmull and Rom's slopes."""
    m0, m1 = (p[2] - p[0]) / 2, (p[3] - p[1]) / 2
    return (2 * u**3 - 3 * u**2 + 1) * p[1] + (u**3 - 2 * u**2 + u) * m0 + (-2 * u**3 + 3 * u**2) * p[2] + (u**3 - u**2) * m1


def exact(points: np.ndarray, basis: str, wrap: str, samples: int = 400) -> np.ndarray:
    """A fine polyline on the curve, by the definition of its basis."""
    n = len(points)
    if wrap == "pinned" and basis != "bezier":
        points = np.concatenate([[2 * points[0] - points[1]], points, [2 * points[-1] - points[-2]]])
        n += 2
    rows = []
    step = 3 if basis == "bezier" else 1
    segments = n // step if wrap == "periodic" else (n - 4) // step + 1
    for segment in range(segments):
        p = points[(step * segment + np.arange(4)) % n]
        for u in np.linspace(0, 1, samples, endpoint=False):
            if basis == "bezier":
                rows.append(casteljau(p, u))
            elif basis == "catmullRom":
                rows.append(hermite(p, u))
            else:
                rows.append(de_boor(p, np.arange(8.0), 3, 3 + u))
    p = points[(step * (segments - 1) + np.arange(4)) % n]
    rows.append(casteljau(p, 1.0) if basis == "bezier" else hermite(p, 1.0) if basis == "catmullRom" else (p[1] + 4 * p[2] + p[3]) / 6)
    return np.array(rows)


def distance_to_polyline(points: np.ndarray, line: np.ndarray) -> np.ndarray:
    a, ab = line[:-1], np.diff(line, axis=0)
    squares = np.maximum(np.sum(ab**2, axis=1), 1e-30)
    share = np.clip(np.sum((points[:, None] - a) * ab, axis=2) / squares, 0, 1)
    return np.linalg.norm(a + share[..., None] * ab - points[:, None], axis=2).min(axis=1)


CASES = [
    ("bezier", "nonperiodic", 7),
    ("bezier", "pinned", 7),
    ("bezier", "periodic", 6),
    ("bspline", "nonperiodic", 6),
    ("bspline", "pinned", 6),
    ("bspline", "periodic", 6),
    ("catmullRom", "nonperiodic", 6),
    ("catmullRom", "pinned", 6),
    ("catmullRom", "periodic", 6),
]


@pytest.mark.parametrize(("basis", "wrap", "count"), CASES)
@pytest.mark.parametrize("tolerance", [1e-4, 1e-5])
def test_cubic_curves_are_those_of_their_basis_within_the_tolerance(basis, wrap, count, tolerance, rng) -> None:
    points = rng.normal(0, 0.05, (2, count, 3)).astype(np.float32).astype(np.float64)
    on = make.stage()
    made = make.curves(on, "/hair", points, [count] * 2, "cubic", basis, wrap)
    segments = made.ComputeSegmentCounts(0.0)
    hair = usd.read_hair(on, tolerance=tolerance)
    assert len(hair) == 2
    assert hair.closed.tolist() == [wrap == "periodic"] * 2
    for strand, rows in enumerate(np.split(hair.points, np.cumsum(hair.point_counts)[:-1])):
        line = exact(points[strand], basis, wrap)
        assert (len(rows) - 1) >= segments[strand]
        # Points are on the curve, and the curve is nowhere farther from the chords than the tolerance.
        assert distance_to_polyline(rows, line).max() < 1e-6
        away = distance_to_polyline(line, rows).max()
        assert away <= tolerance * 1.001 + 1e-7
        # Nor were far more chords made than are needed: the bound is for each segment.
        assert away > tolerance / 30
        np.testing.assert_allclose(rows[[0, -1]], line[[0, -1]], atol=1e-12)
        lengths = np.linalg.norm(np.diff(line, axis=0), axis=1).sum()
        assert hair.lengths[strand] == pytest.approx(lengths, rel=1e-5)
        along = np.split(hair.arclengths, np.cumsum(hair.point_counts)[:-1])[strand]
        assert along[0] == 0.0 and (np.diff(along) >= np.linalg.norm(np.diff(rows, axis=0), axis=1) - 1e-12).all()


def test_linear_curves_are_their_points_and_closed_ones_end_where_they_began() -> None:
    on = make.stage()
    points = np.arange(15.0).reshape(5, 3) ** 1.1
    make.curves(on, "/hair", points, [3, 2])
    hair = usd.read_hair(on)
    np.testing.assert_array_equal(hair.points.astype(np.float32), points.astype(np.float32))
    assert hair.point_counts.tolist() == [3, 2]
    on.GetPrimAtPath("/hair").GetAttribute("wrap").Set("periodic")
    hair = usd.read_hair(on)
    assert hair.point_counts.tolist() == [4, 3]
    np.testing.assert_array_equal(hair.points[3], hair.points[0])
    np.testing.assert_array_equal(hair.points[6], hair.points[4])


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_nurbs_of_any_order_and_with_weights(tolerance, rng) -> None:
    on = make.stage()
    made = UsdGeom.NurbsCurves.Define(on, "/hair")
    half = np.sqrt(0.5)
    # A quarter of a circle, exactly; a curve of order 4 with a knot of its own; a straight one of order 2; one of order 5 on a part of its range.
    quarter, free = [[1, 0, 0], [1, 1, 0], [0, 1, 0]], rng.normal(0, 0.3, (6, 3)).round(3)
    straight, high = [[0, 0, 0], [1, 0, 0], [1, 1, 0]], rng.normal(0, 0.3, (7, 3)).round(3)
    knots = [[0, 0, 0, 1, 1, 1], [0, 0, 0, 0, 0.3, 0.8, 1, 1, 1, 1], [0, 0, 1, 2, 2], [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]]
    points = np.concatenate([quarter, free, straight, high]).astype(np.float32).astype(np.float64)
    made.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points.astype(np.float32)))
    made.CreateCurveVertexCountsAttr([3, 6, 3, 7])
    made.CreateOrderAttr([3, 4, 2, 5])
    made.CreateKnotsAttr([value for row in knots for value in row])
    made.CreateRangesAttr([(0, 1), (0, 1), (0, 2), (4.5, 6.25)])
    for weights in ([1, half, 1] + [1.0] * 16, None):
        if weights is None:
            made.GetPointWeightsAttr().Clear()
        else:
            made.CreatePointWeightsAttr(weights)
        made.CreateWidthsAttr(np.arange(19.0))
        made.SetWidthsInterpolation("vertex")
        hair = usd.read_hair(on, tolerance=tolerance)
        rows = np.split(hair.points, np.cumsum(hair.point_counts)[:-1])
        if weights is not None:
            np.testing.assert_allclose(np.linalg.norm(rows[0], axis=1), 1.0, atol=1e-9)
            assert hair.lengths[0] == pytest.approx(np.pi / 2, rel=1e-6)
        for strand, degree, low, high_ in ((1, 3, 0.0, 1.0), (3, 4, 4.5, 6.25)):
            own = points[3:9] if strand == 1 else points[12:]
            line = np.array([de_boor(own, np.array(knots[strand], float), degree, t) for t in np.linspace(low, high_, 1200)])
            assert distance_to_polyline(rows[strand], line).max() < 1e-5
            assert distance_to_polyline(line, rows[strand]).max() <= tolerance
            assert hair.lengths[strand] == pytest.approx(np.linalg.norm(np.diff(line, axis=0), axis=1).sum(), rel=1e-4)
        np.testing.assert_allclose(rows[2], points[9:12], atol=1e-12)
        widths = np.split(hair.widths, np.cumsum(hair.point_counts)[:-1])
        np.testing.assert_allclose(widths[2], [9, 10, 11], atol=1e-9)
        assert widths[1][0] == pytest.approx(3) and widths[1][-1] == pytest.approx(8)
    # Control vertices need no valid knots.
    made.GetKnotsAttr().Set([0, 0, 1, 1])
    with pytest.raises(usd.UsdError, match=r"/hair: knots has 4 numbers; vertices plus order of each curve expected, 33 in all"):
        usd.read_hair(on)
    assert len(usd.read_hair(on, tolerance=None).points) == 19


def test_data_along_curves_have_all_interpolations() -> None:
    points = np.cumsum(np.ones((2, 5, 3)), axis=1) * [0.01, 0.0, 0.0]
    for kind, wrap, sizes in (("linear", "nonperiodic", 5), ("cubic", "pinned", 5), ("cubic", "nonperiodic", 3), ("linear", "periodic", 5)):
        on = make.stage()
        made = make.curves(on, "/hair", points, [5, 5], kind, "bspline", wrap)
        for interpolation, values in (
            ("constant", [0.02]),
            ("uniform", [0.02, 0.04]),
            ("varying", np.linspace(0.02, 0.04, 2 * sizes)),
            ("vertex", np.linspace(0.02, 0.04, 10)),
        ):
            made.CreateWidthsAttr(Vt.FloatArray(list(values)))
            made.SetWidthsInterpolation(interpolation)
            hair = usd.read_hair(on)
            widths = np.split(hair.widths, np.cumsum(hair.point_counts)[:-1])
            assert widths[0][0] == pytest.approx(
                values[0] if not (interpolation == "vertex" and wrap == "nonperiodic" and kind == "cubic") else 0.02 + 0.02 / 9, rel=1e-5
            )
            if interpolation == "uniform":
                assert np.ptp(widths[1]) == 0.0 and widths[1][0] == pytest.approx(0.04)
            if interpolation in ("varying", "vertex") and wrap != "periodic":
                assert (np.diff(widths[0]) > 0.0).all()
            if wrap == "periodic":
                assert widths[0][-1] == widths[0][0]
    on = make.stage()
    made = make.curves(on, "/hair", points, [5, 5], "cubic", "bspline", "nonperiodic")
    make.primvar(made, "widths", make.FLOATS, "vertex", [0.1, 0.2], [0, 1] * 5)
    made.CreateWidthsAttr([9.0])
    assert usd.read_hair(on).widths.max() < 0.21
    # Solaris writes a value for each vertex as varying; it is taken for what it is, and said.
    make.primvar(made, "widths", make.FLOATS, "varying", Vt.FloatArray([0.1] * 10))
    UsdGeom.PrimvarsAPI(made).GetPrimvar("widths").BlockIndices()
    with pytest.warns(usd.UsdWarning, match=r"/hair: primvars:widths has 10 values, which fits interpolation 'vertex', not 'varying'"):
        assert usd.read_hair(on).widths.max() == pytest.approx(0.1)
    make.primvar(made, "widths", make.FLOATS, "vertex", Vt.FloatArray([0.1] * 7))
    with pytest.raises(
        usd.UsdError, match=r"/hair: primvars:widths has 7 values with interpolation 'vertex'; expected 10 \(vertex\), 6 \(varying\), 2 \(uniform\)"
    ):
        usd.read_hair(on)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"curveVertexCounts": [4, 3]}, "curveVertexCounts has 2 curves of 7 vertices, and points has 6"),
        ({"curveVertexCounts": [5, 1]}, r"curveVertexCounts\[1\] is 1; at least 2 expected"),
        ({"curveVertexCounts": [7, -1]}, r"curveVertexCounts\[1\] is -1; at least 2 expected"),
        ({"basis": "bezier", "curveVertexCounts": [6]}, r"curveVertexCounts\[0\] is 6; a nonperiodic bezier curve has 4, 7, 10 and so on"),
        ({"basis": "hermite"}, 'basis is "hermite"; "bezier", "bspline" or "catmullRom" expected'),
        ({"wrap": "segmented"}, 'wrap is "segmented"; "nonperiodic", "pinned" or "periodic" expected'),
        ({"type": "quartic"}, 'type is "quartic"; "linear" or "cubic" expected'),
        ({"points": [(0, 0, 0)] * 5 + [(0, np.nan, 0)]}, r"points\[5\] is \(0.0, nan, 0.0\); finite numbers expected"),
    ],
)
def test_errors_name_the_prim_the_attribute_and_the_value(change, text) -> None:
    on = make.stage()
    make.curves(on, "/root/hair", np.arange(18.0), [6], "cubic")
    for name, value in change.items():
        on.GetPrimAtPath("/root/hair").GetAttribute(name).Set(value)
    with pytest.raises(usd.UsdError, match="^/root/hair: " + text) as caught:
        usd.read_hair(on)
    assert caught.value.path == "/root/hair"


def test_bounds_of_evaluation(tmp_path) -> None:
    on = make.stage()
    make.curves(on, "/hair", np.random.default_rng(1).normal(0, 10, (8, 3)), [8], "cubic")
    with pytest.raises(usd.UsdError, match=r"/hair: the stage has more than 100 points at a tolerance of 5e-05 m"):
        usd.read_hair(on, max_points=100)
    with pytest.raises(usd.UsdError, match=r"/hair: curve 0 bends so far that it needs .* chords a segment, 4096 at most"):
        usd.read_hair(on, tolerance=1e-12)
    for tolerance in (0.0, -1.0, np.nan):
        with pytest.raises(ValueError, match="tolerance"):
            usd.read_hair(on, tolerance=tolerance)
