"""MuJoCo 4's rod: a one-dimensional flex (discrete elastic rod with a twist an edge), lengths held by edge equalities. Settings: `ghost`
(cases.py), `jacobian` (dense, sparse).

Units inside are mm, mg, s: MuJoCo refuses inertias as small as a hair's in SI units. Edge equalities are soft: with the default solref hair
stretches by tens of per cent, so they are as stiff as MuJoCo lets them be at the step. flexcomp gives all vertices the same mass; here
each gets its own (the tip half an edge's), without which the rod errs at first order in the number of edges. `discrete` is the only integrator that takes the
rod's elasticity implicitly (`implicit` and `implicitfast` refuse it; Euler blows up at 1/15000 s). The solver needs one iteration a
step, whatever its tolerance: the equalities are its only constraints."""
import time

import mujoco
import numpy as np

from cases import vertices
from wire import serve

MM, MG = 1e3, 1e6
VERSION = mujoco.__version__


def rod(case, elements, settings, name):
    points = vertices(case, elements, settings["ghost"])
    return f"""<flexcomp name="{name}" type="direct" dim="1" point="{' '.join(f'{c * MM:.12g}' for p in points for c in p)}"
  element="{' '.join(f'{i} {i + 1}' for i in range(elements + 1))}" mass="{case.mass * MG}" radius="{case.radius * MM}">
  <edge equality="true" solref="1e-6 1" solimp="0.9999 0.9999 0.001"/>
  <elasticity young="{case.youngs_modulus * MM}" poisson="{case.poisson_ratio}" damping="0"/>
  <contact selfcollide="none" contype="0" conaffinity="0"/>
  <pin id="0 1"/></flexcomp>"""


def document(case, step, rods, jacobian):
    return f"""<mujoco><option timestep="{step!r}" gravity="0 0 {-case.gravity * MM}" integrator="discrete" solver="Newton"
  jacobian="{jacobian}"><flag contact="disable"/></option><worldbody>{''.join(rods)}</worldbody></mujoco>"""


class World:
    def __init__(self, case, elements, step, strands, settings):
        rods = [rod(case, elements, settings, f"s{k}") for k in range(strands)]
        self.model = mujoco.MjModel.from_xml_string(document(case, step, rods, settings["jacobian"]))
        self.data = mujoco.MjData(self.model)
        self.vertices = elements + 2
        bodies = self.model.flex_vertbodyid.reshape(strands, self.vertices)
        vertex = case.density * case.area * case.length / elements * MG
        for body in bodies[:, 2:].ravel():
            mass = vertex / 2 if body in bodies[:, -1] else vertex
            self.model.body_inertia[body] *= mass / self.model.body_mass[body]
            self.model.body_mass[body] = mass
        mujoco.mj_setConst(self.model, self.data)
        self.rewind()

    def advance(self, steps):
        mujoco.mj_step(self.model, self.data, steps)
        if any(warning.number for warning in self.data.warning):
            raise ArithmeticError("MuJoCo warns: " + ", ".join(str(w.number) for w in self.data.warning))

    def points(self, strand):
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_flex(self.model, self.data)
        first = strand * self.vertices
        return self.data.flexvert_xpos[first + 1 : first + self.vertices] / MM

    def rewind(self):
        mujoco.mj_resetData(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)


def overhead(calls=20, steps=1000):
    model = mujoco.MjModel.from_xml_string("<mujoco><worldbody/></mujoco>")
    data = mujoco.MjData(model)
    start = time.process_time()
    for _ in range(calls):
        mujoco.mj_step(model, data, steps)
    return (time.process_time() - start) / (calls * steps)


if __name__ == "__main__":
    serve(World=World, overhead=overhead, VERSION=VERSION)
