"""Render hair from a cache of guides to another cache."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix.curves import CurveCache, CurveCacheWriter, CurveData, Curves, Path
from superhelix.enums import CurveAttribute
from superhelix.records import RenderSettings
from superhelix.render import RenderGuides, RenderHair
from superhelix.scalp import Scalp


def interpolate(
    guides: Path,
    out: Path,
    *,
    roots: npt.ArrayLike | None = None,
    scalp: Scalp | None = None,
    count: int = 0,
    scale: float | None = None,
    fps: float | None = None,
    settings: RenderSettings | None = None,
    seed: int = 0,
) -> int:
    """Interpolates render hair from a cache of guides (.usda, as simulate writes it) to another cache, with one strand for each of roots, or for each
    of count follicles scattered over a scalp near the guides. The first frame is the rest pose; roots and scalp are in that pose, m. Velocities are
    written if the guides have them. Returns the number of strands.
    """
    with CurveCache(guides) as cache:
        times = cache.times()
        with cache.sample(float(times[0])) as first:
            units, counts = first.units(), first.point_counts()
            metres = scale if scale is not None else (units.metres or 1.0)
            rest = first.points(metres, dtype=np.float64)
            moving = first.attribute(CurveAttribute.VELOCITY) is not None
        if (roots is None) == (scalp is None):
            raise ValueError("roots, scalp: give one of the two")
        if scalp is not None:
            starts = np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.int64)
            follicles = scalp.scatter(count, guide_roots=rest[starts], seed=seed)
            places: npt.NDArray[Any] = scalp.root_frames(follicles)
        else:
            places = np.asarray(roots, dtype=np.float64)
        step = float(np.median(np.diff(times))) if len(times) > 1 else 1.0 / 24.0
        rate = fps if fps is not None else 1.0 / step
        with RenderHair.from_guides(RenderGuides(rest, counts), places, settings) as hair, hair.pose() as pose:
            shape = (hair.strand_count, hair.points_per_strand, 3)
            velocities = np.zeros(shape, dtype=np.float32) if moving else None
            # The first frame says what does not change.
            first_frame = np.zeros(shape, dtype=np.float32)
            data = CurveData(first_frame, velocities=velocities, up_axis=units.up_axis, metres_per_unit=units.metres)
            with CurveCacheWriter(out, data, rate) as writer:
                for time, curves in cache:
                    pose.set_guides(_guides(curves, counts, metres, moving))
                    points = pose.evaluate(velocities=velocities)
                    scale = np.float32(1.0 / metres)
                    writer.write(time, points * scale, None if velocities is None else velocities * scale)
            return hair.strand_count


def _guides(curves: Curves, counts: npt.NDArray[np.uint32], metres: float, moving: bool) -> RenderGuides:
    """A frame's curves as guides, with their velocities where the cache has some."""
    speeds = curves.attribute(CurveAttribute.VELOCITY) if moving else None
    rows = curves.points(metres, dtype=np.float64)
    return RenderGuides(rows, counts, velocities=None if speeds is None else speeds * np.float32(metres))
