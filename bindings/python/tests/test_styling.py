"""Styling tools, combs that hold strands, frozen styles, hair handle."""

from __future__ import annotations

import numpy as np
import pytest

import superhelix as shx

DOWN = shx.Frame(rotation=(0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5)))
ALONG_Y = (-np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5))


def hanging(solver: shx.Solver, count: int = 4) -> shx.StrandIds:
    return solver.add_strands(shx.StrandDefs(count, element_count=5, length=0.1, root=[DOWN] * count))


def test_tools_are_bodies() -> None:
    with shx.Solver() as solver:
        tool = shx.ToolDef(kind=shx.Tool.COMB, tooth_count=5)
        teeth = solver.add_tool(tool, shx.Frame(origin=(0.1, 0.0, 0.0)))
        assert len(teeth) == 5
        frames = shx.tool_frames(tool, shx.Frame(origin=(0.2, 0.0, 0.0)))
        solver.set_body_frames(frames, teeth)
        solver.step(0.01)
        np.testing.assert_array_equal(solver.body_frames(teeth)[:, 0], 0.2)
        with pytest.raises(shx.InvalidArgumentError, match=r"def\.radius"):
            solver.add_tool(shx.ToolDef(kind=shx.Tool.FINGER, radius=-1.0), shx.Frame())
    np.testing.assert_allclose(shx.tool_hot_box(shx.ToolDef(kind=shx.Tool.PLATES), 0.01), (0.045, 0.007, 0.0125))


def test_clip_cut_heat_freeze() -> None:
    with shx.Solver() as solver:
        ids = hanging(solver)
        clip = shx.ClipDef(pose=shx.Frame(origin=(0.0, 0.0, -0.05)), half_edges=(0.1, 0.1, 0.005))
        held = solver.clip_strands(clip)
        assert len(held) == 4
        solver.move_constraints(clip.pose, shx.Frame(origin=(0.01, 0.0, -0.05)), held, 0.1)
        solver.step(0.1, 4)
        assert np.all(solver.constraint_targets(held)[:, 0] > 0.009)
        solver.remove_constraints(held)
        heated = solver.heat_strands(shx.HeatDef(half_edges=(1.0, 1.0, 1.0)), 0.1)
        np.testing.assert_allclose(heated, 0.1)
        cuts = solver.scissor_strands([(-1, -1, -0.06), (1, -1, -0.06), (1, 1, -0.06), (-1, 1, -0.06)], ids[:2])
        assert list(cuts.strands) == list(ids[:2])
        np.testing.assert_allclose(cuts.lengths + cuts.removed, 0.1)
        np.testing.assert_allclose(cuts.positions[:, 2], -0.06, atol=1e-9)
        solver.freeze_strands(ids[:3])
        solver.step(0.1)
        np.testing.assert_array_equal(solver.frozen_strands(), (True, True, True, False))
        solver.wake_strands(ids[1])
        np.testing.assert_array_equal(solver.frozen_strands(), (True, False, True, False))


def test_ring_comb() -> None:
    with shx.Solver() as solver:
        ids = hanging(solver)
        finger = shx.ToolDef(kind=shx.Tool.FINGER, radius=0.001)
        with shx.RingComb(finger, shx.Frame(origin=(-0.01, -0.03, -0.03), rotation=ALONG_Y)) as comb:
            comb.before_step(solver, shx.Frame(origin=(0.01, -0.03, -0.03), rotation=ALONG_Y), 0.01, ids)
            solver.step(0.01)
            report = comb.after_step(solver)
            assert (report.caught, report.held, report.combed) == (4, 4, 0)
            assert report.force.shape == (3,)
            comb.release(solver)
        assert solver.constraint_count() == 0
        with pytest.raises(shx.UnsupportedError, match="plates"):
            shx.RingComb(shx.ToolDef(kind=shx.Tool.PLATES), shx.Frame())


def test_ring_comb_in_the_hand() -> None:
    """A ball in the hand, which hair without contact ignores, and a tooth along y from there on; both go along x."""
    with shx.Solver() as solver, shx.Solver() as other:
        hanging(solver)
        held = solver.add_body(shx.BodyDef.sphere(1e-3, pose=shx.Frame(origin=(-0.01, -0.03, -0.03))))
        finger = shx.ToolDef(kind=shx.Tool.FINGER, radius=0.001)
        tooth = shx.Frame(origin=(-0.01, -0.03, -0.03), rotation=ALONG_Y)
        with shx.Haptic(solver, held, shx.HapticDef(mode=shx.HapticMode.DIRECT)) as hand:
            with pytest.raises(shx.InvalidIdError, match=r"bodies\[0\]"):
                hand.add_ring_comb(other, finger, tooth)
            with pytest.raises(shx.UnsupportedError, match="plates"):
                hand.add_ring_comb(solver, shx.ToolDef(kind=shx.Tool.PLATES), tooth)
            with pytest.raises(shx.InvalidArgumentError, match=r"def\.max_force"):
                hand.add_ring_comb(solver, finger, tooth, shx.RingCombDef(max_force=0.0))
            with pytest.raises(shx.InvalidArgumentError, match="index"):
                hand.ring_comb_report(0)
            assert hand.add_ring_comb(solver, finger, tooth) == 0
            assert hand.add_ring_comb(solver, finger, tooth, ids=()) == 1
            pulled = np.zeros(3)
            for step in range(11):
                x = -0.01 + 0.002 * step
                felt = hand.update(shx.Frame(origin=(x, -0.03, -0.03)), (2.0, 0.0, 0.0, 0.0, 0.0, 0.0), dt=1e-3)
                np.testing.assert_allclose(felt.state.contact_force, pulled, atol=1e-12)
                hand.before_step(solver, 1e-3)
                solver.step(1e-3)
                hand.after_step(solver)
                pulled = hand.ring_comb_report(0).force
                frame = hand.ring_comb_frame(0)
                np.testing.assert_allclose(frame[:3], felt.state.proxy.origin, atol=1e-12)
                np.testing.assert_allclose(frame[3:], ALONG_Y, atol=0.01)
            report = hand.ring_comb_report(0)
            assert (report.held, report.caught, solver.constraint_count()) == (4, 0, 4)
            assert report.force[0] < 0.0
            assert hand.ring_comb_report(1).held == 0
            hand.release_ring_combs(solver)
            assert solver.constraint_count() == 0


def test_hair_handle() -> None:
    h1 = shx.hair_handle("h1")
    np.testing.assert_allclose((h1.major_diameter, h1.bending_stiffness), (93.1e-6, 7.59e-9))
    easy = shx.adjust_hair_handle(h1, combing_ease=1.0)
    assert easy.frictional_force < h1.frictional_force
    assert shx.hair_handle_type(easy).friction < 1.0
    curve = shx.run_combing_test(h1, shx.CombingTest(stroke=0.005))
    assert len(curve.force) == len(curve.stroke) == 120
    assert curve.mean_force > 0.0
    with pytest.raises(shx.InvalidArgumentError, match="curliness"):
        shx.adjust_hair_handle(h1, curliness=2.0)
