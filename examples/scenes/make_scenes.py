#!/usr/bin/env python3
"""Writes the scenes beside it, for `superhelix run`: no libraries needed.

Lengths in m, z up. Strands are laid out by formula, so that every run of this script gives the same files.
"""
import json
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))


def rounded(value):
    """Numbers to seven digits: what a reader of the scene wants to see."""
    if isinstance(value, float):
        return float(f"{value:.7g}")
    if isinstance(value, (list, tuple)):
        return [rounded(item) for item in value]
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    return value


def write(name, about, scene):
    """One line for each strand, collider and attachment, and for each other key."""
    lines = []
    for key, value in scene.items():
        if key in ("strands", "colliders", "attachments"):
            items = ",\n".join("    " + json.dumps(rounded(item)) for item in value)
            lines.append(f'  "{key}": [\n{items}\n  ]')
        else:
            # In full: a step rounded to less would leave a remainder in every interval.
            lines.append(f'  "{key}": {json.dumps(value)}')
    comment = "".join(f"  // {line}\n" for line in about)
    with open(os.path.join(HERE, name), "w", encoding="utf-8") as file:
        file.write("{\n" + comment + ",\n".join(lines) + "\n}\n")


def turn(tangent, up=(0.0, 0.0, 1.0)):
    """The unit quaternion x, y, z, w of a frame whose first axis is the tangent."""
    norm = math.sqrt(sum(x * x for x in tangent))
    x = [value / norm for value in tangent]
    if abs(sum(a * b for a, b in zip(x, up))) > 0.99:
        up = (1.0, 0.0, 0.0)
    along = sum(a * b for a, b in zip(x, up))
    z = [a - along * b for a, b in zip(up, x)]
    norm = math.sqrt(sum(a * a for a in z))
    z = [value / norm for value in z]
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    m = [[x[row], y[row], z[row]] for row in range(3)]
    trace = m[0][0] + m[1][1] + m[2][2]
    if trace > 0:
        s = 2 * math.sqrt(trace + 1)
        q = [(m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4]
    else:
        i = max(range(3), key=lambda axis: m[axis][axis])
        j, k = (i + 1) % 3, (i + 2) % 3
        s = 2 * math.sqrt(1 + m[i][i] - m[j][j] - m[k][k])
        q = [0.0] * 4
        q[i] = s / 4
        q[j], q[k] = (m[j][i] + m[i][j]) / s, (m[k][i] + m[i][k]) / s
        q[3] = (m[k][j] - m[j][k]) / s
    norm = math.sqrt(sum(value * value for value in q))
    return [value / norm for value in q]


HAIR = {"elements": 10, "radius": [40e-6, 40e-6], "youngs_modulus": 2e9, "air_drag": 1e-5, "internal_friction": 5e-10}
DOWN = turn((0.0, 0.0, -1.0))


def incline():
    angle = math.radians(20)
    write(
        "incline.json",
        ["A limp strand laid across a slope of 20 degrees (gravity is turned, not the plane). Friction of 0.4 holds it: tan 20 is 0.364.",
         "With 0.36 it slides."],
        {
            "version": 1, "gravity": [0, 9.81 * math.sin(angle), -9.81 * math.cos(angle)],
            "time_step": 1 / 60, "duration": 1, "output_interval": 0.1,
            "contact": {"model": "coulomb"},
            "strands": [{"elements": 10, "length": 0.2, "youngs_modulus": 1e6, "root": {"origin": [0, 0, 50e-6]}}],
            "colliders": [{"shape": "halfspace", "friction": 0.4}],
            "output": ["points", "contacts", "wrenches"],
        },
    )


def braid_tie():
    strands = []
    for index in range(12):
        angle = 2 * math.pi * index / 12
        origin = [0.012 * math.cos(angle), 0.012 * math.sin(angle), 0]
        strands.append({**HAIR, "length": 0.2, "viscosity": 0.02, "root": {"origin": origin, "rotation": DOWN}})
    attachments = [
        {"kind": "tie", "strand": index, "arclength": 0.14, "other": index + 1, "other_arclength": 0.14} for index in range(11)
    ]
    motion = {"times": [0.0, 0.5, 1.0], "frames": [[0, 0, -0.135, 0, 0, 0, 1], [0.03, 0, -0.12, 0, 0, 0, 1], [0, 0, -0.13, 0, 0, 0, 1]]}
    attachments.append({"kind": "point", "strand": 0, "arclength": 0.14, "motion": motion})
    write(
        "braid_tie.json",
        ["Twelve strands drawn together by a tie 14 cm from their roots, which is led to the side and back."],
        {
            "version": 1, "time_step": 1 / 120, "duration": 1.5, "output_interval": 0.25, "strands": strands,
            "attachments": attachments, "output": ["points", "attachments"],
        },
    )


def shoulder():
    strands, head, radius = [], [0.0, 0.0, 0.21], 0.085
    count = 220
    for index in range(count):
        # Even over the upper half of the head, by the golden angle; the face (against y) stays free, and so does the back of the head.
        height = 1 - 1.05 * (index + 0.5) / count
        around = index * math.pi * (3 - math.sqrt(5))
        flat = math.sqrt(1 - height * height)
        normal = [flat * math.cos(around), flat * math.sin(around), height]
        if abs(normal[1]) > 0.55:
            continue
        strands.append({
            **HAIR, "elements": 12, "length": 0.28 + 0.04 * math.sin(5.1 * index) ** 2,
            "natural_curvatures": [[0, 4 * math.sin(78.233 * index), 4 * math.cos(37.719 * index)]], "viscosity": 0.01,
            "root": {"origin": [middle + radius * value for middle, value in zip(head, normal)], "rotation": turn(normal)},
        })
    body = {"friction": 2.0}
    write(
        "shoulder.json",
        ["Long hair that stands away from a head is let go: it falls over head and neck and lies on the shoulders."],
        {
            "version": 1, "time_step": 1 / 120, "duration": 1.5, "output_interval": 0.25,
            "contact": {"model": "hard", "strands": {"exempt_length": 0.004}},
            "strands": strands,
            "colliders": [
                {"shape": "sphere", "radius": radius, **body, "pose": {"origin": head}},
                {"shape": "capsule", "a": [0, 0, 0.02], "b": [0, 0, 0.16], "radius": 0.045, **body},
                {"shape": "capsule", "a": [-0.15, 0, 0], "b": [0, 0, 0.02], "radius": 0.07, **body},
                {"shape": "capsule", "a": [0, 0, 0.02], "b": [0.15, 0, 0], "radius": 0.07, **body},
            ],
            "output": ["points"],
        },
    )


def combed_sphere():
    radius, strands = 0.09, []
    count = 150
    for index in range(count):
        # Even over a cap of 40 degrees, by the golden angle.
        height = 1 - (1 - math.cos(math.radians(40))) * (index + 0.5) / count
        around = index * math.pi * (3 - math.sqrt(5))
        flat = math.sqrt(1 - height * height)
        normal = [flat * math.cos(around), flat * math.sin(around), height]
        # Tousled: every strand leaves towards a side of its own, and bends by chance.
        toward = 2.4 * index * index
        tangent = [0.7 * n + s for n, s in zip(normal, [math.cos(toward), math.sin(toward), 0.0])]
        bend, sweep = 5 * math.sin(78.233 * index), 5 * math.cos(37.719 * index)
        strands.append({
            **HAIR, "elements": 8, "length": 0.05 + 0.015 * math.sin(5.1 * index) ** 2, "youngs_modulus": 5e7, "viscosity": 0.01,
            "natural_curvatures": [[0, bend, sweep]],
            "root": {"origin": [radius * value for value in normal], "rotation": turn(tangent)},
        })
    teeth = []
    # The comb comes down on the left side from 0.3 to 0.5 s, and goes from there over the crown to the right: each pose turns it about
    # y. Its teeth end 0.3 mm above the sphere.
    times = [0.3, 0.5] + [0.5 + 0.05 * step for step in range(1, 25)]
    for tooth in range(25):
        y = -0.072 + 0.006 * tooth
        frames = []
        for step, _ in enumerate(times):
            angle = math.radians(-75 + 6 * max(0, step - 1))
            away = 0.1 if step == 0 else 0.0
            frames.append([away * math.sin(angle), y, away * math.cos(angle), 0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2)])
        inner = math.sqrt(0.0913 ** 2 - y * y)
        teeth.append({
            "shape": "capsule", "a": [0, 0, inner], "b": [0, 0, 0.15], "radius": 0.001, "friction": 0.0,
            "motion": {"times": times, "frames": frames},
        })
    write(
        "combed_sphere.json",
        ["Tousled limp hair lies down on a sphere, whose friction holds it; a comb of 25 smooth teeth, 2 mm thick and 4 mm apart, then goes over the",
         "sphere from left to right in 1.2 s, and the hair stays as it has been combed."],
        {
            "version": 1, "time_step": 1 / 240, "duration": 2.0, "output_interval": 0.25,
            "contact": {"model": "hard", "strands": {"exempt_length": 0.01}},
            "strands": strands,
            "colliders": [{"shape": "sphere", "radius": radius, "friction": 0.5}] + teeth,
            "output": ["points"],
        },
    )


def render_hair():
    radius, tilt, strands, count = 0.09, 0.3, [], 40
    times = [0.0, 0.25, 0.5, 0.75, 1.0]
    # The head nods about x and back.
    angles = [0.0, tilt, 0.0, -tilt, 0.0]
    frames = [[0, 0, 0, math.sin(angle / 2), 0, 0, math.cos(angle / 2)] for angle in angles]
    for index in range(count):
        # Even over a cap of 50 degrees, by the golden angle.
        height = 1 - (1 - math.cos(math.radians(50))) * (index + 0.5) / count
        around = index * math.pi * (3 - math.sqrt(5))
        flat = math.sqrt(1 - height * height)
        normal = [flat * math.cos(around), flat * math.sin(around), height]
        strands.append({
            "elements": 6, "length": 0.12,
            "hair": {"type": "caucasian2", "strand": index, "variation": {"between": 0.1, "seed": 1}},
            "root_motion": {
                "times": times, "frames": frames,
                "local": {"origin": [radius * value for value in normal], "rotation": turn(normal)},
            },
        })
    write(
        "render_hair.json",
        ["Forty guides on a head that nods, and two thousand strands to be drawn that follow them in wisps: render.usda beside this file."],
        {
            "version": 1, "time_step": 1 / 60, "duration": 1.0, "output_interval": 1 / 30, "strands": strands,
            "render_hair": {"out": "render.usda", "count": 2000, "curliness": 0.5, "wisps": 3, "frizz": 0.001},
        },
    )


if __name__ == "__main__":
    incline()
    braid_tie()
    shoulder()
    combed_sphere()
    render_hair()
