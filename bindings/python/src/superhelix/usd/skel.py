"""Points that a skeleton moves (UsdSkel): blend shapes, then linear blend or dual quaternion skinning."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from superhelix.usd._pxr import Usd, UsdGeom, UsdSkel, UsdWarning, Vt, refuse
from superhelix.usd.curves.bases import Numbers
from superhelix.usd.curves.controls import rows
from superhelix.usd.instances import as_matrix


class Skinned:
    """A prim that a skeleton moves."""

    def __init__(self, prim: Any, skeleton: Any, query: Any) -> None:
        self.prim, self._skeleton, self._query = prim, skeleton, query
        self._animation = skeleton.GetAnimQuery()
        self.times: set[float] = set()
        if self._animation:
            self.times.update(self._animation.GetJointTransformTimeSamples())
            if query.HasBlendShapes():
                self.times.update(self._animation.GetBlendShapeWeightTimeSamples())

    @property
    def moving(self) -> bool:
        """Whether the points move over time within the prim's space."""
        return len(self.times) > 1

    def deform(self, points: Numbers, code: Any) -> Numbers:
        """Points of the prim's space, in that space, as the skeleton has them at a time code."""
        points = self._shaped(points, code)
        if not self._query.HasJointInfluences():
            return points
        transforms = self._skeleton.ComputeSkinningTransforms(code)
        if self._query.GetSkinningMethod() == UsdSkel.Tokens.dualQuaternion:
            array = Vt.Vec3fArray.FromNumpy(points.astype(np.float32))
            moved = rows(array, 3) if self._query.ComputeSkinnedPoints(transforms, array, code) else None
        else:
            moved = self._blended(points, transforms, code)
        if moved is None or len(moved) != len(points):
            refuse(self.prim, "the joints that primvars:skel:jointIndices names are not those of the skeleton")
        cache = UsdGeom.XformCache(code)
        back = cache.GetLocalToWorldTransform(self._skeleton.GetPrim()) * cache.GetLocalToWorldTransform(self.prim).GetInverse()
        matrix = as_matrix(back)
        return np.asarray(moved @ matrix[:3, :3] + matrix[3, :3])

    def _blended(self, points: Numbers, transforms: Any, code: Any) -> Numbers:
        mapper = self._query.GetJointMapper()
        if mapper and not mapper.IsIdentity():
            transforms = mapper.RemapTransforms(transforms)
        found = self._query.ComputeVaryingJointInfluences(len(points), code)
        if found is None:
            refuse(self.prim, f"primvars:skel:jointIndices and jointWeights do not match the {len(points)} points")
        width = self._query.GetNumInfluencesPerComponent()
        indices = np.asarray(found[0], dtype=np.int64).reshape(len(points), width)
        weights = np.asarray(found[1], dtype=np.float64).reshape(len(points), width)
        matrices = np.array(transforms, dtype=np.float64).reshape(-1, 4, 4)
        if indices.size and not (indices.min() >= 0 and indices.max() < len(matrices)):
            worst = indices.max() if indices.max() >= len(matrices) else indices.min()
            refuse(self.prim, f"primvars:skel:jointIndices has {worst}; 0 to {len(matrices) - 1} expected")
        bind = as_matrix(self._query.GetGeomBindTransform(code))
        bound = points @ bind[:3, :3] + bind[3, :3]
        out = np.zeros_like(points)
        for place in range(width):
            own = matrices[indices[:, place]]
            out += weights[:, place, None] * (np.einsum("ni,nij->nj", bound, own[:, :3, :3]) + own[:, 3, :3])
        return out

    def _shaped(self, points: Numbers, code: Any) -> Numbers:
        if not self._query.HasBlendShapes() or not self._animation:
            return points
        weights = self._animation.ComputeBlendShapeWeights(code)
        mapper = self._query.GetBlendShapeMapper()
        if weights is None or not mapper:
            return points
        shapes = UsdSkel.BlendShapeQuery(UsdSkel.BindingAPI(self.prim))
        parts = shapes.ComputeSubShapeWeights(mapper.Remap(weights))
        offsets, places = shapes.ComputeSubShapePointOffsets(), shapes.ComputeBlendShapePointIndices()
        out: Numbers = points.copy()
        for weight, shape, part in zip(*parts):
            moves = rows(offsets[part], 3)
            index = np.asarray(places[shape], dtype=np.int64)
            target = index if len(index) else np.arange(len(points))
            if moves is None or len(moves) != len(target) or (len(index) and not (index.min() >= 0 and index.max() < len(points))):
                refuse(self.prim, f"blend shape {shape} does not match the {len(points)} points")
            np.add.at(out, target, weight * moves)
        return np.asarray(out)


class Skeletons:
    """The skeletons of a stage, and which prims they move."""

    def __init__(self, stage: Any) -> None:
        self._cache = UsdSkel.Cache()
        self._bound: dict[str, tuple[Any, Any]] = {}
        predicate = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
        prims = iter(Usd.PrimRange.Stage(stage, predicate))
        for prim in prims:
            if not prim.IsA(UsdSkel.Root):
                continue
            prims.PruneChildren()
            root = UsdSkel.Root(prim)
            self._cache.Populate(root, predicate)
            for binding in self._cache.ComputeSkelBindings(root, predicate):
                for query in binding.GetSkinningTargets():
                    self._bound[str(query.GetPrim().GetPath())] = (binding.GetSkeleton(), query)

    def of(self, prim: Any) -> Skinned | None:
        """What moves a prim, or None."""
        found = self._bound.get(str(prim.GetPath()))
        if found is None:
            if UsdGeom.PrimvarsAPI(prim).HasPrimvar("skel:jointIndices"):
                text = f"{prim.GetPath()}: has joint weights, but no SkelRoot above it or no skeleton: read as if there were none, as USD has it"
                warnings.warn(text, UsdWarning, stacklevel=2)
            return None
        skeleton = self._cache.GetSkelQuery(found[0])
        if not skeleton:
            refuse(prim, f"its skeleton {found[0].GetPath()} is not valid")
        return Skinned(prim, skeleton, found[1])
