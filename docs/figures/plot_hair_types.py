"""Draws docs/figures/hair_types.png and writes the tables of docs/hair_types.md between their markers, from docs/figures/hair_types.csv and
hair_sliders.csv. The points of the picture are an argument (examples/hair_types.rs writes them); without it only the tables are written."""

import csv
import sys
from collections import defaultdict

import matplotlib.pyplot as plt

from plot import COLOURS, put, rows, save
from plot_performance import table

PAGE = "hair_types.md"


def kinds():
    lines = [(f"`{row['type']}`", f"{row['a1_um']} / {row['a2_um']}", row["modulus_gpa"], row["ei0"], row["ei1"], row["ei2"],
              f"{row['curvature']} / {row['twist']}", f"{row['paper_curvature']} / {row['paper_twist']}", row["span_natural"], row["span_rest"],
              row["droop"]) for row in rows("hair_types.csv")]
    put(table(("type", "semi-axes, µm", "E, GPa", "EI0, N·m²", "EI1", "EI2", "κ1 / κ0, rad/m", "the paper's", "natural span", "span at rest", "droop"),
              lines), PAGE, "kinds")


def sliders():
    lines = [(row["slider"], f"`{row['type']}`", row["measure"], row["minus_1"], row["minus_half"], row["zero"], row["half"], row["one"])
             for row in rows("hair_sliders.csv")]
    put(table(("slider", "type", "what is measured", "−1", "−½", "0", "½", "1"), lines), PAGE, "sliders")


def picture(path):
    strands = defaultdict(list)
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            strands[row["type"], row["when"], row["strand"]].append((1e2 * float(row["x"]), 1e2 * float(row["z"])))
    names = [row["type"] for row in rows("hair_types.csv")]
    figure, axes = plt.subplots(2, len(names), figsize=(11, 4.4), sharex=True, sharey=True)
    for row, (when, title) in enumerate([("natural", "natural shape"), ("rest", "at rest under gravity")]):
        for column, name in enumerate(names):
            panel = axes[row][column]
            for (kind, moment, strand), points in strands.items():
                if (kind, moment) == (name, when):
                    panel.plot(*zip(*points), color=COLOURS[int(strand) % 4], linewidth=0.6)
            panel.set_aspect("equal")
            panel.set_title(name if row == 0 else "", fontsize=9)
            if column == 0:
                panel.set_ylabel(f"{title}, cm")
    save(figure, "hair_types.png")


if __name__ == "__main__":
    kinds()
    sliders()
    if len(sys.argv) > 1:
        picture(sys.argv[1])
