"""Writes the tables of docs/theory/hair_types.md between their markers, from docs/figures/hair_types.csv and hair_sliders.csv."""

from plot import put, rows
from plot_performance import table

PAGE = "theory/hair_types.md"


def kinds():
    lines = [(f"`{row['type']}`", f"{row['a1_um']} / {row['a2_um']}", row["modulus_gpa"], row["ei0"], row["ei1"], row["ei2"],
              f"{row['curvature']} / {row['twist']}", f"{row['paper_curvature']} / {row['paper_twist']}", row["span_natural"], row["span_rest"],
              row["droop"]) for row in rows("hair_types.csv")]
    put(table(("type", "semi-axes, µm", "E, GPa", "EI0, N·m²", "EI1", "EI2", "κ1 / κ0, rad/m", "the paper's", "natural span", "span at rest", "droop"),
              lines), PAGE, "kinds")


def sliders():
    lines = [(row["slider"], f"`{row['type']}`", row["measure"], row["minus_1"], row["minus_half"], row["zero"], row["half"], row["one"])
             for row in rows("hair_sliders.csv")]
    put(table(("slider", "type", "what is measured", "−1", "−½", "0", "½", "1"), lines), PAGE, "sliders")


if __name__ == "__main__":
    kinds()
    sliders()
