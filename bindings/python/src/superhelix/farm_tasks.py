"""Tasks of a farm: a piece of work that can run anywhere by itself, and its result. Nothing here needs Dask.

A task is one of

- :class:`Scene`: a scene file for ``superhelix run``, possibly with other settings, possibly in several parts that go on from snapshots;
- :class:`Command`: another command line, such as ``superhelix simulate``;
- :class:`Call`: a Python function.

Each is a value that can be pickled, and does the same wherever it is done: results are compared by their hashes.
"""

from __future__ import annotations

import copy
import ctypes
import functools
import hashlib
import itertools
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

__all__ = ["Call", "Command", "FarmError", "Outcome", "Scene", "Task", "do_part", "join_parts", "wedge"]

BAD_SCENE = 2  # the exit status of `superhelix run` for a scene that no second try makes better


class FarmError(Exception):
    """A task that cannot be done: the same would happen again."""


@dataclass(frozen=True)
class Outcome:
    """The result of a task."""

    name: str
    settings: dict[str, Any]
    hash: str | None = None
    """SHA-256 of what the task made, without what clocks say; None where it failed."""
    result: Any = None
    """The file of the result (scenes), what the command said or the function returned (as JSON)."""
    seconds: float = 0.0
    """Wall time of all parts together, s."""
    attempts: int = 0
    """How often a part was begun; more than there are parts where workers died or parts failed."""
    error: str | None = None
    """Why it failed, or None."""

    def as_json(self) -> dict[str, Any]:
        """For the list of results."""
        return asdict(self)


@dataclass(frozen=True)
class Scene:
    """A scene for ``superhelix run``.

    Args:
        name: Names the task and its folder; letters, digits, ``-``, ``_``, ``.`` and ``=``.
        scene: The scene's keys, or the path of its file.
        settings: Keys of the scene that are set to other values, by dotted paths: ``"time_step"``, ``"strands.*.air_drag"`` (of all strands).
        parts: In how many parts it is run, one after the other, each going on from the snapshot of the one before. A worker that dies costs
            its part, not the run.
        arguments: More arguments of ``superhelix run``, such as ``("--settle",)``.
    """

    name: str
    scene: Mapping[str, Any] | str | os.PathLike[str]
    settings: Mapping[str, Any] = field(default_factory=dict)
    parts: int = 1
    arguments: tuple[str, ...] = ()


@dataclass(frozen=True)
class Command:
    """A command of the binary. ``{out}`` in an argument is the task's own folder; what it writes there is hashed.

    Args:
        name: As of :class:`Scene`.
        arguments: ``("simulate", "/shots/head.tfx", "--out", "{out}/cache")``. Paths should be whole: workers have directories of their own.
        settings: Flags that are added, ``{"--substeps": 2, "--bare": True}``; True is a flag without a value, False one that is left out.
    """

    name: str
    arguments: tuple[str, ...]
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Call:
    """A Python function that workers can import, called with ``settings`` as keyword arguments. It returns what JSON can hold."""

    name: str
    function: Callable[..., Any]
    settings: Mapping[str, Any] = field(default_factory=dict)


Task = Scene | Command | Call


def wedge(task: Task, values: Mapping[str, Sequence[Any]]) -> list[Any]:
    """A task for every combination of settings.

    >>> [each.name for each in wedge(Scene("walk", "walk.json"), {"time_step": [0.01, 0.02], "integrator": ["implicit_euler"]})]
    ['walk-time_step=0.01-integrator=implicit_euler', 'walk-time_step=0.02-integrator=implicit_euler']
    """
    for key, each in values.items():
        if isinstance(each, str) or not isinstance(each, Sequence) or not each:
            raise FarmError(f"values[{key!r}] is {each!r}: a list of at least one value is expected")
    combinations = [dict(zip(values, combination, strict=True)) for combination in itertools.product(*values.values())]
    return [
        replace(task, name="-".join([task.name, *(label(key, value) for key, value in settings.items())]), settings={**task.settings, **settings})
        for settings in combinations
    ]


def label(key: str, value: Any) -> str:
    """A setting as a part of a name that is also a folder's."""
    text = value if isinstance(value, str) else json.dumps(value)
    return "".join(letter if letter.isalnum() or letter in "._=" else "_" for letter in f"{key.strip('-')}={text}")


def check(tasks: Sequence[Task]) -> None:
    """Refuses tasks that would interfere with each other."""
    seen = set()
    for task in tasks:
        if not task.name or not all(letter.isalnum() or letter in "-._=" for letter in task.name) or task.name.startswith("."):
            raise FarmError(f"task {task.name!r}: a name has letters, digits, -, _, . and =, and does not begin with a dot")
        if task.name in seen:
            raise FarmError(f"two tasks are named {task.name!r}")
        seen.add(task.name)
        if isinstance(task, Scene) and task.parts < 1:
            raise FarmError(f"task {task.name!r}: parts is {task.parts}; 1 or more is expected")


def number_of_parts(task: Task) -> int:
    """How many pieces of work it is."""
    return task.parts if isinstance(task, Scene) else 1


# --- doing them ---------------------------------------------------------------------------------------------------------------------------------


def do_part(task: Task, part: int, folder: str, binary: str, before: Any = None) -> dict[str, Any]:
    """Does a part of a task, on whatever machine this is, and reports its result. ``before`` (the part before) is only waited for.

    A part that was done before, with the same inputs and the same binary, is not done again.

    Raises:
        RuntimeError: It failed in a way that another try may not (a signal, a full disk).
    """
    if isinstance(before, Mapping) and before["error"] is not None:
        return dict(before)
    place = Path(folder) / task.name
    place.mkdir(parents=True, exist_ok=True)
    with open(place / f"part{part:03}.attempts", "a", encoding="utf-8") as attempts:
        attempts.write(f"{time.time():.3f} {os.uname().nodename if hasattr(os, 'uname') else ''} {os.getpid()}\n")
    began = time.perf_counter()
    try:
        done = {Scene: do_scene, Command: do_command, Call: do_call}[type(task)](task, part, place, binary)  # type: ignore[operator]
    except FarmError as error:
        done = {"error": str(error)}
    return {"error": None, "seconds": time.perf_counter() - began, **done}


def do_scene(task: Scene, part: int, place: Path, binary: str) -> dict[str, Any]:
    """Runs from the snapshot of the part before to this part's last state."""
    scene = scene_of(task)
    text = json.dumps(scene)
    states = count_states(scene)
    parts = min(task.parts, states)
    if part >= parts:
        return {"file": None}
    last = states * (part + 1) // parts - 1
    arguments = ["--until", str(last), "--quiet", *task.arguments]
    snapshot = place / f"part{part:03}.shxrun"
    if parts > 1:
        arguments += ["--snapshot", str(snapshot)]
    if part > 0:
        arguments += ["--resume", str(place / f"part{part - 1:03}.shxrun")]
    out, key_file = place / f"part{part:03}.json", place / f"part{part:03}.key"
    key = hashlib.sha256("\0".join([text, *arguments, digest_of_binary(binary)]).encode()).hexdigest()
    if out.exists() and key_file.exists() and key_file.read_text(encoding="utf-8") == key and (parts == 1 or snapshot.exists()):
        return {"file": str(out)}
    path = place / "scene.json"
    # Two attempts at once would write the same.
    write(path, text)
    run_binary([binary, "run", str(path), "--out", str(out), *arguments])
    write(key_file, key)
    return {"file": str(out)}


def do_command(task: Command, _part: int, place: Path, binary: str) -> dict[str, Any]:
    """Runs the command in an empty folder, whose files are hashed by their names and bytes."""
    out = place / "out"
    # Leftovers of a worker that died.
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir()
    flags = [word for key, value in task.settings.items() if value is not False for word in ([key] if value is True else [key, str(value)])]
    said = run_binary([binary, *(argument.replace("{out}", str(out)) for argument in task.arguments), *flags])
    digest = hashlib.sha256()
    for path in sorted(each for each in out.rglob("*") if each.is_file()):
        content = path.read_bytes()
        digest.update(f"{path.relative_to(out).as_posix()}\0{len(content)}\0".encode() + content)
    try:
        told = json.loads(said)
    except ValueError:
        told = said
    return {"hash": digest.hexdigest(), "value": told}


def do_call(task: Call, _part: int, _place: Path, _binary: str) -> dict[str, Any]:
    """Calls the function; its exceptions are tried again."""
    value = task.function(**task.settings)
    try:
        text = canonical(value)
    except (TypeError, ValueError) as error:
        raise FarmError(f"{task.name}: what {task.function.__qualname__} returned is nothing that JSON holds: {error}") from error
    return {"hash": hashlib.sha256(text.encode()).hexdigest(), "value": value}


def run_binary(command: list[str]) -> str:
    """Standard output of a command that ends well."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, preexec_fn=die_with_worker())
    except FileNotFoundError as error:
        raise FarmError(f"{command[0]}: not found on this worker: {error}") from error
    if done.returncode == 0:
        return done.stdout
    said = done.stderr.strip() or f"exit status {done.returncode}"
    if done.returncode == BAD_SCENE:
        raise FarmError(said)
    raise RuntimeError(said)


def die_with_worker() -> Callable[[], None] | None:
    """On Linux: makes a child end with the worker that started it, so that no work is done twice."""
    if sys.platform != "linux":
        return None
    prctl = ctypes.CDLL(None).prctl
    return lambda: prctl(1, signal.SIGKILL) and None


# --- scenes -------------------------------------------------------------------------------------------------------------------------------------


def scene_of(task: Scene) -> dict[str, Any]:
    """The scene's keys with the settings in their places. Names of files that are there beside the scene become whole paths."""
    if isinstance(task.scene, Mapping):
        scene, home = copy.deepcopy(dict(task.scene)), Path.cwd()
    else:
        path = Path(task.scene)
        try:
            scene, home = json.loads(without_comments(path.read_text(encoding="utf-8"))), path.resolve().parent
        except (OSError, ValueError) as error:
            raise FarmError(f"{path}: {error}") from error
    for key, value in task.settings.items():
        set_key(scene, key.split("."), value, key)
    return dict(with_whole_paths(scene, home))


def set_key(node: Any, path: list[str], value: Any, whole: str) -> None:
    """Sets what a dotted path names; ``*`` is every entry of a list. A last key that is not there is made."""
    first, rest = path[0], path[1:]
    if isinstance(node, list):
        if first != "*" and not (first.isdecimal() and int(first) < len(node)):
            raise FarmError(f"setting {whole!r}: {first!r} is neither * nor a place in a list of {len(node)}")
        places: list[Any] = list(range(len(node))) if first == "*" else [int(first)]
    elif isinstance(node, dict):
        if rest and first not in node:
            node[first] = {}
        places = [first]
    else:
        raise FarmError(f"setting {whole!r}: there is nothing to hold {first!r}")
    for place in places:
        if rest:
            set_key(node[place], rest, value, whole)
        else:
            node[place] = value


def with_whole_paths(node: Any, home: Path) -> Any:
    """The same with whole paths for texts that name files in ``home``."""
    if isinstance(node, dict):
        return {key: with_whole_paths(value, home) for key, value in node.items()}
    if isinstance(node, list):
        return [with_whole_paths(value, home) for value in node]
    if isinstance(node, str) and node and (home / node).exists():
        return str(home / node)
    return node


def without_comments(text: str) -> str:
    """JSON without // and /* */, which scene files may have."""

    def pieces() -> Iterator[str]:
        at = 0
        while at < len(text):
            if text[at] == '"':
                end = at + 1
                while end < len(text) and text[end] != '"':
                    end += 2 if text[end] == "\\" else 1
                yield text[at : end + 1]
                at = end + 1
            elif text.startswith("//", at):
                end = text.find("\n", at)
                at = len(text) if end < 0 else end
            elif text.startswith("/*", at):
                end = text.find("*/", at + 2)
                if end < 0:
                    raise ValueError("a comment has no end")
                at = end + 2
            else:
                yield text[at]
                at += 1

    return "".join(pieces())


def count_states(scene: Mapping[str, Any]) -> int:
    """How many states ``superhelix run`` writes: at 0, at each multiple of the interval below the duration, and at its end."""
    try:
        duration, interval = float(scene["duration"]), float(scene["output_interval"])
        whole = int(duration / interval + 1e-9)
    except (KeyError, TypeError, ValueError, ZeroDivisionError, OverflowError) as error:
        raise FarmError(f"the scene's duration and output_interval: {error!r}") from error
    return 1 + whole + (duration - whole * interval > max(1e-9 * interval, 1e-9))


# --- results ------------------------------------------------------------------------------------------------------------------------------------


def join_parts(results: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """The results of the parts of a run as that of the whole. Of ``report`` the counts are added and the largest are kept."""
    joined: dict[str, Any] = copy.deepcopy(dict(results[0]))
    for later in results[1:]:
        for key in ("times", "energies", "contacts"):
            if key in joined:
                joined[key] = joined[key] + later[key]
        for key in ("strands", "colliders", "attachments"):
            for thing, more in zip(joined.get(key, []), later.get(key, []), strict=True):
                for name in thing:
                    thing[name] = thing[name] + more[name]
        joined["state_hash"] = later["state_hash"]
        join_reports(joined["report"], later["report"])
    return joined


def join_reports(report: dict[str, Any], later: Mapping[str, Any]) -> None:
    """Adds the later report to the other."""
    steps, more = report["steps"], later["steps"]
    for key, value in later.items():
        if isinstance(value, Mapping):
            mean = "contacts_mean"
            both = (report[key][mean] * steps + value[mean] * more) / max(steps + more, 1)
            for name, number in value.items():
                report[key][name] = max(report[key][name], number) if name.endswith("_max") else report[key][name] + number
            report[key][mean] = both
        elif key.endswith("_mean"):
            report[key] = (report[key] * steps + value * more) / max(steps + more, 1)
        elif key.endswith("_max") or key == "error_max":
            report[key] = max(report[key], value)
        elif key != "steps":
            report[key] += value
    report["steps"] = steps + more


def finish(task: Task, parts: Sequence[Mapping[str, Any]], folder: str) -> Outcome:
    """Gathers the results of a task's parts."""
    place = Path(folder) / task.name
    attempts = sum(len(path.read_text(encoding="utf-8").splitlines()) for path in place.glob("part*.attempts"))
    seconds = sum(part.get("seconds", 0.0) for part in parts)
    told = {"name": task.name, "settings": dict(task.settings), "seconds": seconds, "attempts": attempts}
    failed = next((part["error"] for part in parts if part["error"] is not None), None)
    if failed is not None:
        return Outcome(**told, error=failed)
    if not isinstance(task, Scene):
        return Outcome(**told, hash=parts[0]["hash"], result=parts[0]["value"])
    files = [part["file"] for part in parts if part["file"] is not None]
    joined = join_parts([json.loads(Path(file).read_text(encoding="utf-8")) for file in files])
    out = place / "result.json"
    write(out, json.dumps(joined))
    # The numbers of steps and seconds are not part of the result.
    digest = hashlib.sha256(canonical({key: value for key, value in joined.items() if key != "report"}).encode()).hexdigest()
    return Outcome(**told, hash=digest, result=str(out))


def canonical(value: Any) -> str:
    """The same text for the same numbers, to the bit."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"))


def write(path: Path, text: str) -> None:
    """Writes a file whole or not at all."""
    neighbour = path.with_name(f".{path.name}.{os.uname().nodename if hasattr(os, 'uname') else ''}.{os.getpid()}")
    neighbour.write_text(text, encoding="utf-8")
    neighbour.replace(path)


@functools.cache
def digest_of_binary(binary: str) -> str:
    """The build: another one may give other numbers."""
    try:
        return hashlib.sha256(Path(binary).read_bytes()).hexdigest()
    except OSError as error:
        raise FarmError(f"{binary}: not there on this worker: {error}") from error
