"""Draws docs/figures/validation_*.png from the csv files that the validation tests record, and writes the measured tables of
docs/theory/validation_statics.md, validation_dynamics.md and extremes.md between their markers. Run by `make figures`."""

import csv
import re
from collections import defaultdict

import numpy as np
from PIL import Image

from plot import COLOURS, FIGURES, plt, put, rows, save

GREY = "#666666"


def save_small(figure, name):
    """As a picture of few colours: a third of the bytes."""
    save(figure, name)
    path = FIGURES / name
    Image.open(path).convert("RGB").quantize(96, dither=Image.Dither.NONE).save(path, optimize=True)
    print(f"  {path.stat().st_size // 1024} kB in 96 colours")


def table(test, name):
    return rows(f"validation_{test}_{name}.csv")


def natural(text):
    """Sorts 2 before 10, words before numbers."""
    parts = re.split(r"(-?\d+\.?\d*)", text)
    return [(1, float(part), "") if k % 2 else (0, 0.0, part) for k, part in enumerate(parts)]


STATICS, DYNAMICS = "theory/validation_statics.md", "theory/validation_dynamics.md"

# Sections of the pages: marker, its tables in the csv.
SECTIONS = [
    ("cantilever", ["cantilever"]), ("ellipse", ["ellipse"]), ("planar", ["planar"]), ("curl", ["curl"]), ("generic", ["generic"]),
    ("bend-twist", ["bend-twist", "postbuckled"]), ("greenhill", ["greenhill"]), ("lateral", ["lateral"]),
    ("frequency", ["frequency", "vertical", "drooped", "arc"]), ("hair", ["hair", "hair frequency"]), ("linear response", ["linear response"]),
]


def elements():
    """Every case: its errors at the N that were tried, the order, and the N that 1 % and 0.1 % take."""
    found = defaultdict(lambda: defaultdict(list))
    for test in ("statics", "vibration"):
        for row in table(test, "elements"):
            found[row["section"], row["case"]][int(row["elements"])].append(float(row["error"]))
    # Cases that share a name (two weights) are lines of their own, the smaller errors first.
    data = defaultdict(lambda: defaultdict(dict))
    for (section, case), line in found.items():
        many = max(len(errors) for errors in line.values())
        for n, errors in line.items():
            for k, error in enumerate(sorted(errors)):
                data[section][case if many == 1 else f"{case} ({k + 1})"][n] = error
    for marker, sections in SECTIONS:
        counts = sorted({n for section in sections for line in data[section].values() for n in line})
        lines = ["| case | " + " | ".join(f"N = {n}" for n in counts) + " | order | N for 1 % | N for 0.1 % |",
                 "|---" * (len(counts) + 4) + "|"]
        for section in sections:
            for case in sorted(data[section], key=natural):
                line = data[section][case]
                (n1, e1), (n2, e2) = sorted(line.items())[-2:]
                order = np.log(e1 / e2) / np.log(n2 / n1)
                need = [int(np.ceil(n2 * np.sqrt(e2 / share))) for share in (1e-2, 1e-3)]
                cells = " | ".join(f"{line[n]:.1e}" if n in line else "" for n in counts)
                lines.append(f"| {case} | {cells} | {order:.2f} | {need[0]} | {need[1]} |")
        put(lines, DYNAMICS if marker in ("frequency", "hair") else STATICS, marker)
    figure, axes = plt.subplots(1, 3, figsize=(10.5, 3.9), sharey=True)
    groups = [("shapes at rest: distance of the tip, L", ["cantilever", "ellipse", "planar", "curl", "generic", "hair", "postbuckled"]),
              ("critical weights, relative", ["bend-twist", "greenhill", "lateral"]),
              ("frequencies, relative", ["frequency", "vertical", "drooped", "arc", "hair frequency"])]
    for panel, (title, sections) in zip(axes, groups):
        for colour, section in zip(COLOURS + ["#b03a5b", "#8a8a2f", "#2b9c9c"], sections):
            for k, line in enumerate(data[section].values()):
                n, error = np.array(sorted(line.items())).T
                name = {"generic": "no symmetry", "curl": "curls in space", "planar": "curls in the plane", "greenhill": "self-buckling and beyond",
                        "postbuckled": "past bend–twist", "lateral": "lateral buckling", "frequency": "straight rod", "vertical": "hanging, standing",
                        "hair": "appendix B's hair", "hair frequency": "appendix B's hair"}.get(section, section)
                panel.loglog(n, error, "o-", color=colour, markersize=2, linewidth=0.7, alpha=0.75, label=name if k == 0 else None)
        n = np.array([5, 160])
        panel.loglog(n, 4.0 / n**2, ":", color="black", linewidth=1.2, label="$4/N^2$")
        for level, name in ((1e-2, "1 %"), (1e-3, "0.1 %")):
            panel.axhline(level, color="grey", linewidth=0.7)
            panel.text(165, level * 1.08, name, ha="right", va="bottom", color="grey", fontsize=8)
        panel.set_title(title, fontsize=9)
        panel.set_xlabel("elements N")
        panel.set_xticks([5, 10, 20, 40, 80, 160], ["5", "10", "20", "40", "80", "160"])
        panel.minorticks_off()
        panel.legend(fontsize=7, loc="lower left", ncols=2)
        panel.set_ylim(1e-8, 2.0)
    axes[0].set_ylabel("error")
    save_small(figure, "validation_elements.png")


def shapes():
    data = defaultdict(lambda: defaultdict(list))
    for row in table("statics", "shapes"):
        data[row["shape"]][row["kind"]].append([float(row[axis]) for axis in "xyz"])
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.0), width_ratios=[1, 1.6])
    straight = sorted((name for name in data if name.startswith("cantilever")), key=natural)
    for k, name in enumerate(straight):
        line, tip = np.array(data[name]["engine"]), np.array(data[name]["reference"])
        colour = plt.cm.viridis(k / len(straight))
        left.plot(line[:, 0], line[:, 2], color=colour, linewidth=1.2)
        left.plot(tip[:, 0], tip[:, 2], "o", color="black", markersize=3.5, markerfacecolor="white")
        gamma = name.split()[1]
        if float(gamma) <= 100:
            left.annotate(f"Γ = {gamma}", (tip[0, 0], tip[0, 2]), xytext=(4, 2), textcoords="offset points", fontsize=7)
        elif float(gamma) == 2000:
            left.annotate(f"Γ to {gamma}", (tip[0, 0], tip[0, 2]), xytext=(-4, -10), textcoords="offset points", fontsize=7)
    left.set_title("straight rod, clamped horizontally (N = 40; 160 from Γ = 1000)\nlines: engine; circles: reference tips", fontsize=8.5)
    left.set_xlabel("x / L")
    left.set_ylabel("z / L")
    left.set_aspect("equal")
    left.set_xlim(-0.05, 1.15)
    wanted = ["curl 2 16", "curl 2 25", "curl 4 150", "curl 6 300", "curl 10 1000"]
    for k, name in enumerate(wanted):
        line, reference = np.array(data[name]["engine"]), np.array(data[name]["reference"])
        # Of the two mirror images the reference's.
        if (line[:, 1] @ reference[np.linspace(0, len(reference) - 1, len(line)).astype(int), 1]) < 0:
            line[:, 1] *= -1
        shift = 0.42 * k
        colour = (COLOURS + ["#b03a5b"])[k]
        right.plot(line[:, 1] + shift, line[:, 2], color=colour, linewidth=2.2, alpha=0.7)
        right.plot(reference[:, 1] + shift, reference[:, 2], ".", color="black", markersize=3)
        turns, gamma = name.split()[1:]
        right.text(shift, 0.03, f"φ = {turns}π\nΓ = {gamma}", ha="center", va="bottom", fontsize=7.5)
    right.set_title("curls hanging in space, seen from the side (N = 80)\nlines: engine; points: reference", fontsize=8.5, pad=22)
    right.set_xlabel("y / L (set side by side)")
    right.set_ylabel("z / L")
    right.set_aspect("equal")
    save_small(figure, "validation_shapes.png")


def bend_twist():
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.8))
    data = defaultdict(list)
    for row in table("statics", "bend_twist"):
        data[row["poisson"], row["side"], row["elements"]].append(
            [float(row[key]) for key in ("phi_over_pi", "critical", "reference")])
    for colour, poisson in zip(COLOURS, ["0.5", "0.48", "0.3"]):
        for side in ("low", "high"):
            line = np.array(sorted(data[poisson, side, "80"]))
            left.semilogy(line[:, 0], line[:, 2], "-", color=colour, linewidth=1.1, label=f"reference, σ = {poisson}" if side == "low" else None)
            for count, marker in (("20", "v"), ("80", "o")):
                points = np.array(sorted(data[poisson, side, count]))
                left.semilogy(points[:, 0], points[:, 1], marker, color=colour, markersize=4, markerfacecolor="white",
                              label=f"engine, N = {count}" if colour == COLOURS[0] and side == "low" else None)
    left.text(3.2, 80, "leaves its plane", ha="center", fontsize=8, color=GREY)
    left.text(2.45, 13, "planar: coiled", ha="left", fontsize=8, color=GREY)
    left.text(2.02, 210, "planar: drawn straight", ha="left", fontsize=8, color=GREY)
    left.set_xlabel("natural turn of the rod φ / π")
    left.set_ylabel("weight Γ")
    left.set_title("bend–twist: where a hanging curl leaves its plane", fontsize=9)
    left.set_ylim(8, 900)
    left.legend(fontsize=7, loc="upper left", ncols=2)
    buckling = defaultdict(list)
    exact = {}
    for row in table("statics", "buckling"):
        buckling[int(row["elements"])].append((float(row["gamma"]), float(row["tip_aside"])))
        exact[float(row["gamma"])] = float(row["reference"])
    for colour, count in zip(COLOURS, sorted(buckling)):
        gamma, aside = np.array(sorted(buckling[count])).T
        right.semilogx(gamma, aside, "o", color=colour, markersize=4, markerfacecolor="white", label=f"engine, N = {count}")
    gamma, aside = np.array(sorted(exact.items())).T
    right.semilogx(gamma, aside, "k+", markersize=9, label="reference")
    right.axvline(7.8373, color="grey", linewidth=0.8)
    right.text(7.7, 0.03, "Greenhill: 7.837", rotation=90, ha="right", va="bottom", fontsize=7.5, color="grey")
    right.set_xticks([8, 10, 15, 20, 30, 50], ["8", "10", "15", "20", "30", "50"])
    right.minorticks_off()
    right.set_xlabel("weight Γ")
    right.set_ylabel("tip aside / L")
    right.set_title("an upright rod, buckled under its weight", fontsize=9)
    right.legend(fontsize=7.5)
    save_small(figure, "validation_stability.png")


def motion():
    figure, axes = plt.subplots(1, 3, figsize=(10.5, 3.6))
    vertical = defaultdict(list)
    for row in table("vibration", "vertical"):
        vertical[row["mode"], int(row["elements"])].append([float(row[key]) for key in ("gamma", "omega", "reference")])
    panel = axes[0]
    for colour, mode in zip(COLOURS, ("1", "2")):
        every = sorted({(line[0], line[2]) for (m, _), lines in vertical.items() if m == mode for line in lines})
        gamma, exact = np.array(every).T
        panel.plot(gamma, exact, "-", color=colour, linewidth=1, label=f"reference, mode {mode}")
        for count, marker in ((10, "v"), (40, "o")):
            points = np.array(sorted(vertical[mode, count]))
            panel.plot(points[:, 0], points[:, 1], marker, color=colour, markersize=4, markerfacecolor="white",
                       label=f"engine, N = {count}" if mode == "1" else None)
    panel.set_xscale("symlog", linthresh=10)
    panel.set_xticks([-7.5, 0, 10, 50, 500], ["−7.5", "0", "10", "50", "500"])
    panel.set_xlabel("weight Γ (below 0: standing)")
    panel.set_ylabel("ω in √(EI/ρSL⁴)")
    panel.set_title("vertical rods: frequencies,\nand critical rates of spin", fontsize=9)
    panel.legend(fontsize=7)
    panel = axes[1]
    steps = defaultdict(list)
    for row in table("dynamics", "steps"):
        steps[row["case"]].append((float(row["step"]), float(row["error"])))
    for k, (case, points) in enumerate(sorted(steps.items())):
        step, error = np.array(sorted(points)).T
        panel.loglog(step, error, "o-", markersize=3, linewidth=0.9, color=plt.cm.tab10(k), label=case)
    every = sorted({step for points in steps.values() for step, _ in points}, reverse=True)
    lines = ["| case | " + " | ".join(f"1/{1 / step:.0f} s" for step in every) + " |", "|---" * (len(every) + 1) + "|"]
    for case, points in sorted(steps.items()):
        lines.append(f"| {case} | " + " | ".join(f"{dict(points)[step]:.1e}" for step in every) + " |")
    put(lines, DYNAMICS, "steps")
    step = np.array([1 / 7680, 1 / 480])
    panel.loglog(step, 2e3 * step**2, ":", color="black", linewidth=1.2, label="second order")
    panel.set_ylim(1e-10, 3e-2)
    panel.set_xticks([1 / rate for rate in (7680, 3840, 1920, 960, 480)], ["1/7680", "1/3840", "1/1920", "1/960", "1/480"], fontsize=8)
    panel.minorticks_off()
    panel.set_xlabel("step h (s)")
    panel.set_ylabel("largest tip error / L in ½ s")
    panel.set_title("one element: order in the step", fontsize=9)
    panel.legend(fontsize=6, loc="lower right", ncols=2)
    panel = axes[2]
    motions = defaultdict(list)
    for row in table("dynamics", "motions"):
        motions[row["case"]].append((int(row["elements"]), float(row["error"])))
    for k, (case, points) in enumerate(sorted(motions.items())):
        count, error = np.array(sorted(points)).T
        panel.loglog(count, error, "o-", markersize=3, linewidth=0.9, color=plt.cm.tab20(k), label=case)
    count = np.array([5, 40])
    panel.loglog(count, 3.0 / count**2, ":", color="black", linewidth=1.2, label="$3/N^2$")
    panel.set_xticks([5, 10, 20, 40], ["5", "10", "20", "40"])
    panel.minorticks_off()
    panel.set_xlabel("elements N")
    panel.set_title("motions of the continuous rod\n(h = 1/3840 s)", fontsize=9)
    panel.legend(fontsize=6, ncols=2, loc="lower left")
    save_small(figure, "validation_motion.png")


def whirl():
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.5))
    data = defaultdict(list)
    lines = ["| shaft | spin / critical | growth / ω | theory | whirls at / ω | theory |", "|---" * 6 + "|"]
    for row in table("whirl", "whirl"):
        data[row["case"]].append([float(row[key]) for key in ("spin_by_critical", "growth_by_omega", "theory")])
        lines.append("| " + " | ".join(row[key] for key in row) + " |")
    put(lines, DYNAMICS, "whirl")
    for k, (case, points) in enumerate(sorted(data.items())):
        spin, growth, theory = np.array(sorted(points)).T
        left.plot(spin, theory, "-", color=plt.cm.tab10(k), linewidth=0.9)
        left.plot(spin, growth, "o", color=plt.cm.tab10(k), markersize=4.5, markerfacecolor="white", label=case)
    left.axhline(0.0, color="grey", linewidth=0.7)
    left.set_xlabel("spin / critical spin")
    left.set_ylabel("growth rate / ω")
    left.set_title("whirling shafts (lines: theory; circles: engine)", fontsize=9)
    left.legend(fontsize=6.5)
    shaken = sorted((float(row["acceleration_g"]), float(row["out_of_plane"]), row["left_at_s"]) for row in table("whirl", "shaken"))
    right.semilogy([row[0] for row in shaken], [row[1] for row in shaken], "o-", color=COLOURS[0], markersize=4)
    right.set_xlabel("acceleration of the root / g")
    right.set_ylabel("furthest out of the plane / L, in 3 s")
    right.axvline(12.3287 / 9.0 - 1.0, color="grey", linewidth=0.8)
    right.text(12.3287 / 9.0 - 1.02, 2e-2, "Γ(1 + a/g) = 12.33", rotation=90, ha="right", va="center", fontsize=7.5, color="grey")
    right.set_title("a curl (φ = 2π, Γ = 9) shaken up and down at 5 Hz", fontsize=9)
    save_small(figure, "validation_whirl.png")
    lines = ["| acceleration / g | largest Γ(1 + a/g) | furthest out of its plane, L | leaves (L/20) after |", "|---" * 4 + "|"]
    for strength, out, when in shaken:
        lines.append(f"| {strength:g} | {9 * (1 + strength):.1f} | {out:.1e} | {when + ' s' if when else 'stays'} |")
    put(lines, DYNAMICS, "shaken")


def extremes():
    if not (FIGURES / "extremes.csv").exists():
        return
    lines = ["| integrator | draws | cases | failed | steps | strand-seconds | iterations a step | unconverged | in substeps | not finite | quiet stretches | energy grew in | the same, unconverged | "
             "worst stretch | worst frame | converged, checked | worst, L | wound up |", "|---" * 18 + "|"]
    for row in rows("extremes.csv"):
        steps = int(row["steps"])
        grew = []
        for count, worst in (("grew", "worst_growth"), ("grew_unconverged", "worst_growth_unconverged")):
            growth = float(row[worst])
            by = f"{100 * (growth - 1):.2g} %" if growth < 1.99 else f"{growth:.2g} times"
            grew.append(f"{row[count]}, to {by}" if growth >= 1.99 and row[count] != "0" else f"{row[count]}, by {by}" if row[count] != "0" else "0")
        probe = f"{float(row['worst_probe']):.0e}" if row["probes"] != "0" else ""
        lines.append(f"| {row['integrator']} | {row['stratum']} | {int(row['cases']):,} | {int(row['failed_cases']):,} | {steps:,} | {float(row['strand_seconds']):,.0f} | "
                     f"{float(row['iterations_a_step']):.2f} | {100 * int(row['unconverged']) / steps:.2g} % | "
                     f"{100 * int(row['subdivided']) / steps:.2g} % | {row['quarantined']} | "
                     f"{int(row['quiet_stretches']):,} | {grew[0]} | {grew[1]} | {row['worst_stretch']} | {row['worst_skew']} | {row['probes']} | {probe} | {row['wound']} |")
    put(lines, "theory/extremes.md", "extremes")
    cells, failed = defaultdict(lambda: [0, 0]), ["0", "below 1/2", "1/2 to 50", "above 50"]
    for row in rows("extremes_papers.csv"):
        cell = cells[int(row["h_decade"]), row["friction_number"]]
        cell[0] += int(row["cases"])
        cell[1] += int(row["failed"])
    decades = sorted({decade for decade, _ in cells})
    lines = ["| γ/(h EI0) | " + " | ".join(f"h from 10^{d} s" for d in decades) + " |", "|---" * (len(decades) + 1) + "|"]
    for friction in failed:
        line = []
        for decade in decades:
            cases, bad = cells[decade, friction]
            line.append(f"{bad} of {cases}" if cases else "")
        lines.append(f"| {friction} | " + " | ".join(line) + " |")
    put(lines, "theory/extremes.md", "papers")


elements()
shapes()
bend_twist()
motion()
whirl()
extremes()
