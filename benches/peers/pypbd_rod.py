"""pyPBD: rigid segments with XPBD compliance and one direct O(n) solve an iteration ("direct position-based solver for stiff rods", Deul
et al. 2018). Settings: `iterations` (of the solve, a step), `ghost` (cases.py), `velocity` ("second" takes pyPBD's second-order velocity
update).

Gravity cannot be set from Python (9.81 along -y), so strands are turned so that y is up. Masses are in mg: in kg the solver's thresholds
are larger than a hair. A body must have a mesh: a cube, whose principal axes pyPBD leaves
alone (those of smaller meshes it turns, and the body with them). Steps are taken as substeps of one call, which is the same to
rounding, leaves Python out and moves the meshes once: half the cost."""
import atexit
import os
import shutil
import tempfile
import time

import numpy as np
import pypbd as pbd

from cases import vertices
from wire import serve

MG = 1e6
VERSION = "2.2.2"
SIMULATION = pbd.Simulation.getCurrent()
SIMULATION.initDefault()


def cube():
    folder = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, folder)
    path = os.path.join(folder, "cube.obj")
    faces = [(1, 2, 4), (1, 4, 3), (5, 7, 8), (5, 8, 6), (1, 5, 6), (1, 6, 2), (3, 4, 8), (3, 8, 7), (1, 3, 7), (1, 7, 5), (2, 6, 8), (2, 8, 4)]
    with open(path, "w") as file:
        file.writelines(f"v {x} {y} {z}\n" for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5))
        file.writelines("f %d %d %d\n" % face for face in faces)
    return pbd.OBJLoader.loadObjToMesh(path, [1, 1, 1])


VERTICES, MESH = cube()


def empty_model():
    SIMULATION.reset()
    model = SIMULATION.getModel()
    model.cleanup()
    return model


class World:
    def __init__(self, case, elements, step, strands, settings):
        self.case, self.step, self.model = case, step, empty_model()
        self.local = np.array([0.0, case.length / elements / 2, 0.0])
        self.strands = [self.add(case, elements, settings) for _ in range(strands)]
        self.stepper = SIMULATION.getTimeStep()
        self.stepper.setValueUInt(pbd.TimeStepController.MAX_ITERATIONS, settings["iterations"])
        # Nothing here has constraints on velocities: the iterations meant for them would only cost.
        self.stepper.setValueUInt(pbd.TimeStepController.MAX_ITERATIONS_V, 0)
        order = {"first": pbd.TimeStepController.ENUM_VUPDATE_FIRST_ORDER, "second": pbd.TimeStepController.ENUM_VUPDATE_SECOND_ORDER}
        self.stepper.setValueInt(pbd.TimeStepController.VELOCITY_UPDATE_METHOD, order[settings.get("velocity", "first")])
        pbd.TimeManager.getCurrent().setTime(0.0)
        # The colouring of constraints is made in the first step; it is not part of stepping.
        self.advance(1)
        self.rewind()

    def add(self, case, elements, settings):
        points = np.array(vertices(case, elements, settings["ghost"]))
        points = np.column_stack([points[:, 0], points[:, 2], -points[:, 1]])
        edges = np.diff(points, axis=0)
        lengths = np.linalg.norm(edges, axis=1)
        edges /= lengths[:, None]
        edge = case.length / elements
        mass = case.density * case.area * edge * MG
        normal = np.array([0.0, 1.0, 0.0]) if abs(edges[0][1]) < 0.9 else np.array([0.0, 0.0, 1.0])
        bodies = []
        for i in range(elements + 1):
            normal = normal - normal.dot(edges[i]) * edges[i]
            normal /= np.linalg.norm(normal)
            rotation = np.column_stack([normal, edges[i], np.cross(normal, edges[i])])      # y is the rod's axis
            body = self.model.addRigidBody(1.0, VERTICES, MESH, (points[i] + points[i + 1]) / 2, rotation, np.full(3, edge),
                                           testMesh=False, generateCollisionObject=False)
            body.setMass(0.0 if i == 0 else mass)
            if i:
                across, along = mass * (edge**2 / 12 + case.radius**2 / 4), mass * case.radius**2 / 2
                body.setInertiaTensor(np.array([across, along, across]))
            bodies.append(body)
        first = len(self.model.getRigidBodies()) - elements - 1
        made = self.model.addDirectPositionBasedSolverForStiffRodsConstraint(
            [(first + i, first + i + 1) for i in range(elements)], [points[i + 1] for i in range(elements)], [case.radius] * elements,
            [(lengths[i] + lengths[i + 1]) / 2 for i in range(elements)], [case.youngs_modulus * MG] * elements,
            [case.shear_modulus * MG] * elements)
        assert made, "pyPBD refused the rod"
        return points[1], bodies[1:]

    def advance(self, steps):
        pbd.TimeManager.getCurrent().setTimeStepSize(steps * self.step)
        self.stepper.setValueUInt(pbd.TimeStepController.NUM_SUB_STEPS, steps)
        self.stepper.step(self.model)

    def points(self, strand):
        clamp, bodies = self.strands[strand]
        ends = [np.array(b.getPosition()).ravel() + np.array(b.getRotationMatrix()).reshape(3, 3) @ self.local for b in bodies]
        y_up = np.array([clamp] + ends)
        return np.column_stack([y_up[:, 0], -y_up[:, 2], y_up[:, 1]])

    def rewind(self):
        self.model.reset()


def overhead(steps=2000):
    model, stepper = empty_model(), SIMULATION.getTimeStep()
    stepper.setValueUInt(pbd.TimeStepController.NUM_SUB_STEPS, 1)
    start = time.process_time()
    for _ in range(steps):
        stepper.step(model)
    return (time.process_time() - start) / steps


if __name__ == "__main__":
    serve(World=World, overhead=overhead, VERSION=VERSION)
