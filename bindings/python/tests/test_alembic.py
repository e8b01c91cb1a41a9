"""Alembic: what is written comes back, files of Blender are read with their transforms, damaged files are refused."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest
from conftest import GROOMS

import superhelix as shx
from superhelix import alembic
from superhelix.alembic import AlembicError, AlembicFile, HairWriter, read_hair, write_hair

DATA = Path(__file__).resolve().parent / "data"
COUNTS = np.array([3, 5, 2, 9])
TOTAL = int(COUNTS.sum())


def frames(count: int = 4) -> np.ndarray:
    """Points of some frames, single precision."""
    return np.random.default_rng(3).normal(size=(count, TOTAL, 3)).astype(np.float32)


def test_frames_come_back(tmp_path: Path) -> None:
    """To the bit, with velocities and widths that change; the file appears when it is complete, and the same input gives the same bytes."""
    rows, path = frames(), tmp_path / "hair.abc"
    for path in (tmp_path / "hair.abc", tmp_path / "again.abc"):
        with HairWriter(path, COUNTS, up_axis=shx.UpAxis.Y, widths=1e-4) as writer:
            for number in range(4):
                writer.write((number + 3) / 30, rows[number], -rows[number], np.full(TOTAL, (number + 1) / 1024))
                assert not path.exists()
    assert sorted(os.listdir(tmp_path)) == ["again.abc", "hair.abc"]
    assert (tmp_path / "hair.abc").read_bytes() == path.read_bytes()
    with AlembicFile(path) as file:
        np.testing.assert_allclose(file.times, np.arange(3, 7) / 30)
        for number in range(4):
            read = file.read((number + 3) / 30)
            assert np.array_equal(read.points, rows[number]) and np.array_equal(read.velocities, -rows[number])
            assert np.array_equal(read.widths, np.full(TOTAL, (number + 1) / 1024)) and np.array_equal(read.point_counts, COUNTS)
            assert read.objects == ["/hair/hairShape"] and read.object_of.tolist() == [0] * 4
        # Before the first frame, between two, after the last.
        for time, number in ((-1.0, 0), (3.9 / 30, 0), (4.1 / 30, 1), (9.0, 3)):
            assert np.array_equal(file.read(time).points, rows[number])
    assert np.array_equal(read_hair(path).points, rows[0])


@pytest.mark.parametrize("times", [[0.0, 0.1, 0.3, 0.35], [2.0, 3.0, 4.0, 5.0], [-0.5, 0.0, 0.5, 1.0]])
def test_times(tmp_path: Path, times: list[float]) -> None:
    rows = frames()
    with HairWriter(tmp_path / "hair.abc", COUNTS) as writer:
        for time, points in zip(times, rows, strict=True):
            writer.write(time, points)
    with AlembicFile(tmp_path / "hair.abc") as file:
        np.testing.assert_allclose(file.times, times)
        for time, points in zip(times, rows, strict=True):
            read = file.read(time, up_axis=shx.UpAxis.Z)
            assert np.array_equal(read.points, points) and read.velocities is None and read.widths is None


@pytest.mark.parametrize("order", ["AAAA", "AABBC", "ABAB", "AAB", "ABB", "ABBBCCA"])
def test_frames_that_repeat(tmp_path: Path, order: str) -> None:
    """Samples that repeat are stored once where Alembic does so, and every frame is still the right one."""
    rows = frames()
    with HairWriter(tmp_path / "hair.abc", COUNTS, widths=[1, 2, 3, 4]) as writer:
        for number, letter in enumerate(order):
            writer.write(number / 24, rows["ABC".index(letter)])
    with AlembicFile(tmp_path / "hair.abc") as file:
        for number, letter in enumerate(order):
            read = file.read(number / 24, up_axis=shx.UpAxis.Z)
            assert np.array_equal(read.points, rows["ABC".index(letter)])
            assert np.array_equal(read.widths, np.repeat([1.0, 2.0, 3.0, 4.0], COUNTS))
    if order == "AAAA":
        many = tmp_path / "many.abc"
        with HairWriter(many, COUNTS, widths=[1, 2, 3, 4]) as writer:
            for number in range(1000):
                writer.write(number / 24, rows[0])
        # No bytes for a thousand times the same.
        assert many.stat().st_size < (tmp_path / "hair.abc").stat().st_size + 64


def test_units_axes_and_one_moment(tmp_path: Path) -> None:
    """A file in centimetres with y up, of points in metres with z up."""
    write_hair(tmp_path / "cm.abc", [[[0.0, 0.0, 0.01], [0.02, 0.03, 0.05]]], velocities=[[[0, 0, 1], [0, 1, 0]]], metres_per_unit=0.01, widths=0.001)
    raw = read_hair(tmp_path / "cm.abc")
    np.testing.assert_allclose(raw.points, [[0, 1, 0], [2, 5, -3]], atol=1e-6)
    np.testing.assert_allclose(raw.velocities, [[0, 100, 0], [0, 0, -100]], atol=1e-5)
    read = read_hair(tmp_path / "cm.abc", metres_per_unit=0.01, up_axis=shx.UpAxis.Z)
    np.testing.assert_allclose(read.points, [[0, 0, 0.01], [0.02, 0.03, 0.05]], atol=1e-9)
    np.testing.assert_allclose(read.velocities, [[0, 0, 1], [0, 1, 0]], atol=1e-7)
    np.testing.assert_allclose(read.widths, [0.001, 0.001], rtol=1e-6)
    assert len(read.groom()) == 1 and read.groom().up_axis == shx.UpAxis.Z


def test_a_file_of_blender(tmp_path: Path) -> None:
    """Written by Blender 5.0: curves below two empties that move, turn and scale. The points are those that Blender had in the world."""
    expected = json.loads((DATA / "blender_5_0.json").read_text())
    with AlembicFile(DATA / "blender_5_0.abc") as file:
        np.testing.assert_allclose(file.times, np.arange(1, 5) / 24)
        for number, points in enumerate(expected):
            read = file.read((number + 1) / 24, up_axis=shx.UpAxis.Z)
            np.testing.assert_allclose(read.points, points, atol=2e-6)
            np.testing.assert_allclose(read.widths, 4 * np.linspace(0.001, 0.002, 7), rtol=1e-6)
            assert read.point_counts.tolist() == [3, 4] and read.objects == ["/outer/inner/fur/fur"]


def test_groom_and_cache(tmp_path: Path) -> None:
    """A groom from Alembic is simulated as that from the file that it was made of, into a cache in Alembic."""
    drawn = shx.Groom.read(GROOMS / "sintel_hair_001.tfx", scale=0.01, every=24)
    write_hair(tmp_path / "groom.abc", drawn.points, drawn.point_counts, up_axis=drawn.up_axis, metres_per_unit=0.01)
    groom = shx.Groom.read(tmp_path / "groom.abc", scale=0.01)
    np.testing.assert_allclose(groom.points, drawn.points, atol=1e-7)
    assert groom.up_axis == shx.UpAxis.Y and len(shx.Groom.read(tmp_path / "groom.abc", scale=0.01, every=2)) == 5
    with pytest.raises(ValueError, match="does not state its unit"):
        shx.Groom.read(tmp_path / "groom.abc")
    done = shx.simulate(groom, lambda time: [0.1 * time, 0, 0, 0, 0, 0, 1], duration=0.1, fps=30, cache=tmp_path / "sim.abc")
    with AlembicFile(tmp_path / "sim.abc") as file:
        np.testing.assert_allclose(file.times, done.times)
        for number, time in enumerate(done.times):
            read = file.read(time, metres_per_unit=0.01)
            np.testing.assert_allclose(read.points, done.points[number].reshape(-1, 3), atol=1e-7)
        # The head goes at 0.1 m/s.
        np.testing.assert_allclose(read.velocities[::33], [[0.1, 0, 0]] * len(groom), atol=1e-3)
        assert (read.widths > 0.0).all()


def test_what_cannot_be_written(tmp_path: Path) -> None:
    """Errors name the argument and leave nothing behind."""
    points = frames()[0]
    for options, text in (
        ({"point_counts": []}, "point_counts: no strands"),
        ({"point_counts": [3, 1]}, r"point_counts\[1\]: 1; at least 2"),
        ({"up_axis": 0}, "up_axis: 0"),
        ({"metres_per_unit": 0.0}, "metres_per_unit: 0"),
        ({"widths": [1.0, 2.0]}, "widths: 2 numbers; 1, 4 .strands. or 19"),
        ({"widths": -1.0}, r"widths\[0\]: -1.0"),
        ({"name": "a/b"}, "name: 'a/b'"),
    ):
        with pytest.raises(ValueError, match=text):
            HairWriter(tmp_path / "hair.abc", **{"point_counts": COUNTS, **options})
    with pytest.raises(ValueError, match=r"\.abc expected"):
        HairWriter(tmp_path / "hair.usda", COUNTS)
    with pytest.raises(FileNotFoundError, match="no folder"):
        HairWriter(tmp_path / "none" / "hair.abc", COUNTS)
    writer = HairWriter(tmp_path / "hair.abc", COUNTS)
    writer.write(0.0, points, points)
    for arguments, text in (
        ((0.0, points, points), "time: 0.0 after 0.0 s"),
        ((None, points, points), "time: None after"),
        ((np.inf, points, points), "time: inf"),
        ((1.0, points), "velocities: none, and the first frame has some"),
        ((1.0, points[1:], points), "points: shape"),
        ((1.0, points * np.nan, points), "points: some are not finite"),
        ((1.0, points, points[:, :2]), "velocities: shape"),
        ((1.0, points, points, 1e-4), "widths: the first frame has none"),
    ):
        with pytest.raises(ValueError, match=text):
            writer.write(*arguments)
    writer.write(1.0, points, points)
    writer.close()
    with pytest.raises(ValueError, match="closed"):
        writer.write(2.0, points, points)
    assert len(alembic.AlembicFile(tmp_path / "hair.abc").times) == 2
    (tmp_path / "hair.abc").unlink()
    with pytest.raises(ValueError, match="no frame was written"):
        HairWriter(tmp_path / "hair.abc", COUNTS).close()
    with pytest.raises(RuntimeError), HairWriter(tmp_path / "hair.abc", COUNTS) as writer:
        writer.write(0.0, points)
        raise RuntimeError
    assert os.listdir(tmp_path) == []


def test_what_cannot_be_read(tmp_path: Path) -> None:
    path = tmp_path / "hair.abc"
    write_hair(path, frames()[0], COUNTS)
    good = path.read_bytes()
    for content, text in ((b"", "no Alembic file"), (b"#usda 1.0 and more than 16", "no Alembic file"), (b"\x89HDF\r\n\x1a\n" + bytes(20), "HDF5")):
        path.write_bytes(content)
        with pytest.raises(AlembicError, match=text):
            read_hair(path)
    path.write_bytes(good[:5] + b"\0" + good[6:])
    with pytest.raises(AlembicError, match="not written to its end"):
        read_hair(path)
    path.write_bytes(good.replace(b"AbcGeom_Curve_v2", b"AbcGeom_Other_v2"))
    with pytest.raises(AlembicError, match="no curves"):
        read_hair(path)
    path.write_bytes(good)
    for options in ({"metres_per_unit": -1.0}, {"up_axis": 0}, {"time": np.nan}):
        with pytest.raises(ValueError, match=next(iter(options))):
            read_hair(path, **options)
    with pytest.raises(FileNotFoundError):
        read_hair(tmp_path / "none.abc")


@pytest.mark.parametrize("source", ["own", "blender"])
def test_damaged_files_are_refused_or_read(tmp_path: Path, source: str) -> None:
    """Files cut short anywhere, or with a byte changed: what comes is an AlembicError, or curves of finite points."""
    path, random = tmp_path / "hair.abc", np.random.default_rng(11)
    if source == "own":
        with HairWriter(path, COUNTS, widths=1e-4) as writer:
            for number, rows in enumerate(frames()):
                writer.write(number / 24, rows, rows)
        good = path.read_bytes()
    else:
        good = (DATA / "blender_5_0.abc").read_bytes()
    refused = 0
    for case in range(3000):
        bad = bytearray(good)
        if case % 3 == 0:
            del bad[random.integers(len(good)) :]
        else:
            for place in random.integers(len(good), size=case % 3):
                bad[place] = random.integers(256)
        path.write_bytes(bytes(bad))
        try:
            with AlembicFile(path) as file:
                for time in file.times[:5]:
                    assert np.isfinite(file.read(time).points).all()
        except AlembicError as error:
            assert str(path) in str(error)
            refused += 1
    assert 1000 < refused < 3000
