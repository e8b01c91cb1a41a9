"""What records.py is made of: classes around one C structure (Record) or an array of them (Table), and the descriptors of their fields."""

from __future__ import annotations

import ctypes
import operator
from collections.abc import Sequence
from enum import IntEnum, IntFlag
from functools import cache
from typing import Any, ClassVar, Generic, SupportsFloat, SupportsIndex, TypeVar, overload

import numpy as np
import numpy.typing as npt

from superhelix import _capi
from superhelix._library import functions
from superhelix.errors import check
from superhelix.ids import Id, Ids

T = TypeVar("T")
SetT = TypeVar("SetT")
EnumT = TypeVar("EnumT", bound="IntEnum | IntFlag")
IdT = TypeVar("IdT", bound=Id)
IdsT = TypeVar("IdsT", bound=Ids[Any])
RecordT = TypeVar("RecordT", bound="Record")
TableT = TypeVar("TableT", bound="Table")


@cache
def dtype_of(struct: type[ctypes.Structure]) -> np.dtype[Any]:
    """The numpy type with a structure's fields, offsets and size."""
    return np.dtype(struct)


def initialize(structure: ctypes.Structure) -> None:
    """Fills a versioned structure with the library's defaults."""
    name = _capi.INITIALIZERS.get(type(structure))
    if name is not None:
        check(getattr(functions, name)(ctypes.byref(structure), ctypes.sizeof(structure)))


class Record:
    """One C structure. Attributes are its fields; keyword arguments of the constructor set them, the others have the library's defaults."""

    __slots__ = ("_c",)
    _STRUCT: ClassVar[type[ctypes.Structure]]
    _c: Any

    def __init__(self) -> None:
        self._c = self._STRUCT()
        initialize(self._c)

    def _set(self, **values: object) -> None:
        for name, value in values.items():
            if value is not None:
                setattr(self, name, value)

    @classmethod
    def _view(cls: type[RecordT], structure: Any) -> RecordT:
        """A record that shares a structure's memory."""
        record = cls.__new__(cls)
        record._c = structure
        return record

    @classmethod
    def _names(cls) -> list[str]:
        return [name for base in reversed(cls.__mro__) for name, item in vars(base).items() if isinstance(item, RecordDescriptor)]

    def as_dict(self) -> dict[str, Any]:
        """The fields by name; records within as dictionaries."""
        values = ((name, getattr(self, name)) for name in self._names())
        return {name: value.as_dict() if isinstance(value, Record) else value for name, value in values}

    def copy(self: RecordT, **changes: object) -> RecordT:
        """A copy, with some fields changed."""
        other = type(self).__new__(type(self))
        other._c = type(self._c).from_buffer_copy(self._c)
        known = self._names()
        for name in changes:
            if name not in known:
                raise TypeError(f"{type(self).__name__} has no field {name!r}")
        other._set(**changes)
        return other

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and isinstance(other, Record) and bytes(self._c) == bytes(other._c)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={getattr(self, name)!r}" for name in self._names())
        return f"{type(self).__name__}({fields})"

    def __reduce__(self) -> tuple[Any, ...]:
        return _record_from_bytes, (type(self), bytes(self._c))


def reference(name: str, record: RecordT | None, kind: type[RecordT]) -> Any:
    """A pointer to a record that a function was given, or None; raises where it is of another kind."""
    if record is None:
        return None
    if not isinstance(record, kind):
        raise TypeError(f"{name}: {record!r}; {kind.__name__} expected")
    return ctypes.byref(record._c)


def _record_from_bytes(cls: type[RecordT], data: bytes) -> RecordT:
    return cls._view(cls._STRUCT.from_buffer_copy(data))


class RecordDescriptor(Generic[T, SetT]):
    """A field of a record."""

    def __init__(self, doc: str) -> None:
        self.__doc__ = doc
        self.name = ""
        self.owner = ""

    def __set_name__(self, owner: type[Record], name: str) -> None:
        self.name, self.owner = name, owner.__name__

    @overload
    def __get__(self, record: None, owner: type) -> RecordDescriptor[T, SetT]: ...
    @overload
    def __get__(self, record: Record, owner: type) -> T: ...
    def __get__(self, record: Record | None, owner: type) -> Any:
        return self if record is None else self.read(getattr(record._c, self.name))

    def __set__(self, record: Record, value: SetT) -> None:
        setattr(record._c, self.name, self.written(record, value))

    def read(self, value: Any) -> Any:
        """The field's value as Python has it."""
        return value

    def written(self, record: Record, value: SetT) -> Any:
        """A value as C has it; raises where it is none for this field."""
        raise NotImplementedError

    def refuse(self, value: object, expected: str) -> TypeError:
        """The error for a value of a wrong type."""
        return TypeError(f"{self.owner}.{self.name}: {value!r}; {expected} expected")


class FloatField(RecordDescriptor[float, SupportsFloat]):
    """A number."""

    def written(self, record: Record, value: SupportsFloat) -> float:
        if isinstance(value, (str, bytes)) or not hasattr(value, "__float__"):
            raise self.refuse(value, "a number")
        return float(value)


class IntField(RecordDescriptor[int, SupportsIndex]):
    """A whole number of at least zero."""

    def written(self, record: Record, value: SupportsIndex) -> int:
        try:
            number = operator.index(value)
        except TypeError:
            raise self.refuse(value, "a whole number") from None
        most = 256 ** getattr(type(record._c), self.name).size - 1
        if not 0 <= number <= most:
            raise ValueError(f"{self.owner}.{self.name}: {number}; 0 to {most} expected")
        return number


class BoolField(RecordDescriptor[bool, bool]):
    """True or False."""

    def read(self, value: Any) -> bool:
        return bool(value)

    def written(self, record: Record, value: bool) -> int:
        if not isinstance(value, (bool, np.bool_)) and value not in (0, 1):
            raise self.refuse(value, "True or False")
        return int(value)


class EnumField(RecordDescriptor[EnumT, EnumT], Generic[EnumT]):
    """One of an enumeration's members (or several of its bits)."""

    def __init__(self, members: type[EnumT], doc: str) -> None:
        super().__init__(doc)
        self.members: Any = members

    def read(self, value: Any) -> Any:
        try:
            return self.members(value)
        except ValueError:
            # 0 where nothing was chosen yet.
            return value

    def written(self, record: Record, value: EnumT) -> int:
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
            raise self.refuse(value, self.members.__name__)
        if isinstance(value, (IntEnum, IntFlag)) and not isinstance(value, self.members):
            raise self.refuse(value, self.members.__name__)
        if not 0 <= value < 2**32:
            raise ValueError(f"{self.owner}.{self.name}: {value}; {self.members.__name__} expected")
        return int(value)


class VectorField(RecordDescriptor["tuple[float, ...]", "Sequence[float] | npt.NDArray[Any]"]):
    """Some numbers."""

    def __init__(self, length: int, doc: str) -> None:
        super().__init__(doc)
        self.length = length

    def read(self, value: Any) -> tuple[float, ...]:
        return tuple(value)

    def written(self, record: Record, value: Sequence[float] | npt.NDArray[Any]) -> Any:
        try:
            numbers = [float(number) for number in value]
        except (TypeError, ValueError):
            raise self.refuse(value, f"{self.length} numbers") from None
        if len(numbers) != self.length:
            raise ValueError(f"{self.owner}.{self.name}: {len(numbers)} numbers; {self.length} expected")
        return (ctypes.c_double * self.length)(*numbers)


class RecordField(RecordDescriptor[RecordT, RecordT], Generic[RecordT]):
    """A structure within the structure. Reading gives a record that shares its memory."""

    def __init__(self, kind: type[RecordT], doc: str) -> None:
        super().__init__(doc)
        self.kind = kind

    def read(self, value: Any) -> RecordT:
        return self.kind._view(value)

    def written(self, record: Record, value: RecordT) -> Any:
        if not isinstance(value, self.kind):
            raise self.refuse(value, self.kind.__name__)
        return value._c


class IdField(RecordDescriptor[IdT, IdT], Generic[IdT]):
    """An id."""

    def __init__(self, kind: type[IdT], doc: str) -> None:
        super().__init__(doc)
        self.kind = kind

    def read(self, value: Any) -> IdT:
        return self.kind(value.bits)

    def written(self, record: Record, value: IdT) -> Any:
        if type(value) is not self.kind:
            raise self.refuse(value, self.kind.__name__)
        return value._value()


class Table:
    """Many C structures. data is the structured numpy array of them; attributes are views of its columns."""

    __slots__ = ("data",)
    _STRUCT: ClassVar[type[ctypes.Structure]]
    data: npt.NDArray[Any]

    def __init__(self, data: npt.NDArray[Any]) -> None:
        expected = dtype_of(self._STRUCT)
        if data.dtype != expected or data.ndim != 1:
            raise TypeError(f"{type(self).__name__}: an array of {data.dtype} and {data.ndim} dimensions; one of {expected} expected")
        self.data = data

    @classmethod
    def _zeros(cls: type[TableT], count: int) -> TableT:
        return cls(np.zeros(count, dtype=dtype_of(cls._STRUCT)))

    def __len__(self) -> int:
        return len(self.data)

    def __getitem__(self: TableT, index: slice | npt.NDArray[Any] | list[int]) -> TableT:
        if isinstance(index, (int, np.integer)):
            raise TypeError(f"{type(self).__name__}: index {index}; a slice, a mask or a list of rows expected (or an index of .data)")
        return type(self)(self.data[index])

    def __repr__(self) -> str:
        return f"{type(self).__name__}({len(self)})"


class Column(Generic[T]):
    """A column of a table: a view, so that writing to it changes the table."""

    def __init__(self, doc: str) -> None:
        self.__doc__ = doc
        self.name = ""

    def __set_name__(self, owner: type[Table], name: str) -> None:
        self.name = name

    @overload
    def __get__(self, table: None, owner: type) -> Column[T]: ...
    @overload
    def __get__(self, table: Table, owner: type) -> T: ...
    def __get__(self, table: Table | None, owner: type) -> Any:
        return self if table is None else self.read(table.data[self.name])

    def read(self, column: npt.NDArray[Any]) -> Any:
        """The column as Python has it."""
        return column


class FloatColumn(Column[npt.NDArray[np.float64]]):
    """Numbers, or a row of numbers each."""


class UintColumn(Column[npt.NDArray[np.uint32]]):
    """Whole numbers."""


class IntColumn(Column[npt.NDArray[np.int32]]):
    """Whole numbers."""


class FrameColumn(Column[npt.NDArray[np.float64]]):
    """Frames: rows of origin and quaternion, seven numbers."""

    def read(self, column: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
        return np.concatenate([column["origin"], column["rotation"]], axis=-1)


class IdColumn(Column[IdsT], Generic[IdsT]):
    """Ids."""

    def __init__(self, kind: type[IdsT], doc: str) -> None:
        super().__init__(doc)
        self.kind = kind

    def read(self, column: npt.NDArray[Any]) -> IdsT:
        return self.kind(column["bits"])
