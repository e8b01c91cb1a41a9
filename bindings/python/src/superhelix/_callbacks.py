"""The host's functions that the library calls: a parallel loop and a log.

An exception in one does not cross the library: it is kept, and raised by the call that it happened in when that returns.
"""

from __future__ import annotations

import concurrent.futures
import ctypes
import logging
import threading
from collections.abc import Callable
from typing import Any, Protocol

from superhelix import _capi
from superhelix.enums import LogLevel


class Run(Protocol):
    """A parallel loop calls this, from any of its threads, for a range of items: begin to end - 1. worker is any number that no other thread
    has at the same time.
    """

    def __call__(self, begin: int, end: int, worker: int) -> None: ...


#: A parallel loop: calls run(begin, end, worker) over ranges of min_range items or more that cover 0 to count - 1.
ParallelFor = Callable[[int, int, Run], None]

#: Receives messages.
Log = Callable[[LogLevel, str], None]

_RANGE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_uint32, ctypes.c_uint32, ctypes.c_uint32)


class Failures:
    """Exceptions of callbacks, by the thread that they happened on: callbacks run on the thread that called the library."""

    __slots__ = ("_by_thread", "any")

    def __init__(self) -> None:
        self._by_thread: dict[int, BaseException] = {}
        #: Whether there may be some: checked after every call.
        self.any = False

    def keep(self, error: BaseException) -> None:
        """Keeps the first exception of this thread."""
        self._by_thread.setdefault(threading.get_ident(), error)
        self.any = True

    def take(self) -> BaseException | None:
        """This thread's exception, which is then forgotten."""
        error = self._by_thread.pop(threading.get_ident(), None)
        self.any = bool(self._by_thread)
        return error


class _Loop:
    """One call of a parallel loop. It outlasts every call of run, also where the host's function raises or returns early."""

    def __init__(self, function: int, task: int | None) -> None:
        self._function = _RANGE(function)
        self._task = task
        self._state = threading.Condition()
        self._running = 0
        self._over = False

    def run(self, begin: int, end: int, worker: int) -> None:
        """Does items begin to end - 1."""
        with self._state:
            if self._over:
                raise RuntimeError("run was called after the parallel loop had returned")
            self._running += 1
        try:
            self._function(self._task, begin, end, worker)
        finally:
            with self._state:
                self._running -= 1
                self._state.notify_all()

    def finish(self) -> None:
        """Waits for the calls that still run, and refuses later ones."""
        with self._state:
            self._over = True
            self._state.wait_for(lambda: self._running == 0)


def parallel_for_callback(loop: ParallelFor, failures: Failures) -> Any:
    """A host's parallel loop as a C callback."""

    def callback(_user: object, count: int, min_range: int, function: int, task: int | None) -> None:
        one = _Loop(function, task)
        try:
            loop(count, min_range, one.run)
        except BaseException as error:  # raised again by the call that this happened in
            failures.keep(error)
        finally:
            one.finish()

    return _capi.shx_parallel_for_fn(callback)


def log_callback(log: Log, failures: Failures) -> Any:
    """A host's log as a C callback."""

    def callback(_user: object, level: int, message: bytes) -> None:
        try:
            log(LogLevel(level), message.decode("utf-8", "replace"))
        except BaseException as error:  # raised again by the call that this happened in
            failures.keep(error)

    return _capi.shx_log_fn(callback)


def parallel_for_on(executor: concurrent.futures.Executor, workers: int) -> ParallelFor:
    """A parallel loop on an executor of threads, in as many ranges as there are workers or fewer."""
    if workers < 1:
        raise ValueError(f"workers: {workers}; at least 1 expected")

    def loop(count: int, min_range: int, run: Run) -> None:
        ranges = max(1, min(workers, count // max(1, min_range)))
        bounds = [count * part // ranges for part in range(ranges + 1)]
        tasks = [executor.submit(run, bounds[part], bounds[part + 1], part) for part in range(1, ranges)]
        run(bounds[0], bounds[1], 0)
        for task in tasks:
            task.result()

    return loop


_LEVELS = {LogLevel.ERROR: logging.ERROR, LogLevel.WARN: logging.WARNING, LogLevel.INFO: logging.INFO, LogLevel.DEBUG: logging.DEBUG}


def log_to_logging(level: LogLevel, message: str) -> None:
    """A log that hands messages to Python's logging, logger "superhelix"."""
    logging.getLogger("superhelix").log(_LEVELS[level], "%s", message)


def attach(structure: Any, name: str, callback: Any) -> None:
    """Puts a callback into a structure's field, which then keeps it alive."""
    setattr(structure, name, ctypes.cast(callback, ctypes.c_void_p))
