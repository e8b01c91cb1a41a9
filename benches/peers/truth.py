"""Where the tips should be, every 1/60 s: the continuous rod.

- cantilever: tests/data/reference/physics.json, S2_u, two methods that have nothing to do with any of the four programs (5e-7 of the length).
- curl, coil: superhelix, second order, extrapolated to no step and no element size. That rests on its own right to be believed:
  the curl's tip at 0.1 s is known from three other codes, and `extrapolated_peers` takes the two position-level peers to no step and no
  element size likewise."""
import json
from pathlib import Path

import numpy as np

from judge import record_times

REFERENCE = Path(__file__).resolve().parents[2] / "tests" / "data" / "reference" / "physics.json"
# Agreed upon by three codes to 0.02, 0.03, 0.02 mm (tests/integrators/peer_case.rs).
PUBLISHED = {"curl": np.array([0.17246, -0.00663, -0.05098])}
FINE = {"curl": (64, 128), "coil": (160, 320)}
PEERS_FINE = {"curl": (30, 60), "coil": (120, 240)}


def tips(program, case, elements, rate, settings):
    every, times = record_times(case, rate)
    answer = program.ask({"do": "measure", "case": case.wire(), "elements": elements, "rate": rate, "records": len(times), "every": every,
                          "strands": 1, "settings": settings, "patience": 0.0, "least_runs": 1, "most_runs": 1})
    if "tips" not in answer:
        raise RuntimeError(f"{program.name} at {elements} elements, 1/{rate} s: {answer}")
    return np.array(answer["tips"], dtype=float)


def extrapolated(program, case, counts, rate, order, settings):
    """To no step (from `rate` and twice that, of that order in the step) and to no element size (second order in it)."""
    def without_steps(elements):
        coarse, fine = (tips(program, case, elements, r, settings) for r in (rate, 2 * rate))
        return (2**order * fine - coarse) / (2**order - 1)
    coarse, fine = (without_steps(elements) for elements in counts)
    ratio = (counts[1] / counts[0]) ** 2
    return (ratio * fine - coarse) / (ratio - 1)


def truth(programs, case):
    """(tips, what is known of their error in lengths)."""
    if case.name == "cantilever":
        known = json.loads(REFERENCE.read_text())["dynamics_planar"]["S2_u"]
        frames = slice(1, case.frames + 1)
        assert known["si"]["L"] == case.length and known["si"]["E"] == case.youngs_modulus and known["si"]["rho"] == case.density
        return np.column_stack([known["tip_x"][frames], np.zeros(case.frames), known["tip_z"][frames]]) * case.length, 5e-7
    settings = {"integrator": "second order", "tolerance": 1e-6, "cap": 50}
    ours, (coarse, fine) = programs["superhelix"], FINE[case.name]
    best = extrapolated(ours, case, (coarse, fine), 3840, 2, settings)
    worse = extrapolated(ours, case, (coarse // 2, coarse), 1920, 2, settings)
    return best, float(np.linalg.norm(best - worse, axis=1).max() / case.length)


def checks(programs, case, right):
    """{what: largest distance from the truth, in lengths}. A truth that is not where three codes agree it is ends the run."""
    found = {}
    if case.name in PUBLISHED:
        found["the published position"] = float(np.linalg.norm(right[-1] - PUBLISHED[case.name]) / case.length)
        if not found["the published position"] < 3e-4:
            raise RuntimeError(f"{case.name}: the tip is {found} lengths from where it is known to be")
    if case.name in PEERS_FINE:
        for name, settings in [("pyPBD", {"iterations": 1, "ghost": 0.01}), ("MuJoCo", {"jacobian": "sparse", "ghost": 0.01})]:
            tip = extrapolated(programs[name], case, PEERS_FINE[case.name], 3840, 1, settings)
            found[f"{name}, extrapolated"] = float(np.linalg.norm(tip - right, axis=1).max() / case.length)
    return found
