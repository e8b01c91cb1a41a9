"""Draws docs/figures/single_precision.png and writes the tables of docs/notebook/lanes.md from docs/figures/single_precision.csv. Run by `make figures`."""

from collections import defaultdict

import matplotlib.pyplot as plt

from plot import COLOURS, put, rows, save

HAIR = ["stiff", "soft", "limp", "curly", "coil"]
PALETTE = dict(zip(HAIR, COLOURS + ["#808080"]))


def figure(data):
    figure, panels = plt.subplots(1, 2, figsize=(8.4, 4.2), sharey=True)
    for panel, study, key, label in [(panels[0], "rate", "rate", "steps a second (10 elements)"),
                                     (panels[1], "elements", "elements", "elements (60 steps a second)")]:
        lines = defaultdict(list)
        for row in data[study]:
            lines[row["hair"], row["motion"]].append((float(row[key]), max(float(row["f32"]), 1e-8)))
        for (hair, motion), points in lines.items():
            style = "-" if motion == "shake" else "--"
            panel.loglog(*zip(*sorted(points)), style, marker="o", markersize=3, linewidth=1.1, color=PALETTE[hair],
                         label=hair if motion == "shake" else None)
        panel.axhline(1e-3, color="grey", linewidth=0.8)
        panel.set_xlabel(label)
    panels[0].set_ylabel("largest distance of f32 from f64 in 3 s / L")
    panels[0].set_title("solid: shaken head; dashed: recorded walk", fontsize=9)
    panels[1].set_title("grey: a thousandth of the length", fontsize=9)
    panels[0].legend(fontsize=8, ncols=2, loc="upper left")
    save(figure, "single_precision.png")


def number(text):
    value = float(text)
    return "0" if value == 0 else f"{value:.0e}".replace("e-0", "e-")


def motions(data, study, key, called):
    values = sorted({int(row[key]) for row in data[study]})
    lines = ["| hair (Γ) | motion | " + " | ".join(called(value) for value in values) + " |", "|---" * (len(values) + 2) + "|"]
    cells = {(row["hair"], row["gamma"], row["motion"], int(row[key])): row for row in data[study]}
    for hair, gamma, motion in dict.fromkeys(cell[:3] for cell in cells):
        line = []
        for value in values:
            row = cells[hair, gamma, motion, value]
            failed = int(row["unconverged32"])
            note = f" ({failed} of {row['steps']})" if failed else ""
            line.append(number(row["f32"]) + note)
        lines.append(f"| {hair} ({gamma}) | {motion} | " + " | ".join(line) + " |")
    return lines


def effort(data):
    lines = ["| | mean iterations in f64 | in f32 | steps in parts, f64 | f32 | unconverged, f64 | f32 |", "|---" * 7 + "|"]
    for study, key, values in [("rate", "rate", [30, 60, 120, 240, 480, 990]), ("elements", "elements", [5, 50, 200])]:
        for value in values:
            chosen = [row for row in data[study] if int(row[key]) == value]
            mean = [sum(float(row[f"iterations{bits}"]) for row in chosen) / len(chosen) for bits in (64, 32)]
            total = {name: sum(int(row[name]) for row in chosen) for name in ("subdivided64", "subdivided32", "unconverged64", "unconverged32")}
            called = f"1/{value} s" if key == "rate" else f"{value} elements, 1/60 s"
            lines.append(f"| {called} | {mean[0]:.2f} | {mean[1]:.2f} | " + " | ".join(str(count) for count in total.values()) + " |")
    return lines


def still(data):
    lines = ["| hair (Γ) | elements | step | f32 | f64 |", "|---" * 5 + "|"]
    for row in data["rest"]:
        lines.append(f"| {row['hair']} ({row['gamma']}) | {row['elements']} | 1/{row['rate']} s | {number(row['f32'])} | {number(row['f64'])} |")
    return lines


def energy(data):
    rates = sorted({int(row["rate"]) for row in data["energy"]})
    lines = ["| hair (Γ) | " + " | ".join(f"1/{rate} s" for rate in rates) + " |", "|---" * (len(rates) + 1) + "|"]
    cells = {(row["hair"], row["gamma"], int(row["rate"])): row for row in data["energy"]}
    for hair, gamma in dict.fromkeys(cell[:2] for cell in cells):
        pairs = [cells[hair, gamma, rate] for rate in rates]
        lines.append(f"| {hair} ({gamma}) | " + " | ".join(f"{float(row['f32']):+.4f} ({float(row['f64']):+.4f})" for row in pairs) + " |")
    return lines


if __name__ == "__main__":
    data = defaultdict(list)
    for row in rows("single_precision.csv"):
        data[row["study"]].append(row)
    figure(data)
    put(motions(data, "rate", "rate", lambda rate: f"1/{rate} s"), "notebook/lanes.md", "steps")
    put(motions(data, "elements", "elements", lambda count: f"N = {count}"), "notebook/lanes.md", "elements")
    put(effort(data), "notebook/lanes.md", "effort")
    put(still(data), "notebook/lanes.md", "rest")
    put(energy(data), "notebook/lanes.md", "energy")
