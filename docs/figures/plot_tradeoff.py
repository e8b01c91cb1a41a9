"""Draws docs/figures/tradeoff*.png from docs/figures/tradeoff*.csv and writes the tables of docs/notebook/tradeoff.md between their markers. Run by
`make tradeoff` and `make figures`."""

import csv
from collections import Counter
from pathlib import Path
from statistics import median

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

FIGURES = Path(__file__).resolve().parent
PAGE = FIGURES.parent / "notebook/tradeoff.md"
plt.rcParams.update({"font.size": 8, "axes.grid": True, "grid.alpha": 0.3, "grid.linewidth": 0.5, "legend.frameon": False,
                     "axes.spines.top": False, "axes.spines.right": False})
SCENES = ["calm_sway", "walk", "head_shake", "curly_bounce", "stiff_bristle", "wind_gust"]
HAIRS = ["straight", "wavy", "curly", "fuzzy"]
PRESETS = ["preview", "balanced", "accurate"]
INTEGRATORS = {"linearly_implicit": ("#c7622b", "linearly implicit (papers)"), "implicit_euler": ("#3d8f53", "implicit Euler"),
               "second_order": ("#1f5fa8", "second order")}
RED = "#b01030"


def rows(name):
    with open(FIGURES / name, newline="") as file:
        return list(csv.DictReader(file))


def number(text):
    return float(text) if text else None


def read():
    data = rows("tradeoff.csv")
    for row in data:
        for key in ("tip", "tip_most", "shape", "us_per_second", "iterations", "unconverged", "blown_up_s", "tolerance", "error_tolerance"):
            row[key] = number(row[key])
        for key in ("rate", "elements", "cap"):
            row[key] = int(row[key])
    return data


def of(data, scene, hair):
    return [row for row in data if row["scene"] == scene and row["hair"] == hair]


def is_papers(row):
    return row["integrator"] == "linearly_implicit" and row["rate"] == 30 and row["elements"] == 5


def is_plain(row):
    return not row["preset"] and row["cap"] == 50 and row["tolerance"] == 1e-3 and row["error_tolerance"] == 0 and row["freedoms"] == "all"


def front(candidates):
    """Settings that no other one beats in both cost and error, from the cheapest; those wrong by half a length are no settings."""
    best, chosen = 0.5, []
    for row in sorted((row for row in candidates if row["shape"] is not None), key=lambda row: row["us_per_second"]):
        if row["shape"] < best:
            best = row["shape"]
            chosen.append(row)
    return chosen


def percent(value):
    return f"{100 * value:.2g} %" if value < 0.995 else f"{100 * value:.0f} %"


def cost(value):
    return f"{value:.0f}" if value < 9.5e3 else f"{value / 1e3:.0f}k"


def named(row):
    """A setting in few characters."""
    short = {"linearly_implicit": "L", "implicit_euler": "E", "second_order": ""}[row["integrator"]]
    extras = ""
    if row["cap"] != 50 and not row["preset"]:
        extras += f" cap {row['cap']}"
    if row["tolerance"] != 1e-3 and not row["preset"]:
        extras += f" tol {row['tolerance']:g}"
    if row["error_tolerance"] and not row["preset"]:
        extras += f" adaptive {row['error_tolerance']:g}"
    if row["freedoms"] != "all":
        extras += f" {row['freedoms']}"
    return f"{short}{row['rate']}×{row['elements']}{extras}" + (f" ({row['preset']})" if row["preset"] else "")


def panel(axes, cases, truth):
    ceiling, floor = 2.0, 1e-4
    for integrator, (colour, label) in INTEGRATORS.items():
        dots = [row for row in cases if row["integrator"] == integrator and row["shape"] is not None and not row["preset"]]
        axes.scatter([row["us_per_second"] for row in dots], [min(row["shape"], ceiling) for row in dots], s=5, color=colour, alpha=0.5,
                     linewidths=0, label=label, rasterized=True)
    best = front(cases)
    axes.plot([row["us_per_second"] for row in best], [row["shape"] for row in best], color="black", linewidth=0.9,
              drawstyle="steps-post", label="front")
    for preset, marker in zip(PRESETS, "v^D"):
        for row in cases:
            if row["preset"] == preset:
                axes.plot(row["us_per_second"], row["shape"], marker, color="black", markerfacecolor="gold", markersize=5.5, zorder=4,
                          linestyle="none", label=preset)
    for row in cases:
        if is_papers(row) and row["shape"] is not None:
            axes.plot(row["us_per_second"], min(row["shape"], ceiling), "*", color=RED, markersize=9, zorder=5, linestyle="none",
                      label="the papers' choice: linearly implicit, 1/30 s, N = 5")
        elif is_papers(row):
            axes.plot(row["us_per_second"], ceiling, "X", color=RED, markersize=7, zorder=5, linestyle="none", clip_on=False,
                      label="the papers' choice, blown up (time in s)")
            axes.annotate(f"{row['blown_up_s']:.2g} s", (row["us_per_second"], ceiling), textcoords="offset points", xytext=(7, -3),
                          fontsize=7, color=RED)
    uncertain = float(truth["shape_uncertainty"])
    axes.axhspan(floor, max(uncertain, floor), color="grey", alpha=0.15, linewidth=0, label="what the comparison is good for")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(15, 3e5)
    axes.set_ylim(floor, 1.15 * ceiling)


def legend(figure, axes):
    seen = {}
    for panel_axes in axes:
        for handle, label in zip(*panel_axes.get_legend_handles_labels()):
            seen.setdefault(label, handle)
    figure.legend(seen.values(), seen.keys(), loc="lower center", ncols=4, fontsize=8, markerscale=1.0)
    for handle in figure.legends[0].legend_handles[:3]:
        handle.set_sizes([25])
        handle.set_alpha(1)


def save(figure, name, bottom):
    figure.tight_layout(rect=(0, bottom, 1, 1))
    figure.savefig(FIGURES / name, dpi=110, metadata={"Software": None})
    plt.close(figure)
    print(f"docs/figures/{name}: {(FIGURES / name).stat().st_size // 1024} kB")


def draw(data, truths, scenes, name, bottom):
    figure, grid = plt.subplots(len(scenes), 4, figsize=(11, 2.35 * len(scenes) + 0.9), sharex=True, sharey=True, squeeze=False)
    for line, scene in zip(grid, scenes):
        for axes, hair in zip(line, HAIRS):
            panel(axes, of(data, scene, hair), truths[scene, hair])
            axes.set_title(f"{scene.replace('_', ' ')}, {hair}", fontsize=8.5)
        line[0].set_ylabel("shape error / length")
    for axes in grid[-1]:
        axes.set_xlabel("µs a strand and simulated second")
    legend(figure, grid.flat)
    save(figure, name, bottom)


def slices(data):
    """What a cap, a tolerance and frozen freedoms do: error and cost beside the same setting without."""
    plain = {(row["scene"], row["hair"], row["rate"], row["elements"]): row for row in data
             if is_plain(row) and row["integrator"] == "second_order"}
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11, 3.4))
    table = []

    def gather(wanted):
        chosen = [row for row in data if row["integrator"] == "second_order" and not row["preset"] and wanted(row) and
                  (row["scene"], row["hair"], row["rate"], row["elements"]) in plain]
        pairs = [(row, plain[row["scene"], row["hair"], row["rate"], row["elements"]]) for row in chosen]
        return [(row["shape"] / base["shape"] if row["shape"] is not None else None, row["us_per_second"] / base["us_per_second"], row)
                for row, base in pairs]

    def spread(pairs):
        errors = [error if error is not None else 1e9 for error, _, _ in pairs]
        errors.sort()
        return median(errors), errors[int(0.9 * (len(errors) - 1))], median(cost for _, cost, _ in pairs)

    rates = [24, 60, 240]
    for axes, key, values, label in [(left, "cap", [1, 2, 4, 8], "iteration cap"), (middle, "tolerance", [1e-1, 1e-2, 1e-4, 1e-6], "tolerance, rad")]:
        for rate, colour in zip(rates, ["#7a4a9e", "#1f5fa8", "#3d8f53"]):
            def wanted(row, value):
                other = row["tolerance"] == 1e-3 if key == "cap" else row["cap"] == 50
                return row[key] == value and row["rate"] == rate and row["freedoms"] == "all" and row["error_tolerance"] == 0 and other
            points = [(value, *spread(gather(lambda row: wanted(row, value)))) for value in values]
            axes.plot([p[0] for p in points], [p[2] for p in points], "o-", color=colour, markersize=3.5, linewidth=1.2,
                      label=f"error, h = 1/{rate}: nine tenths are below")
            axes.plot([p[0] for p in points], [p[3] for p in points], "s--", color=colour, markersize=3, linewidth=0.9, markerfacecolor="white",
                      label=f"cost, h = 1/{rate}: median")
            table += [(key, value, rate, *point) for value, *point in points]
        axes.set_xscale("log")
        axes.set_ylim(0, 2.6)
        axes.axhline(1, color="grey", linewidth=0.8)
        axes.set_xlabel(label)
        axes.legend(fontsize=6.5, loc="upper right")
    left.set_xticks([1, 2, 4, 8], ["1", "2", "4", "8"])
    left.minorticks_off()
    left.set_title("an iteration cap, beside none", fontsize=8.5)
    middle.set_title("a tolerance, beside 10⁻³ rad", fontsize=8.5)
    middle.invert_xaxis()
    for value in [1e-2, 3e-3, 1e-3, 3e-4]:
        for rate in [24, 30, 60]:
            pairs = gather(lambda row: row["error_tolerance"] == value and row["rate"] == rate)
            if pairs:
                table.append(("adaptive", f"{value:g}", rate, *spread(pairs)))
    shown = [("bend", "#1f5fa8", "twist frozen"), ("bend1", "#c7622b", "one bending alone")]
    for freedoms, colour, label in shown:
        for rate in rates:
            for hair in HAIRS:
                pairs = gather(lambda row: row["freedoms"] == freedoms and row["rate"] == rate and row["hair"] == hair)
                table.append(("freedoms", f"{freedoms}, {hair}", rate, *spread(pairs)))
        place = [index + (-0.18 if freedoms == "bend" else 0.18) for index in range(len(HAIRS))]
        for rate, alpha in zip(rates, (0.45, 0.7, 1.0)):
            heights = [next(line[3] for line in table if line[:3] == ("freedoms", f"{freedoms}, {hair}", rate)) for hair in HAIRS]
            offsets = [at + 0.11 * (rates.index(rate) - 1) for at in place]
            right.bar(offsets, [height - 1 for height in heights], bottom=1, width=0.1, color=colour, alpha=alpha,
                      label=f"{label}, h = 1/{rate}")
    right.set_yscale("log")
    right.set_xticks(range(len(HAIRS)), HAIRS)
    right.axhline(1, color="grey", linewidth=0.8)
    right.set_title("median error beside all freedoms", fontsize=8.5)
    right.legend(fontsize=6.5)
    save(figure, "tradeoff_slices.png", 0)
    return table


def put(lines, name):
    """Puts a table between the page's markers."""
    start, end = f"<!-- {name}: made by make tradeoff -->\n", f"<!-- end of {name} -->"
    before, rest = PAGE.read_text().split(start)
    _, after = rest.split(end)
    PAGE.write_text(before + start + "\n".join(lines) + "\n" + end + after)
    print(f"docs/notebook/tradeoff.md: {name}")


def price_table(data):
    targets = [0.1, 0.03, 0.01, 0.003]
    lines = ["| scene | hair | " + " | ".join(f"{100 * target:g} %" for target in targets) + " | least error |", "|---" * (3 + len(targets)) + "|"]
    for scene in SCENES:
        for hair in HAIRS:
            best = front(of(data, scene, hair))
            cells = []
            for target in targets:
                row = next((row for row in best if row["shape"] <= target), None)
                cells.append(f"{named(row)}: {cost(row['us_per_second'])}" if row else "–")
            last = best[-1]
            lines.append(f"| {scene.replace('_', ' ')} | {hair} | " + " | ".join(cells) +
                         f" | {percent(last['shape'])}: {named(last)}: {cost(last['us_per_second'])} |")
    put(lines, "prices")


def front_table(data):
    lines = ["| scene | hair | settings on the front: error, µs |", "|---|---|---|"]
    count, total, decent = Counter(), 0, 0
    for scene in SCENES:
        for hair in HAIRS:
            best = front(of(data, scene, hair))
            lines.append(f"| {scene.replace('_', ' ')} | {hair} | " + "; ".join(f"{named(row)}: {percent(row['shape'])}, {cost(row['us_per_second'])}" for row in best) + " |")
            total += len(best)
            for row in best:
                if row["shape"] > 0.1:
                    continue
                decent += 1
                count[row["integrator"]] += 1
                count["cap"] += row["cap"] < 50
                count["loose"] += row["tolerance"] > 1e-3
                count["tight"] += row["tolerance"] < 1e-3
                count["adaptive"] += row["error_tolerance"] > 0
                count["frozen"] += row["freedoms"] != "all"
    put(lines, "fronts")
    put([f"Of {total} settings on the 24 fronts, {decent} err by less than a tenth of the length. Of these, {count['second_order']} are of second order, "
         f"{count['implicit_euler']} implicit Euler, {count['linearly_implicit']} the papers' step; {count['cap']} have a cap below 50, {count['loose']} a tolerance "
         f"above 10⁻³ rad, {count['tight']} below; {count['adaptive']} have adaptive steps; {count['frozen']} have frozen freedoms."], "members")


def preset_table(data):
    lines = ["| preset | hair | N (bristle) | " + " | ".join(scene.replace("_", " ") for scene in SCENES) + " |", "|---" * (3 + len(SCENES)) + "|"]
    summary = ["| preset | error: median of the 24 | the worst | µs: median | the dearest |", "|---|---|---|---|---|"]
    for preset in PRESETS:
        chosen = {(row["scene"], row["hair"]): row for row in data if row["preset"] == preset}
        for hair in HAIRS:
            cells = [chosen[scene, hair] for scene in SCENES]
            lines.append(f"| {preset} | {hair} | {chosen['walk', hair]['elements']} ({chosen['stiff_bristle', hair]['elements']}) | " +
                         " | ".join(f"{percent(row['shape'])}, {cost(row['us_per_second'])}" for row in cells) + " |")
        errors = [row["shape"] for row in chosen.values()]
        costs = [row["us_per_second"] for row in chosen.values()]
        worst, dearest = max(chosen.values(), key=lambda row: row["shape"]), max(chosen.values(), key=lambda row: row["us_per_second"])
        where = lambda row: f"{row['scene'].replace('_', ' ')}, {row['hair']}"
        summary.append(f"| `{preset}` | {percent(median(errors))} | {percent(worst['shape'])} ({where(worst)}) | {cost(median(costs))} | "
                       f"{cost(dearest['us_per_second'])} ({where(dearest)}) |")
    put(summary, "presets")
    put(lines, "presets in full")


def papers_table(data):
    lines = ["| scene | " + " | ".join(HAIRS) + " |", "|---" * (1 + len(HAIRS)) + "|"]
    for scene in SCENES:
        cells = []
        for hair in HAIRS:
            cases = of(data, scene, hair)
            papers = next(row for row in cases if is_papers(row))
            same = [row for row in front(cases) if row["us_per_second"] <= papers["us_per_second"]]
            beside = f"; {percent(same[-1]['shape'])}: {named(same[-1])}" if same else ""
            cells.append((f"blown up at {papers['blown_up_s']:.2g} s" if papers["shape"] is None else
                          f"{percent(papers['shape'])}, {cost(papers['us_per_second'])}") + beside)
        lines.append(f"| {scene.replace('_', ' ')} | " + " | ".join(cells) + " |")
    put(lines, "papers")


def slice_table(table):
    lines = ["| what | h | error: median | a tenth is worse than | cost: median |", "|---|---|---|---|---|"]
    for key, value, rate, middle, tenth, price in table:
        many = lambda ratio: "blown up" if ratio > 1e8 else f"{ratio:.2f}" if ratio < 10 else f"{ratio:.0f}"
        lines.append(f"| {key} {value} | 1/{rate} | {many(middle)} | {many(tenth)} | {price:.2f} |")
    put(lines, "slices")


def truth_table(truths):
    lines = ["| scene | hair | N | frames compared | more elements: tip, shape | halved step: tip |", "|---" * 6 + "|"]
    for row in truths.values():
        lines.append(f"| {row['scene'].replace('_', ' ')} | {row['hair']} | {row['elements']} | {row['frames']} | "
                     f"{float(row['tip_uncertainty']):.1e}, {float(row['shape_uncertainty']):.1e} | {float(row['step_halving']):.1e} |")
    put(lines, "truth")


def check_table():
    lines = ["| scene | hair | N | largest tip distance | rms shape | reference, s | extrapolated, s |", "|---" * 7 + "|"]
    for row in rows("tradeoff_check.csv"):
        lines.append(f"| {row['scene'].replace('_', ' ')} | {row['hair']} | {row['elements']} | {float(row['tip_most']):.1e} | {float(row['shape']):.1e} | "
                     f"{row['reference_s']} | {row['extrapolated_s']} |")
    put(lines, "check")


def main():
    data = read()
    truths = {(row["scene"], row["hair"]): row for row in rows("tradeoff_truth.csv")}
    draw(data, truths, SCENES, "tradeoff.png", 0.05)
    draw(data, truths, ["walk"], "tradeoff_walk.png", 0.2)
    slice_table(slices(data))
    price_table(data)
    front_table(data)
    preset_table(data)
    papers_table(data)
    truth_table(truths)
    check_table()


main()
