"""Writes the tables of docs/notebook/contact.md and docs/notebook/tradeoff.md between their markers, from contact_*.csv in docs/figures. Run by `make contact`.
With another folder than docs/figures the tables of the numbers there are printed, and docs/ stays as it is.
"""

import csv
import sys
from pathlib import Path

from plot import FIGURES, put
from plot_performance import table, unit

FOLDER = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else FIGURES


def rows(name):
    with open(FOLDER / name, newline="") as file:
        return list(csv.DictReader(file))


def show(lines, name, *pages):
    if FOLDER == FIGURES.resolve():
        for page in pages:
            put(lines, page, name)
    else:
        print("\n".join([name, *lines]))


def shake():
    lines = [(row["model"], row["median_ms"], row["ninth_decile_ms"], row["worst_ms"], row["contacts"], row["iterations"],
              row["most_iterations"], row["penetration_m"], row["overlap_m"], row["deep_steps"], row["residual"], row["unconverged"], row["rolled_back"])
             for row in rows("contact_shake.csv")]
    show(table(("model", "ms a step, median", "nine of ten", "worst", "contacts", "iterations, mean", "most", "deepest reported, m",
                "overlap, m", "of 90 steps deeper than 0.1 mm", "residual",
                "unconverged strand steps", "rolled back"), lines), "shake", "notebook/contact.md")


def price():
    """A line a model and step; rough and smooth side by side."""
    found = {}
    for row in rows("contact_price.csv"):
        found.setdefault((row["model"], row["step_s"]), {})[row["case"]] = row
    lines = [(model, f"1/{1 / float(step):.0f}", *(f"{1e3 * float(of[case]['rms_error_m']):.2f}" for case in ("rough", "smooth")),
              *(of[case]["ms_a_strand_second"] for case in ("rough", "smooth")))
             for (model, step), of in found.items()]
    show(table(("model", "step, s", "rough: error, mm", "smooth: error, mm", "rough: cost, ms", "smooth: cost, ms"), lines),
         "price", "notebook/contact.md", "notebook/tradeoff.md")


def rest():
    lines = [(row["model"], f"{1e3 * float(row['tip_error_m']):.4f}", f"{1e2 * float(row['force_error']):.3f}", f"{1e6 * float(row['deepest_m']):.1f}")
             for row in rows("contact_rest.csv")]
    show(table(("model", "tip off, mm", "force off, %", "deepest, µm"), lines), "rest", "notebook/contact.md", "notebook/tradeoff.md")


def scaling():
    lines = [("tufts of 16 strands" if row["case"] == "tufts" else "one head", row["model"], row["strands"], row["contacts"], row["ms_a_step"], row["us_a_contact"],
              row["contacts_found"], row["search_ms"], row["search_us_a_contact_found"], row["units_a_us"], row["unconverged"])
             for row in rows("contact_scaling.csv")]
    show(table(("scene", "model", "strands", "contacts", "ms per step", "µs per contact", "contacts found by a search", "ms a search",
                "µs per contact found", "units of work per µs", "unconverged strand steps, of 30 each"), lines), "scaling", "notebook/contact.md")


def walk():
    free = {}
    lines = []
    for row in rows("contact_walk.csv"):
        median, crowd = float(row["median_ms"]), (row["guides"], row["precision"])
        free.setdefault(crowd, median)
        touches = not row["case"].startswith("free")
        lines.append((row["case"], row["guides"], row["elements"], row["precision"].lower(), row["median_ms"], f"{median / free[crowd]:.1f}", row["ninth_decile_ms"],
                      row["worst_ms"], *(f"{100 * float(row[key]):.2f}" if touches else "" for key in ("deeper_than_half_mm", "deeper_than_2_mm"))))
    show(table(("model", "guides", "elements", "precision", "ms per step, median", "over the free step", "nine of ten", "worst", "% of strands somewhere deeper than 0.5 mm",
                "than 2 mm"), lines), "walk", "notebook/contact.md")


def strands():
    lines = []
    for row in rows("contact_strands.csv"):
        one, two = float(row["one_thread_ms"]), float(row["two_threads_ms"])
        lines.append((row["case"], row["guides"], row["one_thread_ms"], f"{1e3 * one / int(row['guides']):.1f}", row["two_threads_ms"], f"{one / two:.2f}"))
    show(table(("model", "guides", "ms per step, one thread", "µs per strand", "two threads", "faster by"), lines), "strands", "notebook/contact.md")


def jumps():
    lines = [(row["model"], row["what"], row["budget_ms"] if float(row["budget_ms"]) else "none", row["calm_ms"], row["dearest_ms"], row["p999_ms"],
              row["left"], row["lost_after"], row["deepest_after_m"])
             for row in rows("contact_jumps.csv")]
    show(table(("model", "the head goes", "budget, ms", "ms a calm step (at random: the median)", "dearest", "99.9 of 100", "strand steps left", "lost a second later",
                "deepest then, m"), lines), "jumps", "notebook/contact.md")


def aims():
    lines = [(row["what"].replace(" x ", " × "), unit(row["unit"]), row["asked"], row["when_asked"], row["measured"], row["ratio_to_free"],
              row["worst"], row["note"])
             for row in rows("contact_aims.csv")]
    show(table(("what", "unit", "asked, at most", "when it was asked", "median", "over the free step", "worst", "besides"), lines),
         "aims", "notebook/contact.md")


if __name__ == "__main__":
    shake()
    jumps()
    price()
    rest()
    scaling()
    walk()
    strands()
    aims()
