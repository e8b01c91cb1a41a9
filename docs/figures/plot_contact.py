"""Writes the tables of docs/contact.md between their markers, from docs/figures/contact_*.csv. Run by `make contact`."""

from plot import put, rows
from plot_performance import table

PAGE = "contact.md"


def shake():
    lines = [(row["model"], row["median_ms"], row["ninth_decile_ms"], row["worst_ms"], row["touches"], row["iterations"],
              row["most_iterations"], row["penetration_m"], row["residual"], row["unconverged"], row["rolled_back"])
             for row in rows("contact_shake.csv")]
    put(table(("model", "ms a step, median", "nine of ten", "worst", "touches", "iterations, mean", "most", "deepest, m", "residual",
               "unconverged strand steps", "rolled back"), lines), PAGE, "shake")


def price():
    lines = [(row["model"], f"1/{1 / float(row['step_s']):.0f}", f"{1e3 * float(row['rms_error_m']):.2f}", row["ms_a_strand_second"])
             for row in rows("contact_price.csv")]
    put(table(("model", "step, s", "error, mm", "cost, ms"), lines), PAGE, "price")


if __name__ == "__main__":
    shake()
    price()
