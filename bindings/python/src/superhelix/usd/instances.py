"""Where prims of a stage are: transforms, native instances, and point instancers, one within another too."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from superhelix.usd._pxr import Sdf, Usd, UsdError, UsdGeom, refuse
from superhelix.usd.curves.bases import Numbers

PURPOSES = ("default", "render", "guide", "proxy")


def as_matrix(matrix: Any) -> Numbers:
    """A 4x4 matrix of USD, which acts on rows."""
    return np.array(matrix, dtype=np.float64)


def transformed(rows: Numbers, linear: Numbers) -> Numbers:
    """Rows times a 3x3 matrix. Products this narrow cost more in threads of a linear algebra library than they save."""
    if np.array_equal(linear, np.eye(3)):
        return np.array(rows)
    out = rows[:, :1] * linear[0]
    out += rows[:, 1:2] * linear[1]
    out += rows[:, 2:] * linear[2]
    return np.asarray(out)


class Placed:
    """A prim and where it is. matrix(code): its placement in the world at a time code; moving: whether that changes over time."""

    def __init__(self, prim: Any, path: str, matrix: Callable[[Any], Numbers], moving: bool, times: set[float]) -> None:
        self.prim, self.path, self.matrix, self.moving, self.times = prim, path, matrix, moving, times


class _Place:
    """A space in which prims are: the world, or a prototype under one of its instances."""

    def __init__(self, walk: Walk, root: Any, matrix: Callable[[Any], Any] | None, label: str, moving: bool, times: set[float]) -> None:
        self.walk, self.root, self.matrix, self.label, self.moving, self.times = walk, root, matrix, label, moving, times

    def of(self, prim: Any, code: Any) -> Any:
        """The placement of a prim in the world, as a Gf.Matrix4d."""
        cache = self.walk.transforms(code)
        if self.matrix is None:
            return cache.GetLocalToWorldTransform(prim)
        return cache.ComputeRelativeTransform(prim, self.root)[0] * self.matrix(code)

    def name(self, prim: Any) -> str:
        """The path of a prim, after that of its instance."""
        return str(prim.GetPath()) if not self.label else f"{self.label}{prim.GetPath()}"

    def placed(self, prim: Any) -> Placed:
        """A prim in this space."""
        times, moving, step = set(self.times), self.moving, prim
        while step and step.GetPath() != Sdf.Path.absoluteRootPath and (self.root is None or step != self.root):
            xform = UsdGeom.Xformable(step)
            if xform:
                times.update(xform.GetTimeSamples())
                moving = moving or xform.TransformMightBeTimeVarying()
            step = step.GetParent()
        return Placed(prim, self.name(prim), lambda code: as_matrix(self.of(prim, code)), moving, times)


class Walk:
    """Finds prims of a stage that would be drawn, at a time code."""

    def __init__(self, stage: Any, code: Any, purposes: Sequence[str] | None, paths: Sequence[str] | None, most: int) -> None:
        self.stage, self.code, self.purposes, self.most = stage, code, purposes, most
        self.paths = None if paths is None else [Sdf.Path(path) for path in paths]
        for path in self.paths or ():
            if not stage.GetPrimAtPath(path):
                raise UsdError(path, "there is no such prim")
        for purpose in purposes or ():
            if purpose not in PURPOSES:
                raise ValueError(f"purposes: {purpose!r}; some of {', '.join(PURPOSES)} expected")
        self._caches: dict[Any, Any] = {}
        self._found = 0

    def transforms(self, code: Any) -> Any:
        """The transforms at a time code."""
        if code not in self._caches:
            self._caches[code] = UsdGeom.XformCache(code)
        return self._caches[code]

    def find(self, kinds: Sequence[Any], chosen: bool = False) -> Iterator[Placed]:
        """Prims of these schemas, in the order of the stage. chosen: the paths given count already for the prim's ancestors."""
        world = _Place(self, None, None, "", False, set())
        predicate = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
        yield from self._under(world, iter(Usd.PrimRange.Stage(self.stage, predicate)), kinds, chosen or self.paths is None)

    def _wanted(self, prim: Any) -> bool:
        return self.paths is None or any(prim.GetPath().HasPrefix(path) for path in self.paths)

    def _drawn(self, prim: Any) -> bool:
        imageable = UsdGeom.Imageable(prim)
        if imageable.ComputeVisibility(self.code) == UsdGeom.Tokens.invisible:
            return False
        return self.purposes is None or str(imageable.ComputePurpose()) in self.purposes

    def _under(self, place: _Place, prims: Any, kinds: Sequence[Any], chosen: bool) -> Iterator[Placed]:
        for prim in prims:
            if prim.IsA(UsdGeom.PointInstancer):
                prims.PruneChildren()
                if self._drawn(prim):
                    yield from self._instances(place, prim, kinds, chosen or self._wanted(prim))
            elif any(prim.IsA(kind) for kind in kinds) and (chosen or self._wanted(prim)) and self._drawn(prim):
                self._found += 1
                if self._found > self.most:
                    refuse(prim, f"the stage has more than {self.most} curve prims and instances of them: raise max_prims, or choose prims")
                yield place.placed(prim)

    def _instances(self, place: _Place, prim: Any, kinds: Sequence[Any], chosen: bool) -> Iterator[Placed]:
        instancer = UsdGeom.PointInstancer(prim)
        prototypes = [self.stage.GetPrimAtPath(path) for path in instancer.GetPrototypesRel().GetForwardedTargets()]
        which = np.asarray(instancer.GetProtoIndicesAttr().Get(self.code) or (), dtype=np.int64)
        wrong = np.flatnonzero((which < 0) | (which >= len(prototypes)))
        if len(wrong):
            refuse(prim, f"protoIndices[{wrong[0]}] is {which[wrong[0]]}; prototypes has {len(prototypes)} targets")
        attributes = (
            instancer.GetPositionsAttr(),
            instancer.GetOrientationsAttr(),
            instancer.GetOrientationsfAttr(),
            instancer.GetScalesAttr(),
            instancer.GetVelocitiesAttr(),
            instancer.GetAngularVelocitiesAttr(),
        )
        times = {time for attribute in attributes for time in attribute.GetTimeSamples()}
        speeds = instancer.GetVelocitiesAttr().HasAuthoredValue() or instancer.GetAngularVelocitiesAttr().HasAuthoredValue()
        moving = speeds or any(attribute.ValueMightBeTimeVarying() for attribute in attributes)
        if len(which) > self.most:
            refuse(prim, f"{len(which)} instances: raise max_prims above {self.most}, or choose prims")
        mask = instancer.ComputeMaskAtTime(self.code)
        arrays: dict[Any, Any] = {}

        def transform(code: Any, index: int) -> Any:
            if code not in arrays:
                made = instancer.ComputeInstanceTransformsAtTime(code, self.code, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask)
                if len(made) != len(which):
                    refuse(prim, f"positions, orientations or scales do not match the {len(which)} instances of protoIndices")
                arrays[code] = made
            return arrays[code][index]

        outer = place.placed(prim)
        predicate = Usd.TraverseInstanceProxies(Usd.PrimIsActive & Usd.PrimIsLoaded & ~Usd.PrimIsAbstract)
        for index, prototype in enumerate(which.tolist()):
            root = prototypes[prototype]
            if not root or (len(mask) and not mask[index]):
                continue

            def matrix(code: Any, index: int = index) -> Any:
                return transform(code, index) * place.of(prim, code)

            inner = _Place(self, root, matrix, f"{place.name(prim)}[{index}]", moving or outer.moving, times | outer.times)
            yield from self._under(inner, iter(Usd.PrimRange(root, predicate)), kinds, chosen)
