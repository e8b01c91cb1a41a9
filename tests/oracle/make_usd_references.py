"""Reference numbers for tests/files/usda.rs by Pixar's own library (pip install usd-core, 26.11) and numpy: run it in tests/data/usd; it
writes reference.json there.

World points of control points by UsdGeom.Xformable; points of cubic curves by the basis matrices of the USD documentation; NURBS by scipy."""

import json

import numpy as np
from pxr import Gf, Usd, UsdGeom
from scipy.interpolate import BSpline

BSPLINE = np.array([[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 0, 3, 0], [1, 4, 1, 0]]) / 6
BEZIER = np.array([[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 3, 0, 0], [1, 0, 0, 0]], float)
CATMULL_ROM = np.array([[-1, 3, -3, 1], [2, -5, 4, -1], [-1, 0, 1, 0], [0, 2, 0, 0]]) / 2


def cubic(basis, step, controls, per_span):
    controls = np.array(controls, float)
    spans = (len(controls) - 4) // step + 1
    out = []
    for span in range(spans):
        four = controls[step * span:step * span + 4]
        for k in range(per_span + (span == spans - 1)):
            u = k / per_span
            out.append(np.array([u**3, u**2, u, 1]) @ basis @ four)
    return np.array(out).tolist()


def world(stage, path, time):
    prim = stage.GetPrimAtPath(path)
    matrix = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(time)
    points = UsdGeom.PointBased(prim).GetPointsAttr().Get(time)
    return [list(matrix.Transform(Gf.Vec3d(*point))) for point in points]


placed = Usd.Stage.Open("placed.usda")
sphere = Usd.Stage.Open("arnold_groom_sphere.usda")
moving = Usd.Stage.Open("arnold_motion_var_vel.usda")
controls = [[0, 0, 0], [1, 2, 0], [2, -1, 1], [4, 0, 2], [5, 1, 0], [5, 3, 1], [6, 3, 3]]
knots = [0, 0, 0, 0, 1, 2.5, 3, 4, 4, 4, 4]
weights = [1, 0.5, 2, 1, 3, 1, 1]
homogeneous = np.hstack([np.array(controls, float) * np.array(weights)[:, None], np.array(weights, float)[:, None]])
spline = BSpline(np.array(knots, float), homogeneous, 3)
parameters = [b + (e - b) * k / 4 for b, e in zip([0, 1, 2.5, 3], [1, 2.5, 3, 4]) for k in range(4)] + [4]
rational = [(spline(u)[:3] / spline(u)[3]).tolist() for u in parameters]
sphere_points = world(sphere, "/groom_sphere", Usd.TimeCode.EarliestTime())
reference = {
    "placed": {str(time): world(placed, "/head/hair/a", time) + world(placed, "/head/hair/b", time) for time in (0, 2.5, 10)},
    "moving": {
        str(time): {
            "points": world(moving, "/cur_var_vel/curve_0", time),
            "velocities": [list(v) for v in UsdGeom.PointBased(moving.GetPrimAtPath("/cur_var_vel/curve_0")).GetVelocitiesAttr().Get(time)],
        }
        for time in (6, 9)
    },
    "sphere_first": cubic(BSPLINE, 1, sphere_points[:13], 4),
    "sphere_last": cubic(BSPLINE, 1, sphere_points[-13:], 4),
    "controls": controls,
    "bspline": cubic(BSPLINE, 1, controls, 4),
    "bezier": cubic(BEZIER, 3, controls, 4),
    "catmullRom": cubic(CATMULL_ROM, 1, controls, 4),
    "knots": knots,
    "weights": weights,
    "nurbs": rational,
}
with open("reference.json", "w") as file:
    json.dump(reference, file, indent=0)
    file.write("\n")
