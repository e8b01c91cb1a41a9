"""Draws docs/figures/*.png from docs/figures/*.csv and writes the measured tables of docs/theory/*.md and docs/notebook/*.md between their markers. Run by `make figures`."""

import csv
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

FIGURES = Path(__file__).resolve().parent
DOCS = FIGURES.parent
plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "grid.linewidth": 0.5, "legend.frameon": False,
                     "axes.spines.top": False, "axes.spines.right": False})
COLOURS = ["#1f5fa8", "#c7622b", "#3d8f53", "#7a4a9e"]


def rows(name):
    with open(FIGURES / name, newline="") as file:
        return list(csv.DictReader(file))


def save(figure, name):
    figure.tight_layout()
    figure.savefig(FIGURES / name, dpi=110, metadata={"Software": None})
    plt.close(figure)
    print(f"docs/figures/{name}: {(FIGURES / name).stat().st_size // 1024} kB")


def put(lines, page, name):
    """Puts a table between a page's markers."""
    page = DOCS / page
    text, end = page.read_text(), f"<!-- end of {name} -->"
    start = next(line + "\n" for line in text.splitlines() if line.startswith(f"<!-- {name}: made by "))
    before, rest = text.split(start)
    _, after = rest.split(end)
    page.write_text(before + start + "\n".join(lines) + "\n" + end + after)
    print(f"docs/{page.relative_to(DOCS)}: table of {name}")


def convergence():
    data = defaultdict(lambda: defaultdict(list))
    for row in rows("convergence.csv"):
        values = (float(row["step"]), float(row["tip_error"]), float(row["extrapolated_error"] or "nan"))
        data[row["integrator"]][row["trajectory"]].append(values)
    figure, axes = plt.subplots(1, 2, figsize=(8.4, 4.4), sharey=True)
    for panel, (integrator, title, weight, slope, order) in zip(axes, [
            ("implicit_euler", "implicit Euler", 0.5, 1, "first order"),
            ("second_order", "second order (default)", 0.1, 2, "second order")]):
        for colour, (name, points) in zip(COLOURS, sorted(data[integrator].items())):
            step, error, extrapolated = np.array(points).T
            panel.loglog(step, error, "o-", color=colour, markersize=3.5, linewidth=1.2, label=name)
            panel.loglog(step, extrapolated, "s--", color=colour, markersize=3, linewidth=0.9, markerfacecolor="white")
        step = np.array([min(step), max(step)])
        panel.loglog(step, weight * (step / step[1]) ** slope, ":", color="black", linewidth=1, label=order)
        panel.axhline(1e-4, color="grey", linewidth=0.8)
        panel.set_xlabel("step h (s)")
        panel.set_title(f"{title}\nsolid: as it is; dashed: Richardson, from h and 2h", fontsize=9)
    axes[1].text(step[0], 1.1e-4, "$10^{-4}$ L", ha="left", va="bottom", color="grey")
    axes[1].legend(fontsize=8, loc="lower right")
    axes[0].set_ylabel("largest tip error / length")
    save(figure, "convergence.png")
    rates = [60, 240, 960, 3840, 15360]
    lines = ["| trajectory | integrator | " + " | ".join(f"h = 1/{rate}" for rate in rates) + " | extrapolated from the last two |",
             "|---" * (len(rates) + 3) + "|"]
    for name in sorted(data["second_order"]):
        for integrator in ("implicit_euler", "second_order"):
            points = data[integrator][name]
            known = {round(1 / step): error for step, error, _ in points}
            lines.append(f"| `{name}` | {integrator.replace('_', ' ')} | " + " | ".join(f"{known[rate]:.2g}" for rate in rates) +
                         f" | {points[-1][2]:.1g} |")
    put(lines, "theory/convergence.md", "convergence")


def sampling():
    data = rows("sampling.csv")
    lines = ["| what is written | a copy | processor time | ratio | a point, ns | clock, one thread | clock, two |", "|---" * 7 + "|"]
    for row in data:
        if row["kind"] == "sampling":
            copy, one, two, spent = (float(row[key]) for key in "abcd")
            points = 16e-6 * int(row["count"])
            lines.append(f"| {row['what']} | {copy:.2f} | {spent:.1f} | {spent / copy:.1f} | {spent / points:.1f} | {one:.1f} | {two:.1f} |")
        if row["kind"] == "one by one":
            spent, points = float(row["d"]), 16e-6 * int(row["count"])
            lines.append(f"| (strand by strand, `Solver::sample_strands`: all three in f64) | | {spent:.0f} | | {spent / points:.1f} | "
                         f"{float(row['a']):.0f} | |")
    put(lines, "notebook/performance.md", "sampling")
    told = {(row["what"], row["count"]): float(row["b"]) for row in data if row["kind"] == "memory"}
    counts = sorted({int(count) for _, count in told})
    lines = ["| integrator | " + " | ".join(f"N = {count}" for count in counts) + " |", "|---" * (len(counts) + 1) + "|"]
    for name in ("SecondOrder", "ImplicitEuler", "LinearlyImplicit"):
        words = "".join(" " + letter.lower() if letter.isupper() else letter for letter in name).strip()
        lines.append(f"| {words} | " + " | ".join(f"{told[name, str(count)]:.0f}" for count in counts) + " |")
    put(lines, "notebook/performance.md", "memory")
    lines = ["| strands | added in one call | every other one removed in one call | as many added again |", "|---|---|---|---|"]
    for row in data:
        if row["kind"] == "population":
            lines.append(f"| {int(row['count']):,} | " + " | ".join(f"{float(row[key]):.0f} ms" for key in "abc") + " |")
    put(lines, "notebook/performance.md", "population")


def limits():
    """The table in docs/notebook/integrators.md, between the markers."""
    table = defaultdict(dict)
    for row in rows("limits.csv"):
        papers = f"✗ {float(row['papers_blown_up_s']):.2g} s" if row["papers_blown_up_s"] else f"{float(row['papers_error_mm']):.3g}"
        euler = f"{float(row['euler_error_mm']):.3g}" if row["euler_error_mm"] else "✗"
        second = f"{float(row['second_order_error_mm']):.3g}" if row["second_order_error_mm"] else "✗"
        table[row["hair"], row["motion"], row["dissipation"]][int(row["rate"])] = f"{papers} ({euler}; {second})"
    rates = sorted({rate for line in table.values() for rate in line})
    lines = ["| hair | motion | dissipation | " + " | ".join(f"h = 1/{rate}" for rate in rates) + " |", "|---" * (3 + len(rates)) + "|"]
    for (hair, motion, dissipation), line in table.items():
        lines.append(f"| {hair} | {motion} | {dissipation} | " + " | ".join(line[rate] for rate in rates) + " |")
    put(lines, "notebook/integrators.md", "limits")


def newton():
    table = defaultdict(dict)
    for row in rows("newton.csv"):
        key = row["motion"], row["integrator"].replace("_", " "), f"{float(row['tolerance']):g}"
        failed = f", {row['beyond_cap']} ✗" if row["beyond_cap"] != "0" else ""
        table[key][int(row["elements"]), int(row["rate"])] = f"{float(row['iterations']):.1f} ({row['most']}{failed})"
    scenes = list(next(iter(table.values())))
    lines = ["| motion | integrator | tolerance, rad | " + " | ".join(f"N = {count}, h = 1/{rate}" for count, rate in scenes) + " |",
             "|---" * (3 + len(scenes)) + "|"]
    for (motion, integrator, tolerance), line in table.items():
        lines.append(f"| {motion} | {integrator} | {tolerance} | " + " | ".join(line[scene] for scene in scenes) + " |")
    put(lines, "theory/newton.md", "newton")


def power(value):
    """A number to two digits, with a power of ten as the pages write it."""
    mantissa, exponent = f"{value:.1e}".split("e")
    raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{mantissa}·10{raised}"


def quadrature():
    table = defaultdict(list)
    for row in rows("quadrature_angles.csv"):
        table[row["points"]].append(float(row["largest_turn"]))
    raised = [str(exponent).translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")) for exponent in range(2, 13)]
    lines = ["| points | " + " | ".join(f"10⁻{exponent}" for exponent in raised) + " |", "|---" * 12 + "|"]
    for points, turns in table.items():
        lines.append(f"| {points} | " + " | ".join("–" if turn == 0 else f"{turn:#.3g}".rstrip(".") for turn in turns) + " |")
    put(lines, "theory/quadrature.md", "quadrature angles")

    tolerances = ["1e-2", "1e-3", "1e-4", "1e-6"]
    worst = defaultdict(lambda: defaultdict(float))
    for row in rows("quadrature_motions.csv"):
        line = worst[row["hair"], row["elements"]]
        line["error"] = min(line["error"] or 1, float(row["error"]))
        for key, value in [("points", float(row["points"])), ("added", float(row["added"])),
                           ("velocity", float(row["velocity_added"]) / float(row["velocity_error"]))]:
            line[key, row["tolerance"]] = max(line[key, row["tolerance"]], value)
    lines = ["| hair | N | least error, L | points: " + " | ".join(power(float(t))[4:] for t in tolerances) + " | positions, added, L: " +
             " | ".join(power(float(t))[4:] for t in tolerances) + " | velocities, added, of the error: " +
             " | ".join(power(float(t))[4:] for t in tolerances) + " |", "|---" * 15 + "|"]
    for (hair, elements), line in worst.items():
        lines.append(f"| {hair} | {elements} | {power(line['error'])} | " + " | ".join(f"{line['points', t]:.1f}" for t in tolerances) + " | " +
                     " | ".join(power(line["added", t]) for t in tolerances) + " | " +
                     " | ".join(f"{100 * line['velocity', t]:.2g} %" for t in tolerances) + " |")
    put(lines, "notebook/quadrature.md", "quadrature motions")

    costs = rows("quadrature_cost.csv")
    six = next(float(row["instructions"]) for row in costs if row["points"] == "6")
    lines = ["| points | tolerance | iterations a step | instructions an element and step | of those of six points |", "|---" * 5 + "|"]
    for row in costs:
        lines.append(f"| {row['points']} | {power(float(row['tolerance']))[4:]} | {float(row['iterations']):.2f} | {row['instructions']} | {float(row['instructions']) / six:.2f} |")
    put(lines, "notebook/performance.md", "quadrature cost")


def friction():
    data = {key: np.array([float(row[key]) for row in rows("friction_curve.csv")]) for key in ("time", "recorded", "best", "quarter", "fourfold")}
    figure, axes = plt.subplots(figsize=(7.2, 3.2))
    axes.plot(data["time"], 100 * data["recorded"], ".", color="black", markersize=3.5, label="recorded (noise: 2 % of the span)")
    for colour, key, label in zip(COLOURS, ("best", "quarter", "fourfold"), ("fitted γ", "γ / 4", "4 γ")):
        axes.plot(data["time"], 100 * data[key], color=colour, linewidth=1.4 if key == "best" else 0.9, label=label)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("span (cm)")
    axes.legend(fontsize=8, ncols=4, loc="upper center", bbox_to_anchor=(0.5, 1.15))
    save(figure, "friction.png")
    units = {"internal_friction": "γ", "viscosity": "μ", "air_drag": "ν"}
    lines = ["| curve | noise | fitted | true | found | off by | standard error | half the step would move it by | verdict |", "|---" * 9 + "|"]
    for row in rows("friction.csv"):
        true, value, error = (float(row[key]) for key in ("truth", "value", "standard_error"))
        determined = row["verdict"] == "Determined"
        noise = f"{float(row['noise_permille']) / 10:g} %" if row["noise_permille"] != "0" else "none"
        lines.append(f"| `{row['curve']}` | {noise} | {units[row['coefficient']]} | {true:.3g} | " +
                     (f"{value:.4g} | {100 * (value / true - 1):+.2f} % | {100 * error / value:.2f} % | {100 * float(row['step_shift']):+.2f} % | "
                      if determined else "| | | | ") + f"{row['verdict'].lower()} |")
    put(lines, "theory/friction_fit.md", "friction")


if __name__ == "__main__":
    convergence()
    sampling()
    limits()
    newton()
    quadrature()
    friction()
