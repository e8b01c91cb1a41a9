"""Draws docs/figures/render_hair.png and writes the tables of docs/render_hair.md. Run by `make figures`.

    plot_render_hair.py FRAMES    directory with a.hair ... d.hair, e.hair as `scripts/render_hair.sh` makes them
"""

import struct
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from plot import DOCS, put, rows, save
from plot_performance import table

GROOMS = DOCS.parent / "tests" / "data" / "grooms"


def hair(path):
    data = Path(path).read_bytes()
    strands, points, mask, segments = struct.unpack("<4I", data[4:20])
    assert mask & 1 == 0, "strands of equal numbers of points"
    return np.frombuffer(data, "<f4", 3 * points, 128).reshape(strands, segments + 1, 3)


def bust():
    vertices, faces = [], []
    for line in (GROOMS / "sintel_bust.obj").read_text().splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append([float(value) for value in rest[:3]])
        elif word == "f":
            corners = [int(value.split("/")[0]) - 1 for value in rest]
            faces += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
    return np.array(vertices)[np.array(faces)]


def turned(points, angle):
    """Seen from the back and a little from the side: x to the right, y up, depth towards the eye."""
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.stack([cosine * points[..., 0] - sine * points[..., 2], points[..., 1], sine * points[..., 0] + cosine * points[..., 2]], -1)


def panel(axes, strands, mesh, title, angle, limits):
    strands, mesh = turned(strands, angle), turned(mesh, angle)
    normals = np.cross(mesh[:, 1] - mesh[:, 0], mesh[:, 2] - mesh[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True) + 1e-12
    light = np.array([-0.3, 0.6, 0.74])
    light /= np.linalg.norm(light)
    shown = normals[:, 2] > 0
    mesh, normals = mesh[shown], normals[shown]
    pieces = np.stack([strands[:, :-1], strands[:, 1:]], 2).reshape(-1, 2, 3)
    along = pieces[:, 1] - pieces[:, 0]
    along /= np.linalg.norm(along, axis=1, keepdims=True) + 1e-12
    # Kajiya and Kay 1989.
    sine = np.sqrt(np.clip(1 - (along @ light) ** 2, 0, 1))
    half = light + np.array([0, 0, 1])
    half /= np.linalg.norm(half)
    shine = np.clip(1 - (along @ half) ** 2, 0, 1) ** 20
    colours = np.clip(np.outer(0.25 + 0.75 * sine, [0.50, 0.16, 0.07]) + np.outer(0.35 * shine, [1.0, 0.8, 0.6]), 0, 1)
    depth_of_hair, depth_of_mesh = pieces[:, :, 2].mean(1), mesh[:, :, 2].mean(1)
    # Layers from back to front, the mesh and the hair of each.
    edges = np.quantile(np.concatenate([depth_of_hair, depth_of_mesh]), np.linspace(0, 1, 41))
    edges[-1] += 1
    for low, high in zip(edges, edges[1:]):
        chosen = (depth_of_mesh >= low) & (depth_of_mesh < high)
        if chosen.any():
            shade = 0.45 + 0.5 * np.clip(normals[chosen] @ light, 0, 1)
            axes.add_collection(PolyCollection(mesh[chosen][:, :, :2], facecolors=np.outer(shade, [0.93, 0.80, 0.72]), edgecolors="face", linewidths=0.3))
        chosen = np.flatnonzero((depth_of_hair >= low) & (depth_of_hair < high))
        chosen = chosen[np.argsort(depth_of_hair[chosen])]
        if len(chosen):
            axes.add_collection(LineCollection(pieces[chosen][:, :, :2], colors=colours[chosen], linewidths=0.22))
    axes.set_xlim(limits[0] - 0.5, limits[1] + 0.5)
    axes.set_ylim(limits[2] - 0.5, limits[3] + 0.5)
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(title, fontsize=9)


def picture(directory):
    mesh = bust()
    angle = np.radians(-35)
    seen = turned(hair(Path(directory) / "a.hair"), angle)[..., :2]
    low, high = seen.min((0, 1)), seen.max((0, 1))
    figure, axes = plt.subplots(1, 5, figsize=(13.5, 4.4))
    for place, name, title in zip(axes, "abcde", [
            "(a) smoothly interpolated", "(b) interpolated near the roots,\nclumpy near the tips", "(c) disjoint locks",
            "(d) with the criterion on tips", "(d) without it"]):
        panel(place, hair(Path(directory) / f"{name}.hair"), mesh, title, angle, (low[0] - 1.5, high[0] + 1.5, low[1], high[1]))
    save(figure, "render_hair.png")


def tables():
    lines, last = [], None
    for row in rows("render_hair.csv"):
        key = (row["groom"], row["guides"])
        head = (row["groom"], row["guides"], row["strands"]) if key != last else ("", "", "")
        percent = tuple(f"{100 * float(row[name]):.1f}" for name in ("length_kept", "turning_kept", "curls_kept", "apart_median"))
        lines.append(head + (row["mixed"],) + percent)
        last = key
    put(table(("groom", "guides", "strands made", "mixed", "length kept, %", "turning kept, %", "curls kept, %", "apart, % of the length"), lines),
        "render_hair.md", "kept")
    lines = [(row["space"], row["threads"], row["output"], row["least_ms"], row["median_ms"]) for row in rows("render_hair_cost.csv")]
    put(table(("mixed in", "threads", "what", "least, ms", "median, ms"), lines), "render_hair.md", "render_cost")


if __name__ == "__main__":
    tables()
    if len(sys.argv) > 1:
        picture(sys.argv[1])
