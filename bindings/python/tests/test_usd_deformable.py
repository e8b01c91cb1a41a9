"""Curves for other simulators: written and read after the deformable body proposal for UsdPhysics, in its units."""

from __future__ import annotations

import numpy as np
import pytest
import usd_stages as make
from conftest import hanging
from pxr import Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, Vt

import superhelix as shx
from superhelix import usd

E, NU, D, RHO = 3e9, 0.4, 1e-4, 1300.0


def sample(**fields) -> usd.DeformableCurves:
    points = np.cumsum(np.full((2, 5, 3), [0.01, 0.002, 0.0]), axis=1)
    given = {"thickness": D, "density": RHO, "youngs_modulus": E, "poissons_ratio": NU, **fields}
    return usd.DeformableCurves(points.reshape(-1, 3), [5, 5], **given)


@pytest.mark.parametrize("suffix", ["usda", "usdc", "usdz"])
@pytest.mark.parametrize(("up", "metres"), [(shx.UpAxis.Y, 0.01), (shx.UpAxis.Z, 1.0)])
def test_what_is_written_comes_back_in_si_units(suffix, up, metres, tmp_path, rng) -> None:
    normals = rng.normal(0, 1, (10, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    curves = sample(
        normals=normals,
        velocities=rng.normal(0, 1, (10, 3)),
        rest_points=rng.normal(0, 0.1, (10, 3)),
        rest_normals=normals[::-1],
        thickness=np.linspace(1e-4, 2e-4, 8),
        thickness_of="segment",
        masses=[1e-6, 2e-6],
        masses_of="curve",
        stretch_stiffness=20.0,
        shear_stiffness=8.0,
        bend_stiffness=1.5e-8,
        twist_stiffness=1.1e-8,
        attached=np.array([0, 1, 5, 6]),
    )
    path = tmp_path / f"cables.{suffix}"
    head = [0.1, 0.2, 0.3, *shx.frames.from_axis_angle((0, 0, 1), 0.5)]
    usd.write_deformables(path, curves, up_axis=up, metres_per_unit=metres, head=head)
    assert make.validation_errors(path) == []
    (found,) = usd.read_deformables(path)
    for name in ("points", "velocities", "normals", "rest_points", "rest_normals", "thickness", "masses"):
        np.testing.assert_allclose(getattr(found, name), getattr(curves, name), rtol=1e-5, atol=1e-7, err_msg=name)
    for name in ("density", "youngs_modulus", "poissons_ratio", "stretch_stiffness", "shear_stiffness", "bend_stiffness", "twist_stiffness"):
        assert getattr(found, name) == pytest.approx(getattr(curves, name), rel=1e-6), name
    assert (found.thickness_of, found.masses_of, found.closed, found.revision) == ("segment", "curve", False, usd.REVISION)
    assert found.attached.tolist() == [0, 1, 5, 6] and found.attached_to == "/World/head"
    # The numbers in the file are in the stage's units: force/area, force and force area of a centimetre.
    stage = Usd.Stage.Open(str(path))
    material = stage.GetPrimAtPath("/World/materials/strands")
    assert material.GetAttribute("physics:youngsModulus").Get() == pytest.approx(E * metres, rel=1e-6)
    assert material.GetAttribute("physics:curvesStretchStiffness").Get() == pytest.approx(20.0 / metres, rel=1e-6)
    assert material.GetAttribute("physics:curvesBendStiffness").Get() == pytest.approx(1.5e-8 / metres**3, rel=1e-6)
    assert UsdPhysics.MaterialAPI(material).GetDensityAttr().Get() == pytest.approx(RHO * metres**3, rel=1e-6)
    assert UsdPhysics.Scene(stage.GetPrimAtPath("/World/scene")).GetGravityMagnitudeAttr().Get() == pytest.approx(9.81 / metres, rel=1e-6)
    attachment = stage.GetPrimAtPath("/World/strands_roots")
    where = (
        np.asarray(attachment.GetAttribute("physics:coords1").Get())
        @ np.array(UsdGeom.XformCache().GetLocalToWorldTransform(stage.GetPrimAtPath("/World/head")))[:3, :3]
    )
    np.testing.assert_allclose(where + np.array(head[:3]) / metres, curves.points[[0, 1, 5, 6]] / metres, atol=1e-5 / metres)


def test_schemas_and_names_are_those_of_the_proposal(tmp_path) -> None:
    """Names, types, variability and interpolation as in the text of the proposal and in Newton's reader of this revision."""
    usd.write_deformables(tmp_path / "c.usda", sample(rest_points=np.zeros((10, 3)) + np.arange(10)[:, None], attached=np.array([0])))
    stage = Usd.Stage.Open(str(tmp_path / "c.usda"))
    prim = stage.GetPrimAtPath("/World/strands")
    names = prim.GetPrimTypeInfo().GetAppliedAPISchemas()
    assert {"PhysicsDeformableBodyAPI", "PhysicsCurvesDeformableSimAPI", "PhysicsCollisionAPI", "MaterialBindingAPI"} <= set(names)
    curves = UsdGeom.BasisCurves(prim)
    assert curves.GetTypeAttr().Get() == "linear" and curves.GetWrapAttr().Get() == "nonperiodic"
    assert curves.GetNormalsInterpolation() == "vertex" and len(curves.GetNormalsAttr().Get()) == 10
    types = {
        "physics:thicknesses": (Sdf.ValueTypeNames.FloatArray, Sdf.VariabilityVarying),
        "physics:thicknesses:elementType": (Sdf.ValueTypeNames.Token, Sdf.VariabilityUniform),
        "physics:restShapePoints": (Sdf.ValueTypeNames.Point3fArray, Sdf.VariabilityVarying),
    }
    for name, (kind, variability) in types.items():
        attribute = prim.GetAttribute(name)
        assert (attribute.GetTypeName(), attribute.GetVariability(), attribute.IsCustom()) == (kind, variability, False)
    material, relation = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")
    assert relation.GetName() == "material:binding:physics"
    assert {"PhysicsMaterialAPI", "PhysicsCurvesDeformableMaterialAPI"} <= set(material.GetPrim().GetPrimTypeInfo().GetAppliedAPISchemas())
    attachment = stage.GetPrimAtPath("/World/strands_roots")
    assert attachment.GetTypeName() == "PhysicsAttachment"
    assert [attachment.GetAttribute(f"physics:type{k}").Get() for k in (0, 1)] == ["point", "xform"]
    # Normals that were not given follow the segments without twist.
    normals = np.asarray(curves.GetNormalsAttr().Get())
    np.testing.assert_allclose(normals @ [0.01, 0.002, 0.0], 0.0, atol=1e-8)


def test_stiffnesses_are_derived_from_modulus_ratio_and_thickness() -> None:
    bare = sample()
    shear = E / (2 * (1 + NU))
    area, second = np.pi * D**2 / 4, np.pi * D**4 / 64
    found = bare.stiffness()
    np.testing.assert_allclose(
        [found.stretch[0], found.shear[1], found.bend[0], found.twist[1]], [E * area, 0.9 * shear * area, E * second, shear * 2 * second]
    )
    given = sample(bend_stiffness=2e-8, twist_stiffness=1.5e-8)
    (first, _) = given.materials()
    assert first.youngs_modulus * second == pytest.approx(2e-8)
    assert first.youngs_modulus / (2 * (1 + first.poisson_ratio)) * 2 * second == pytest.approx(1.5e-8)
    assert tuple(first.radius) == (D / 2, D / 2)
    heavy = sample(masses=[2e-6, 4e-6], masses_of="curve").materials()
    length = 4 * np.hypot(0.01, 0.002)
    assert [m.density for m in heavy] == pytest.approx([2e-6 / (length * area), 4e-6 / (length * area)])
    with pytest.raises(ValueError, match=r"strands: curve 0 bends with .* a strand with that ratio would have Poisson's ratio 1; above -1, at most 0\.5"):
        sample(bend_stiffness=2e-8, twist_stiffness=1e-8).materials()
    for fields, text in (
        ({"thickness": 0.0}, "thickness: 0.0; above 0 expected"),
        ({"thickness": [1e-4] * 3, "thickness_of": "point"}, "thickness: 3 numbers; 10 expected"),
        ({"thickness_of": "face"}, "thickness_of: 'face'; one of constant, curve, segment, point expected"),
        ({"poissons_ratio": 0.6}, "poissons_ratio: 0.6"),
        ({"bend_stiffness": -1.0}, "bend_stiffness: -1.0; 0 or more expected"),
    ):
        with pytest.raises(ValueError, match=text):
            sample(**fields)


def author(stage, material: dict[str, float], **attributes) -> None:
    prim = make.curves(stage, "/World/cable", np.cumsum(np.full((4, 3), 1.0), axis=0)).GetPrim()
    prim.AddAppliedSchema("PhysicsCurvesDeformableSimAPI")
    bound = UsdShade.Material.Define(stage, "/World/rubber")
    bound.GetPrim().AddAppliedSchema("PhysicsCurvesDeformableMaterialAPI")
    for name, value in material.items():
        bound.GetPrim().CreateAttribute(f"physics:{name}", Sdf.ValueTypeNames.Float).Set(value)
    UsdShade.MaterialBindingAPI.Apply(prim).Bind(bound, UsdShade.Tokens.weakerThanDescendants, "physics")
    for name, value in attributes.items():
        kind = Sdf.ValueTypeNames.Token if isinstance(value, str) else Sdf.ValueTypeNames.FloatArray
        prim.CreateAttribute(f"physics:{name.replace('__', ':')}", kind).Set(value)


def test_earlier_revisions_and_fallbacks_are_read() -> None:
    from superhelix.usd.deformable import READ_REVISIONS

    on = make.stage("Z", 0.01)
    author(on, {})
    (found,) = usd.read_deformables(on)
    assert (found.youngs_modulus, found.poissons_ratio, found.thickness[0], found.density) == (1e6, 0.3, 1e-3, 1000.0)
    assert found.revision == READ_REVISIONS[0] and found.rest_points is None and found.attached is None
    on = make.stage("Z", 0.01)
    author(on, {"curvesThickness": 0.2, "youngsModulus": 1e7, "curvesBendStiffness": float("-inf"), "density": 1e-3})
    (found,) = usd.read_deformables(on)
    assert found.revision == READ_REVISIONS[1]
    assert found.thickness[0] == pytest.approx(2e-3) and found.youngs_modulus == pytest.approx(1e9) and found.bend_stiffness is None
    assert found.density == pytest.approx(1000.0)
    on = make.stage("Z", 0.01)
    author(on, {"thickness": 0.2, "stretchStiffness": 1e7, "bendStiffness": 2e7})
    (found,) = usd.read_deformables(on)
    area, second = np.pi * 2e-3**2 / 4, np.pi * 2e-3**4 / 64
    assert found.revision == READ_REVISIONS[2]
    assert (found.stretch_stiffness, found.shear_stiffness) == (pytest.approx(1e9 * area), pytest.approx(1e9 * area))
    assert (found.bend_stiffness, found.twist_stiffness) == (pytest.approx(2e9 * second), pytest.approx(2e9 * second))


@pytest.mark.parametrize(
    ("material", "attributes", "text"),
    [
        ({}, {"thicknesses": [0.1]}, r"/World/cable: physics:thicknesses:elementType is ''; one of constant, curve, segment, point expected"),
        ({}, {"thicknesses": [0.1] * 4, "thicknesses__elementType": "segment"}, r"physics:thicknesses has 4 values; 3 expected for elementType 'segment'"),
        ({}, {"thicknesses": [0.1, 0, 0.1], "thicknesses__elementType": "segment"}, r"physics:thicknesses\[1\] is 0; above 0 expected"),
        ({}, {"restShapePoints": [0.0] * 9}, "physics:restShapePoints has 3 vectors; one for each of 4 points expected"),
        ({"poissonsRatio": 0.7}, {}, r"/World/rubber: physics:poissonsRatio is 0\.7; -1 to 0\.5 expected"),
        ({"curvesTwistStiffness": -3.0}, {}, r"/World/rubber: physics:curvesTwistStiffness is -3; 0 to"),
    ],
)
def test_bad_files_are_refused_by_name_and_value(material, attributes, text) -> None:
    on = make.stage()
    author(on, material, **attributes)
    with pytest.raises(usd.UsdError, match=text):
        usd.read_deformables(on)


def test_only_linear_curves_and_marked_prims() -> None:
    on = make.stage()
    author(on, {})
    make.curves(on, "/World/hair", np.zeros((4, 3)) + np.arange(4)[:, None])
    assert [found.path for found in usd.read_deformables(on)] == ["/World/cable"]
    on.GetPrimAtPath("/World/cable").GetAttribute("type").Set("cubic")
    with pytest.raises(usd.UsdError, match='/World/cable: type is "cubic"; PhysicsCurvesDeformableSimAPI takes "linear"'):
        usd.read_deformables(on)


def test_strands_of_a_solver_go_out_and_come_back_as_the_same_rods(tmp_path) -> None:
    natural = np.tile([3.0, 15.0, -4.0], (5, 1))
    with shx.Solver() as solver:
        strands = solver.add_strands(hanging(6, natural_curvatures=natural, poisson_ratio=0.4, youngs_modulus=np.geomspace(1e9, 8e9, 6)))
        solver.step(0.1, 4)
        out = usd.deformables_from_solver(solver, points_per_strand=24, levels=3)
        assert sum(len(part) for part in out) == 6 and 2 <= len(out) <= 3
        # Each prim has strands within half a step of the scale.
        assert max(part.stiffness_error for part in out) < 8 ** (1 / 3) - 1
        usd.write_deformables(tmp_path / "rods.usdc", out)
        assert make.validation_errors(tmp_path / "rods.usdc") == []
        back = usd.read_deformables(tmp_path / "rods.usdc")
        assert [len(part) for part in back] == [len(part) for part in out]
        for mine, theirs in zip(out, back):
            own = strands[mine.strands]
            np.testing.assert_allclose(theirs.points.reshape(-1, 24, 3), solver.sample_strands(24, own, dtype=np.float64), atol=1e-7)
            np.testing.assert_allclose(theirs.velocities.reshape(-1, 24, 3), solver.sample_velocities(24, own), atol=1e-6)
            assert theirs.attached.tolist() == [v for k in range(len(mine)) for v in (24 * k, 24 * k + 1)]
            # Frames: normals are across the segments.
            edges = np.diff(theirs.points.reshape(-1, 24, 3), axis=1)
            across = np.sum(edges * theirs.normals.reshape(-1, 24, 3)[:, :-1], axis=2) / np.linalg.norm(edges, axis=2)
            assert np.abs(across).max() < 0.01
            # The rest shape is the natural one: a helix of its curvature.
            fitted = theirs.fit(shx.FitOptions(element_count=5))
            sizes = np.linalg.norm(fitted.curvatures[:, :, 1:], axis=2)
            np.testing.assert_allclose(sizes, np.hypot(15.0, 4.0), rtol=0.02)
            for material in theirs.materials():
                moduli = [solver.material(strand).youngs_modulus for strand in own]
                assert min(moduli) * 0.999 <= material.youngs_modulus <= max(moduli) * 1.001
                assert material.poisson_ratio == pytest.approx(0.4, rel=1e-4)
    with pytest.raises(ValueError, match="levels: 0"):
        usd.deformables_from_solver(solver, levels=0)
    assert Vt is not None
