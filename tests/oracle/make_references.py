"""Makes tests/data/reference/{inertia,entire}.json: numbers that the engine's own formulas had no part in.

usage: python make_references.py      (numpy, scipy, mpmath)

inertia: the oracle's mass matrix (oracle.py: Jacobians at Gauss points) with 120 points an element, far above need.
entire:  Stumpff's functions by mpmath with 60 digits.
"""
import json
import os

import mpmath
import numpy as np

from oracle import Rod

HERE = os.path.dirname(os.path.abspath(__file__))
OUT = os.path.join(HERE, "..", "data", "reference")


def inertia():
    cases = []
    directions = {
        "general": (0.4, 0.7, -0.59),
        "planar": (0.0, 0.8, 0.6),
        "twist": (1.0, 0.0, 0.0),
        "bend1": (0.0, 1.0, 0.0),
    }
    for angle in (0.0, 1e-8, 1e-4, 1e-2, 1.0, 3.0, 10.0, 50.0):
        for name, direction in directions.items():
            if angle == 0.0 and name != "general":
                continue
            ells = [0.03, 0.05, 0.02]
            d = np.array(direction) / np.linalg.norm(direction)
            # A different direction on each element, the same angle: rolled about the tangent.
            q = []
            for k, ell in enumerate(ells):
                c, s = np.cos(0.9 * k), np.sin(0.9 * k)
                roll = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
                if name == "planar":
                    roll = np.eye(3)
                q.append((angle / ell) * (roll @ d))
            q = np.array(q)
            rod = Rod(L=sum(ells), N=3, a1=6e-5, a2=4e-5, E=2e9, poisson=0.48, rho=1300, n=120, ells=ells)
            m, _ = rod.MF(q.ravel(), np.zeros(9), 0.0)
            cases.append(dict(angle=angle, kind=name, lengths=ells, curvatures=q.tolist(), linear_density=rod.rhoS, matrix=m.tolist()))
    json.dump(cases, open(os.path.join(OUT, "inertia.json"), "w"))


def entire():
    mpmath.mp.dps = 60
    rows = []
    points = [0.0, 1e-30, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 1, 2, 3, 5, 7, 9, 9.8696, 12, 13.9, 13.999999, 14.000001, 14.1, 14.5, 14.999999, 15.000001, 15.1, 15.3, 15.7, 16.2, 17, 18.3, 20, 25, 30,
              39.4784176, 39.5, 50, 64, 80, 100, 157.9, 200, 400, 900, 1600, 2500, 1e4]
    for z in points:
        z = mpmath.mpf(z)
        row = [float(z)]
        z = mpmath.mpf(float(z))
        for k in range(1, 8):
            if z == 0:
                value = 1 / mpmath.factorial(k)
            else:
                value = mpmath.nsum(lambda j: (-z) ** int(j) / mpmath.factorial(2 * int(j) + k), [0, mpmath.inf], method="d") if z < 300 else None
                if value is None:
                    x = mpmath.sqrt(z)
                    c = {1: mpmath.sin(x) / x, 2: (1 - mpmath.cos(x)) / z}
                    for i in range(3, k + 1):
                        c[i] = (1 / mpmath.factorial(i - 2) - c[i - 2]) / z
                    value = c[k]
            row.append(float(value))
        rows.append(row)
    json.dump(rows, open(os.path.join(OUT, "entire.json"), "w"))


if __name__ == "__main__":
    inertia()
    entire()
