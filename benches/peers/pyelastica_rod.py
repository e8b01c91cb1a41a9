"""PyElastica: an explicit Cosserat rod (position Verlet), its kernels compiled by numba, its steps made in Python. Settings: `ghost`
(cases.py), `soft` (what stretch and shear stiffness are multiplied by), `inertia` (what the rotary inertia is multiplied by).

With a hair's own stiffness and inertia a stable step is 0.07 µs. Softer shear and stretch, and heavier sections, are what users do about it: bending and twist,
which make the motion, keep their stiffness. What it costs in accuracy is in the error."""
import logging
import time

import elastica as ea
import numpy as np

from cases import vertices
from wire import serve

VERSION = "1.0.0"
logging.disable(logging.CRITICAL)


class Simulator(ea.BaseSystemCollection, ea.Constraints, ea.Forcing):
    pass


class World:
    def __init__(self, case, elements, step, strands, settings):
        self.step = np.float64(step)
        self.simulator, self.stepper = Simulator(), ea.PositionVerlet()
        self.rods = [self.add(case, elements, settings) for _ in range(strands)]
        self.simulator.finalize()
        self.start = [self.state(rod) for rod in self.rods]
        # numba compiles at the first step.
        self.time = np.float64(0.0)
        self.advance(1)
        self.rewind()

    def add(self, case, elements, settings):
        points = np.array(vertices(case, elements, settings["ghost"])).T
        edges = np.diff(points, axis=1)
        edges /= np.linalg.norm(edges, axis=0)
        directors = np.zeros((3, 3, elements + 1))
        normal = np.array([0.0, 1.0, 0.0])
        for i in range(elements + 1):
            normal = normal - normal.dot(edges[:, i]) * edges[:, i]
            normal /= np.linalg.norm(normal)
            directors[0, :, i], directors[1, :, i], directors[2, :, i] = normal, np.cross(edges[:, i], normal), edges[:, i]
        rod = ea.CosseratRod.straight_rod(
            elements + 1, start=points[:, 0].copy(), direction=edges[:, 0].copy(), normal=directors[0, :, 0].copy(),
            base_length=case.length * (elements + 1) / elements, base_radius=case.radius, density=case.density,
            youngs_modulus=case.youngs_modulus, shear_modulus=case.shear_modulus, position=points.copy(), directors=directors.copy())
        rod.rest_lengths[:] = rod.lengths
        rod.compute_internal_forces_and_torques(0.0)
        rod.rest_kappa[:] = rod.kappa
        rod.rest_sigma[:] = rod.sigma
        rod.shear_matrix *= settings["soft"]
        rod.mass_second_moment_of_inertia *= settings["inertia"]
        rod.inv_mass_second_moment_of_inertia /= settings["inertia"]
        self.simulator.append(rod)
        self.simulator.constrain(rod).using(ea.FixedConstraint, constrained_position_idx=(0, 1), constrained_director_idx=(0,))
        self.simulator.add_forcing_to(rod).using(ea.GravityForces, acc_gravity=np.array([0.0, 0.0, -case.gravity]))
        return rod

    @staticmethod
    def parts(rod):
        return rod.position_collection, rod.velocity_collection, rod.director_collection, rod.omega_collection

    def state(self, rod):
        return [part.copy() for part in self.parts(rod)]

    def advance(self, steps):
        for begin in range(0, steps, 512):
            for _ in range(min(512, steps - begin)):
                self.time = self.stepper.step(self.simulator, self.time, self.step)
            if not np.isfinite(self.rods[0].velocity_collection[2, -1]):
                raise ArithmeticError("not finite")

    def points(self, strand):
        return self.rods[strand].position_collection[:, 1:].T

    def rewind(self):
        self.time = np.float64(0.0)
        for rod, start in zip(self.rods, self.start):
            for part, was in zip(self.parts(rod), start):
                part[:] = was
            for rate in (rod.acceleration_collection, rod.alpha_collection):
                rate[:] = 0.0


def overhead(steps=2000):
    """Of a rod of one element: what a step costs before there is anything to work out."""
    from cases import CASES
    world = World(CASES[2], 1, 1e-7, 1, {"ghost": 1.0, "soft": 1e-4, "inertia": 400.0})
    start = time.process_time()
    world.advance(steps)
    return (time.process_time() - start) / steps


if __name__ == "__main__":
    serve(World=World, overhead=overhead, VERSION=VERSION)
