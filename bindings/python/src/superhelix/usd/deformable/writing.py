"""Writes deformable curves."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix._part_files import PartFile
from superhelix.enums import UpAxis
from superhelix.usd._pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, UsdUtils, Vt, reload_layers
from superhelix.usd.deformable.model import BODY_API, CURVES_API, MATERIAL_API, REVISION, STIFFNESSES, DeformableCurves
from superhelix.usd.layout import extent, floats, prim_name, vectors


def write_deformables(
    path: str | os.PathLike[str],
    curves: DeformableCurves | Sequence[DeformableCurves],
    *,
    up_axis: UpAxis = UpAxis.Z,
    metres_per_unit: float = 1.0,
    gravity: npt.ArrayLike | None = None,
    collide: bool = True,
    head: npt.ArrayLike | None = None,
    prim: str = "/World",
) -> None:
    """Writes curves with their material, rest shape and thickness, each DeformableCurves a prim below prim. Points are in m, in the axes of up_axis.

    gravity: m/s^2 (None: 9.81 downwards). collide: whether other simulators let the curves collide. head: the frame (seven numbers) of the
    Xform to which attached points are attached (None: at the origin); points without attached float freely there.
    """
    target = Path(path)
    if target.suffix not in (".usd", ".usda", ".usdc", ".usdz"):
        raise ValueError(f"path: {target.name} ends in {target.suffix or 'nothing'!r}; one of .usd, .usda, .usdc, .usdz expected")
    if not 0.0 < metres_per_unit < np.inf:
        raise ValueError(f"metres_per_unit: {metres_per_unit}; above 0 expected")
    if up_axis not in (UpAxis.Y, UpAxis.Z):
        raise ValueError(f"up_axis: {up_axis!r}; UpAxis.Y or UpAxis.Z expected")
    bodies = [curves] if isinstance(curves, DeformableCurves) else list(curves)
    if not bodies:
        raise ValueError("curves: none; at least one DeformableCurves expected")
    part = PartFile(target, ".usda" if target.suffix == ".usda" else ".usdc")
    packed = None
    try:
        layer = Sdf.Layer.CreateNew(str(part.path))
        stage = Usd.Stage.Open(layer)
        UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y if up_axis == UpAxis.Y else UsdGeom.Tokens.z)
        UsdGeom.SetStageMetersPerUnit(stage, metres_per_unit)
        UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
        stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, prim).GetPrim())
        layer.customLayerData = {"superhelix:deformableProposal": REVISION}
        _put_scene(stage, f"{prim}/scene", up_axis, metres_per_unit, gravity)
        UsdGeom.Scope.Define(stage, f"{prim}/materials")
        names: set[str] = set()
        attached = any(body.attached is not None for body in bodies)
        if attached:
            _put_head(stage, f"{prim}/head", head, metres_per_unit)
        for body in bodies:
            name = base = str(prim_name(body.name))
            number = 1
            while name in names or name in ("scene", "materials", "head"):
                number += 1
                name = f"{base}_{number}"
            names.add(name)
            made = _put_curves(stage, f"{prim}/{name}", body, metres_per_unit, collide)
            _bind(made, _put_material(stage, f"{prim}/materials/{name}", body, metres_per_unit))
            if body.attached is not None:
                _put_attachment(stage, f"{prim}/{name}_roots", made, f"{prim}/head", body, metres_per_unit)
        layer.Save()
        del stage
        if target.suffix == ".usdz":
            packed = PartFile(target, ".usdz")
            if not UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(part.path)), str(packed.path), f"{target.stem}.usdc"):
                raise OSError(f"{target}: cannot be written")
            packed.place()
            part.drop()
        else:
            part.place()
        reload_layers([target])
    except BaseException:
        part.drop()
        if packed is not None:
            packed.drop()
        raise


def _put_scene(stage: Any, path: str, up_axis: UpAxis, metres: float, gravity: npt.ArrayLike | None) -> None:
    down = np.array([0.0, -9.81, 0.0] if up_axis == UpAxis.Y else [0.0, 0.0, -9.81]) if gravity is None else np.asarray(gravity, dtype=np.float64)
    if down.shape != (3,) or not np.isfinite(down).all():
        raise ValueError(f"gravity: {gravity!r}; three finite numbers expected")
    size = float(np.linalg.norm(down))
    scene = UsdPhysics.Scene.Define(stage, path)
    scene.CreateGravityMagnitudeAttr(size / metres)
    if size > 0.0:
        scene.CreateGravityDirectionAttr(Gf.Vec3f(*(down / size).tolist()))


def _put_head(stage: Any, path: str, frame: npt.ArrayLike | None, metres: float) -> None:
    head = UsdGeom.Xform.Define(stage, path)
    if frame is not None:
        row = np.asarray(frame, dtype=np.float64)
        if row.shape != (7,) or not np.isfinite(row).all():
            raise ValueError(f"head: {frame!r}; seven finite numbers expected: origin, m, and quaternion x, y, z, w")
        head.AddTranslateOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*(row[:3] / metres).tolist()))
        head.AddOrientOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Quatd(row[6], *row[3:6].tolist()))


def _put_curves(stage: Any, path: str, body: DeformableCurves, metres: float, collide: bool) -> Any:
    curves = UsdGeom.BasisCurves.Define(stage, path)
    prim = curves.GetPrim()
    for schema in (BODY_API, CURVES_API):
        prim.AddAppliedSchema(schema)
    if collide:
        UsdPhysics.CollisionAPI.Apply(prim)
    curves.CreateTypeAttr(UsdGeom.Tokens.linear)
    curves.CreateWrapAttr(UsdGeom.Tokens.periodic if body.closed else UsdGeom.Tokens.nonperiodic)
    curves.CreateCurveVertexCountsAttr(Vt.IntArray.FromNumpy(body.point_counts.astype(np.int32)))
    curves.CreatePointsAttr(vectors(body.points / metres))
    widths = body.thickness_of_curves() / metres
    curves.CreateWidthsAttr(floats(widths))
    curves.SetWidthsInterpolation(UsdGeom.Tokens.uniform)
    curves.CreateExtentAttr(extent((body.points / metres).astype(np.float32), widths))
    if body.velocities is not None:
        curves.CreateVelocitiesAttr(vectors(body.velocities / metres))
    normals = body.normals if body.normals is not None else _any_normals(body)
    curves.CreateNormalsAttr(vectors(normals))
    curves.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
    kinds = Sdf.ValueTypeNames
    _set(prim, "physics:thicknesses", kinds.FloatArray, floats(body.thickness / metres))
    _set(prim, "physics:thicknesses:elementType", kinds.Token, body.thickness_of, Sdf.VariabilityUniform)
    if body.rest_points is not None:
        _set(prim, "physics:restShapePoints", kinds.Point3fArray, vectors(body.rest_points / metres))
    if body.rest_normals is not None:
        _set(prim, "physics:restNormals", kinds.Normal3fArray, vectors(body.rest_normals))
    if body.masses is not None:
        _set(prim, "physics:masses", kinds.FloatArray, floats(body.masses))
        _set(prim, "physics:masses:elementType", kinds.Token, body.masses_of, Sdf.VariabilityUniform)
    return curves


def _set(prim: Any, name: str, kind: Any, value: Any, variability: Any = None) -> None:
    attribute = prim.CreateAttribute(name, kind, False, *([] if variability is None else [variability]))
    attribute.Set(value)


def _any_normals(body: DeformableCurves) -> npt.NDArray[np.float64]:
    """Normals carried from segment to segment without twist, for curves that have none."""
    out = np.zeros_like(body.points)
    start = 0
    for count in body.point_counts.tolist():
        edges = np.diff(body.points[start : start + count], axis=0)
        sizes = np.linalg.norm(edges, axis=1, keepdims=True)
        tangents = edges / np.where(sizes > 0.0, sizes, 1.0)
        normal = np.eye(3)[np.argmin(np.abs(tangents[0]))]
        for place in range(count):
            tangent = tangents[min(place, count - 2)]
            normal = normal - tangent * (normal @ tangent)
            normal = normal / np.linalg.norm(normal) if np.linalg.norm(normal) > 1e-9 else np.eye(3)[np.argmin(np.abs(tangent))]
            out[start + place] = normal
        start += count
    return out


def _put_material(stage: Any, path: str, body: DeformableCurves, metres: float) -> Any:
    material = UsdShade.Material.Define(stage, path)
    prim = material.GetPrim()
    UsdPhysics.MaterialAPI.Apply(prim).CreateDensityAttr(body.density * metres**3)
    prim.AddAppliedSchema(MATERIAL_API)
    _set(prim, "physics:youngsModulus", Sdf.ValueTypeNames.Float, body.youngs_modulus * metres)
    _set(prim, "physics:poissonsRatio", Sdf.ValueTypeNames.Float, body.poissons_ratio)
    for mode, power in STIFFNESSES.items():
        value = getattr(body, f"{mode}_stiffness")
        if value is not None:
            _set(prim, f"physics:curves{mode.capitalize()}Stiffness", Sdf.ValueTypeNames.Float, value / metres**power)
    return material


def _bind(curves: Any, material: Any) -> None:
    UsdShade.MaterialBindingAPI.Apply(curves.GetPrim()).Bind(material, UsdShade.Tokens.weakerThanDescendants, "physics")


def _put_attachment(stage: Any, path: str, curves: Any, head: str, body: DeformableCurves, metres: float) -> None:
    assert body.attached is not None
    prim = stage.DefinePrim(path, "PhysicsAttachment")
    kinds = Sdf.ValueTypeNames
    prim.CreateRelationship("physics:src0", False).SetTargets([curves.GetPath()])
    prim.CreateRelationship("physics:src1", False).SetTargets([head])
    _set(prim, "physics:type0", kinds.Token, "point", Sdf.VariabilityUniform)
    _set(prim, "physics:type1", kinds.Token, "xform", Sdf.VariabilityUniform)
    _set(prim, "physics:indices0", kinds.IntArray, Vt.IntArray.FromNumpy(body.attached.astype(np.int32)))
    inverse = UsdGeom.XformCache().GetLocalToWorldTransform(stage.GetPrimAtPath(head)).GetInverse()
    matrix = np.array(inverse)
    _set(prim, "physics:coords1", kinds.Vector3fArray, vectors(body.points[body.attached] / metres @ matrix[:3, :3] + matrix[3, :3]))
