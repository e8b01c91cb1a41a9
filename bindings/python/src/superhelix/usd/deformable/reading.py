"""Reads deformable curves, of the present revision of the proposal and of the two before it."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from superhelix.usd import instances
from superhelix.usd._pxr import Usd, UsdGeom, UsdPhysics, UsdShade, UsdWarning, errors_of, refuse
from superhelix.usd.curves.bases import Numbers
from superhelix.usd.curves.controls import Controls, rows
from superhelix.usd.deformable.model import (
    BODY_API,
    CURVES_API,
    DENSITY,
    MATERIAL_API,
    POISSONS_RATIO,
    READ_REVISIONS,
    STIFFNESSES,
    THICKNESS,
    YOUNGS_MODULUS,
    DeformableCurves,
    authored,
    element_counts,
)
from superhelix.usd.read import HairStage

#: Namespaces of attributes: the proposal's, and that of Omniverse's schema of the same shape.
_NAMESPACES = ("physics", "omniphysics")


def applied(prim: Any, schema: str) -> bool:
    """Whether a schema is applied that this USD need not know, under the proposal's name or Omniverse's."""
    names = {*prim.GetPrimTypeInfo().GetAppliedAPISchemas(), *prim.GetAppliedSchemas()}
    return schema in names or f"Omni{schema}" in names


def _attribute(prim: Any, name: str, code: Any) -> Any:
    for space in _NAMESPACES:
        attribute = prim.GetAttribute(f"{space}:{name}")
        if attribute and attribute.HasAuthoredValue():
            return attribute.Get(code)
    return None


def read_deformables(stage: Any, time: float | None = None, **options: Any) -> list[DeformableCurves]:
    """Reads the curves that are marked for simulation (PhysicsCurvesDeformableSimAPI), in metres, kilograms and the stage's axes.

    time: s; None: the state that is authored without time, as the proposal has it, else the first sample. options: those of HairStage. Where nothing
    is authored, the proposal's values stand: 1 MPa, 0.3, 1 mm, 1000 kg/m^3.
    """
    reader = HairStage(stage, **{**options, "tolerance": None})
    kilograms = float(UsdPhysics.GetStageKilogramsPerUnit(reader.stage))
    default = Usd.TimeCode.Default() if time is None else Usd.TimeCode(time * reader.codes_per_second)
    walk = instances.Walk(reader.stage, default, reader.options.purposes, reader.options.prims, reader.options.max_prims)
    made = []
    with errors_of(reader.name):
        attachments = _attachments(reader.stage)
        for placed in walk.find((UsdGeom.BasisCurves,)):
            if applied(placed.prim, CURVES_API):
                code = default
                if time is None and UsdGeom.PointBased(placed.prim).GetPointsAttr().Get(default) is None:
                    code = Usd.TimeCode.EarliestTime()
                made.append(_curves(reader, placed, code, kilograms, attachments))
    return made


def _curves(reader: HairStage, placed: instances.Placed, code: Any, kilograms: float, attachments: dict[str, tuple[list[int], str]]) -> DeformableCurves:
    prim, metres = placed.prim, reader.metres_per_unit
    curves = UsdGeom.BasisCurves(prim)
    if curves.GetTypeAttr().Get() != UsdGeom.Tokens.linear:
        refuse(prim, f'type is "{curves.GetTypeAttr().Get()}"; {CURVES_API} takes "linear"')
    controls = Controls(prim, code)
    if not len(controls.points):
        refuse(prim, "has no points")
    wrap = curves.GetWrapAttr().Get()
    closed = wrap == UsdGeom.Tokens.periodic
    counts = element_counts(controls.counts, closed)
    matrix = placed.matrix(code)
    place = reader.placing(placed.matrix, None)
    linear = matrix[:3, :3] @ reader._turn
    scale = abs(float(np.linalg.det(matrix[:3, :3]))) ** (1.0 / 3.0) * metres
    points = place(controls.points, code)

    def vectors(name: str, values: Any) -> Numbers | None:
        found = rows(values, 3)
        if found is None or not len(found):
            return None
        if len(found) != len(points):
            refuse(prim, f"{name} has {len(found)} vectors; one for each of {len(points)} points expected")
        return found

    def turned(name: str, values: Any) -> Numbers | None:
        found = vectors(name, values)
        if found is None:
            return None
        moved = found @ linear
        size = np.linalg.norm(moved, axis=1, keepdims=True)
        if not (size > 0.0).all():
            refuse(prim, f"{name}[{int(np.argmin(size))}] has no length")
        return np.asarray(moved / size)

    rest = vectors("physics:restShapePoints", _attribute(prim, "restShapePoints", code))
    speeds = controls.velocities
    material, revision = _material(prim, code, metres, kilograms)
    thickness, thickness_of = _elements(prim, "thicknesses", code, counts, None)
    if thickness is not None:
        thickness, revision = thickness * scale, READ_REVISIONS[0]
    else:
        own = material.pop("thickness", None)
        thickness, thickness_of = np.array([THICKNESS if own is None else own]), "constant"
    material.pop("thickness", None)
    masses, masses_of = _elements(prim, "masses", code, counts, "point")
    moduli = material.pop("moduli", None)
    body = _body(prim)
    density = authored(_attribute(body, "density", code)) if body else None
    if density:
        material["density"] = density * kilograms / metres**3
    total = authored(_attribute(body, "mass", code)) if body else None
    if masses is None and total:
        masses, masses_of = np.array([total]), "constant"
    found = attachments.get(str(prim.GetPath()))
    made = DeformableCurves(
        points,
        controls.counts.astype(np.uint32),
        turned("normals", curves.GetNormalsAttr().Get(code)),
        None if speeds is None else place(controls.points + speeds, code) - points,
        None if rest is None else place(rest, code),
        turned("physics:restNormals", _attribute(prim, "restNormals", code)),
        thickness,
        thickness_of,
        None if masses is None else masses * kilograms,
        masses_of,
        closed=closed,
        name=prim.GetName(),
        path=placed.path,
        revision=revision,
        attached=None if found is None else np.array(found[0], dtype=np.int64),
        attached_to=None if found is None else found[1],
        **material,
    )
    if moduli is not None:
        _apply_moduli(made, moduli)
    return made


def _elements(prim: Any, name: str, code: Any, counts: dict[str, int], otherwise: str | None) -> tuple[Numbers | None, str]:
    """Values for elements of a kind, checked."""
    values = _attribute(prim, name, code)
    if values is None or not len(values):
        return None, otherwise or "constant"
    kind = _attribute(prim, f"{name}:elementType", code) or otherwise
    if kind is None or kind not in counts:
        refuse(prim, f"physics:{name}:elementType is {kind or ''!r}; one of {', '.join(counts)} expected")
    array = np.asarray(values, dtype=np.float64)
    if len(array) != counts[kind]:
        refuse(prim, f"physics:{name} has {len(array)} values; {counts[kind]} expected for elementType {kind!r}")
    bad = np.flatnonzero(~(np.isfinite(array) & (array > 0.0)))
    if len(bad):
        refuse(prim, f"physics:{name}[{bad[0]}] is {array[bad[0]]:g}; above 0 expected")
    return array, str(kind)


def _material(prim: Any, code: Any, metres: float, kilograms: float) -> tuple[dict[str, Any], str]:
    """Fields of DeformableCurves from the bound material, in SI units, and the revision whose attributes it has."""
    made: dict[str, Any] = {"density": DENSITY, "youngs_modulus": YOUNGS_MODULUS, "poissons_ratio": POISSONS_RATIO}
    bound = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")[0]
    if not bound:
        return made, READ_REVISIONS[0]
    found = bound.GetPrim()

    def number(name: str, low: float, high: float, unit: float) -> float | None:
        value = authored(_attribute(found, name, code))
        if value is not None and not low <= value <= high:
            refuse(found, f"physics:{name} is {value:g}; {low:g} to {high:g} expected")
        return None if value is None else value * unit

    largest = float(np.finfo(np.float32).max)
    density = number("density", 0.0, largest, kilograms / metres**3)
    if density:
        made["density"] = density
    if not applied(found, MATERIAL_API):
        warnings.warn(f"{found.GetPath()}: has no {MATERIAL_API}, so only its density counts", UsdWarning, stacklevel=3)
        return made, READ_REVISIONS[0]
    pressure = kilograms / metres
    modulus, ratio = number("youngsModulus", 0.0, largest, pressure), number("poissonsRatio", -1.0, 0.5, 1.0)
    if modulus is not None:
        made["youngs_modulus"] = modulus
    if ratio is not None:
        made["poissons_ratio"] = ratio
    new = False
    for mode, power in STIFFNESSES.items():
        value = number(f"curves{mode.capitalize()}Stiffness", 0.0, largest, kilograms * metres**power)
        if value is not None:
            made[f"{mode}_stiffness"], new = value, True
    thickness = number("curvesThickness", 0.0, largest, metres)
    if thickness is not None:
        made["thickness"] = thickness
        return made, READ_REVISIONS[1]
    old = {mode: number(f"{mode}Stiffness", 0.0, largest, pressure) for mode in STIFFNESSES}
    older = number("thickness", 0.0, largest, metres)
    if not new and modulus is None and (older is not None or any(value is not None for value in old.values())):
        made["thickness"], made["moduli"] = older, old
        return made, READ_REVISIONS[2]
    return made, READ_REVISIONS[0]


def _apply_moduli(made: DeformableCurves, moduli: dict[str, float | None]) -> None:
    """The first revision had moduli, force/area: each times its factor of the section. Shear stands in by stretch, and twist by bend, as in Newton."""
    diameter = float(made.thickness[0])
    area, bend, twist = np.pi * diameter**2 / 4.0, np.pi * diameter**4 / 64.0, np.pi * diameter**4 / 32.0
    factors = {"stretch": area, "shear": area, "bend": bend, "twist": twist}
    for mode, value in moduli.items():
        if value is not None:
            setattr(made, f"{mode}_stiffness", value * factors[mode])
    if made.shear_stiffness is None:
        made.shear_stiffness = made.stretch_stiffness
    if made.twist_stiffness is None:
        made.twist_stiffness = made.bend_stiffness


def _body(prim: Any) -> Any:
    """The prim itself or its parent, whichever is the deformable body."""
    for found in (prim, prim.GetParent()):
        if found and applied(found, BODY_API):
            return found
    return None


def _attachments(stage: Any) -> dict[str, tuple[list[int], str]]:
    """Points of curves that are attached to a frame, hard."""
    made: dict[str, tuple[list[int], str]] = {}
    for prim in stage.Traverse():
        if prim.GetTypeName() not in ("PhysicsAttachment", "OmniPhysicsAttachment"):
            continue
        kinds = (_attribute(prim, "type0", Usd.TimeCode.Default()), _attribute(prim, "type1", Usd.TimeCode.Default()))
        enabled = _attribute(prim, "attachmentEnabled", Usd.TimeCode.Default())
        if enabled is False:
            continue
        sources = []
        for name in ("src0", "src1"):
            relations = (prim.GetRelationship(f"{space}:{name}") for space in _NAMESPACES)
            sources.append([target for relation in relations if relation for target in relation.GetTargets()])
        if kinds != ("point", "xform") or len(sources[0]) != 1 or len(sources[1]) != 1:
            warnings.warn(f"{prim.GetPath()}: attaches {kinds[0]} to {kinds[1]}; only points attached to a frame are read", UsdWarning, stacklevel=3)
            continue
        indices = [int(index) for index in _attribute(prim, "indices0", Usd.TimeCode.Default()) or ()]
        made[str(sources[0][0])] = (indices, str(sources[1][0]))
    return made
