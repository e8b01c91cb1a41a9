"""Writes the tables of docs/theory/render_strands.md and docs/notebook/render_hair.md. Run by `make figures`."""

from plot import put, rows
from plot_performance import table


def tables():
    lines, last = [], None
    for row in rows("render_hair.csv"):
        key = (row["groom"], row["guides"])
        head = (row["groom"], row["guides"], row["strands"]) if key != last else ("", "", "")
        percent = tuple(f"{100 * float(row[name]):.1f}" for name in ("length_kept", "turning_kept", "curls_kept", "apart_median"))
        lines.append(head + (row["mixed"],) + percent)
        last = key
    put(table(("groom", "guides", "strands made", "mixed", "length kept, %", "turning kept, %", "curls kept, %", "apart, % of the length"), lines),
        "theory/render_strands.md", "kept")
    lines = [(row["space"], row["threads"], row["output"], row["least_ms"], row["median_ms"]) for row in rows("render_hair_cost.csv")]
    put(table(("mixed in", "threads", "what", "least, ms", "median, ms"), lines), "notebook/render_hair.md", "render_cost")


if __name__ == "__main__":
    tables()
