#!/usr/bin/env python3
"""Draws the figures of docs/theory/styling_tools.md and docs/theory/hair_handle.md from what the tests print:

    cargo test --profile demo --test styling -- --nocapture --test-threads=1 > styling.txt
    python3 docs/figures/plot_styling.py styling.txt
"""

import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

FOLDER = Path(__file__).resolve().parent

text = Path(sys.argv[1]).read_text(encoding="utf-8")

spread = [float(value) for value in re.findall(r"stroke \d+: lateral spread ([\d.]+) mm", text)]
figure, axes = plt.subplots(figsize=(4.5, 2.8), layout="constrained")
axes.plot(range(len(spread)), spread, "o-", color="#7a4a2b")
axes.set(xlabel="stroke", ylabel="lateral spread, mm", ylim=(0, None), xticks=range(len(spread)))
axes.spines[["top", "right"]].set_visible(False)
figure.savefig(FOLDER / "combing_spread.png", dpi=150)

curves = re.findall(r"^(h1|h2|ga1|gc3) stroke,mm ([\d., e-]+) force,uN ([\d., e-]+)$", text, re.MULTILINE)
figure, axes = plt.subplots(figsize=(5.5, 3.2), layout="constrained")
for name, stroke, force in curves:
    axes.plot([float(x) for x in stroke.split(",")], [float(x) for x in force.split(",")], label=name.upper())
axes.set(xlabel="stroke, mm", ylabel="force on one hair, µN", ylim=(0, None))
axes.spines[["top", "right"]].set_visible(False)
axes.legend(frameon=False)
figure.savefig(FOLDER / "combing_force.png", dpi=150)
