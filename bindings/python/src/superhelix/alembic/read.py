"""Reads curves of an Alembic file at a time, with the transforms above them."""

from __future__ import annotations

import os
from dataclasses import dataclass
from types import TracebackType
from typing import Any

import numpy as np
import numpy.typing as npt

from superhelix.alembic.ogawa import AlembicError, Header, Kind, OgawaReader
from superhelix.enums import UpAxis
from superhelix.groom import Groom

Numbers = npt.NDArray[np.float64]
#: The numbers that an operation of a transform takes: scale, translate, rotate, matrix, rotate about x, y, z.
_OPERANDS = (3, 3, 4, 16, 1, 1, 1)
#: More than any program makes: a damaged file could have objects in themselves.
_DEEPEST, _MOST_OBJECTS = 256, 1_000_000


@dataclass
class AlembicHair:
    """Curves at one time, in metres, in the world: y up, or z if it was asked for. Rows per point are curve by curve, root first."""

    points: Numbers
    point_counts: npt.NDArray[np.uint32]
    up_axis: UpAxis
    metres_per_unit: float
    time: float
    #: Velocities of the points, m/s: what the file states, carried along by its transforms but without their own motion; None if an object has none.
    velocities: Numbers | None
    #: Widths (diameters) at the points, m; None if an object has none.
    widths: Numbers | None
    #: Paths of the objects, and the object of each curve.
    objects: list[str]
    object_of: npt.NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.point_counts)

    def __repr__(self) -> str:
        return f"AlembicHair({len(self)} curves, {len(self.points)} points, {len(self.objects)} objects, time {self.time:g} s)"

    def groom(self) -> Groom:
        """The curves as a superhelix.Groom, for prepare and simulate."""
        return Groom(self.points, self.point_counts, self.up_axis, self.metres_per_unit)


@dataclass
class _Carrier:
    """A transform above curves."""

    operations: npt.NDArray[np.uint8]
    values: Header | None
    inherits: bool


@dataclass
class _Curves:
    path: str
    carriers: list[_Carrier]
    properties: dict[str, Header]


def _rotation(axis: Numbers, degrees: float) -> Numbers:
    """A rotation, to be multiplied from the left."""
    length = float(np.linalg.norm(axis))
    matrix = np.eye(4)
    if length == 0.0:
        return matrix
    x, y, z = axis / length
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    angle = np.radians(degrees)
    matrix[:3, :3] += np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
    return matrix


def _operation(kind: int, numbers: Numbers) -> Numbers:
    """One operation of a transform, to be multiplied from the left."""
    matrix = np.eye(4)
    if kind == 0:
        matrix[[0, 1, 2], [0, 1, 2]] = numbers
    elif kind == 1:
        matrix[:3, 3] = numbers
    elif kind == 2:
        matrix = _rotation(numbers[:3], numbers[3])
    elif kind == 3:
        # Alembic multiplies rows from the left.
        matrix = numbers.reshape(4, 4).T
    else:
        matrix = _rotation(np.eye(3)[kind - 4], numbers[0])
    return matrix


class AlembicFile:
    """A file that is open for reading. A context manager."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._file = OgawaReader(path)
        self._curves: list[_Curves] = []
        self._object_count = 0
        try:
            self._collect(self._file.top, "", [], 0)
            if not self._curves:
                raise AlembicError(f"{self._file.name}: no curves")
            times = {time for item in self._curves for header in self._moving(item) for time in self._times(header)}
        except BaseException:
            self._file.close()
            raise
        #: The times at which something is stated, s; one if nothing moves.
        self.times: list[float] = sorted(times) or [0.0]

    def _collect(self, place: int, path: str, carriers: list[_Carrier], depth: int) -> None:
        if depth > _DEEPEST:
            raise AlembicError(f"{self._file.name}: {path}: objects in objects, more than {_DEEPEST} deep")
        for name, metadata, child in self._file.objects(place):
            self._object_count += 1
            if self._object_count > _MOST_OBJECTS:
                raise AlembicError(f"{self._file.name}: more than {_MOST_OBJECTS} objects")
            members = self._file.children(child)
            properties = self._file.properties(members[0]) if members else {}
            below, here = carriers, f"{path}/{name}"
            if "schema=AbcGeom_Xform_v3" in metadata and ".xform" in properties:
                below = [*carriers, self._carrier(here, self._file.properties(properties[".xform"].place))]
            elif "schema=AbcGeom_Curve_v2" in metadata and ".geom" in properties:
                found = self._file.properties(properties[".geom"].place)
                missing = [wanted for wanted in ("P", "nVertices", "curveBasisAndType") if wanted not in found or found[wanted].count == 0]
                if missing:
                    raise AlembicError(f"{self._file.name}: {here}: curves without {', '.join(missing)}")
                self._curves.append(_Curves(here, carriers, found))
            self._collect(child, here, below, depth + 1)

    def _carrier(self, path: str, properties: dict[str, Header]) -> _Carrier:
        operations = np.zeros(0, dtype=np.uint8)
        if ".ops" in properties and properties[".ops"].count:
            operations = np.asarray(self._file.sample(properties[".ops"], 0).reshape(-1) // 16, dtype=np.uint8)
            if (operations >= len(_OPERANDS)).any():
                raise AlembicError(f"{self._file.name}: {path}: a transform with operation {operations.max()}; 0 to {len(_OPERANDS) - 1} expected")
        inherits = properties.get(".inherits")
        follows = inherits is None or inherits.count == 0 or bool(self._file.sample(inherits, 0).any())
        values = properties.get(".vals")
        return _Carrier(operations, values if values is not None and values.count else None, follows)

    @staticmethod
    def _moving(item: _Curves) -> list[Header]:
        headers = [item.properties["P"], *(carrier.values for carrier in item.carriers if carrier.values is not None)]
        return [header for header in headers if header.count > 1]

    def _times(self, header: Header) -> list[float]:
        sampling = self._file.samplings[header.sampling]
        return [sampling.time(number) for number in range(header.count)]

    def _sample(self, header: Header, time: float) -> npt.NDArray[Any]:
        """The sample at a time: that before it, or the first."""
        sampling = self._file.samplings[header.sampling]
        # A frame's time may be off by a rounding.
        late = time + 1e-6
        if sampling.per_cycle > 0.0 and len(sampling.times) == 1:
            number = int(np.clip(np.floor((late - sampling.times[0]) / sampling.per_cycle), 0, header.count - 1))
        else:
            number = max(sum(sampling.time(each) <= late for each in range(header.count)) - 1, 0)
        return self._file.sample(header, number)

    def _numbers(self, header: Header, time: float) -> Numbers:
        """The same in double precision."""
        # Whoever takes them looks for what is not finite.
        with np.errstate(invalid="ignore"):
            return np.asarray(self._sample(header, time), dtype=np.float64)

    def _matrix(self, item: _Curves, time: float) -> Numbers:
        """From an object's space to the world, 4x4."""
        total = np.eye(4)
        for carrier in item.carriers:
            if not carrier.inherits:
                total = np.eye(4)
            if carrier.values is None:
                continue
            values = self._numbers(carrier.values, time).reshape(-1)
            wanted = sum(_OPERANDS[kind] for kind in carrier.operations.tolist())
            if len(values) != wanted or not np.isfinite(values).all():
                raise AlembicError(f"{self._file.name}: {item.path}: a transform of {len(values)} numbers; {wanted} finite ones expected")
            at = 0
            for kind in carrier.operations.tolist():
                total = total @ _operation(kind, values[at : at + _OPERANDS[kind]])
                at += _OPERANDS[kind]
        return total

    def read(self, time: float | None = None, *, metres_per_unit: float = 1.0, up_axis: UpAxis = UpAxis.Y) -> AlembicHair:
        """All curves at a time, s; None: the first that is stated. Between samples: those of the one before. metres_per_unit: the file states none. up_axis: Z
        turns them.
        """
        if not 0.0 < metres_per_unit < np.inf:
            raise ValueError(f"metres_per_unit: {metres_per_unit}; above 0 expected")
        if up_axis not in (UpAxis.Y, UpAxis.Z):
            raise ValueError(f"up_axis: {up_axis!r}; UpAxis.Y or UpAxis.Z expected")
        moment = self.times[0] if time is None else float(time)
        if not np.isfinite(moment):
            raise ValueError(f"time: {moment}; a finite number of seconds expected")
        parts = [self._read_object(item, moment, metres_per_unit) for item in self._curves]
        points, counts, velocities, widths = zip(*parts, strict=True)
        turn = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]) if up_axis == UpAxis.Z else np.eye(3)
        return AlembicHair(
            np.concatenate(points) @ turn.T,
            np.concatenate(counts),
            up_axis,
            metres_per_unit,
            moment,
            None if any(rows is None for rows in velocities) else np.concatenate(velocities) @ turn.T,
            None if any(rows is None for rows in widths) else np.concatenate(widths),
            [item.path for item in self._curves],
            np.repeat(np.arange(len(self._curves)), [len(rows) for rows in counts]),
        )

    def _read_object(self, item: _Curves, time: float, scale: float) -> tuple[Numbers, npt.NDArray[np.uint32], Numbers | None, Numbers | None]:
        where, properties = f"{self._file.name}: {item.path}", item.properties
        basis = self._sample(properties["curveBasisAndType"], time).reshape(-1)
        # Catmull-Rom curves that say that they are linear, as Blender's do, go through their points, too.
        if len(basis) != 4 or basis[0] != 1:
            raise AlembicError(f"{where}: {'cubic' if len(basis) == 4 and basis[0] == 0 else 'NURBS'} curves; linear ones expected: convert them")
        if basis[1] != 0:
            raise AlembicError(f"{where}: closed curves; open ones expected")
        counts = self._sample(properties["nVertices"], time).reshape(-1)
        local = self._numbers(properties["P"], time)
        if local.shape[1:] != (3,) or (counts < 1).any() or int(counts.sum(dtype=np.int64)) != len(local):
            raise AlembicError(f"{where}: {len(local)} points of {local.shape[1]} numbers for curves of {int(counts.sum(dtype=np.int64))} points")
        matrix = self._matrix(item, time)
        points = scale * (local @ matrix[:3, :3].T + matrix[:3, 3])
        if not np.isfinite(points).all():
            raise AlembicError(f"{where}: points that are not finite")
        velocities = self._optional(properties.get(".velocities"), time, len(points), 3, where)
        widths = self._widths(properties.get("width"), time, counts, where)
        size = float(np.cbrt(abs(np.linalg.det(matrix[:3, :3]))))
        return (
            points,
            counts.astype(np.uint32),
            None if velocities is None else scale * velocities @ matrix[:3, :3].T,
            None if widths is None else scale * size * widths,
        )

    def _optional(self, header: Header | None, time: float, count: int, extent: int, where: str) -> Numbers | None:
        if header is None or header.kind is Kind.COMPOUND or header.count == 0:
            return None
        rows = self._numbers(header, time)
        if rows.shape != (count, extent):
            raise AlembicError(f"{where}: {header.name} has shape {rows.shape}; ({count}, {extent}) expected")
        return rows

    def _widths(self, header: Header | None, time: float, counts: npt.NDArray[Any], where: str) -> Numbers | None:
        """Widths at the points, of one for all, for each curve or for each point; of a property with indices, too."""
        if header is None:
            return None
        if header.kind is Kind.COMPOUND:
            inside = self._file.properties(header.place)
            if ".vals" not in inside or ".indices" not in inside or not inside[".vals"].count or not inside[".indices"].count:
                return None
            values, places = self._numbers(inside[".vals"], time).reshape(-1), self._sample(inside[".indices"], time).reshape(-1).astype(np.int64)
            if len(places) and (places.min() < 0 or places.max() >= len(values)):
                raise AlembicError(f"{where}: width has index {places.max()}, and {len(values)} values")
            widths = values[places]
        elif header.count == 0:
            return None
        else:
            widths = self._numbers(header, time).reshape(-1)
        total = int(counts.sum(dtype=np.int64))
        if len(widths) == total:
            return widths
        if len(widths) == len(counts):
            return np.repeat(widths, counts)
        if len(widths) == 1:
            return np.full(total, widths[0])
        raise AlembicError(f"{where}: {len(widths)} widths; 1, {len(counts)} (curves) or {total} (points) expected")

    def close(self) -> None:
        """Closes the file."""
        self._file.close()

    def __enter__(self) -> AlembicFile:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()


def read_hair(path: str | os.PathLike[str], time: float | None = None, *, metres_per_unit: float = 1.0, up_axis: UpAxis = UpAxis.Y) -> AlembicHair:
    """Reads all curves of a file at a time: see AlembicFile.read."""
    with AlembicFile(path) as file:
        return file.read(time, metres_per_unit=metres_per_unit, up_axis=up_axis)
