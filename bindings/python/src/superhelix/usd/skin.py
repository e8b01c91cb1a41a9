"""The skin under the hair: its mesh at a time, and root frames that go with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from superhelix.frames import moved, multiply, rotate
from superhelix.records import FollicleTable
from superhelix.scalp import Scalp
from superhelix.usd import instances
from superhelix.usd._pxr import Usd, UsdError, UsdGeom, refuse
from superhelix.usd.curves.bases import Integers, Numbers, starts_of
from superhelix.usd.curves.controls import rows

if TYPE_CHECKING:
    from superhelix.usd.hair import Hair
    from superhelix.usd.read import HairStage


@dataclass
class SkinMesh:
    """A mesh at one time: vertices, m; triangles, three indices each, anticlockwise seen from outside; the face of the file that each triangle is of,
    and its number in that face; uvs: texture coordinates of the corners of each triangle, (triangles, 3, 2), or None. Faces are fans of triangles.
    """

    path: str
    vertices: Numbers
    triangles: npt.NDArray[np.uint32]
    faces: Integers
    fans: Integers
    face_sizes: Integers
    uvs: Numbers | None = None
    #: Whether the corners of the triangles are in the other order than in the file: it is left-handed, or mirrored.
    flipped: bool = False

    def scalp(self) -> Scalp:
        """The mesh as a superhelix.Scalp."""
        return Scalp(self.vertices, self.triangles, uvs=self.uvs)


def _uvs(prim: Any, code: Any, corners: Integers, vertices: Integers) -> Numbers | None:
    """Texture coordinates of the corners of triangles."""
    for name in ("st", "uv", "UVMap", "map1"):
        found = UsdGeom.PrimvarsAPI(prim).GetPrimvar(name)
        values = rows(found.ComputeFlattened(code), 2) if found and found.HasValue() and "2" in str(found.GetTypeName()) else None
        if values is None:
            continue
        kind = str(found.GetInterpolation())
        index = corners if kind == "faceVarying" else vertices
        if kind in ("faceVarying", "vertex", "varying") and index.max() < len(values):
            return np.asarray(values[index])
    return None


def read_mesh(stage: HairStage, path: str, time: float | None) -> SkinMesh:
    """See HairStage.mesh."""
    prim = stage.stage.GetPrimAtPath(path)
    if not prim:
        raise UsdError(path, "there is no such prim")
    if not prim.IsA(UsdGeom.Mesh):
        refuse(prim, f"is a {prim.GetTypeName() or 'prim without a type'}; a Mesh expected")
    mesh = UsdGeom.Mesh(prim)
    skinned = stage.skeletons.of(prim)
    if time is None:
        times = set(mesh.GetPointsAttr().GetTimeSamples()) | (set() if skinned is None else skinned.times)
        code = Usd.TimeCode(min(times)) if times else Usd.TimeCode.EarliestTime()
    else:
        code = Usd.TimeCode(time * stage.codes_per_second)
    points = rows(mesh.GetPointsAttr().Get(code), 3)
    sizes = np.asarray(mesh.GetFaceVertexCountsAttr().Get(code) or (), dtype=np.int64)
    indices = np.asarray(mesh.GetFaceVertexIndicesAttr().Get(code) or (), dtype=np.int64)
    if points is None or not len(points) or not len(sizes):
        refuse(prim, "has no points or no faces")
    if int(sizes.sum()) != len(indices):
        refuse(prim, f"faceVertexCounts has {len(sizes)} faces of {int(sizes.sum())} corners, and faceVertexIndices has {len(indices)}")
    bad = np.flatnonzero((indices < 0) | (indices >= len(points)))
    if len(bad):
        refuse(prim, f"faceVertexIndices[{bad[0]}] is {indices[bad[0]]}; 0 to {len(points) - 1} expected")
    small = np.flatnonzero(sizes < 3)
    if len(small):
        refuse(prim, f"faceVertexCounts[{small[0]}] is {sizes[small[0]]}; at least 3 expected")
    walk = instances.Walk(stage.stage, code, None, None, 1)
    matrix = instances.as_matrix(walk.transforms(code).GetLocalToWorldTransform(prim))
    vertices = stage.placing(lambda code: instances.as_matrix(walk.transforms(code).GetLocalToWorldTransform(prim)), skinned)(points, code)
    faces = np.repeat(np.arange(len(sizes)), sizes - 2)
    fans = np.arange(len(faces)) - np.repeat(starts_of(sizes - 2), sizes - 2)
    first = starts_of(sizes)[faces]
    corners = np.stack([first, first + fans + 1, first + fans + 2], axis=1)
    # A left-handed mesh, or one that its placement mirrors, has its corners the other way round.
    flipped = bool((mesh.GetOrientationAttr().Get(code) == UsdGeom.Tokens.leftHanded) != (np.linalg.det(matrix[:3, :3]) < 0.0))
    if flipped:
        corners = corners[:, [0, 2, 1]]
    triangles = indices[corners]
    return SkinMesh(str(path), vertices, triangles.astype(np.uint32), faces, fans, sizes, _uvs(prim, code, corners, triangles), flipped)


def _closest(points: Numbers, corners: Numbers) -> tuple[Integers, Numbers]:
    """For each point the nearest triangle, and the barycentric coordinates of the place on it (of the second and third corner)."""
    centres = corners.mean(axis=1)
    reach = np.linalg.norm(corners - centres[:, None], axis=2).max(axis=1)
    triangle, place = np.zeros(len(points), dtype=np.int64), np.zeros((len(points), 2))
    squares = np.sum(centres**2, axis=1)
    chunk = max(1, 4_000_000 // max(len(corners), 1))
    for start in range(0, len(points), chunk):
        own = points[start : start + chunk]
        away = np.sqrt(np.maximum(np.sum(own**2, axis=1)[:, None] - 2.0 * own @ centres.T + squares, 0.0))
        limit = (away + reach).min(axis=1)
        point, candidate = np.nonzero(away - reach <= limit[:, None] * (1.0 + 1e-9))
        where = _on_triangles(own[point], corners[candidate])
        spot = (
            corners[candidate, 0]
            + where[:, :1] * (corners[candidate, 1] - corners[candidate, 0])
            + where[:, 1:] * (corners[candidate, 2] - corners[candidate, 0])
        )
        order = np.lexsort((np.linalg.norm(spot - own[point], axis=1), point))
        best = order[np.searchsorted(point[order], np.arange(len(own)))]
        triangle[start : start + len(own)], place[start : start + len(own)] = candidate[best], where[best]
    return triangle, place


def _on_triangles(points: Numbers, corners: Numbers) -> Numbers:
    """Barycentric coordinates, of the second and third corner, of the places on triangles that are nearest to points."""
    a, ab, ac = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    ap = points - a
    d00, d01, d11 = np.sum(ab * ab, axis=1), np.sum(ab * ac, axis=1), np.sum(ac * ac, axis=1)
    d20, d21 = np.sum(ap * ab, axis=1), np.sum(ap * ac, axis=1)
    area = d00 * d11 - d01 * d01
    safe = np.where(area > 0.0, area, 1.0)
    v, w = (d11 * d20 - d01 * d21) / safe, (d00 * d21 - d01 * d20) / safe
    inside = (area > 0.0) & (v >= 0.0) & (w >= 0.0) & (v + w <= 1.0)
    # On an edge: the nearest place on each of the three, and the best of these.
    on_ab = np.clip(d20 / np.where(d00 > 0.0, d00, 1.0), 0.0, 1.0)
    on_ac = np.clip(d21 / np.where(d11 > 0.0, d11, 1.0), 0.0, 1.0)
    bc = ac - ab
    d22 = np.sum(bc * bc, axis=1)
    on_bc = np.clip(np.sum((ap - ab) * bc, axis=1) / np.where(d22 > 0.0, d22, 1.0), 0.0, 1.0)
    zero = np.zeros_like(v)
    choices = np.stack([np.stack([on_ab, zero], 1), np.stack([zero, on_ac], 1), np.stack([1.0 - on_bc, on_bc], 1)])
    away = np.linalg.norm(choices[..., :1] * ab + choices[..., 1:] * ac - ap, axis=2)
    edge = choices[np.argmin(away, axis=0), np.arange(len(points))]
    return np.where(inside[:, None], np.stack([v, w], axis=1), edge)


def _on_faces(mesh: SkinMesh, prims: Integers, uvs: Numbers) -> tuple[Integers, Numbers]:
    """Triangles and barycentric coordinates of Houdini's skinprim and skinprimuv: on a triangle of its second and third corner; on a quad bilinear."""
    first = starts_of(np.bincount(mesh.faces, minlength=len(mesh.face_sizes)))
    u, v = uvs[:, 0], uvs[:, 1]
    triangle, place = first[prims], np.stack([u, v], axis=1)
    quad = mesh.face_sizes[prims] == 4
    # In the unit square with corners (0, 0), (0, 1), (1, 1), (1, 0), the fan's first triangle has v >= u.
    upper = quad & (v >= u)
    place[upper] = np.stack([v - u, u], axis=1)[upper]
    lower = quad & ~upper
    triangle = np.where(lower, triangle + 1, triangle)
    place[lower] = np.stack([v, u - v], axis=1)[lower]
    return triangle, place[:, ::-1] if mesh.flipped else place


class SkinRoots:
    """Roots that go with a skin. Bound to a mesh once; frames returns the roots' frames wherever the mesh is now."""

    def __init__(self, stage: HairStage, mesh: str, hair: Hair, frames: npt.ArrayLike, time: float | None = None) -> None:
        """hair: strands as drawn; frames: their root frames, for example those of Solver.root_frames; time: when hair and skin fit (s; None: hair.time).

        Roots are bound to the skin's nearest triangle. Where the hair says on which face it grows (skinprim, skinprimuv) and that place is as near to
        the root, to a tenth of a millimetre, it counts instead, so that roots on folds keep their side.
        """
        self._stage, self.mesh = stage, mesh
        skin = stage.mesh(mesh, hair.time if time is None else time)
        self._count = len(skin.vertices)
        rest = np.asarray(frames, dtype=np.float64)
        if rest.shape != (len(hair), 7):
            raise ValueError(f"frames: shape {rest.shape}; ({len(hair)}, 7) expected")
        corners = skin.vertices[skin.triangles]
        triangle, place = _closest(hair.roots, corners)
        if hair.skin_prims is not None and hair.skin_uvs is not None:
            bad = np.flatnonzero(hair.skin_prims >= len(skin.face_sizes))
            if len(bad):
                raise UsdError(mesh, f"skinprim of strand {bad[0]} is {hair.skin_prims[bad[0]]}; the mesh has {len(skin.face_sizes)} faces")
            given = (hair.skin_prims >= 0) & np.isfinite(hair.skin_uvs).all(axis=1) & np.isin(skin.face_sizes[hair.skin_prims], (3, 4))
            said, where = _on_faces(skin, np.where(given, hair.skin_prims, 0), np.where(given[:, None], hair.skin_uvs, 0.0))
            near = given & (_distance(hair.roots, corners[said], where) <= _distance(hair.roots, corners[triangle], place) + 1e-4)
            triangle, place = np.where(near, said, triangle), np.where(near[:, None], where, place)
        #: How far each root is from the skin, m.
        self.distances = _distance(hair.roots, corners[triangle], place)
        self._follicles = FollicleTable._zeros(len(hair))
        self._follicles.data["triangle"] = triangle
        self._follicles.data["barycentric"] = np.clip(place, 0.0, 1.0)
        self._scalp = skin.scalp()
        on_skin = self._scalp.root_frames(self._follicles)
        back = on_skin[:, 3:] * [-1.0, -1.0, -1.0, 1.0]
        self._local = np.concatenate([rotate(back, rest[:, :3] - on_skin[:, :3]), multiply(back, rest[:, 3:])], axis=1)

    def frames(self, time: float) -> Numbers:
        """Returns the roots' frames at a time, s: rows for Solver.set_root_frames."""
        now = self._stage.mesh(self.mesh, time)
        if len(now.vertices) != self._count:
            raise UsdError(self.mesh, f"has {len(now.vertices)} points at {time:g} s; {self._count} expected, as where the roots were bound")
        return np.asarray(moved(self._scalp.root_frames(self._follicles, now.vertices), self._local))


def _distance(points: Numbers, corners: Numbers, place: Numbers) -> Numbers:
    spot = corners[:, 0] + place[:, :1] * (corners[:, 1] - corners[:, 0]) + place[:, 1:] * (corners[:, 2] - corners[:, 0])
    return np.asarray(np.linalg.norm(spot - points, axis=1))
