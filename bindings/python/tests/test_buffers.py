"""Arrays go in and out without copies, and wrong ones are named."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import hanging

import superhelix as shx


@pytest.fixture
def strands(solver):
    solver.add_strands(hanging(6))
    return solver


def test_points_are_written_in_place_into_strided_views(strands) -> None:
    plain = strands.sample_strands(5, dtype=np.float64)
    vertices = np.full((6, 5, 8), -7.0, dtype=np.float64)
    strands.sample_strands(5, out=vertices[..., 2:5])
    np.testing.assert_array_equal(vertices[..., 2:5], plain)
    assert (vertices[..., :2] == -7.0).all()
    assert (vertices[..., 5:] == -7.0).all()
    packed = np.zeros(30, dtype=[("position", np.float32, 3), ("normal", np.float32, 3), ("uv", np.float16, 2)])
    strands.sample_strands(5, out=packed["position"])
    np.testing.assert_allclose(packed["position"].reshape(6, 5, 3), plain, atol=1e-7)
    assert not packed["normal"].any()


def test_the_fourth_number_is_the_radius(strands) -> None:
    points = np.zeros((6, 5, 4), dtype=np.float32)
    assert strands.sample_strands(5, out=points) is points
    np.testing.assert_allclose(points[..., 3], 50e-6, rtol=1e-6)


def test_frames_and_velocities_come_with_the_points(strands) -> None:
    frames, velocities = np.zeros((6, 5, 7)), np.ones((6, 5, 3), dtype=np.float32)
    points = strands.sample_strands(5, dtype=np.float64, frames=frames, velocities=velocities)
    np.testing.assert_array_equal(frames[..., :3], points)
    np.testing.assert_allclose(np.linalg.norm(frames[..., 3:], axis=-1), 1.0)
    np.testing.assert_array_equal(frames, strands.sample_frames(5))
    x, y, z, w = np.moveaxis(frames[..., 3:], -1, 0)
    tangents = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], axis=-1)
    np.testing.assert_allclose(strands.sample_tangents(5), tangents, atol=1e-12)
    np.testing.assert_allclose(strands.sample_tangents(5, dtype=np.float32), tangents, atol=2e-6)
    along = np.zeros((6, 5, 3))
    strands.sample_strands(5, frames=along)
    np.testing.assert_array_equal(along, strands.sample_tangents(5))
    with pytest.raises(ValueError, match=r"frames: shape \(6, 5, 2\); \(..., 7 or 4 or 3\) expected"):
        strands.sample_strands(5, frames=along[..., :2])
    np.testing.assert_array_equal(velocities, 0.0)
    np.testing.assert_array_equal(strands.sample_velocities(5), 0.0)


def test_origin_is_subtracted_before_numbers_are_narrowed() -> None:
    far = 1e5
    with shx.Solver() as solver:
        root = shx.Frame(origin=(far, 0.0, 0.0))
        solver.add_strands(shx.StrandDefs(1, element_count=2, length=0.1, root=root))
        points = solver.sample_strands(3, origin=(far, 0.0, 0.0))
    np.testing.assert_allclose(points[0, :, 0], [0.0, 0.05, 0.1], atol=1e-8)


@pytest.mark.parametrize(
    ("make", "error", "text"),
    [
        (lambda: np.zeros((6, 5, 3), dtype=np.int32), TypeError, "out: an array of int32; float32 or float64 expected"),
        (lambda: np.zeros((6, 5, 2)), ValueError, r"out: shape \(6, 5, 2\); \(..., 3 or 4\) expected"),
        (lambda: np.zeros((6, 4, 3)), ValueError, "out: room for 24 items; 30 expected"),
        (lambda: np.zeros((3, 5, 6)).T, ValueError, "out: "),
        (lambda: np.zeros((6, 5, 3)).astype(">f8"), TypeError, "out: an array of >f8"),
        (lambda: np.zeros((12, 5, 3))[::2], ValueError, "out: items are not evenly spaced"),
        (lambda: np.zeros((6, 5, 6))[..., ::2], ValueError, "out: the numbers of an item are not contiguous"),
        (lambda: np.zeros((30, 3))[::-1], ValueError, "out: items overlap or run backwards"),
        (lambda: [[0.0] * 3] * 30, TypeError, "out: list; a numpy array expected"),
        (lambda: np.broadcast_to(np.zeros(3), (30, 3)), ValueError, "out: the array is read-only"),
    ],
)
def test_wrong_outputs_are_named(strands, make, error, text) -> None:
    with pytest.raises(error, match=text):
        strands.sample_strands(5, out=make())


def test_inputs_are_read_in_place_or_named(strands) -> None:
    frames = strands.root_frames()
    wide = np.zeros((6, 10))
    wide[:, 1:8] = frames
    wide[:, 1] += 0.25
    strands.teleport_roots(wide[:, 1:8])
    np.testing.assert_allclose(strands.root_frames()[:, 0], frames[:, 0] + 0.25)
    strands.teleport_roots(frames.tolist())
    np.testing.assert_array_equal(strands.root_frames(), frames)
    with pytest.raises(ValueError, match="frames: 5 items; 6 expected"):
        strands.teleport_roots(frames[:5])
    with pytest.raises(TypeError, match="frames: an array of float32; float64 expected"):
        strands.teleport_roots(frames.astype(np.float32))
    with pytest.raises(ValueError, match=r"frames: shape \(6, 6\)"):
        strands.teleport_roots(frames[:, :6])
    with pytest.raises(TypeError, match="frames: not rows of numbers"):
        strands.teleport_roots([["a", "b"]])


def test_quaternions_alone(strands) -> None:
    out = np.zeros((6, 4), dtype=np.float32)
    np.testing.assert_allclose(strands.root_frames(out=out), strands.root_frames()[:, 3:], atol=1e-7)


def test_small_arrays_are_converted_where_that_loses_nothing(solver) -> None:
    ids = solver.add_strands(hanging(1, 3))
    solver.set_natural_curvatures(ids[0], [[0, 1, 2], [0, 0, 0], [3, 0, 0]])
    np.testing.assert_array_equal(solver.natural_curvatures(ids[0]), [[0, 1, 2], [0, 0, 0], [3, 0, 0]])
    solver.set_natural_curvatures(ids[0], np.ones((3, 3), dtype=np.float32)[::-1])
    np.testing.assert_array_equal(solver.natural_curvatures(ids[0]), 1.0)
    with pytest.raises(TypeError, match="curvatures: numbers of float64 expected"):
        solver.set_natural_curvatures(ids[0], [["a"] * 3])
    with pytest.raises(TypeError, match="curvatures: numbers of float64 expected"):
        solver.set_natural_curvatures(ids[0], np.ones((3, 3), dtype=complex))
    with pytest.raises(ValueError, match=r"curvatures: shape \(3, 2\)"):
        solver.set_natural_curvatures(ids[0], np.ones((3, 2)))
