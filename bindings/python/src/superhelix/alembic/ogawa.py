"""Ogawa, the container of Alembic files: data and groups of places of data, and the properties of objects that Alembic lays out in them.

A place is the offset of data (its first bit set) or of a group; 0 is an empty group, and the bit alone empty data. Groups are written after their
children. Samples of a property that repeat are written once.
"""

from __future__ import annotations

import hashlib
import mmap
import os
import struct
from dataclasses import dataclass, field
from enum import IntEnum
from typing import IO, Any

import numpy as np
import numpy.typing as npt

_DATA = 1 << 63
_MAGIC = b"Ogawa"
#: The largest metadata that is kept in the table which all headers share; longer ones are written in place.
_SHARED, _IN_PLACE = 255, 0xFF
_MOST_SAMPLES = 10_000_000
#: Seconds per cycle of samples at any times.
ACYCLIC = np.finfo(np.float64).max / 32.0


class AlembicError(ValueError):
    """A file that is no Alembic file, is damaged, or has what is not supported."""


class Kind(IntEnum):
    """Kinds of properties."""

    COMPOUND = 0
    SCALAR = 1
    ARRAY = 2


#: Alembic's numbers of types. 12 and 13 are strings.
_TYPES = ("u1", "u1", "i1", "<u2", "<i2", "<u4", "<i4", "<u8", "<i8", "<f2", "<f4", "<f8")
BOOL, UINT8, INT32, FLOAT32, FLOAT64 = 0, 1, 6, 10, 11


@dataclass
class TimeSampling:
    """When samples are: seconds per cycle, and the times of the first cycle."""

    per_cycle: float = 1.0
    times: list[float] = field(default_factory=lambda: [0.0])

    def time(self, sample: int) -> float:
        """The time of a sample, s."""
        if self.per_cycle >= ACYCLIC:
            return self.times[min(sample, len(self.times) - 1)]
        cycle, place = divmod(sample, len(self.times))
        return self.times[place] + cycle * self.per_cycle


# --- Writing ------------------------------------------------------------------------------------------------------------------


class OgawaWriter:
    """Writes a file's data as they come, and its groups when they are complete."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file
        file.write(_MAGIC + struct.pack(">BH", 0, 1) + bytes(8))
        self._end = 16
        self.metadata: dict[bytes, int] = {}

    def data(self, content: bytes) -> int:
        """Writes data, and returns their place."""
        if not content:
            return _DATA
        place, self._end = self._end, self._end + 8 + len(content)
        self._file.write(struct.pack("<Q", len(content)))
        self._file.write(content)
        return place | _DATA

    def group(self, places: list[int]) -> int:
        """Writes a group of places, and returns its own."""
        if not places:
            return 0
        place, self._end = self._end, self._end + 8 + 8 * len(places)
        self._file.write(struct.pack(f"<{len(places) + 1}Q", len(places), *places))
        return place

    def metadata_index(self, metadata: bytes) -> int:
        """The index of metadata in the shared table; 0 for none, 255 where they are written in place."""
        if not metadata:
            return 0
        if len(metadata) <= _SHARED and (metadata in self.metadata or len(self.metadata) < 254):
            return self.metadata.setdefault(metadata, len(self.metadata)) + 1
        return _IN_PLACE

    def finish(self, root: int) -> None:
        """Says where the file's first group is, and that the file is complete."""
        self._file.flush()
        self._file.seek(8)
        self._file.write(struct.pack("<Q", root))
        self._file.seek(5)
        self._file.write(b"\xff")
        self._file.flush()


class Property:
    """A property of numbers that is being written: scalars of extent numbers, or arrays of rows of them."""

    def __init__(self, name: str, kind: Kind, type_number: int, extent: int, metadata: str = "", sampling: int = 1) -> None:
        self.name, self._kind, self._type, self._extent, self._metadata, self._sampling = name, kind, type_number, extent, metadata.encode(), sampling
        self._places: list[int] = []
        self._first_changed = self._last_changed = self.count = 0
        self._key, self._place = b"", 0
        self._scalar_like = self._homogenous = True
        self._rows = -1

    def add(self, writer: OgawaWriter, values: npt.ArrayLike) -> None:
        """Writes the next sample."""
        array = np.ascontiguousarray(values, dtype=_TYPES[self._type])
        content, rows = array.tobytes(), array.size // self._extent
        key = hashlib.blake2b(content, digest_size=16).digest()
        if self.count == 0 or key != self._key or rows != self._rows:
            if self._first_changed:
                for _ in range(self._last_changed + 1, self.count):
                    self._put()
            self._key, self._place = key, writer.data(key + content)
            self._homogenous = self._homogenous and self._rows in (-1, rows)
            self._scalar_like = self._scalar_like and rows == 1
            self._rows = rows
            self._put()
            self._first_changed = self._first_changed or self.count
            self._last_changed = self.count
        self.count += 1

    def _put(self) -> None:
        # The size of the data says how many rows an array has.
        self._places += [self._place] if self._kind is Kind.SCALAR else [self._place, _DATA]

    def finish(self, writer: OgawaWriter) -> tuple[int, bytes]:
        """Its group's place, and its header."""
        info = int(self._kind) | self._type << 4 | self._extent << 12 | (0x400 if self._homogenous else 0)
        info |= 1 if self._scalar_like and self._kind is Kind.ARRAY and self.count else 0
        content = [self.count]
        if self._last_changed == 0:
            info |= 0x800
        elif (self._first_changed, self._last_changed) != (1, self.count - 1):
            info |= 0x200
            content += [self._first_changed, self._last_changed]
        if self._sampling:
            info |= 0x100
            content.append(self._sampling)
        return writer.group(self._places), _header(writer, info, content, self.name, self._metadata)


def _header(writer: OgawaWriter, info: int, numbers: list[int], name: str, metadata: bytes) -> bytes:
    """The header of a property."""
    text = name.encode()
    index = writer.metadata_index(metadata)
    longest = max(len(text), len(metadata), *numbers, 0)
    hint = 0 if longest < 1 << 8 else 1 if longest < 1 << 16 else 2
    size = struct.Struct("<" + "BHI"[hint])
    out = struct.pack("<I", info | hint << 2 | index << 20) + b"".join(size.pack(number) for number in numbers) + size.pack(len(text)) + text
    return out + (size.pack(len(metadata)) + metadata if index == _IN_PLACE else b"")


def compound(writer: OgawaWriter, members: list[tuple[int, bytes]]) -> int:
    """Writes the group of a compound property's members: places and headers."""
    return writer.group([place for place, _ in members] + [writer.data(b"".join(header for _, header in members))]) if members else 0


def compound_header(writer: OgawaWriter, name: str, metadata: str) -> bytes:
    """The header of a compound property."""
    return _header(writer, int(Kind.COMPOUND), [], name, metadata.encode())


def write_object(writer: OgawaWriter, properties: int, children: list[tuple[str, str, int]]) -> int:
    """Writes the group of an object: the place of its properties, and names, metadata and places of its children."""
    headers = b""
    for name, metadata, _ in children:
        text, more = name.encode(), metadata.encode()
        index = writer.metadata_index(more)
        headers += struct.pack("<I", len(text)) + text + bytes([index]) + (struct.pack("<I", len(more)) + more if index == _IN_PLACE else b"")
    hashes = hashlib.blake2b(headers, digest_size=32).digest()
    return writer.group([properties, *(place for _, _, place in children), writer.data(headers + hashes)])


def write_archive(writer: OgawaWriter, top: int, metadata: str, samplings: list[tuple[int, TimeSampling]]) -> None:
    """Writes the file's first group, and completes the file. samplings: the number of samples and the times of each time sampling."""
    version, library = writer.data(struct.pack("<i", 0)), writer.data(struct.pack("<i", 10803))
    about = writer.data(metadata.encode())
    times = b"".join(
        struct.pack("<IdI", count, sampling.per_cycle, len(sampling.times)) + np.array(sampling.times, dtype="<f8").tobytes() for count, sampling in samplings
    )
    shared = writer.data(b"".join(bytes([len(text)]) + text for text in writer.metadata))
    writer.finish(writer.group([version, library, top, about, writer.data(times), shared]))


# --- Reading ------------------------------------------------------------------------------------------------------------------


@dataclass
class Header:
    """What the header of a property says."""

    name: str
    kind: Kind
    type_number: int
    extent: int
    count: int
    first_changed: int
    last_changed: int
    sampling: int
    metadata: str
    place: int = 0


class _Bytes:
    """Reads numbers and texts off data, within their bounds."""

    def __init__(self, what: str, content: bytes) -> None:
        self._what, self._content, self._at = what, content, 0

    def __bool__(self) -> bool:
        return self._at < len(self._content)

    def take(self, count: int) -> bytes:
        if self._at + count > len(self._content):
            raise AlembicError(f"{self._what}: ends in the middle of a header")
        self._at += count
        return self._content[self._at - count : self._at]

    def number(self, form: str) -> int:
        return int(struct.unpack("<" + form, self.take(struct.calcsize("<" + form)))[0])

    def double(self) -> float:
        return float(struct.unpack("<d", self.take(8))[0])

    def text(self, count: int) -> str:
        return self.take(count).decode("utf-8", "replace")


class OgawaReader:
    """Reads a file. Whatever the file says is held against its size."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.name = os.fspath(path)
        with open(path, "rb") as file:
            start = file.read(16)
            if len(start) < 16 or start[:5] != _MAGIC:
                kind = (
                    "an Alembic file in HDF5, which current programs do not write; convert it with abcconvert" if start[:4] == b"\x89HDF" else "no Alembic file"
                )
                raise AlembicError(f"{self.name}: {kind}")
            if start[5] != 0xFF:
                raise AlembicError(f"{self.name}: was not written to its end")
            self._map = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        try:
            self._load(int.from_bytes(start[8:], "little"))
        except BaseException:
            self.close()
            raise

    def _load(self, root: int) -> None:
        first = self.children(root)
        if len(first) < 6:
            raise AlembicError(f"{self.name}: its first group has {len(first)} members; 6 expected")
        version = self.data(first[0])
        if version != bytes(4):
            raise AlembicError(f"{self.name}: of version {int.from_bytes(version, 'little')}; 0 expected")
        self.top, self.samplings = first[2], list[TimeSampling]()
        times = _Bytes(self.name, self.data(first[4]))
        while times:
            times.number("I")
            per_cycle, count = times.double(), times.number("I")
            self.samplings.append(TimeSampling(per_cycle, np.frombuffer(times.take(8 * count), dtype="<f8").tolist()))
            if not self.samplings[-1].times:
                raise AlembicError(f"{self.name}: a time sampling without times")
        shared = _Bytes(self.name, self.data(first[5]))
        self._metadata = [""]
        while shared:
            self._metadata.append(shared.text(shared.number("B")))

    def close(self) -> None:
        """Closes the file."""
        self._map.close()

    def _span(self, offset: int, unit: int) -> tuple[int, int]:
        if offset + 8 > len(self._map):
            raise AlembicError(f"{self.name}: points to byte {offset}, and has {len(self._map)}")
        count = int.from_bytes(self._map[offset : offset + 8], "little")
        if count > (len(self._map) - offset - 8) // unit:
            raise AlembicError(f"{self.name}: {count} times {unit} bytes at byte {offset}, and the file has {len(self._map)}")
        return offset + 8, count

    def children(self, place: int) -> list[int]:
        """The places in a group."""
        if place & _DATA:
            raise AlembicError(f"{self.name}: data where a group is expected, at byte {place & ~_DATA}")
        if place == 0:
            return []
        start, count = self._span(place, 8)
        return list(struct.unpack(f"<{count}Q", self._map[start : start + 8 * count]))

    def data(self, place: int) -> bytes:
        """Data."""
        if not place & _DATA:
            raise AlembicError(f"{self.name}: a group where data are expected, at byte {place}")
        if place == _DATA:
            return b""
        start, count = self._span(place & ~_DATA, 1)
        return self._map[start : start + count]

    def objects(self, place: int) -> list[tuple[str, str, int]]:
        """Names, metadata and places of an object's children."""
        members = self.children(place)
        if len(members) < 2:
            return []
        found, headers = [], _Bytes(self.name, self.data(members[-1])[:-32])
        for member in members[1:-1]:
            name, index = headers.text(headers.number("I")), headers.number("B")
            found.append((name, headers.text(headers.number("I")) if index == _IN_PLACE else self._shared(index), member))
        return found

    def _shared(self, index: int) -> str:
        if index >= len(self._metadata):
            raise AlembicError(f"{self.name}: metadata {index}, and it has {len(self._metadata)}")
        return self._metadata[index]

    def properties(self, place: int) -> dict[str, Header]:
        """The members of a compound property, by name."""
        members = self.children(place)
        if not members:
            return {}
        found, headers = {}, _Bytes(self.name, self.data(members[-1]))
        for member in members[:-1]:
            header = self._header(headers)
            header.place = member
            found[header.name] = header
        return found

    def _header(self, headers: _Bytes) -> Header:
        info = headers.number("I")
        hint = info >> 2 & 3
        if hint == 3:
            raise AlembicError(f"{self.name}: the header of a property has a size that there is not")
        form = "BHI"[hint]
        kind = (Kind.COMPOUND, Kind.SCALAR, Kind.ARRAY, Kind.ARRAY)[info & 3]
        count = first = last = sampling = 0
        if kind is not Kind.COMPOUND:
            count = headers.number(form)
            if count > _MOST_SAMPLES:
                raise AlembicError(f"{self.name}: a property of {count} samples; at most {_MOST_SAMPLES} expected")
            if info & 0x200:
                first, last = headers.number(form), headers.number(form)
            elif not info & 0x800:
                first, last = 1, count - 1
            sampling = headers.number(form) if info & 0x100 else 0
            if sampling >= len(self.samplings) or not 0 <= first <= last + 1 or last > max(count, 1):
                raise AlembicError(f"{self.name}: samples {first} to {last} of {count} change, at times {sampling} of {len(self.samplings)}")
        name = headers.text(headers.number(form))
        index = info >> 20 & 0xFF
        metadata = headers.text(headers.number(form)) if index == _IN_PLACE else self._shared(index)
        return Header(name, kind, info >> 4 & 15, info >> 12 & 0xFF, count, first, last, sampling, metadata)

    def sample(self, header: Header, number: int) -> npt.NDArray[Any]:
        """A sample of a property of numbers: rows of its extent; of a scalar one row."""
        if header.kind is Kind.COMPOUND or header.type_number >= len(_TYPES) or header.extent == 0:
            raise AlembicError(f"{self.name}: property {header.name}: no numbers")
        number = min(max(number, 0), header.count - 1)
        if number < header.first_changed or (header.first_changed, header.last_changed) == (0, 0):
            stored = 0
        else:
            stored = min(number, header.last_changed) - header.first_changed + 1
        members = self.children(header.place)
        step = 1 if header.kind is Kind.SCALAR else 2
        if step * stored >= len(members):
            raise AlembicError(f"{self.name}: property {header.name}: sample {number} is missing")
        content, kind = self.data(members[step * stored])[16:], np.dtype(_TYPES[header.type_number])
        if len(content) % (kind.itemsize * header.extent):
            raise AlembicError(f"{self.name}: property {header.name}: {len(content)} bytes; rows of {kind.itemsize * header.extent} expected")
        return np.frombuffer(content, dtype=kind).reshape(-1, header.extent)
