"""Ids: names of strands, bodies and constraints of one solver.

A StrandId is no BodyId: type checkers refuse one in place of the other, and so do the functions at run time. StrandIds holds many in an
array and is indexed like one: ids[3] is a StrandId, ids[10:20] and ids[mask] are StrandIds.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterable, Iterator
from typing import Any, ClassVar, Generic, TypeVar, overload

import numpy as np
import numpy.typing as npt

from superhelix import _capi

IdT = TypeVar("IdT", bound="Id")
IdsT = TypeVar("IdsT", bound="Ids[Any]")


class Id:
    """Names one thing of one solver. Hashable; the null id is false."""

    __slots__ = ("bits",)
    _STRUCT: ClassVar[type[ctypes.Structure]]
    bits: int

    def __init__(self, bits: int = 0) -> None:
        object.__setattr__(self, "bits", int(bits))

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"{type(self).__name__} cannot be changed")

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and isinstance(other, Id) and other.bits == self.bits

    def __hash__(self) -> int:
        return hash((type(self).__name__, self.bits))

    def __bool__(self) -> bool:
        return self.bits != 0

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.bits:#x})"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.bits,)

    def _value(self) -> Any:
        """The structure that C functions take."""
        return self._STRUCT(self.bits)


class StrandId(Id):
    """Names a strand of one solver."""

    __slots__ = ()
    _STRUCT = _capi.shx_strand_id


class BodyId(Id):
    """Names a body of one solver."""

    __slots__ = ()
    _STRUCT = _capi.shx_body_id


class ConstraintId(Id):
    """Names a constraint of one solver."""

    __slots__ = ()
    _STRUCT = _capi.shx_constraint_id


class Ids(Generic[IdT]):
    """Many ids. bits is the array of their values, as C functions take it."""

    __slots__ = ("bits",)
    _ID: ClassVar[type[Any]]
    bits: npt.NDArray[np.uint64]

    def __init__(self, ids: Iterable[IdT] | npt.NDArray[np.uint64] = ()) -> None:
        if isinstance(ids, np.ndarray):
            if ids.dtype != np.uint64:
                raise TypeError(f"{type(self).__name__}: an array of {ids.dtype}; uint64 expected")
            self.bits = np.ascontiguousarray(ids).reshape(-1)
            return
        listed = list(ids)
        for one in listed:
            if type(one) is not self._ID:
                raise TypeError(f"{type(self).__name__}: {one!r} is no {self._ID.__name__}")
        self.bits = np.array([one.bits for one in listed], dtype=np.uint64)

    @classmethod
    def _of(cls: type[IdsT], ids: object) -> IdsT:
        """A function's argument as an array of ids; raises for anything else."""
        if isinstance(ids, cls):
            return ids
        if isinstance(ids, cls._ID):
            return cls([ids])
        if isinstance(ids, (list, tuple)):
            return cls(ids)
        raise TypeError(f"ids: {type(ids).__name__}; {cls.__name__} or {cls._ID.__name__} expected")

    def __len__(self) -> int:
        return len(self.bits)

    def __iter__(self) -> Iterator[IdT]:
        return (self._ID(bits) for bits in self.bits.tolist())

    @overload
    def __getitem__(self: IdsT, index: slice | npt.NDArray[Any] | list[int]) -> IdsT: ...
    @overload
    def __getitem__(self, index: int) -> IdT: ...
    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, (int, np.integer)):
            return self._ID(int(self.bits[index]))
        return type(self)(self.bits[index])

    def __add__(self: IdsT, other: IdsT) -> IdsT:
        if type(other) is not type(self):
            return NotImplemented
        return type(self)(np.concatenate([self.bits, other.bits]))

    def __contains__(self, one: object) -> bool:
        return isinstance(one, Id) and type(one) is self._ID and bool((self.bits == np.uint64(one.bits)).any())

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and isinstance(other, Ids) and np.array_equal(self.bits, other.bits)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({len(self)})"


class StrandIds(Ids[StrandId]):
    """Many strands of one solver."""

    __slots__ = ()
    _ID = StrandId


class BodyIds(Ids[BodyId]):
    """Many bodies of one solver."""

    __slots__ = ()
    _ID = BodyId


class ConstraintIds(Ids[ConstraintId]):
    """Many constraints of one solver."""

    __slots__ = ()
    _ID = ConstraintId
