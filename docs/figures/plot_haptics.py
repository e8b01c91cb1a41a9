"""Draws the figures of docs/notebook/haptics.md from docs/figures/haptics_*.csv, and the picture of the comb from out/haptics where that was just made."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from plot import put, rows, save
from plot_performance import table

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "out" / "haptics"
PAGE = "notebook/haptics.md"
MOMENTS = (0.02, 0.8, 1.4, 2.0)
TEETH = 7


def numbers(name, *columns):
    table = rows(name)
    return [np.array([float(row[column]) for row in table]) for column in columns]


def curves(path):
    """The polylines of an OBJ."""
    points, lines = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(word) for word in words[1:4]])
        elif words[:1] == ["l"]:
            lines.append([int(word) - 1 for word in words[1:]])
    points = np.array(points)
    return [points[line] for line in lines]


def bust():
    points, faces = [], []
    for line in (ROOT / "tests/data/grooms/sintel_bust.obj").read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([0.01 * float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
            faces += [[corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1)]
    return np.array(points), np.array(faces)


def seen(points, turn, down=0.5):
    """Right, up and towards the eye, from behind the head, from the side by an angle and from above by another."""
    c, s = np.cos(turn), np.sin(turn)
    x, y, z = points[..., 0], points[..., 1] - 0.3, points[..., 2]
    near = -s * x - c * z
    return np.stack([-c * x + s * z, np.cos(down) * y - np.sin(down) * near, np.sin(down) * y + np.cos(down) * near], axis=-1)


def comb_picture():
    """Four moments of the first stroke, from behind and to the left."""
    if not (OUT / "hair.3.obj").exists():
        return
    turn = 0.6
    points, faces = bust()
    corners = seen(points, turn)[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    facing = normals[:, 2] > 0.0
    order = np.argsort(corners[facing].mean(axis=1)[:, 2])
    light = 0.45 + 0.55 * np.clip(normals[facing] @ np.array([0.3, 0.5, 0.8]), 0.0, 1.0)
    skin = np.clip(light[:, None] * np.array([0.93, 0.78, 0.68]), 0.0, 1.0)
    force = np.genfromtxt(OUT / "force.csv", delimiter=",", names=True)
    figure, axes = plt.subplots(1, len(MOMENTS), figsize=(13.0, 4.6))
    for k, (moment, axis) in enumerate(zip(MOMENTS, axes)):
        axis.add_collection(PolyCollection(corners[facing][order][:, :, :2], facecolors=skin[order], edgecolors=skin[order], linewidths=0.3))
        tick = min(int(moment * 1000), len(force) - 1)
        tip = np.array([force[name][tick] for name in ("x", "y", "z")])
        items = [(strand, "hair") for strand in curves(OUT / f"hair.{k}.obj")]
        for tooth in range(TEETH):
            at = tip + np.array([0.006 * (tooth - TEETH // 2), 0.0, 0.0])
            items.append((np.array([at + np.array([0.0, 0.0, -0.04]), at]), "tooth"))
        drawn = [(seen(line, turn), kind) for line, kind in items]
        drawn.sort(key=lambda item: item[0][:, 2].mean())
        for line, kind in drawn:
            if kind == "hair":
                shade = 0.55 + 0.45 * np.clip((line[:, 2].mean() + 0.05) / 0.2, 0.0, 1.0)
                colour, width = np.array([0.50, 0.26, 0.12]) * shade, 1.5
            else:
                colour, width = np.array([0.10, 0.22, 0.45]), 2.6
            axis.add_collection(LineCollection([line[:, :2]], colors=[colour], linewidths=width, capstyle="round"))
        axis.set(xlim=(-0.17, 0.15), ylim=(-0.16, 0.19), aspect="equal")
        axis.axis("off")
        axis.set_title(f"{moment:.1f} s", fontsize=10)
    save(figure, "haptics_comb.png")


def comb_force():
    t, x, y, z, height, pressing = numbers("haptics_comb.csv", "seconds", "force_x", "force_y", "force_z", "y", "pressing")
    figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(9.0, 5.2), sharex=True, height_ratios=(3, 1, 1))
    for values, label in ((x, "across"), (y, "up"), (z, "towards the head")):
        top.plot(t, 1e3 * values, lw=0.9, label=label)
    top.plot(t, 1e3 * np.sqrt(x * x + y * y + z * z), color="black", lw=0.6, label="size")
    top.set_ylabel("force on the hand, mN")
    top.legend(frameon=False, ncol=4, fontsize=8)
    middle.plot(t, 100 * height, lw=0.9, color="tab:gray")
    middle.set_ylabel("height, cm")
    bottom.fill_between(t, pressing, step="mid", color="tab:brown", alpha=0.6)
    bottom.set(ylabel="contacts", xlabel="s")
    save(figure, "haptics_force.png")


def types():
    felt = rows("haptics_types.csv")
    figure, axes = plt.subplots(1, 2, figsize=(11.0, 4.0), sharex=True)
    for law, axis in zip(("contact", "explicit"), axes):
        for kind in dict.fromkeys(row["type"] for row in felt):
            mine = [row for row in felt if row["type"] == kind and row["law"] == law]
            axis.plot([float(row["seconds"]) for row in mine], [float(row["force_uN"]) for row in mine], lw=0.9, label=kind)
        axis.set(xlabel="s", title="contact" if law == "contact" else "the explicit formula")
        axis.set_yscale("symlog", linthresh=1.0 if law == "contact" else 0.1)
    axes[0].set_ylabel("force, µN (means over 25 ms)")
    axes[1].legend(frameon=False, fontsize=8, ncol=2)
    save(figure, "haptics_types.png")


def rates():
    t, direct, once, finely = numbers("haptics_rates_curves.csv", "seconds", "direct", "handed_over", "handed_over_8")
    figure, axis = plt.subplots(figsize=(9.0, 3.2))
    axis.plot(t, direct, lw=1.6, label="direct, 1 kHz", color="silver")
    axis.plot(t, once, lw=0.6, label="handed over, 120 Hz", color="tab:red")
    axis.plot(t, finely, lw=0.6, label="the same, 8 substeps", color="tab:blue")
    axis.set(xlabel="s", ylabel="force, µN")
    axis.legend(frameon=False)
    save(figure, "haptics_rates.png")


def latency():
    ms, *ways = numbers("haptics_latency.csv", "from_ms", "to_simulation", "to_device", "whole_way")
    figure, axes = plt.subplots(1, 3, figsize=(11.0, 2.8), sharey=False)
    # The last is counted in whole milliseconds, the device's ticks.
    whole = np.bincount(np.floor(ms + 0.25).astype(int), weights=ways[2])
    titles = ("pose to simulation", "simulation to force", "pose to the first force of its step")
    for way, title, axis in zip((*ways[:2], whole), titles, axes):
        width = 1.0 if way is whole else 0.25
        axis.bar(width * np.arange(len(way)), way, width=0.9 * width, align="edge", color="tab:blue")
        last = width * np.nonzero(way)[0].max() if way.any() else 1.0
        axis.set(xlabel="ms", title=title, xlim=(0, last + 1.0), yscale="log")
    axes[0].set_ylabel("steps")
    save(figure, "haptics_latency.png")


def tables():
    """The measured tables of the page."""
    put(table(("strands", "contacts", "step, ms", "hand-over, ms", "the longest, ms"),
              [tuple(row.values()) for row in rows("haptics_cost.csv")]), PAGE, "cost")
    put(table(("", "median, ms", "99 of 100", "99.9 of 100", "longest"), [tuple(row.values()) for row in rows("haptics_minute.csv")]), PAGE, "minute")

    def percent(row, record):
        return ", ".join(f"{100 * float(row[f'{record}_{ticks}ms']):.1f}" for ticks in (1, 8, 25)) + " %"

    put(table(("hair", "stroke", "force, rms", "simulation", "substeps", "late", "handed over", "the simulation's own steps"),
              [(row["hair"], f"{row['seconds']} s", f"{row['rms_uN']} µN", f"{float(row['rate_hz']):.0f} Hz", row["substeps"],
                f"{row['late_ms']} ms", percent(row, "felt"), percent(row, "simulated")) for row in rows("haptics_rates.csv")]), PAGE, "rates")
    put(table(("type", "EI1, 10⁻⁹ N·m²", "friction", "κ1, rad/m", "mean drag, µN", "peak, µN", "mean drag by the explicit formula, µN"),
              [tuple(row.values()) for row in rows("haptics_types_means.csv")]), PAGE, "types")


if __name__ == "__main__":
    tables()
    comb_picture()
    comb_force()
    types()
    rates()
    latency()
