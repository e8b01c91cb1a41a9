"""The GIL is released, steps are cancelled, callbacks are safe."""

from __future__ import annotations

import concurrent.futures
import gc
import logging
import sys
import threading
import time
import weakref

import numpy as np
import pytest
from conftest import hanging

import superhelix as shx


def moving(count: int = 2000, **options) -> shx.Solver:
    solver = shx.Solver(**options)
    solver.add_strands(shx.StrandDefs(count, element_count=10, length=0.3, root=hanging(count).data["root"].copy().view(np.float64).reshape(-1, 7)))
    return solver


def test_other_threads_run_during_a_step() -> None:
    """While one thread is in a step, another notes the time. With the GIL held it would note none in the middle of the step."""
    stamps, done = [], threading.Event()

    def note() -> None:
        while not done.is_set():
            stamps.append(time.perf_counter())

    with moving() as solver:
        thread = threading.Thread(target=note)
        thread.start()
        began = time.perf_counter()
        solver.step(0.1, 48)
        ended = time.perf_counter()
        done.set()
        thread.join()
    third = (ended - began) / 3
    # Longer than the interpreter lets another thread run on its own account.
    assert third > 4 * sys.getswitchinterval()
    assert sum(began + third < stamp < ended - third for stamp in stamps) > 100


def test_reading_functions_run_side_by_side() -> None:
    with moving(500) as solver, concurrent.futures.ThreadPoolExecutor(4) as pool:
        expected = solver.sample_strands(16)
        for points in pool.map(lambda _: solver.sample_strands(16), range(16)):
            np.testing.assert_array_equal(points, expected)


def test_a_second_thread_in_a_step_is_refused() -> None:
    with moving() as solver:
        errors: list[BaseException] = []

        def disturb() -> None:
            time.sleep(0.01)
            try:
                solver.step(0.01)
            except shx.BusyError as error:
                errors.append(error)

        thread = threading.Thread(target=disturb)
        thread.start()
        solver.step(0.1, 10)
        thread.join()
    assert len(errors) == 1
    assert "shx_solver_step" in str(errors[0])


def test_closing_during_a_step_frees_after_it() -> None:
    solver = moving()
    thread = threading.Thread(target=solver.step, args=(0.1, 8))
    handle = weakref.ref(solver)
    thread.start()
    time.sleep(0.01)
    solver.close()
    assert solver.closed
    thread.join()
    del solver, thread
    gc.collect()
    assert handle() is None


def test_steps_are_limited_and_cancelled() -> None:
    with moving(200) as solver:
        solver.add_body(shx.BodyDef.sphere(0.1))
        solver.set_strand_contact(shx.StrandContact())
        report = solver.step(0.05, max_work=10**9)
        assert report.stop_reason is shx.StopReason.NONE
        cancel = shx.Cancel()
        assert not cancel.is_set()
        cancel.set()
        report = solver.step(0.05, cancel=cancel)
        assert report.stop_reason is shx.StopReason.CANCELLED
        cancel.clear()
        assert solver.step(0.05, cancel=cancel, max_seconds=30.0).stop_reason is shx.StopReason.NONE
        with pytest.raises(ValueError, match="max_work: -1"):
            solver.step(0.05, max_work=-1)
        with pytest.raises(shx.InvalidArgumentError, match="seconds"):
            solver.step(0.05, max_seconds=float("nan"))


def test_a_step_is_cancelled_from_another_thread() -> None:
    with moving(3000) as solver:
        cancel = shx.Cancel()
        threading.Timer(0.05, cancel.set).start()
        began = time.perf_counter()
        report = solver.step(1.0, 400, cancel=cancel)
        assert report.stop_reason is shx.StopReason.CANCELLED
        assert time.perf_counter() - began < 5.0


def test_a_parallel_loop_of_the_host_gives_the_same_bits() -> None:
    calls = []

    def loop(count: int, min_range: int, run: shx.Run) -> None:
        calls.append(count)
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            bounds = [count * part // 3 for part in range(4)]
            for task in [pool.submit(run, bounds[part], bounds[part + 1], part) for part in range(3)]:
                task.result()

    with moving(300) as plain, moving(300, parallel_for=loop, worker_count=3) as solver:
        plain.step(0.05, 2)
        solver.step(0.05, 2)
        assert solver.state_hash() == plain.state_hash()
    assert calls
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        with moving(300) as plain, moving(300, parallel_for=shx.parallel_for_on(pool, 2), worker_count=2) as solver:
            plain.step(0.05)
            solver.step(0.05)
            assert solver.state_hash() == plain.state_hash()


def test_an_exception_in_the_loop_comes_out_of_the_call_and_the_step_is_whole() -> None:
    def broken(count: int, min_range: int, run: shx.Run) -> None:
        run(0, count // 2, 0)
        raise KeyError("my loop")

    with moving(300) as plain, moving(300, parallel_for=broken, worker_count=2) as solver:
        plain.step(0.05)
        with pytest.raises(KeyError, match="my loop"):
            solver.step(0.05)
        # Items that the loop left out were done by the calling thread.
        assert solver.state_hash() == plain.state_hash()


def test_run_is_refused_after_the_loop_has_returned() -> None:
    kept = []

    def loop(count: int, min_range: int, run: shx.Run) -> None:
        run(0, count, 0)
        kept.append(run)

    with moving(300, parallel_for=loop, worker_count=2) as solver:
        solver.step(0.05)
        with pytest.raises(RuntimeError, match="after the parallel loop had returned"):
            kept[0](0, 1, 0)


def test_calling_the_solver_from_its_own_callback_is_refused() -> None:
    errors = []

    def loop(count: int, min_range: int, run: shx.Run) -> None:
        try:
            solver.step(0.01)
        except shx.BusyError as error:
            errors.append(error)
        solver.close()
        run(0, count, 0)

    solver = moving(300, parallel_for=loop, worker_count=2)
    with pytest.raises(ValueError, match="closed"):
        solver.step(0.05)
        solver.step(0.05)
    assert errors


def test_messages_reach_the_log(caplog) -> None:
    messages: list[tuple[shx.LogLevel, str]] = []
    with shx.Solver(log=lambda level, text: messages.append((level, text)), log_level=shx.LogLevel.DEBUG) as solver:
        solver.add_strands(hanging(1))
        solver.step(0.01)
        with pytest.raises(shx.InvalidArgumentError) as caught:
            solver.step(-1.0)
    assert (shx.LogLevel.ERROR, str(caught.value)) in messages
    assert shx.LogLevel.DEBUG in {level for level, _ in messages}
    with caplog.at_level(logging.DEBUG, logger="superhelix"):
        with shx.Solver(log=shx.log_to_logging, log_level=shx.LogLevel.INFO):
            pass
    assert caplog.records


def test_an_exception_in_the_log_comes_out_of_the_call() -> None:
    def broken(level: shx.LogLevel, text: str) -> None:
        raise ZeroDivisionError(text)

    with shx.Solver(log=broken, log_level=shx.LogLevel.ERROR) as solver:
        with pytest.raises(ZeroDivisionError) as caught:
            solver.step(-1.0)
        assert isinstance(caught.value.__cause__, shx.InvalidArgumentError)
        solver.strand_count()


def test_callbacks_live_as_long_as_the_solver() -> None:
    class Loop:
        def __call__(self, count: int, min_range: int, run: shx.Run) -> None:
            run(0, count, 0)

    loop = Loop()
    gone = weakref.ref(loop)
    solver = moving(200, parallel_for=loop, worker_count=2)
    del loop
    gc.collect()
    solver.step(0.05)
    assert gone() is not None
    solver.close()
    gc.collect()
    assert gone() is None


def test_a_field_of_wind_is_called_and_a_constant_one_is_the_uniform_wind() -> None:
    with shx.Solver() as uniform, shx.Solver() as field:
        for solver in (uniform, field):
            solver.add_strands(shx.StrandDefs(5, element_count=6, length=0.1, air_drag=1e-5))
        uniform.set_wind((1.0, -0.5, 0.25))
        calls: list[tuple[float, tuple[int, ...]]] = []

        def wind(seconds: float, positions: np.ndarray) -> tuple[float, float, float]:
            calls.append((seconds, positions.shape))
            return (1.0, -0.5, 0.25)

        field.set_wind_field(wind)
        del wind
        gc.collect()
        uniform.step(0.05, 2)
        field.step(0.05, 2)
        assert [seconds for seconds, _ in calls] == pytest.approx([0.025, 0.05])
        assert all(shape[0] >= 5 * 6 * 3 and shape[1] == 3 for _, shape in calls)
        uniform.set_wind((0, 0, 0))
        assert field.state_hash() == uniform.state_hash()
        field.set_wind_field(lambda seconds, positions: positions[:, :2])
        with pytest.raises(ValueError, match="broadcast"):
            field.step(0.01)
        field.set_wind_field(None)
        field.step(0.01)


def test_debug_drawing_gives_tables() -> None:
    with moving(20) as solver:
        drawn = solver.debug_draw(shx.DebugLayers.CENTRELINES, points_per_strand=33, transform=np.diag([100.0, 100.0, 100.0]))
        assert len(drawn.lines) == 20 * 32 * 2
        assert len(drawn.points) == 0
        points = solver.sample_strands(33, dtype=np.float64)
        np.testing.assert_allclose(drawn.lines.position[1::2].reshape(20, 32, 3), 100 * points[:, 1:], atol=1e-9)
        assert set(drawn.lines.layer) == {shx.DebugLayers.CENTRELINES}
        with pytest.raises(shx.InvalidArgumentError, match="frame_length"):
            solver.debug_draw(frame_length=-1.0)


def test_an_allocator_comes_too_late_once_there_was_a_solver() -> None:
    with shx.Solver(), pytest.raises(shx.UnsupportedError, match="too late"):
        shx.set_allocator(1, 1)
