"""Static planar strands held at both ends, by collocation (scipy's solve_bvp, tolerance 1e-9): the reference for tests/constraints/pins_clamps_rings.rs.

The strand leaves the origin along x (clamped) and its tip is hinged at a point (X, Z); weight w a metre along -z. With theta the tangent's
angle, N the force that what lies beyond a point exerts on it, N = F - w (L - s) z, F the hinge's force: EI theta'' = sin(theta) N_x - cos(theta) N_z.

Needs numpy and scipy. Writes tests/data/reference/elastica.json.
"""

import json
import math
import pathlib

import numpy as np
from scipy.integrate import solve_bvp

RADIUS, DENSITY, YOUNG, GRAVITY = 50e-6, 1300.0, 2e9, 9.81
STIFFNESS = YOUNG * math.pi / 4 * RADIUS**4
WEIGHT = DENSITY * math.pi * RADIUS**2 * GRAVITY


def solve(length, x_tip, z_tip):
    # Unit of length: the strand's; of force: EI / L^2.
    w = WEIGHT * length**3 / STIFFNESS

    def slopes(s, y, p):
        theta, kappa, _, _ = y
        n_x, n_z = p[0], p[1] - w * (1 - s)
        return np.array([kappa, np.sin(theta) * n_x - np.cos(theta) * n_z, np.cos(theta), np.sin(theta)])

    def ends(a, b, p):
        return np.array([a[0], a[2], a[3], b[1], b[2] - x_tip / length, b[3] - z_tip / length])

    s = np.linspace(0, 1, 101)
    guess = None
    # From a gentle case by continuation of the tip.
    for share in np.linspace(0.05, 1, 20):
        target = (1 + share * (x_tip / length - 1), share * z_tip / length)
        boundary = lambda a, b, p, t=target: np.array([a[0], a[2], a[3], b[1], b[2] - t[0], b[3] - t[1]])
        if guess is None:
            bend = 0.3
            y = np.array([-bend * np.sin(math.pi * s), -bend * math.pi * np.cos(math.pi * s), s, -0.05 * np.sin(math.pi * s)])
            p = np.array([-5.0, w / 2])
        else:
            y, p = guess
        found = solve_bvp(slopes, boundary, s, y, p, tol=1e-6, max_nodes=100_000)
        assert found.success, (target, found.message)
        guess = (found.sol(s), found.p)
    found = solve_bvp(slopes, ends, s, guess[0], guess[1], tol=1e-9, max_nodes=200_000)
    assert found.success, found.message
    at = np.linspace(0, 1, 21)
    values = found.sol(at)
    force = found.p * STIFFNESS / length**2
    return {
        "length": length,
        "tip": [x_tip, z_tip],
        "points": [[float(x * length), float(z * length)] for x, z in zip(values[2], values[3])],
        "hinge_force": [float(force[0]), float(force[1])],
        "tip_angle": float(values[0, -1]),
    }


if __name__ == "__main__":
    cases = [solve(0.1, 0.08, -0.01), solve(0.2, 0.12, -0.05), solve(0.2, 0.17, 0.02)]
    text = json.dumps({"radius": RADIUS, "density": DENSITY, "youngs_modulus": YOUNG, "gravity": GRAVITY, "cases": cases}, indent=1)
    pathlib.Path(__file__).parent.parent.joinpath("data/reference/elastica.json").write_text(text + "\n")
    for case in cases:
        print(case["tip"], case["hinge_force"], case["tip_angle"], case["points"][10])
