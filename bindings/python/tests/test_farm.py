"""The farm gives the bits of a serial run, whichever workers die. Needs Dask and the superhelix binary (SUPERHELIX_BINARY)."""

from __future__ import annotations

import io
import json
import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

distributed = pytest.importorskip("distributed", reason="the farm's extra is not installed: pip install 'superhelix[farm]'")

from superhelix import farm  # noqa: E402
from superhelix.farm_tasks import count_states, join_parts, scene_of, set_key, without_comments  # noqa: E402

BINARY = os.environ.get("SUPERHELIX_BINARY")
needs_binary = pytest.mark.skipif(BINARY is None, reason="SUPERHELIX_BINARY names no superhelix program")


def strand(y: float) -> dict[str, Any]:
    """One of a few strands side by side."""
    return {
        "elements": 5,
        "length": 0.1,
        "radius": [60e-6, 50e-6],
        "density": 1300,
        "youngs_modulus": 2e9,
        "poisson_ratio": 0.4,
        "natural_curvatures": [[1.0, 12.0, 3.0]],
        "root": {"origin": [0.0, y, 0.0]},
    }


def scene(duration: float = 0.1, strands: int = 3) -> dict[str, Any]:
    """A scene whose strands fall on a ball."""
    return {
        "version": 1,
        "time_step": 0.01,
        "duration": duration,
        "output_interval": 0.01,
        "strands": [strand(0.002 * k) for k in range(strands)],
        "colliders": [{"shape": "sphere", "radius": 0.03, "pose": {"origin": [0.05, 0.0, -0.05]}}],
        "output": ["tips", "curvatures", "energies", "wrenches"],
    }


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    """Two workers that are processes of their own."""
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def hashes(outcomes: list[farm.Outcome]) -> dict[str, str | None]:
    """By the tasks' names; all must have ended well."""
    assert [outcome.error for outcome in outcomes] == [None] * len(outcomes)
    return {outcome.name: outcome.hash for outcome in outcomes}


# --- scenes ---


@needs_binary
def test_wedges_in_parts_give_what_a_serial_run_in_one_part_gives(client: Any, tmp_path: Path) -> None:
    values = {"strands.*.air_drag": [0.0, 1e-5], "time_step": [0.01, 0.005]}
    log = io.StringIO()
    parted = farm.run(farm.wedge(farm.Scene("fall", scene(), parts=3), values), tmp_path / "farm", client=client, log=log)
    serial = farm.run_serial(farm.wedge(farm.Scene("fall", scene()), values), tmp_path / "serial", log=None)
    assert hashes(parted) == hashes(serial)
    # Four settings, four results.
    assert len(set(hashes(parted).values())) == 4
    first = json.loads(Path(str(parted[0].result)).read_text(encoding="utf-8"))
    whole = json.loads(Path(str(serial[0].result)).read_text(encoding="utf-8"))
    assert len(first["times"]) == 11 and len(first["strands"][0]["tips"]) == 11
    assert first["state_hash"] == whole["state_hash"]
    for key in ("steps", "iterations_max", "unconverged", "subdivided"):
        assert first["report"][key] == whole["report"][key], key
    assert first["report"]["iterations_mean"] == pytest.approx(whole["report"]["iterations_mean"])
    listed = json.loads((tmp_path / "farm" / "results.json").read_text(encoding="utf-8"))
    assert [each["hash"] for each in listed] == [outcome.hash for outcome in parted]
    assert listed[3]["settings"] == {"strands.*.air_drag": 1e-5, "time_step": 0.005}
    assert "dashboard at http" in log.getvalue() and "4 of 4 tasks, 12 of 12 parts" in log.getvalue()


@needs_binary
def test_a_scene_whose_worker_is_killed_is_run_to_the_same_end(client: Any, tmp_path: Path) -> None:
    # Each part takes hundreds of times longer than the killer's polling interval.
    long = scene(duration=12.0, strands=60)
    killed: list[int] = []

    def kill() -> None:
        part = tmp_path / "farm" / "long" / "part001.attempts"
        while not part.exists() or not part.read_text(encoding="utf-8").endswith("\n"):
            time.sleep(0.001)
        pid = int(part.read_text(encoding="utf-8").split()[-1])
        os.kill(pid, signal.SIGKILL)
        killed.append(pid)

    killer = threading.Thread(target=kill, daemon=True)
    killer.start()
    outcomes = farm.run([farm.Scene("long", long, parts=2)], tmp_path / "farm", client=client, log=None)
    killer.join(10.0)
    assert killed and outcomes[0].attempts > 2, "the worker was not killed while it ran the part"
    serial = farm.run_serial([farm.Scene("long", long)], tmp_path / "serial", log=None)
    assert hashes(outcomes) == hashes(serial)


@needs_binary
def test_a_bad_scene_is_told_and_the_others_go_on(client: Any, tmp_path: Path) -> None:
    tasks = farm.wedge(farm.Scene("bad", scene(), parts=2), {"time_step": [-1.0, 0.01]})
    bad, good = farm.run(tasks, tmp_path, client=client, log=None)
    assert bad.hash is None and bad.error is not None and "time_step" in bad.error
    assert good.error is None and good.hash is not None


@needs_binary
def test_parts_that_were_done_are_not_done_again(client: Any, tmp_path: Path) -> None:
    tasks = [farm.Scene("once", scene(), parts=2)]
    first = farm.run(tasks, tmp_path, client=client, log=None)
    made = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("part*.json")}
    assert len(made) == 2
    again = farm.run(tasks, tmp_path, client=client, log=None)
    assert hashes(first) == hashes(again)
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("part*.json")} == made
    # Another scene of that name is another run.
    other = farm.run([farm.Scene("once", scene(duration=0.05), parts=2)], tmp_path, client=client, log=None)
    assert hashes(other) != hashes(first)


@needs_binary
def test_commands_are_hashed_by_their_files(client: Any, tmp_path: Path) -> None:
    lock = farm.Command("lock", ("lock", "--type", "african", "--strands", "3", "--length", "0.1", "--out", "{out}/lock.json"))
    tasks = farm.wedge(lock, {"--seed": [1, 2]})
    outcomes = farm.run(tasks, tmp_path / "farm", client=client, log=None)
    serial = farm.run_serial(tasks, tmp_path / "serial", log=None)
    assert hashes(outcomes) == hashes(serial)
    assert len(set(hashes(outcomes).values())) == 2


# --- Python functions ---


def wait_to_be_killed(marker: str, value: float) -> dict[str, float]:
    """Waits for ever the first time, and returns the second time."""
    path = Path(marker)
    if not path.exists():
        path.write_text(str(os.getpid()), encoding="utf-8")
        time.sleep(600.0)
    return {"square": value * value}


def always_fails() -> None:
    """Never ends well."""
    raise OSError("the disk is full")


def test_a_call_whose_worker_is_killed_is_made_again(client: Any, tmp_path: Path) -> None:
    marker = tmp_path / "marker"

    def kill() -> None:
        while not marker.exists() or not marker.read_text(encoding="utf-8"):
            time.sleep(0.02)
        os.kill(int(marker.read_text(encoding="utf-8")), signal.SIGKILL)

    threading.Thread(target=kill, daemon=True).start()
    call = farm.Call("call", wait_to_be_killed, {"marker": str(marker), "value": 0.1})
    outcomes = farm.run([call], tmp_path / "farm", client=client, log=None)
    assert outcomes[0].result == {"square": 0.1 * 0.1} and outcomes[0].attempts == 2
    assert hashes(outcomes) == hashes(farm.run_serial([call], tmp_path / "serial", log=None))


def test_what_always_fails_is_given_up_and_told(client: Any, tmp_path: Path) -> None:
    tasks = [farm.Call("fails", always_fails), farm.Call("good", dict, {"a": 1})]
    failed, good = farm.run(tasks, tmp_path, client=client, retries=1, log=None)
    assert failed.error == "OSError: the disk is full" and failed.attempts == 2 and failed.hash is None
    assert good.result == {"a": 1}


def test_a_cluster_of_its_own(tmp_path: Path) -> None:
    log = io.StringIO()
    outcomes = farm.run([farm.Call(f"call{k}", dict, {"k": k}) for k in range(3)], tmp_path, workers=1, log=log)
    assert [outcome.result for outcome in outcomes] == [{"k": 0}, {"k": 1}, {"k": 2}]
    assert "dashboard at http" in log.getvalue()


# --- what needs no cluster ---


def test_tasks_that_get_in_each_others_way_are_refused(tmp_path: Path) -> None:
    for tasks, text in (
        ([farm.Call("a", dict), farm.Call("a", dict)], "two tasks are named 'a'"),
        ([farm.Call("a/b", dict)], "'a/b'"),
        ([farm.Call("", dict)], "''"),
        ([farm.Scene("a", {}, parts=0)], "parts is 0"),
    ):
        with pytest.raises(farm.FarmError, match=text):
            farm.run_serial(tasks, tmp_path)
    with pytest.raises(farm.FarmError, match="no-such-program"):
        farm.run_serial([farm.Scene("a", {})], tmp_path, binary="no-such-program")
    with pytest.raises(farm.FarmError, match=r"values\['a'\] is \[\]"):
        farm.wedge(farm.Scene("a", {}), {"a": []})


def test_settings_go_to_their_places(tmp_path: Path) -> None:
    (tmp_path / "groom.hair").write_bytes(b"")
    path = tmp_path / "scene.json"
    path.write_text('{ // a comment\n "a": [{"b": 1}, {"b": 2}], "file": "groom.hair", "url": "http://x /* no comment */" }', encoding="utf-8")
    made = scene_of(farm.Scene("x", path, settings={"a.*.b": 3, "a.1.c": 4, "new.key": [1]}))
    assert made["a"] == [{"b": 3}, {"b": 3, "c": 4}] and made["new"] == {"key": [1]}
    assert made["file"] == str(tmp_path / "groom.hair") and made["url"] == "http://x /* no comment */"
    with pytest.raises(farm.FarmError, match=r"'a\.7\.b'"):
        set_key(made, ["a", "7", "b"], 0, "a.7.b")
    with pytest.raises(ValueError, match="no end"):
        without_comments("{ /* }")


@pytest.mark.parametrize(
    ("duration", "interval", "count"), [(0.0, 0.1, 1), (1.0, 0.1, 11), (1.0, 0.4, 4), (1.0, 0.016666, 62), (0.1 + 5e-10, 0.1, 2), (0.1, 7.0, 2)]
)
def test_states_are_counted_as_the_program_writes_them(duration: float, interval: float, count: int) -> None:
    assert count_states({"duration": duration, "output_interval": interval}) == count


def test_reports_of_parts_are_joined() -> None:
    def part(time: float, steps: int, mean: float, most: float) -> dict[str, Any]:
        contact = {"contacts_mean": mean, "contacts_max": most, "sweeps": steps}
        report = {"steps": steps, "iterations_mean": mean, "iterations_max": most, "unconverged": 1, "error_max": most, "contact": contact}
        return {"times": [time], "strands": [{"tips": [[time]]}], "report": report, "state_hash": str(time)}

    joined = join_parts([part(0.0, 1, 2.0, 5), part(1.0, 3, 4.0, 3)])
    assert joined["times"] == [0.0, 1.0] and joined["strands"] == [{"tips": [[0.0], [1.0]]}] and joined["state_hash"] == "1.0"
    report = joined["report"]
    assert (report["steps"], report["iterations_mean"], report["iterations_max"], report["unconverged"]) == (4, 3.5, 5, 2)
    assert report["contact"] == {"contacts_mean": 3.5, "contacts_max": 5, "sweeps": 4}
