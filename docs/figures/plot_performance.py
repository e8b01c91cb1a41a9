"""Draws docs/figures/{cost,scaling}.png and writes the tables of docs/notebook/performance.md between their markers, from
docs/figures/performance_*.csv and instructions.csv. Run by `make bench` and `make figures`."""

from collections import defaultdict

from plot import COLOURS, plt, put, rows, save

PAGE = "notebook/performance.md"


def table(header, lines):
    return ["| " + " | ".join(header) + " |", "|---" * len(header) + "|"] + ["| " + " | ".join(line) + " |" for line in lines]


def unit(text):
    return text.replace("us", "µs")


def machine():
    lines = [(row["what"].replace("10^9", "10⁹"), row["value"]) for row in rows("performance_machine.csv")]
    put(table(("what", "this run"), lines), PAGE, "machine")


def aims():
    lines = []
    for row in rows("performance_aims.csv"):
        if row["limit"]:
            verdict = "reached" if float(row["of_limit"]) <= 1 else f"missed: {row['of_limit']} ×"
        else:
            verdict = ""
        lines.append((row["what"], unit(row["unit"]), row["limit"], row["measured"], f"{100 * float(row['spread']):.0f} %", row["least"], verdict,
                      f"{100 * float(row['of_peak']):.0f} %" if row["of_peak"] else "", row["note"]))
    put(table(("what", "unit", "at most", "median", "spread", "least", "", "of the peak", "note"), lines), PAGE, "aims")


def cost():
    data = rows("performance_cost.csv")
    linear = [row for row in data if row["solver"] == "linear time"]
    dense = [row for row in data if row["solver"] != "linear time"]
    series = defaultdict(list)
    for row in linear:
        series[row["set"], row["precision"]].append((int(row["N"]), float(row["us_element_step"]), float(row["us_element_iter"])))
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.8))
    sets = list(dict.fromkeys(name for name, _ in series))
    for (name, precision), points in series.items():
        counts, steps, _ = zip(*points)
        left.loglog(counts, steps, "o-" if precision == "f64" else "s--", color=COLOURS[sets.index(name)], markersize=3, linewidth=1,
                    label=f"{name}, {precision}")
    left.set_title("by instructions and precision", fontsize=9)
    left.set_ylim(top=6 * left.get_ylim()[1])
    left.legend(fontsize=7, ncols=2, loc="upper right")
    best = series[sets[-1], "f64"]
    right.loglog([p[0] for p in best], [p[1] for p in best], "o-", color=COLOURS[0], markersize=3, label=f"linear time, {sets[-1]}")
    scalar = series[sets[0], "f64"]
    right.loglog([p[0] for p in scalar], [p[1] for p in scalar], "o--", color=COLOURS[0], markersize=3, label="linear time, scalar")
    right.loglog([int(row["N"]) for row in dense], [float(row["us_element_step"]) for row in dense], "s-", color=COLOURS[1], markersize=3,
                 label="dense Cholesky, scalar")
    right.set_title("beside the dense solve, f64", fontsize=9)
    right.legend(fontsize=7)
    for axes in (left, right):
        axes.set_xlabel("elements a strand, N")
        axes.set_ylabel("µs an element and step")
    save(figure, "cost.png")

    counts = sorted({point[0] for points in series.values() for point in points})
    lines = [(name, precision, *(f"{step:.3g}" for _, step, _ in points), f"{max(p[1] for p in points[2:]) / min(p[1] for p in points[2:]):.2f}")
             for (name, precision), points in series.items()]
    header = ("instructions", "precision", *(f"N = {count}" for count in counts), "dearest / cheapest from N = 10")
    text = ["µs an element and step:", ""] + table(header, lines)
    lines = [(name, precision, *(f"{each:.3g}" for _, _, each in points)) for (name, precision), points in series.items()]
    text += ["", "µs an element and iteration (step / iterations):", ""] + table(header[:-1], lines)
    text += ["", "Dense Cholesky, f64, µs an element and step: " +
             ", ".join(f"{float(row['us_element_step']):.3g} at N = {row['N']}" for row in dense) + "."]
    put(text, PAGE, "cost")


def options():
    lines = [(row["integrator"], row["hessian"], row["precision"], row["threads"], f"{float(row['iterations']):.2f}", row["us_element_step"],
              row["us_element_iter"], f"{100 * float(row['spread']):.0f} %") for row in rows("performance_options.csv")]
    put(table(("integrator", "Hessian", "precision", "threads", "iterations", "µs an element and step", "µs an element and iteration", "spread"), lines),
        PAGE, "options")


def scenes():
    lines = [(row["scene"], row["precision"], row["N"], f"{float(row['iterations']):.2f}", row["us_element_step"], row["us_element_iter"],
              f"{float(row['us_element_step']) * int(row['N']):.3g}", f"{100 * float(row['failed']):.2g} %")
             for row in rows("performance_scenes.csv")]
    put(table(("scene", "precision", "N", "iterations", "µs an element and step", "µs an element and iteration", "µs a strand and step",
               "not converged"), lines), PAGE, "scenes")


def absent():
    lines = [(row["without"], row["precision"], row["operations_step"], row["operations_iter"], row["us_element_step"], row["us_element_iter"],
              row["step_ratio"], row["iter_ratio"]) for row in rows("performance_absent.csv")]
    put(table(("left out", "precision", "operations an element and step", "operations an element and iteration", "µs an element and step",
               "µs an element and iteration", "step, to the first row's", "iteration, to the first row's"), lines), PAGE, "absent")


def parts():
    lines = [tuple(row.values()) for row in rows("performance_parts.csv")]
    put(table(("operations an element", "f64", "f32", "f64, two freedoms"), lines), PAGE, "parts")


def scaling():
    series = defaultdict(list)
    for row in rows("performance_scaling.csv"):
        series[row["kind"], row["threads"]].append((int(row["strands"]), float(row["ms_step"]), float(row["us_element_step"]), row["bytes_strand"]))
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.6))
    kinds = list(dict.fromkeys(kind for kind, _ in series))
    for (kind, threads), points in series.items():
        strands, milliseconds, each, _ = zip(*points)
        style = {"color": COLOURS[kinds.index(kind)], "markersize": 3, "linewidth": 1, "label": f"{kind}, {threads} thread{'s' * (threads != '1')}"}
        left.loglog(strands, milliseconds, "o-" if threads == "1" else "s--", **style)
        right.loglog(strands, each, "o-" if threads == "1" else "s--", **style)
    left.axhline(1000 / 60, color="grey", linewidth=0.8)
    left.text(1, 1000 / 60 * 1.1, "a frame at 60 Hz", fontsize=7, color="grey")
    left.set_ylabel("ms a step")
    right.set_ylabel("µs an element and step")
    for axes in (left, right):
        axes.set_xlabel("strands of 5 elements")
    right.legend(fontsize=7)
    save(figure, "scaling.png")
    columns = list(series)
    counts = [point[0] for point in series[columns[0]]]
    lines = [(f"{count}", *(f"{series[column][k][1]:.3g} ({series[column][k][2]:.3g})" for column in columns), series[columns[0]][k][3])
             for k, count in enumerate(counts)]
    header = ("strands", *(f"{kind}, {threads} thread{'s' * (threads != '1')}" for kind, threads in columns), "bytes a strand")
    put(["ms a step, in brackets µs an element and step:", ""] + table(header, lines), PAGE, "scaling")


def cold():
    lines = [(row["what"], f"{row['value']} {unit(row['unit'])}") for row in rows("performance_cold.csv")]
    put(table(("what", ""), lines), PAGE, "cold")


def instructions():
    data = rows("instructions.csv")
    lines = [(row["set"], row["precision"], row["elements"], row["per_element_step"], row["per_element_iteration"]) for row in data]
    put(table(("instructions", "precision", "N", "an element and step of three iterations", "an element and one more iteration"), lines) +
        ["", f"Compiler: {data[0]['compiler']}."], PAGE, "instructions")


if __name__ == "__main__":
    for part in (machine, aims, cost, options, scenes, absent, parts, scaling, cold, instructions):
        part()
