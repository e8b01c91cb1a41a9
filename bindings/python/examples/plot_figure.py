#!/usr/bin/env python3
"""Draws docs/figures/python_plot.png: curls on a head that turns, at three moments. Usage: plot_figure.py OUT.png"""

from __future__ import annotations

import sys

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np

import superhelix as shx
from superhelix.plot import plot_curves


def curls(count: int = 120, points: int = 48) -> np.ndarray:
    """Curls that leave the top half of a head of 8 cm and hang to its shoulders."""
    rng = np.random.default_rng(4)
    polar, turn = np.arccos(1.0 - rng.uniform(0.0, 0.75, count)), rng.uniform(0.0, 2 * np.pi, count)
    out = np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], axis=-1)
    along = np.linspace(0.0, 1.0, points)
    drop = np.cumsum(np.clip(along * 2.2 - 0.15, 0.0, 1.0)) / points
    away = np.stack([out[:, 0], out[:, 1], np.zeros(count)], axis=-1)
    curve = 0.08 * out[:, None] + 0.05 * (along * (1 - 0.4 * along))[:, None] * (0.5 * out + 0.9 * away)[:, None]
    curve[..., 2] -= 0.16 * drop
    phase = turn[:, None] + 26.0 * along
    radius = 0.007 * np.clip(3 * along, 0.0, 1.0)
    side = np.stack([-out[:, 1], out[:, 0], np.zeros(count)], axis=-1)[:, None]
    return curve + radius[:, None] * (np.cos(phase)[..., None] * side + np.sin(phase)[..., None] * away[:, None])


def head(time: float) -> np.ndarray:
    """The head's frame: it turns by 35 degrees to each side, twice in three seconds."""
    return np.r_[0.0, 0.0, 0.0, shx.frames.from_axis_angle((0, 0, 1), 0.6 * np.sin(2 * np.pi * 1.5 * time))]


def main() -> None:
    """Simulates and draws."""
    result = shx.simulate(shx.Groom.from_curves(curls()), head, duration=0.6, body=shx.BodyDef.sphere(0.078), element_count=14)
    figure = plt.figure(figsize=(12, 4.4))
    for place, frame in enumerate((0, 5, 11)):
        ax = figure.add_subplot(1, 3, place + 1, projection="3d")
        plot_curves(result.points[frame], ax=ax, linewidth=1.1)
        ax.view_init(12, -70)
        ax.set_title(f"{result.times[frame]:.2f} s")
    figure.subplots_adjust(left=0.01, right=0.95, bottom=0.09, top=0.92, wspace=0.14)
    figure.savefig(sys.argv[1], dpi=80)


if __name__ == "__main__":
    main()
