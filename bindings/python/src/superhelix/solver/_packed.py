"""Records side by side, as functions with a stride take them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from superhelix._record import Record

RecordT = TypeVar("RecordT", bound=Record)


def packed(name: str, records: RecordT | Sequence[RecordT], kind: type[RecordT], count: int | None) -> tuple[npt.NDArray[np.uint8], int, int]:
    """The bytes of one record, or of count records; the size of one; how many there are."""
    listed: list[Any] = [records] if isinstance(records, kind) else list(records)  # type: ignore[arg-type]
    for place, record in enumerate(listed):
        if not isinstance(record, kind):
            raise TypeError(f"{name}[{place}]: {record!r}; {kind.__name__} expected")
    if count is not None and len(listed) != count and not isinstance(records, kind):
        raise ValueError(f"{name}: {len(listed)} {kind.__name__}; {count} expected")
    data = b"".join(bytes(record._c) for record in listed)
    return np.frombuffer(data, dtype=np.uint8), ctypes.sizeof(kind._STRUCT), len(listed)
