"""Hair drawn by formula on Sintel's bust, for the pictures of docs/guide/blender.md: where it grows, how it is combed, waves and curls.

Metres, z up; the face looks along -y.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from mathutils.bvhtree import BVHTree

Numbers = npt.NDArray[np.float64]

#: The middle of the head, inside.
MIDDLE = np.array([0.0, 0.01, 0.345])
#: The middle of the neck, above the shoulders.
NECK = np.array([0.0, 0.02, 0.21])
#: Elevation of the hairline seen from there, degrees, by the angle from the face: forehead, temples, before and above the ears, nape.
HAIRLINE = ((0, 28, 46, 58, 68, 78, 86, 97, 108, 120, 140, 180), (25, 24, 18, 12, 2, -8, 8, 19, 6, -18, -36, -43))
#: The ways along which hair is drawn before it is cut.
LONG, STEPS = 0.62, 156
GRAVITY = np.array([0.0, 0.0, -1.0])


def unit(vectors: Numbers) -> Numbers:
    """Vectors of length 1."""
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12))


def smooth(value: Numbers, low: float, high: float) -> Numbers:
    """0 below low, 1 above high, smooth between."""
    part = np.clip((value - low) / (high - low), 0.0, 1.0)
    return np.asarray(part * part * (3.0 - 2.0 * part))


def density(vertices: Numbers) -> Numbers:
    """How densely hair grows at vertices: 1 on the scalp, a soft hairline, 0 on face, ears and neck."""
    away = vertices - MIDDLE
    around = np.degrees(np.arctan2(np.abs(away[:, 0]), -away[:, 1]))
    above = np.degrees(np.arcsin(away[:, 2] / np.linalg.norm(away, axis=1)))
    grows = smooth(above - np.interp(around, *HAIRLINE), -2.0, 4.0)
    ear = (np.abs(vertices[:, 0]) > 0.073) & (vertices[:, 2] < 0.372) & (np.abs(vertices[:, 1]) < 0.035)
    return np.where(ear | (vertices[:, 2] < 0.24), 0.0, grows)


class Skin:
    """The bust, to lie on."""

    def __init__(self, vertices: Numbers, faces: npt.NDArray[np.uint32]) -> None:
        self._tree = BVHTree.FromPolygons(vertices.tolist(), faces.tolist(), all_triangles=True)

    def nearest(self, points: Numbers) -> tuple[Numbers, Numbers]:
        """The nearest places and the normals there."""
        found = [self._tree.find_nearest(point) for point in points.tolist()]
        return np.array([place[:] for place, _, _, _ in found]), np.array([normal[:] for _, normal, _, _ in found])


@dataclass(frozen=True)
class Style:
    """How hair is combed."""

    #: Where it is parted, m from the middle.
    part: float
    #: How far off the skin it lies at most, m.
    lie: float
    #: How much of the normal it leaves with.
    lift: float
    #: How strongly hair at the forehead goes back.
    back: float


def combed(roots: Numbers, normals: Numbers, skin: Skin, style: Style, random: np.random.Generator) -> Numbers:
    """Ways of hair that leaves a parting, is kept off the face, bends down and lies on head and shoulders, (roots, STEPS, 3)."""
    # Away from the parting in front, from the crown behind.
    line = np.stack([np.full(len(roots), style.part), np.clip(roots[:, 1], -0.1, 0.055), roots[:, 2]], axis=1)
    away = unit((roots - line) * [1.0, 1.0, 0.0] + 1e-6 * np.sign(roots[:, :1] - style.part) * [1.0, 0.0, 0.0])
    side = np.where(roots[:, :1] >= style.part, 1.0, -1.0)
    front = np.clip((0.0 - roots[:, 1:2]) / 0.08, 0.0, 1.0)
    way = unit(style.lift * normals + 0.9 * away + style.back * front * [0.0, 1.0, 0.0] - 0.25 * (1.0 - front) * [0.0, 0.0, 1.0])
    step = LONG / (STEPS - 1)
    lie = style.lie * (0.25 + random.random(len(roots)) ** 0.7)[:, None]
    points = [roots]
    for k in range(1, STEPS):
        here = points[-1]
        # The face is kept free: hair before it goes to its side and back.
        forehead = (here[:, 1:2] < -0.03) & (here[:, 2:] > 0.2) & (np.abs(here[:, :1]) < 0.075)
        off = np.where(forehead, side * [1.6, 0.0, 0.0] + [0.0, 1.5, 0.0], 0.0)
        way = unit(way + (step / 0.026) * (GRAVITY + off))
        place = here + step * way
        nearest, normal = skin.nearest(place)
        above = np.sum((place - nearest) * normal, axis=1, keepdims=True)
        room = np.minimum(lie, 0.35 * step * k + 0.0012)
        place = place + np.where(above < room, room - above, 0.0) * normal
        way = unit(place - here)
        points.append(here + step * way)
    ways = np.stack(points, axis=1)
    # Pushes off the skin leave kinks.
    for _ in range(40):
        ways[:, 1:-1] = 0.25 * ways[:, :-2] + 0.5 * ways[:, 1:-1] + 0.25 * ways[:, 2:]
    return ways


def lengths_to(ways: Numbers, height: float, longest: float, uneven: float, random: np.random.Generator) -> Numbers:
    """Lengths to a hem at a height, a little uneven; what lies on the shoulders is cut where they end."""
    along = _along(ways)
    below = (ways[:, :, 2] < height) | (np.abs(ways[:, :, 0]) > 0.135)
    first = np.where(below.any(axis=1), below.argmax(axis=1), STEPS - 1)
    cut = along[np.arange(len(ways)), first] * (1.0 - uneven * random.random(len(ways)))
    return np.asarray(np.minimum(cut, longest))


def _along(ways: Numbers) -> Numbers:
    edges = np.linalg.norm(np.diff(ways, axis=1), axis=2)
    return np.concatenate([np.zeros((len(ways), 1)), np.cumsum(edges, axis=1)], axis=1)


def cut(ways: Numbers, lengths: Numbers, count: int) -> Numbers:
    """Strands of count points, each of its length."""
    rows = []
    for way, along, length in zip(ways, _along(ways), lengths, strict=True):
        at = np.linspace(0.0, length, count)
        rows.append(np.stack([np.interp(at, along, way[:, axis]) for axis in range(3)], axis=1))
    return np.stack(rows)


def wound(strands: Numbers, lengths: Numbers, skin: Skin, across: float, off: float, wavelength: float, start: float, phases: Numbers) -> Numbers:
    """Strands that swing to both sides by across and off the skin by off, m: waves if off is small, curls if both are alike. The swing grows along the
    first start metres; phases in turns.
    """
    tangents = unit(np.gradient(strands, axis=1))
    _, normal = skin.nearest(strands.reshape(-1, 3))
    outward = normal.reshape(strands.shape)
    # Directions turn slowly along a strand.
    for _ in range(30):
        outward[:, 1:-1] = unit(0.25 * outward[:, :-2] + 0.5 * outward[:, 1:-1] + 0.25 * outward[:, 2:])
    sideways = unit(np.cross(tangents, outward))
    outward = unit(np.cross(sideways, tangents))
    along = np.linspace(0.0, 1.0, strands.shape[1])[None] * lengths[:, None]
    angle = 2.0 * np.pi * (along / wavelength + phases[:, None])
    width = smooth(along, 0.0, start)
    offset = width[..., None] * (across * np.cos(angle)[..., None] * sideways + off * np.sin(angle)[..., None] * outward)
    return np.asarray(strands + offset - offset[:, :1])
