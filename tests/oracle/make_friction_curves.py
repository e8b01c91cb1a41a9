"""Makes tests/data/friction/: recorded curves of the oracle, with noise, from which friction is fitted (tests/groom/friction_fit.rs).

usage: python make_friction_curves.py [NAME ...]      (numpy, scipy; about a quarter of an hour for all)

Each case is a scene file (NAME.scene.json: the strand, with the true coefficients) and curves NAME_NOISE.csv: time, value, the
root's position. Noise is normal and independent from sample to sample, its seed the case's number and NOISE; its standard deviation
is NOISE in thousandths of the span at rest (of a radian for angles). The strand starts at rest in its equilibrium, found here by
scipy, never by the engine. true.json has the true values, and how far the noise-free curve moved when the oracle's step was halved.
"""
import json
import os
import sys

import numpy as np
from scipy.optimize import fsolve, minimize

from oracle import Rod, simulate

HERE = os.path.dirname(os.path.abspath(__file__))
OUT = os.path.join(HERE, "..", "data", "friction")
DOWN = np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]])  # n0 = -z, n1 = y, n2 = x
QUATERNION = [0.0, np.sqrt(0.5), 0.0, np.sqrt(0.5)]


def oscillation(amplitude, frequency):
    w = 2 * np.pi * frequency

    def root(t):
        return (np.array([0, 0, amplitude * np.sin(w * t)]), DOWN, np.array([0, 0, amplitude * w * np.cos(w * t)]), np.zeros(3))
    return root


def shift(way, middle, width):
    """Sideways by `way` about the time `middle`, and still from then on: the strand swings."""
    def root(t):
        s = np.tanh((t - middle) / width)
        return (np.array([0.5 * way * (1 + s), 0, 0]), DOWN, np.array([0.5 * way / width * (1 - s * s), 0, 0]), np.zeros(3))
    return root


def rest(rod):
    """The stable equilibrium with the root as it is at t = 0, held still."""
    r0 = rod.root(0.0)[0]
    held = Rod.__new__(Rod)
    held.__dict__.update(rod.__dict__)
    held.root = lambda t: (r0, DOWN, np.zeros(3), np.zeros(3))
    zero = np.zeros(3 * rod.N)
    force = lambda q: held.MF(q, zero, 0.0)[1]

    def energy(q):
        _, u, p = held.energy(q, zero, 0.0)
        return (u + p) * 1e6
    scale = 20.0
    q = minimize(lambda x: energy(scale * x), rod.qn.ravel() / scale, jac=lambda x: -force(scale * x) * scale * 1e6, method="BFGS",
                 options=dict(gtol=1e-7, maxiter=2000)).x * scale
    q, _, flag, message = fsolve(lambda q: force(q) / rod.K, q, xtol=1e-13, full_output=True)
    assert np.max(np.abs(force(q) / rod.K)) < 1e-8, message
    hessian = np.array([(force(q - e) - force(q + e)) / 2e-4 for e in 1e-4 * np.eye(q.size)])
    lowest = np.linalg.eigvalsh(0.5 * (hessian + hessian.T) / np.sqrt(np.outer(rod.K, rod.K)))[0]
    assert lowest > 1e-3, f"not stable: {lowest}"
    return q


def observe(rod, q, t, kind):
    chord = rod.tip(q, t)[0] - rod.root(t)[0]
    return {"span_m": np.linalg.norm(chord), "depth_m": -chord[2], "offset_m": chord[0], "angle_rad": np.arctan2(chord[0], -chord[2])}[kind]


CASES = {
    "curl_shaken": dict(
        N=3, L=0.15, a=(50e-6, 50e-6), E=1.5e9, gamma=1e-10, mu=0.0, drag=5e-6, qn=(6.0, 40.0, 0.0),
        root=oscillation(0.01, 3.0), kind="span_m", seconds=2.0, rate=60, noise=(0, 5, 20), fitted=["internal_friction"]),
    "curl_shaken_viscous": dict(
        N=2, L=0.12, a=(55e-6, 45e-6), E=2e9, gamma=0.0, mu=0.01, drag=5e-6, qn=(3.0, 30.0, 10.0),
        root=oscillation(0.01, 4.0), kind="span_m", seconds=1.5, rate=60, noise=(0, 5), fitted=["viscosity"]),
    "pendulum": dict(
        N=2, L=0.2, a=(50e-6, 50e-6), E=1e9, gamma=2e-12, mu=0.0, drag=8e-6, qn=(0.0, 0.0, 0.0),
        root=shift(0.06, 0.3, 0.08), kind="offset_m", seconds=3.0, rate=60, noise=(0, 5, 20), fitted=["air_drag"]),
    "curl_swung": dict(
        N=2, L=0.15, a=(50e-6, 50e-6), E=1.5e9, gamma=5e-11, mu=0.0, drag=1.5e-5, qn=(0.0, 25.0, 0.0),
        root=shift(0.08, 0.25, 0.05), kind="angle_rad", seconds=2.5, rate=60, noise=(0, 5), fitted=["internal_friction", "air_drag"]),
    "straight_shaken": dict(
        N=1, L=0.15, a=(50e-6, 50e-6), E=1.5e9, gamma=1e-10, mu=0.0, drag=5e-6, qn=(0.0, 0.0, 0.0),
        root=oscillation(0.01, 3.0), kind="span_m", seconds=1.0, rate=60, noise=(0, 5), fitted=[]),
    # Written down from 2 s on, when it has forgotten how it began.
    "curl_shaken_long": dict(
        N=1, L=0.1, a=(50e-6, 50e-6), E=1.5e9, gamma=4e-10, mu=0.0, drag=1e-5, qn=(4.0, 30.0, 0.0),
        root=oscillation(0.01, 3.0), kind="depth_m", seconds=3.5, since=2.0, rate=60, noise=(0, 5), fitted=["internal_friction"]),
}


def curve(rod, q0, case, steps):
    """Values at the frames, from frame 0 on, with `steps` steps of the oracle a frame."""
    count = round(case["seconds"] * case["rate"])
    out = simulate(rod, q0.copy(), np.zeros_like(q0), count / case["rate"], 1 / (case["rate"] * steps), every=steps, tol=1e-11)
    return np.array([observe(rod, q0, 0.0, case["kind"])] + [observe(rod, q, t, case["kind"]) for t, q, _ in out])


def scene(case):
    strand = dict(elements=case["N"], length=case["L"], radius=case["a"], density=1300, youngs_modulus=case["E"], poisson_ratio=0.48,
                  internal_friction=case["gamma"], viscosity=case["mu"], air_drag=case["drag"], natural_curvatures=[case["qn"]],
                  root=dict(origin=[0, 0, 0], rotation=QUATERNION))
    return dict(version=1, time_step=1 / 480, duration=case["seconds"], strands=[strand])


def main():
    os.makedirs(OUT, exist_ok=True)
    true_path = os.path.join(OUT, "true.json")
    true = json.load(open(true_path)) if sys.argv[1:] else {}
    for number, (name, case) in enumerate(CASES.items()):
        if sys.argv[1:] and name not in sys.argv[1:]:
            continue
        rod = Rod(case["L"], case["N"], *case["a"], case["E"], 0.48, 1300, case["gamma"], case["mu"], case["drag"], case["qn"],
                  root=case["root"])
        q0 = rest(rod)
        coarse, fine = curve(rod, q0, case, 4), curve(rod, q0, case, 8)
        span = np.linalg.norm(rod.tip(q0)[0] - rod.root(0.0)[0])
        true[name] = dict(internal_friction=case["gamma"], viscosity=case["mu"], air_drag=case["drag"], fitted=case["fitted"],
                          step_halving_error=float(np.max(np.abs(fine - coarse))), span_m=float(span), noise={})
        with open(os.path.join(OUT, f"{name}.scene.json"), "w") as file:
            json.dump(scene(case), file, indent=1)
            file.write("\n")
        print(name, "span", span, "swing", np.ptp(fine), "oracle's error", true[name]["step_halving_error"], flush=True)
        for permille in case["noise"]:
            # An angle is a distance over the span.
            deviation = permille / 1000 * (1.0 if case["kind"] == "angle_rad" else span)
            noisy = fine + np.random.default_rng([number, permille]).normal(0.0, deviation, fine.size)
            file_name = f"{name}_{permille:02d}.csv"
            true[name]["noise"][file_name] = deviation
            with open(os.path.join(OUT, file_name), "w") as file:
                file.write(f"time_s,{case['kind']},root_x_m,root_y_m,root_z_m\n")
                for k, value in list(enumerate(noisy))[round(case.get("since", 0) * case["rate"]):]:
                    t = k / case["rate"]
                    x, y, z = case["root"](t)[0]
                    file.write(f"{t:.9f},{value:.10f},{x:.9f},{y:.9f},{z:.9f}\n")
    with open(true_path, "w") as file:
        json.dump(true, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()
