"""Writes the tables of docs/notebook/groom_fit.md between their markers, from docs/figures/groom_fit*.csv. Run by `make fit`."""

from plot import DOCS, rows
from plot_performance import table

PAGE = DOCS / "notebook/groom_fit.md"


def put(lines, name):
    start, end = f"<!-- {name}: made by make fit -->\n", f"<!-- end of {name} -->"
    before, rest = PAGE.read_text().split(start)
    _, after = rest.split(end)
    PAGE.write_text(before + start + "\n".join(lines) + "\n" + end + after)
    print(f"docs/notebook/{PAGE.name}: table of {name}")


RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def share(value):
    return f"{100 * float(value):.4g}"


def percent(value):
    return f"{100 * float(value):.3g}"


def grooms():
    lines = []
    last = None
    for row in rows("groom_fit.csv"):
        head = (row["groom"].replace("_", " "), row["strands"], f"{float(row['turning_degrees']):.0f}")
        lines.append((head if row["groom"] != last else ("", "", "")) + (row["elements"],)
                     + tuple(" / ".join(percent(row[f"{norm}{rank}"]) for rank in (50, 95, 99, 100)) for norm in ("rms", "max"))
                     + (share(row["within1"]), percent(row["distance95"]), f"{100 * int(row['unequal']) / int(row['strands']):.0f}",
                        f"{float(row['processor_seconds']):.2f}"))
        last = row["groom"]
    put(table(("groom", "strands", "turning, degrees", "N", "rms, %: 50 / 95 / 99 / 100", "largest, %: 50 / 95 / 99 / 100",
               "under 1 %, %", "nearest, %: 95", "unequal, %", "processor time, s"), lines), "grooms")


def rest():
    lines = []
    for row in rows("groom_rest.csv"):
        unit = f"{float(row['metres_per_unit']):.3g}" + ("" if row["known"] == "1" else " (chosen)")
        told = [f"{row[name]} {name}" for name in ("unconverged", "quarantined") if row[name] != "0"]
        mantissa, exponent = row["moved"].split("e")
        moved = f"{float(mantissa):.0f}·10{str(int(exponent)).translate(RAISED)}" if float(mantissa) else "0"
        lines.append((row["groom"].replace("_", " "), unit, row["strands"], row["elements"],
                      f"{row['unstable']} ({100 * int(row['unstable']) / int(row['strands']):.1f} %)",
                      f"{float(row['stiffening95']):.3g} / {float(row['stiffening100']):.3g}", "; ".join([moved] + told)))
    put(table(("groom", "metres a unit", "strands", "N", "unstable as drawn", "stiffening of E: 95 % / largest", "moved in 10 s, of L"), lines), "rest")


def methods():
    lines = []
    last = None
    for row in rows("groom_fit_methods.csv"):
        key = (row["groom"], row["elements"])
        lines.append(((row["groom"].replace("_", " "), row["elements"]) if key != last else ("", ""))
                     + (row["method"], row["strands"], f"{percent(row['rms50'])} / {percent(row['rms95'])}",
                        f"{percent(row['max50'])} / {percent(row['max95'])} / {percent(row['max100'])}", f"{float(row['microseconds']):.0f}"))
        last = key
    put(table(("groom", "N", "method", "strands", "rms, %: 50 / 95", "largest, %: 50 / 95 / 100", "µs a strand"), lines), "methods")


def tolerances():
    lines = [(row["groom"].replace("_", " "), percent(row["tolerance"]), row["strands"], f"{float(row['elements50']):.0f}",
              f"{float(row['elements95']):.0f}", f"{float(row['elements100']):.0f}", row["unmet"],
              f"{1e6 * float(row['processor_seconds']) / int(row['strands']):.0f}")
             for row in rows("groom_fit_tolerance.csv")]
    put(table(("groom", "tolerance, %", "strands", "elements: half", "95 %", "most", "not kept by 100", "µs a strand"), lines),
        "tolerances")


if __name__ == "__main__":
    grooms()
    rest()
    methods()
    tolerances()
