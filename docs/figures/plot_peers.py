"""Draws docs/figures/peers*.png from peers*.csv and writes the tables of docs/notebook/peers.md between their markers. Run by `make peers`; the figures'
folder may be given, and then what is not docs/figures leaves docs/notebook/peers.md alone and prints the tables."""

import csv
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).resolve().parent
FOLDER = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else HERE
PAGE = HERE.parent / "notebook/peers.md"
plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "grid.linewidth": 0.5, "legend.frameon": False,
                     "axes.spines.top": False, "axes.spines.right": False})
PROGRAMS = {"superhelix": ("#1f5fa8", "o"), "pyPBD": ("#c7622b", "s"), "MuJoCo": ("#3d8f53", "^"), "PyElastica": ("#7a4a9e", "D")}
CASES = {"curl": "one turn of a helix", "coil": "a coil of ten turns", "cantilever": "a straight cantilever"}
LIMITS = [0.03, 0.01, 0.003]
WAYS = {"alone_us": "one strand alone", "many_us": "many strands"}


def rows(name):
    with open(FOLDER / name, newline="") as file:
        return list(csv.DictReader(file))


def number(text):
    return float(text) if text not in ("", None) else None


def put(lines, name):
    if FOLDER != HERE:
        print(f"\n{name}:\n" + "\n".join(lines))
        return
    start, end = f"<!-- {name}: made by make peers -->\n", f"<!-- end of {name} -->"
    before, rest = PAGE.read_text().split(start)
    _, after = rest.split(end)
    PAGE.write_text(before + start + "\n".join(lines) + "\n" + end + after)
    print(f"docs/notebook/{PAGE.name}: table of {name}")


def save(figure, name):
    figure.savefig(FOLDER / name, dpi=110, metadata={"Software": None})
    plt.close(figure)
    print(f"{FOLDER / name}: {(FOLDER / name).stat().st_size // 1024} kB")


def read():
    data = rows("peers.csv")
    for row in data:
        for key in ("error", "error_at_end", "stretch", "scan_us", "alone_us", "alone_wall_us", "many_us"):
            row[key] = number(row[key])
        row["settings"] = json.loads(row["settings"])
        row["elements"], row["rate"] = int(row["elements"]), int(row["rate"])
    return data


def of(data, case, program):
    return [row for row in data if row["case"] == case and row["program"] == program]


def cheapest(candidates, way, limit):
    """The cheapest setting that errs by no more; None: there is none."""
    return min((row for row in candidates if row[way] is not None and row["error"] <= limit), key=lambda row: row[way], default=None)


def front(candidates, way):
    best, chosen = 1.0, []
    for row in sorted((row for row in candidates if row[way] is not None), key=lambda row: row[way]):
        if row["error"] < best:
            best = row["error"]
            chosen.append(row)
    return chosen


def draw(data):
    figure, grid = plt.subplots(2, 3, figsize=(11, 6.6), sharey=True)
    for line, (way, title) in zip(grid, WAYS.items()):
        for axes, (case, name) in zip(line, CASES.items()):
            for program, (colour, marker) in PROGRAMS.items():
                mine = of(data, case, program)
                if way == "alone_us":
                    axes.scatter([row["scan_us"] * 1e-6 for row in mine], [row["error"] for row in mine], s=3, color=colour, alpha=0.2, linewidths=0,
                                 rasterized=True)
                best = front(mine, way)
                axes.plot([row[way] * 1e-6 for row in best], [row["error"] for row in best], marker=marker, markersize=3, color=colour, linewidth=1.1,
                          drawstyle="steps-post", label=program)
            axes.axhline(0.01, color="grey", linewidth=0.8)
            axes.axvline(1.0, color="grey", linewidth=0.8, linestyle=":")
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.set_ylim(8e-4, 0.15)
            axes.set_title(f"{name}, {title}", fontsize=9)
        line[0].set_ylabel("largest tip error / length")
    for axes in grid[1]:
        axes.set_xlabel("processor time a strand and simulated second (s)")
    grid[0][0].legend(fontsize=8)
    figure.tight_layout()
    save(figure, "peers.png")


def draw_strands(data):
    figure, axes = plt.subplots(figsize=(5.2, 3.4))
    for program, (colour, marker) in PROGRAMS.items():
        mine = [(int(row["strands"]), float(row["us_per_element_step"])) for row in data if row["program"] == program]
        axes.loglog(*zip(*mine), marker=marker, markersize=4, color=colour, linewidth=1.2, label=program)
    axes.set_xlabel("strands in one world")
    axes.set_ylabel("µs an element and step")
    axes.legend(fontsize=8)
    figure.tight_layout()
    save(figure, "peers_strands.png")


def microseconds(value):
    if value is None:
        return "–"
    return f"{value:.0f}" if value < 9.5e3 else f"{value / 1e3:.0f}k" if value < 9.5e5 else f"{value / 1e6:.1f}M"


def setting(row):
    words = {"second order": "", "implicit Euler": "implicit Euler", "linearly implicit": "linearly implicit"}
    said = row["settings"]
    extras = []
    if row["program"] == "superhelix":
        extras = [words[said["integrator"]]]
        if "tolerance" in said:
            extras.append(f"tol {said['tolerance']:g}")
        if said.get("cap", 50) != 50:
            extras.append(f"cap {said['cap']}")
        if "error_tolerance" in said:
            extras.append(f"adaptive {said['error_tolerance']:g}")
    elif row["program"] == "pyPBD":
        extras = [f"{said['iterations']} iterations" if said["iterations"] > 1 else ""]
    elif row["program"] == "MuJoCo":
        extras = [said["jacobian"]]
    else:
        extras = [f"softness {said['soft']:g}", f"inertia × {said['inertia']:g}"]
    if said.get("ghost") == 1.0:
        extras.append("clamped before")
    return ", ".join([f"{row['elements']} at 1/{row['rate']} s", *filter(None, extras)])


def cost_tables(data):
    for case in CASES:
        lines = ["| program | " + " | ".join(f"{100 * limit:g} %: alone, many" for limit in LIMITS) + " | setting for 1 %, alone | its error | stretch |",
                 "|---" * (len(LIMITS) + 4) + "|"]
        for program in PROGRAMS:
            mine = of(data, case, program)
            cells = []
            for limit in LIMITS:
                alone, many = (cheapest(mine, way, limit) for way in WAYS)
                cells.append(f"{microseconds(alone and alone['alone_us'])}, {microseconds(many and many['many_us'])}" if alone else "–")
            best = cheapest(mine, "alone_us", 0.01)
            about = f"{setting(best)} | {100 * best['error']:.2f} % | {100 * best['stretch']:.1g} %" if best else "– | – | –"
            lines.append(f"| {program} | {' | '.join(cells)} | {about} |")
        put(lines, f"cost of the {case}")


def ahead(data):
    lines = ["| case | " + " | ".join(f"{100 * limit:g} %: {name}" for limit in LIMITS for name in ("alone", "many")) + " |",
             "|---" * (2 * len(LIMITS) + 1) + "|"]
    for case, name in CASES.items():
        cells = []
        for limit in LIMITS:
            for way in WAYS:
                ours = cheapest(of(data, case, "superhelix"), way, limit)
                peers = [row for program in PROGRAMS if program != "superhelix" for row in [cheapest(of(data, case, program), way, limit)] if row]
                if ours and peers:
                    best = min(peers, key=lambda row: row[way])
                    cells.append(f"{best[way] / ours[way]:.1f} × ({best['program']})")
                else:
                    cells.append("no peer gets there" if ours else "–")
        lines.append(f"| {name} | {' | '.join(cells)} |")
    put(lines, "ahead")


def duration(rate, first):
    if not rate:
        return "none tried"
    step = 1.0 / float(rate)
    said = f"1/{int(float(rate))} s" if step > 1e-4 else f"{step * 1e6:.2g} µs"
    return f"{said} or more" if int(float(rate)) == first else said


def stability():
    lines = ["| case | program | N | longest step that holds | and keeps the length to 1 % | a second at 1/60 s | stretch there |", "|---" * 7 + "|"]
    for row in rows("peers_stability.csv"):
        first = 10
        there = number(row["stretch_at_60"])
        tried = row["second_at_60"] != ""
        verdict = "not tried" if not tried else "stable" if row["second_at_60"] == "True" else "not stable"
        if tried and verdict == "not stable" and there is not None and there < 0.2:
            verdict = "holds, stretches"
        stretch = f"{100 * there:.1g} %" if there is not None and there < 1 else "–"
        lines.append(f"| {CASES[row['case']]} | {row['program']} | {row['elements']} | {duration(row.get('bounded_rate'), first)} | "
                     f"{duration(row.get('stable_rate'), first)} | {verdict} | {stretch} |")
    put(lines, "stability")


def strands(data):
    counts = sorted({int(row["strands"]) for row in data})
    lines = ["| program | steps | " + " | ".join(f"{count}" for count in counts) + " |", "|---" * (2 + len(counts)) + "|"]
    for program in PROGRAMS:
        mine = {int(row["strands"]): row for row in data if row["program"] == program}
        some = next(iter(mine.values()))
        iterations = f", {float(some['iterations']):.1f} iterations" if some["iterations"] else ""
        cells = [f"{float(mine[count]['us_per_element_step']):.2f}" if count in mine else "–" for count in counts]
        lines.append(f"| {program} | 1/{some['rate']} s{iterations} | {' | '.join(cells)} |")
    put(lines, "strands")


def about():
    known = {row["what"]: row["value"] for row in rows("peers_about.csv")}
    versions = ", ".join(f"{name} {known[f'version of {name}']}" for name in PROGRAMS)
    empty = ", ".join(f"{name} {float(known[f'us of an empty step of {name}']):.1f} µs" for name in PROGRAMS if name != "superhelix")
    minutes = f"{float(known['minutes']):.0f} minutes"
    if known.get("processor_minutes"):
        minutes += f", {float(known['processor_minutes']):.0f} of processor time"
    put([f"{known['processor']}, {known['processors']} processors, {known['system']}, Python {known['python']}; {versions}; commit {known['commit']}; "
         f"{minutes}{', quick' if known['quick'] == 'True' else ''}. A step of an empty world (PyElastica: of one element): {empty}."], "machine")
    lines = ["| case | " + " | ".join(f"{program}: tried, blown up, stretched, refused" for program in PROGRAMS) + " |", "|---" * 5 + "|"]
    for case, name in CASES.items():
        cells = [", ".join(known[f"{case}, {program}: {what}"] for what in ("tried", "blown up", "stretched", "refused")) for program in PROGRAMS]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    put(lines, "counts")
    lines = ["| case | against | largest distance of the tips, of the length |", "|---|---|---|"]
    for key, value in known.items():
        case, found, what = key.partition(", truth: ")
        if found:
            lines.append(f"| {CASES[case]} | {what} | {float(value):.1e} |")
    put(lines, "truth")


def main():
    data, crowd = read(), rows("peers_strands.csv")
    draw(data)
    draw_strands(crowd)
    cost_tables(data)
    ahead(data)
    stability()
    strands(crowd)
    about()


main()
