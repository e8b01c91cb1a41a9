"""Many shots on many machines: tasks on the workers of a Dask cluster, with the bits that one machine would give.

    from superhelix import farm

    shots = [farm.Scene("walk", "walk.json", parts=4), farm.Scene("turn", "turn.json", parts=4)]
    tasks = [task for shot in shots for task in farm.wedge(shot, {"strands.*.air_drag": [0, 5e-6], "time_step": [1 / 120, 1 / 240]})]
    outcomes = farm.run(tasks, "out")                                   # all cores of this machine
    outcomes = farm.run(tasks, "/shared/out", client=Client("tcp://scheduler:8786"))

Needs ``pip install superhelix[farm]``. Workers need the ``superhelix`` binary and the output folder, at the same paths (a shared file system, or one
machine). ``out/NAME/`` has a task's files, ``out/results.json`` all outcomes. See docs/guide/farm.md.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import shutil
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from .farm_tasks import (
    Call,
    Command,
    FarmError,
    Outcome,
    Scene,
    Task,
    check,
    do_part,
    finish,
    number_of_parts,
    wedge,
    write,
)

if TYPE_CHECKING:
    from distributed import Client, Future

__all__ = ["Call", "Command", "FarmError", "Outcome", "Scene", "Task", "run", "run_serial", "wedge"]

RETRIES = 3


def run(
    tasks: Sequence[Task],
    out: str | os.PathLike[str],
    *,
    client: Client | None = None,
    workers: int | None = None,
    retries: int = RETRIES,
    binary: str | os.PathLike[str] | None = None,
    log: TextIO | None = sys.stderr,
) -> list[Outcome]:
    """Does all tasks on a cluster and gathers their results, in order.

    A task that fails does not stop the others: its outcome says why. One whose worker dies is done again by another worker, and so is one that fails
    for other reasons than its inputs. Parts that an earlier call has done are not done again.

    Args:
        tasks: What to do; names must differ.
        out: The folder for everything, made where there is none.
        client: A cluster's client; None: a cluster of this machine for the time of the call.
        workers: How many processes that cluster has; None: one for each core. Not with ``client``.
        retries: How often a part may lose its worker or fail before its task is given up.
        binary: The ``superhelix`` program; None: that of the environment variable SUPERHELIX_BINARY, or on the path.
        log: Where progress and the dashboard's address go; None: nowhere.

    Raises:
        FarmError: Tasks of the same name, names that are no folder's, no binary.
        ImportError: Dask is not installed.
    """
    check(tasks)
    if client is not None and workers is not None:
        raise FarmError(f"workers is {workers}, and a client of a cluster is given, which has its own")
    program = find_binary(binary) if any(not isinstance(task, Call) for task in tasks) else ""
    folder = str(Path(out).resolve())
    Path(folder).mkdir(parents=True, exist_ok=True)
    with connected(client, workers, retries) as cluster:
        if log is not None:
            print(f"farm: {len(tasks)} tasks, dashboard at {cluster.dashboard_link}", file=log, flush=True)
        chains = [submit(cluster, task, folder, program, retries) for task in tasks]
        follow(chains, log)
        outcomes = [gathered(task, chain, folder) for task, chain in zip(tasks, chains, strict=True)]
    return told(outcomes, folder)


def run_serial(
    tasks: Sequence[Task],
    out: str | os.PathLike[str],
    *,
    binary: str | os.PathLike[str] | None = None,
    log: TextIO | None = sys.stderr,
) -> list[Outcome]:
    """Does the same in this process, one task after the other, without Dask: the hashes are those of :func:`run`.

    Raises:
        FarmError: As :func:`run`.
    """
    check(tasks)
    program = find_binary(binary) if any(not isinstance(task, Call) for task in tasks) else ""
    folder = str(Path(out).resolve())
    Path(folder).mkdir(parents=True, exist_ok=True)
    outcomes = []
    for number, task in enumerate(tasks, 1):
        parts: list[dict[str, Any]] = []
        for part in range(number_of_parts(task)):
            try:
                parts.append(do_part(task, part, folder, program, parts[-1] if parts else None))
            except Exception as error:  # the same as a part that failed on a worker, with no other try
                parts.append({"error": f"{type(error).__name__}: {error}"})
        outcomes.append(finish(task, parts, folder))
        if log is not None:
            print(f"farm: {number} of {len(tasks)} tasks", file=log, flush=True)
    return told(outcomes, folder)


def find_binary(binary: str | os.PathLike[str] | None) -> str:
    """The program's whole path."""
    wanted = os.fspath(binary) if binary is not None else os.environ.get("SUPERHELIX_BINARY", "superhelix")
    found = shutil.which(wanted)
    if found is None:
        raise FarmError(f"binary is {wanted!r}: no such program; give binary=, or set SUPERHELIX_BINARY")
    return str(Path(found).resolve())


@contextlib.contextmanager
def connected(client: Client | None, workers: int | None, retries: int) -> Iterator[Client]:
    """The client given, or one of a cluster that lives as long as this."""
    dask, distributed = needed("dask"), needed("distributed")
    # How often a part may lose its worker is the scheduler's to know: that of a cluster that is given has it from its own configuration.
    with contextlib.ExitStack() as stack:
        if client is None:
            stack.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": retries}))
            cluster = distributed.LocalCluster(n_workers=workers or os.cpu_count() or 1, threads_per_worker=1, dashboard_address=":0")
            client = stack.enter_context(distributed.Client(stack.enter_context(cluster)))
        yield client


def needed(module: str) -> Any:
    """A module of the extra."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError("superhelix.farm needs Dask: pip install 'superhelix[farm]'") from error


def submit(cluster: Client, task: Task, folder: str, binary: str, retries: int) -> list[Future[Any]]:
    """Hands out the parts of a task, each of which waits for the one before."""
    chain: list[Future[Any]] = []
    for part in range(number_of_parts(task)):
        before = chain[-1] if chain else None
        # Impure: two calls of `run` with the same tasks are two.
        future = cluster.submit(do_part, task, part, folder, binary, before, pure=False, retries=retries, key=f"{task.name}-{part}-{time.time_ns()}")
        chain.append(future)
    return chain


def follow(chains: Sequence[Sequence[Future[Any]]], log: TextIO | None) -> None:
    """Waits for all, telling how far they are."""
    futures = [future for chain in chains for future in chain]
    last = {chain[-1].key for chain in chains}
    began, tasks_done, shown = time.monotonic(), 0, -1.0
    for done, future in enumerate(needed("distributed").as_completed(futures), 1):
        tasks_done += future.key in last
        now = time.monotonic()
        # A line a second is enough, and one at the end.
        if log is not None and (now - shown >= 1.0 or done == len(futures)):
            shown = now
            left = (now - began) / done * (len(futures) - done)
            print(f"farm: {tasks_done} of {len(chains)} tasks, {done} of {len(futures)} parts, about {left:.0f} s left", file=log, flush=True)


def gathered(task: Task, chain: Sequence[Future[Any]], folder: str) -> Outcome:
    """The outcome of a task, whether its parts finished or not."""
    parts = []
    for future in chain:
        try:
            parts.append(future.result())
        except Exception as error:  # whatever the part or its workers ended with is the task's outcome, not the farm's
            parts.append({"error": f"{type(error).__name__}: {error}"})
            break
    return finish(task, parts, folder)


def told(outcomes: list[Outcome], folder: str) -> list[Outcome]:
    """Writes the list of all outcomes."""
    write(Path(folder) / "results.json", json.dumps([outcome.as_json() for outcome in outcomes], indent=1) + "\n")
    return outcomes
