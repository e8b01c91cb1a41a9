"""Exceptions: a class for each error code of the C library, with the library's text.

The text names the function, the argument and its value. Each class is also what Python programs expect: a value out of range is a
ValueError, a file that cannot be read an OSError, and so on. A call that raises has changed nothing.
"""

from __future__ import annotations

import ctypes

from superhelix import _capi
from superhelix._library import functions


class SuperhelixError(Exception):
    """Any error that the library reports. code is the C result code, name its name."""

    code: int = 0

    def __init__(self, message: str, code: int | None = None) -> None:
        super().__init__(message)
        if code is not None:
            self.code = code

    @property
    def name(self) -> str:
        """The name of the result code, such as "SHX_ERROR_BUSY"."""
        return functions.shx_result_name(self.code).decode()


class NullArgumentError(SuperhelixError, TypeError):
    """A required argument is missing."""

    code = _capi.SHX_ERROR_NULL_ARGUMENT


class InvalidArgumentError(SuperhelixError, ValueError):
    """A value is out of range."""

    code = _capi.SHX_ERROR_INVALID_ARGUMENT


class InvalidIdError(SuperhelixError, LookupError):
    """An id names nothing in this solver: null, of something removed, or of another solver."""

    code = _capi.SHX_ERROR_INVALID_ID


class StructSizeError(SuperhelixError):
    """A structure is not one that this library can read."""

    code = _capi.SHX_ERROR_STRUCT_SIZE


class BufferTooSmallError(SuperhelixError, ValueError):
    """An output array has too few items."""

    code = _capi.SHX_ERROR_BUFFER_TOO_SMALL


class BusyError(SuperhelixError, RuntimeError):
    """The solver is in use: by one of its own callbacks, or by another thread."""

    code = _capi.SHX_ERROR_BUSY


class SnapshotError(SuperhelixError, ValueError):
    """Bytes that are no snapshot, are damaged, or come from another version."""

    code = _capi.SHX_ERROR_SNAPSHOT


class OutOfMemoryError(SuperhelixError, MemoryError):
    """There is not enough memory."""

    code = _capi.SHX_ERROR_OUT_OF_MEMORY


class UnsupportedError(SuperhelixError, NotImplementedError):
    """This version of the library does not do that."""

    code = _capi.SHX_ERROR_UNSUPPORTED


class FileError(SuperhelixError, OSError):
    """A file could not be read, written or understood."""

    code = _capi.SHX_ERROR_FILE


class InternalError(SuperhelixError, RuntimeError):
    """A bug of the library. The solver of that call is poisoned: close it."""

    code = _capi.SHX_ERROR_INTERNAL


class PoisonedError(SuperhelixError, RuntimeError):
    """An earlier InternalError left this solver in an unknown state. It can only be closed."""

    code = _capi.SHX_ERROR_POISONED


CLASSES: dict[int, type[SuperhelixError]] = {
    cls.code: cls
    for cls in (
        NullArgumentError,
        InvalidArgumentError,
        InvalidIdError,
        StructSizeError,
        BufferTooSmallError,
        BusyError,
        SnapshotError,
        OutOfMemoryError,
        UnsupportedError,
        FileError,
        InternalError,
        PoisonedError,
    )
}


def last_error() -> str:
    """The text of the last error on this thread, or an empty string."""
    size = functions.shx_last_error(None, 0)
    buffer = ctypes.create_string_buffer(size + 1)
    functions.shx_last_error(buffer, size + 1)
    return buffer.value.decode("utf-8", "replace")


def error_of(result: int) -> SuperhelixError:
    """The exception for a result code, with the text of this thread's last error."""
    text = last_error() or functions.shx_result_name(result).decode()
    return CLASSES.get(result, SuperhelixError)(text, result)


def check(result: int) -> None:
    """Raises where a function's result is not success."""
    if result != _capi.SHX_OK:
        raise error_of(result)


__all__ = [
    "BufferTooSmallError",
    "BusyError",
    "FileError",
    "InternalError",
    "InvalidArgumentError",
    "InvalidIdError",
    "NullArgumentError",
    "OutOfMemoryError",
    "PoisonedError",
    "SnapshotError",
    "StructSizeError",
    "SuperhelixError",
    "UnsupportedError",
]
