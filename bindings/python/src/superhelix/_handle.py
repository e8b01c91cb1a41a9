"""Handles: what the library makes, freed when nothing uses it any more."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from types import TracebackType
from typing import Any, TypeVar

from superhelix import _capi
from superhelix.errors import check

OwnerT = TypeVar("OwnerT", bound="Owner")


class Handle:
    """An opaque pointer. It frees what it points to when its last reference goes: a running call holds one, so that closing an object while
    another thread is within one of its functions frees it after that call.
    """

    __slots__ = ("_as_parameter_", "_destroy", "_kept")

    def __init__(self, address: int, destroy: Callable[[_capi.Pointer], Any], kept: object = None) -> None:
        self._as_parameter_ = ctypes.c_void_p(address)
        self._destroy = destroy
        self._kept = kept

    def forget(self) -> None:
        """Leaves what it points to to somebody who has freed it."""
        self._as_parameter_ = ctypes.c_void_p()

    def __del__(self) -> None:
        if getattr(self, "_as_parameter_", None):
            self._destroy(self._as_parameter_)


def made(destroy: Callable[[_capi.Pointer], Any], make: Callable[[_capi.Pointer], int], kept: object = None) -> Handle:
    """The handle that a function writes to its last argument."""
    pointer = ctypes.c_void_p()
    check(make(ctypes.byref(pointer)))
    if pointer.value is None:
        raise AssertionError("the library made a null handle")
    return Handle(pointer.value, destroy, kept)


class Owner:
    """A Python object around a handle: a context manager that closes it."""

    __slots__ = ("__weakref__", "_open")
    _open: Handle | None

    @property
    def _handle(self) -> Handle:
        handle = self._open
        if handle is None:
            raise ValueError(f"this {type(self).__name__} is closed")
        return handle

    @property
    def closed(self) -> bool:
        """Whether close was called."""
        return self._open is None

    def close(self) -> None:
        """Frees the library's memory. Closing twice is fine; using the object afterwards raises ValueError."""
        self._open = None

    def __enter__(self: OwnerT) -> OwnerT:
        self._handle  # noqa: B018 (raises when closed)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()
