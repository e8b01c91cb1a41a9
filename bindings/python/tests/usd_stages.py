"""Stages for the tests of superhelix.usd."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel, Vt


def stage(up: str = "Z", metres: float = 1.0, codes: float = 24.0) -> Any:
    """A stage in memory."""
    made = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(made, up)
    UsdGeom.SetStageMetersPerUnit(made, metres)
    made.SetTimeCodesPerSecond(codes)
    return made


def curves(on: Any, path: str, points: Any, counts: Any = None, kind: str = "linear", basis: str = "bspline", wrap: str = "nonperiodic") -> Any:
    """A BasisCurves prim."""
    rows = np.asarray(points, dtype=np.float32).reshape(-1, 3)
    made = UsdGeom.BasisCurves.Define(on, path)
    made.CreateTypeAttr(kind)
    made.CreateBasisAttr(basis)
    made.CreateWrapAttr(wrap)
    made.CreateCurveVertexCountsAttr(Vt.IntArray(list(counts) if counts is not None else [len(rows)]))
    made.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(rows))
    return made


def primvar(on: Any, name: str, kind: Any, interpolation: str, values: Any, indices: Any = None) -> None:
    """A primvar of a prim."""
    made = UsdGeom.PrimvarsAPI(on).CreatePrimvar(name, kind, interpolation)
    made.Set(values)
    if indices is not None:
        made.SetIndices(Vt.IntArray(list(indices)))


def skinned_head(on: Any, method: str = "classicLinear") -> tuple[Any, Any, Any]:
    """A SkelRoot with a skeleton of two joints that turn and move, a quad mesh and curves on it, both bound to it: mesh, curves, root."""
    root = UsdSkel.Root.Define(on, "/actor")
    UsdGeom.Xformable(root).AddTranslateOp().Set(Gf.Vec3d(0.3, -0.2, 0.1))
    skeleton = UsdSkel.Skeleton.Define(on, "/actor/rig")
    UsdGeom.Xformable(skeleton).AddRotateZOp().Set(20.0)
    joints = ["hips", "hips/head"]
    skeleton.CreateJointsAttr(joints)
    rest = [Gf.Matrix4d(1), Gf.Matrix4d().SetTranslate(Gf.Vec3d(0, 0, 1))]
    skeleton.CreateRestTransformsAttr(rest)
    skeleton.CreateBindTransformsAttr(rest)
    animation = UsdSkel.Animation.Define(on, "/actor/rig/walk")
    animation.CreateJointsAttr(joints)
    for code, angle in ((0.0, 0.0), (12.0, 40.0), (24.0, -25.0)):
        turn = Gf.Quatf(Gf.Rotation(Gf.Vec3d(0, 1, 0.2), angle).GetQuat())
        animation.CreateTranslationsAttr().Set([Gf.Vec3f(0.01 * code, 0, 0), Gf.Vec3f(0, 0, 1)], code)
        animation.CreateRotationsAttr().Set([turn, turn], code)
        animation.CreateScalesAttr().Set([Gf.Vec3h(1, 1, 1)] * 2, code)
    UsdSkel.BindingAPI.Apply(skeleton.GetPrim()).CreateAnimationSourceRel().SetTargets([animation.GetPath()])
    mesh = UsdGeom.Mesh.Define(on, "/actor/head")
    grid = np.array([[x, y, 1.0 + 0.1 * x * y] for y in (-0.5, 0.0, 0.5) for x in (-0.5, 0.0, 0.5)], dtype=np.float32)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(grid))
    mesh.CreateFaceVertexCountsAttr([4] * 4)
    mesh.CreateFaceVertexIndicesAttr([i for y in range(2) for x in range(2) for i in (3 * y + x, 3 * y + x + 1, 3 * y + x + 4, 3 * y + x + 3)])
    roots = np.array([[-0.2, -0.1, 1.002], [0.3, 0.4, 1.012], [0.1, -0.3, 0.997]])
    along = np.linspace(0.0, 0.4, 6)
    hair = curves(on, "/actor/hair", roots[:, None] + along[None, :, None] * np.array([0.1, 0.0, 1.0]), [6] * 3)
    for prim in (mesh.GetPrim(), hair.GetPrim()):
        binding = UsdSkel.BindingAPI.Apply(prim)
        binding.CreateSkeletonRel().SetTargets([skeleton.GetPath()])
        binding.CreateGeomBindTransformAttr().Set(Gf.Matrix4d().SetTranslate(Gf.Vec3d(0.05, 0, 0)))
        binding.CreateSkinningMethodAttr().Set(method)
        points = np.asarray(UsdGeom.PointBased(prim).GetPointsAttr().Get())
        share = np.clip(0.5 + points[:, 0], 0.0, 1.0)
        weights = np.stack([1.0 - share, share], axis=1).astype(np.float32)
        binding.CreateJointIndicesPrimvar(False, 2).Set(Vt.IntArray([0, 1] * len(points)))
        binding.CreateJointWeightsPrimvar(False, 2).Set(Vt.FloatArray.FromNumpy(weights.reshape(-1)))
    return mesh, hair, root


def validation_errors(path: Path | str) -> list[str]:
    """What all of the library's validators say about a file."""
    try:
        from pxr import UsdValidation
    except ImportError:
        # Releases before 2025 have none for Python.
        assert Usd.GetVersion() < (0, 25, 2)
        return []

    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) >= 25
    errors = UsdValidation.ValidationContext(validators).Validate(Usd.Stage.Open(str(path)))
    return [f"{error.GetName()}: {error.GetMessage()}" for error in errors]


def texture_coordinates(values: Any) -> Any:
    """Pairs of numbers as USD has them."""
    return Vt.Vec2fArray.FromNumpy(np.asarray(values, dtype=np.float32))


FLOATS, INTS, STRINGS = Sdf.ValueTypeNames.FloatArray, Sdf.ValueTypeNames.IntArray, Sdf.ValueTypeNames.StringArray
TEXTURE, TEXTURE3 = Sdf.ValueTypeNames.TexCoord2fArray, Sdf.ValueTypeNames.TexCoord3fArray
