"""Writes strands over time as Alembic curves."""

from __future__ import annotations

import os
from pathlib import Path
from types import TracebackType

import numpy as np
import numpy.typing as npt

from superhelix._buffers import column
from superhelix._part_files import PartFile
from superhelix.alembic import ogawa
from superhelix.alembic.ogawa import ACYCLIC, Kind, OgawaWriter, Property, TimeSampling
from superhelix.enums import UpAxis

_CURVES = "schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_GeomBase_v1"
_XFORM = "schema=AbcGeom_Xform_v3"
#: Linear, not periodic, no basis.
_LINEAR = (1, 0, 0, 0)
#: Times are even if they differ from even ones by less than this part of a frame.
_EVEN = 1e-6


class HairWriter:
    """Writes strands to an .abc file, frame by frame, in memory that does not grow. The file appears when the writer is closed.

    As a context manager it abandons the file if the block raises. Strands are linear curves through their points, below a transform that stays at the origin.
    Alembic files have y up: points with z up are turned. They state no unit.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        point_counts: npt.ArrayLike,
        *,
        up_axis: UpAxis = UpAxis.Z,
        metres_per_unit: float = 1.0,
        widths: npt.ArrayLike | None = None,
        name: str = "hair",
    ) -> None:
        """point_counts: points of each strand. up_axis: of the points that are given. metres_per_unit: of the file. widths: diameters, m: one for all, one for
        each strand, or one for each point. name: of the object.
        """
        self.path = Path(path)
        if self.path.suffix.lower() != ".abc":
            raise ValueError(f"path: {self.path.name} ends in {self.path.suffix or 'nothing'!r}; .abc expected")
        if up_axis not in (UpAxis.Y, UpAxis.Z):
            raise ValueError(f"up_axis: {up_axis!r}; UpAxis.Y or UpAxis.Z expected")
        if not 0.0 < metres_per_unit < np.inf:
            raise ValueError(f"metres_per_unit: {metres_per_unit}; above 0 expected")
        if not name or "/" in name:
            raise ValueError(f"name: {name!r}; a name without / expected")
        counts = column("point_counts", point_counts, np.int64)
        if not len(counts):
            raise ValueError("point_counts: no strands; at least one expected")
        if counts.min() < 2:
            raise ValueError(f"point_counts[{int(np.argmin(counts))}]: {counts.min()}; at least 2 expected")
        self.frame_count = 0
        self._name, self._up, self._scale, self._counts, self._total = name, up_axis, 1.0 / metres_per_unit, counts, int(counts.sum())
        self._widths = None if widths is None else self._spread(widths)
        self._times: list[float] = []
        self._timeless = False
        self._has_velocities = False
        self._points = Property("P", Kind.ARRAY, ogawa.FLOAT32, 3, "geoScope=vtx;interpretation=point")
        self._velocities = Property(".velocities", Kind.ARRAY, ogawa.FLOAT32, 3, "interpretation=vector")
        self._width = Property("width", Kind.ARRAY, ogawa.FLOAT32, 1, "arrayExtent=1;geoScope=vtx;isGeomParam=true;podExtent=1;podName=float32_t")
        self._vertices = Property("nVertices", Kind.ARRAY, ogawa.INT32, 1)
        self._basis = Property("curveBasisAndType", Kind.SCALAR, ogawa.UINT8, 4)
        self._bounds = Property(".selfBnds", Kind.SCALAR, ogawa.FLOAT64, 6, "interpretation=box")
        self._part = PartFile(self.path, ".abc")
        # Open until the writer is closed or abandoned.
        self._file = open(self._part.path, "wb")  # noqa: SIM115
        self._ogawa = OgawaWriter(self._file)

    def _spread(self, widths: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """Widths at all points, in the file's unit."""
        array = np.asarray(widths, dtype=np.float64).reshape(-1)
        if len(array) not in (1, len(self._counts), self._total):
            raise ValueError(f"widths: {len(array)} numbers; 1, {len(self._counts)} (strands) or {self._total} (points) expected")
        bad = ~((array >= 0.0) & np.isfinite(array))
        if bad.any():
            raise ValueError(f"widths[{int(np.argmax(bad))}]: {array[bad][0]}; 0 m or more expected")
        rows = np.repeat(array, self._counts) if len(array) == len(self._counts) and len(array) != self._total else np.broadcast_to(array, self._total)
        return np.asarray(rows * self._scale, dtype=np.float32)

    def _rows(self, name: str, vectors: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """Vectors of all points in the file's unit and axes."""
        rows = np.asarray(vectors)
        if rows.shape[-1:] != (3,) or rows.size != 3 * self._total:
            raise ValueError(f"{name}: shape {rows.shape}; {self._total} rows of 3 expected")
        rows = rows.reshape(-1, 3)
        if not np.isfinite(rows).all():
            raise ValueError(f"{name}: some are not finite")
        rows = rows if self._scale == 1.0 else rows * self._scale
        if self._up == UpAxis.Z:
            rows = np.stack([rows[:, 0], rows[:, 2], -rows[:, 1]], axis=1)
        return np.ascontiguousarray(rows, dtype=np.float32)

    def write(self, time: float | None, points: npt.ArrayLike, velocities: npt.ArrayLike | None = None, widths: npt.ArrayLike | None = None) -> None:
        """Writes a frame: its time, s, later than the one before; points, m; velocities, m/s, in all frames if in the first; widths, as those of the writer,
        which frames can change if it has some. time None: hair without time, a single frame.
        """
        if self._file.closed:
            raise ValueError("write: the writer is closed")
        if time is not None and not np.isfinite(time):
            raise ValueError(f"time: {time}; a finite number of seconds expected")
        if self.frame_count and (time is None or self._timeless or time <= self._times[-1]):
            raise ValueError(f"time: {time} after {None if self._timeless else self._times[-1]} s; a later time expected")
        if self.frame_count and (velocities is not None) != self._has_velocities:
            raise ValueError(f"velocities: {'none, and the first frame has some' if self._has_velocities else 'some, and the first frame has none'}")
        if self.frame_count and widths is not None and self._widths is None:
            raise ValueError("widths: the first frame has none")
        rows = self._rows("points", points)
        speeds = None if velocities is None else self._rows("velocities", velocities)
        if widths is not None:
            self._widths = self._spread(widths)
        self._points.add(self._ogawa, rows)
        if speeds is not None:
            self._velocities.add(self._ogawa, speeds)
        if self._widths is not None:
            self._width.add(self._ogawa, self._widths)
        margin = 0.5 * float(self._widths.max()) if self._widths is not None else 0.0
        low, high = rows.min(axis=0).astype(np.float64) - margin, rows.max(axis=0).astype(np.float64) + margin
        self._bounds.add(self._ogawa, np.concatenate([low, high]))
        self._vertices.add(self._ogawa, self._counts)
        self._basis.add(self._ogawa, _LINEAR)
        self._timeless, self._has_velocities = time is None, velocities is not None
        self._times.append(0.0 if time is None else float(time))
        self.frame_count += 1

    def _sampling(self) -> TimeSampling:
        """Even times if they are, else each time."""
        times = np.array(self._times)
        if len(times) == 1:
            return TimeSampling(1.0, [float(times[0])])
        step = float(times[-1] - times[0]) / (len(times) - 1)
        if np.abs(times - times[0] - step * np.arange(len(times))).max() <= _EVEN * step:
            return TimeSampling(step, [float(times[0])])
        return TimeSampling(ACYCLIC, self._times)

    def close(self) -> None:
        """Completes the file and moves it into place. Raises if no frame was written."""
        if self._file.closed:
            return
        if self.frame_count == 0:
            self.abandon()
            raise ValueError(f"{self.path}: no frame was written")
        try:
            self._finish()
            self._file.close()
            self._part.place()
        except BaseException:
            self.abandon()
            raise

    def _finish(self) -> None:
        out = self._ogawa
        properties = [self._bounds, self._points, self._vertices, self._basis, self._width, self._velocities]
        geometry = ogawa.compound(out, [item.finish(out) for item in properties if item.count])
        shape = ogawa.compound(out, [(geometry, ogawa.compound_header(out, ".geom", _CURVES))])
        xform = ogawa.compound(out, [(0, ogawa.compound_header(out, ".xform", _XFORM))])
        curves = ogawa.write_object(out, shape, [])
        carrier = ogawa.write_object(out, xform, [(f"{self._name}Shape", f"{_CURVES};schemaObjTitle=AbcGeom_Curve_v2:.geom", curves)])
        top = ogawa.write_object(out, 0, [(self._name, f"{_XFORM};schemaObjTitle=AbcGeom_Xform_v3:.xform", carrier)])
        sampling = self._sampling()
        about = "_ai_AlembicVersion=Alembic 1.8.3;_ai_Application=superhelix"
        if self.frame_count > 1 and sampling.per_cycle < ACYCLIC:
            about = f"FramesPerTimeUnit={1.0 / sampling.per_cycle:.6f};{about}"
        ogawa.write_archive(out, top, about, [(1, TimeSampling()), (self.frame_count, sampling)])

    def abandon(self) -> None:
        """Abandons the file and deletes what was written."""
        self._file.close()
        self._part.drop()

    def __enter__(self) -> HairWriter:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is None:
            self.close()
        else:
            self.abandon()


def write_hair(
    path: str | os.PathLike[str],
    points: npt.ArrayLike,
    point_counts: npt.ArrayLike | None = None,
    *,
    velocities: npt.ArrayLike | None = None,
    up_axis: UpAxis = UpAxis.Z,
    metres_per_unit: float = 1.0,
    widths: npt.ArrayLike | None = None,
    name: str = "hair",
) -> None:
    """Writes strands at one moment: points, m, (strands, points, 3), or strand by strand with point_counts. The rest: as HairWriter and its write."""
    rows = np.asarray(points)
    if point_counts is None:
        if rows.ndim != 3:
            raise ValueError(f"points: shape {rows.shape}; (strands, points, 3) expected, or give point_counts")
        point_counts = np.full(rows.shape[0], rows.shape[1], dtype=np.uint32)
    with HairWriter(path, point_counts, up_axis=up_axis, metres_per_unit=metres_per_unit, widths=widths, name=name) as writer:
        writer.write(None, rows.reshape(-1, 3), velocities)
