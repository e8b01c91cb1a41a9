"""Records: defaults from the library, checked fields, equality, copies."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import superhelix as shx
from superhelix import records
from superhelix._record import Record, Table


def test_defaults_are_the_librarys() -> None:
    material = shx.Material()
    assert material.density == 1300.0
    assert material.radius == (50e-6, 50e-6)
    assert shx.SolverDef().gravity == (0.0, 0.0, -9.81)
    assert shx.SolverDef().integrator is shx.Integrator.SECOND_ORDER
    assert shx.FitOptions().twist is True


def test_fields_are_set_by_keyword_and_attribute() -> None:
    material = shx.Material(density=1000.0, radius=(1e-4, 5e-5))
    material.youngs_modulus = 3e9
    assert material.as_dict()["radius"] == (1e-4, 5e-5)
    assert (material.density, material.youngs_modulus) == (1000.0, 3e9)
    frame = shx.Frame(origin=(1.0, 2.0, 3.0), rotation=(0.0, 0.0, 0.0, 1.0))
    constraint = shx.ConstraintDef(strand=shx.StrandId(7), target=frame, kind=shx.ConstraintKind.RING)
    assert constraint.target == frame
    assert constraint.strand == shx.StrandId(7)
    constraint.target.origin = (0.0, 0.0, 9.0)
    assert constraint.target.origin[2] == 9.0


@pytest.mark.parametrize(
    ("make", "error", "text"),
    [
        (lambda: shx.Material(density="heavy"), TypeError, "Material.density: 'heavy'; a number expected"),
        (lambda: shx.Material(radius=(1.0, 2.0, 3.0)), ValueError, "Material.radius: 3 numbers; 2 expected"),
        (lambda: shx.SolverDef(worker_count=-1), ValueError, "SolverDef.worker_count: -1; 0 to 4294967295 expected"),
        (lambda: shx.SolverDef(worker_count=2**32), ValueError, "SolverDef.worker_count: 4294967296; 0 to"),
        (lambda: shx.SolverDef(worker_count=1.5), TypeError, "SolverDef.worker_count: 1.5; a whole number expected"),
        (lambda: shx.SolverDef(integrator=shx.Shape.BOX), TypeError, "SolverDef.integrator: .*Integrator expected"),
        (lambda: shx.FitOptions(twist="yes"), TypeError, "FitOptions.twist: 'yes'; True or False expected"),
        (lambda: shx.ConstraintDef(strand=shx.BodyId(3)), TypeError, "ConstraintDef.strand: BodyId.*StrandId expected"),
        (lambda: shx.ConstraintDef(target=3), TypeError, "ConstraintDef.target: 3; Frame expected"),
        (lambda: shx.Material(weight=3), TypeError, "weight"),
        (lambda: shx.Material().copy(weight=3), TypeError, "Material has no field 'weight'"),
    ],
)
def test_wrong_values_are_named(make, error, text) -> None:
    with pytest.raises(error, match=text):
        make()


def test_unknown_attributes_are_refused() -> None:
    material = shx.Material()
    with pytest.raises(AttributeError):
        material.densty = 3.0  # type: ignore[attr-defined]


def test_records_compare_copy_and_pickle() -> None:
    settings = shx.RenderSettings(points_per_strand=9, frizz=1e-3)
    other = settings.copy(frizz=2e-3)
    assert (settings.frizz, other.frizz, other.points_per_strand) == (1e-3, 2e-3, 9)
    assert settings != other
    assert pickle.loads(pickle.dumps(other)) == other
    assert "frizz=0.001" in repr(settings)


def test_every_record_reads_all_of_its_fields() -> None:
    for name in records.__all__:
        cls = getattr(records, name)
        if issubclass(cls, Record):
            record = cls()
            assert cls.__doc__
            for field, value in record.as_dict().items():
                assert getattr(cls, field).__doc__, (name, field)
                assert value is not None
            assert record == cls()
            assert record.copy() == record
        else:
            assert issubclass(cls, Table)
            table = cls._zeros(3)
            for field in [name for name, item in vars(cls).items() if hasattr(item, "read")]:
                assert len(getattr(table, field)) == 3, (name, field)
            assert len(table[1:]) == 2
            with pytest.raises(TypeError, match="a slice"):
                table[0]


def test_ids_are_strong_and_hashable() -> None:
    strand, body = shx.StrandId(5), shx.BodyId(5)
    assert strand != body
    assert len({strand, body, shx.StrandId(5)}) == 2
    assert strand
    assert not shx.StrandId()
    with pytest.raises(AttributeError):
        strand.bits = 6
    ids = shx.StrandIds([strand, shx.StrandId(6), shx.StrandId(7)])
    assert ids[1] == shx.StrandId(6)
    assert list(ids[1:]) == [shx.StrandId(6), shx.StrandId(7)]
    assert ids[np.array([True, False, True])] == shx.StrandIds([strand, shx.StrandId(7)])
    assert strand in ids
    assert body not in ids
    assert len(ids + ids[:1]) == 4
    with pytest.raises(TypeError, match="is no StrandId"):
        shx.StrandIds([body])
    with pytest.raises(TypeError, match="int64; uint64 expected"):
        shx.StrandIds(np.array([1, 2]))
