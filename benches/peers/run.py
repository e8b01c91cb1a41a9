"""Everything that docs/notebook/peers.md shows, in one run: docs/figures/peers*.csv. `make peers` calls it; by hand:

build/peers/venv/bin/python benches/peers/run.py OURS [--quick] [--into FOLDER]

OURS is the engine's program (cargo bench --profile demo --bench peers --no-run names it). The parts:
1. truth (truth.py), and how far other ways to it are from it;
2. scan: every setting, one strand: its errors, a first figure of its cost;
3. stability: an undamped second at ever shorter steps, and at 1/60 s;
4. cost: what is on or near each program's front, again, in rounds that take the programs in turn: one strand alone, and many in a world;
5. strands: cost an element-step for 1 to 1000 strands."""
import argparse
import csv
import json
import math
import os
import platform
import resource
import subprocess
import time
from pathlib import Path
from statistics import median

import programs as processes
import settings as tried
from cases import CASES
from judge import STRETCH, errors, record_times, stretch, verdict
from truth import checks, truth

REPOSITORY = Path(__file__).resolve().parents[2]
ROUNDS = 3
# Seconds that a run of many strands should take; fewer strands than MANY where one is dear, but never below FEWEST.
RUN_OF_MANY = 0.3
FEWEST = 16
# Settings whose first cost is within this factor of the front's are measured again: the first figure is rough.
NEAR = 1.1
# Errors beyond which a setting is of no interest, in lengths.
USELESS = 0.15


def request(case, elements, rate, settings, do="measure", strands=1, seconds=None, patience=0.0, runs=(1, 1)):
    if do == "watch":
        every = max(1, min(rate // 60, round(seconds * rate)))
        records = max(1, int(seconds * rate / every + 1e-9))
    else:
        every, times = record_times(case, rate)
        records = len(times)
    return {"do": do, "case": case.wire(), "elements": elements, "rate": rate, "records": records, "every": every, "strands": strands,
            "settings": settings, "patience": patience, "least_runs": runs[0], "most_runs": runs[1]}


def simulated(case, rate):
    return record_times(case, rate)[1][-1]


def write(folder, name, rows):
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with open(folder / name, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()} for row in rows)
    print(f"{folder / name}: {len(rows)} rows", flush=True)


def scan(programs, case, right, quick):
    """Every setting. One that blows up, or stretches too much, is counted and left out."""
    rows, counts = [], {}
    for name, elements, settings, rates, explicit in tried.grid(case, quick):
        counted = counts.setdefault(name, {"tried": 0, "blown up": 0, "stretched": 0, "refused": 0})
        for rate in rates:
            answer = programs[name].ask(request(case, elements, rate, settings, patience=0.003, runs=(1, 5)))
            counted["tried"] += 1
            if "tips" not in answer:
                counted["refused" if "error" in answer else "blown up"] += 1
                continue
            most, last = errors(answer, case, rate, right)
            if not most < USELESS:
                counted["blown up"] += not most < 2
            elif stretch(answer) >= STRETCH:
                counted["stretched"] += 1
            else:
                rows.append({"case": case.name, "program": name, "elements": elements, "rate": rate, "settings": json.dumps(settings),
                             "error": most, "error_at_end": last, "stretch": stretch(answer), "unconverged": answer.get("unconverged", ""),
                             "scan_us": min(answer["processor"]) / simulated(case, rate) * 1e6})
            if explicit and most < 2:
                break
    return rows, counts


def near_front(rows, cost, factor):
    """Rows that no other one beats in error at less than 1/factor of their cost."""
    return [row for row in rows if not any(other["error"] <= row["error"] and other[cost] * factor < row[cost] for other in rows)]


def fewer(rows):
    """The two cheapest of each twelfth of a decade of error."""
    kept = {}
    for row in sorted(rows, key=lambda row: row["scan_us"]):
        kept.setdefault(math.floor(12 * math.log10(row["error"])), []).append(row)
    return sorted((row for bin_rows in kept.values() for row in bin_rows[:2]), key=lambda row: row["scan_us"])


def costs(programs, cases, rows, quick):
    """Adds alone_us and many_us, microseconds a strand and simulated second, to the rows that are near a front: medians over the rounds."""
    by_case = {case.name: case for case in cases}
    turns = {name: [] for name in programs}
    for case in cases:
        for name, turn in turns.items():
            mine = [row for row in rows if row["case"] == case.name and row["program"] == name and 1e-3 < row["error"] < 0.1]
            turn += fewer(near_front(mine, "scan_us", NEAR))
    # In turn: what else the machine does falls on all programs alike.
    order = [turn[k] for k in range(max(map(len, turns.values()))) for turn in turns.values() if k < len(turn)]
    print(f"measured again: {', '.join(f'{len(turn)} of {name}' for name, turn in turns.items())}", flush=True)
    samples = {id(row): ([], [], []) for row in order}
    for _ in range(1 if quick else ROUNDS):
        for row in order:
            name, case, settings = row["program"], by_case[row["case"]], json.loads(row["settings"])
            span, (alone, wall, many) = simulated(case, row["rate"]), samples[id(row)]
            answer = programs[name].ask(request(case, row["elements"], row["rate"], settings, patience=0.02, runs=(1, 30)))
            alone.append(median(answer["processor"]) / span * 1e6)
            wall.append(median(answer["wall"]) / span * 1e6)
            if name in tried.MANY:
                count = max(FEWEST, min(tried.MANY[name], int(RUN_OF_MANY / (row["scan_us"] * 1e-6 * span))))
                answer = programs[name].ask(request(case, row["elements"], row["rate"], settings, strands=count))
                many.append(answer["processor"][0] / span / count * 1e6)
    for row in order:
        alone, wall, many = samples[id(row)]
        row["alone_us"], row["alone_wall_us"] = median(alone), min(wall)
        # Worlds of one strand can be stepped one after another, whatever the program.
        row["many_us"] = min(median(many), row["alone_us"]) if many else row["alone_us"]


def stability(programs, case, quick):
    elements, rows = tried.STABLE_ELEMENTS[case.name], []
    seconds = 0.25 if quick else 1.0
    contestants = [(name, name, tried.ORDINARY[name], seconds) for name in programs]
    # Explicit and stiff: a hundredth of a second says it.
    contestants += [("PyElastica", "PyElastica, hair as it is", tried.UNCHANGED, 0.002)]
    for program, label, settings, span in contestants:
        row = {"case": case.name, "program": label, "elements": elements, "seconds": span}
        rates = tried.STABLE_RATES if span > 0.1 else [245760 * 2**k for k in range(10)]
        for rate in rates:
            answer = programs[program].ask(request(case, elements, rate, settings, do="watch", seconds=span))
            holds, keeps_length, most, gain = verdict(answer, case, 1 / rate)
            if rate == 60:
                row |= {"second_at_60": holds and keeps_length, "stretch_at_60": most, "gain_at_60": gain,
                        "unconverged_at_60": answer.get("unconverged", "")}
            if holds and "bounded_rate" not in row:
                row |= {"bounded_rate": rate}
            if keeps_length and "stable_rate" not in row:
                row |= {"stable_rate": rate, "stretch": most}
            if "stable_rate" in row and ("second_at_60" in row or rates[0] > 60):
                break
        print(row, flush=True)
        rows.append(row)
    return rows


def strands(programs, case, quick):
    """Cost an element-step against strands in a world, ordinary settings, at 1/240 s (PyElastica: its stable step, for 1/60 s)."""
    rows, elements = [], 20
    for count in tried.STRANDS[::2] if quick else tried.STRANDS:
        for name, program in programs.items():
            rate = 30720 if name == "PyElastica" else 240
            # Beyond, MuJoCo takes minutes to build a world that costs as much a strand.
            if name == "MuJoCo" and count > 64:
                continue
            asked = request(case, elements, rate, tried.ORDINARY[name], strands=count, patience=0.02, runs=(2, 20))
            if name == "PyElastica":
                asked["records"] = 1
            seconds, iterations = [], ""
            for _ in range(1 if quick else 3):
                answer = program.ask(asked)
                if "processor" not in answer:
                    print(name, count, answer)
                    break
                seconds.append(min(answer["processor"]))
                iterations = answer.get("iterations", "")
            if seconds:
                element_steps = asked["records"] * asked["every"] * elements * count
                rows.append({"program": name, "strands": count, "elements": elements, "rate": rate, "iterations": iterations,
                             "us_per_element_step": median(seconds) / element_steps * 1e6})
    return rows


def about(programs, seconds, quick, counts, checked):
    model = next((line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")),
                 platform.machine()) if Path("/proc/cpuinfo").exists() else platform.machine()
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=REPOSITORY, capture_output=True, text=True).stdout.strip()
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    found = {"commit": commit or "unknown", "processor": model, "processors": os.cpu_count(), "system": platform.platform(),
             "python": platform.python_version(), "quick": quick, "minutes": seconds / 60,
             "processor_minutes": (used.ru_utime + used.ru_stime) / 60, "rounds": 1 if quick else ROUNDS}
    for name, program in programs.items():
        found[f"version of {name}"] = program.version
        found[f"us of an empty step of {name}"] = program.overhead * 1e6
    for case, per_program in counts.items():
        for name, counted in per_program.items():
            for what, number in counted.items():
                found[f"{case}, {name}: {what}"] = number
    for case, per_check in checked.items():
        for what, distance in per_check.items():
            found[f"{case}, truth: {what}"] = distance
    return [{"what": key, "value": value} for key, value in found.items()]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("ours")
    parser.add_argument("--quick", action="store_true", help="a ninth of the settings, one round: to see that it works")
    parser.add_argument("--into", type=Path, default=REPOSITORY / "docs" / "figures")
    arguments = parser.parse_args()
    began = time.monotonic()

    def said(what):
        print(f"[{time.monotonic() - began:6.1f} s] {what}", flush=True)
    programs = processes.start(arguments.ours)
    arguments.into.mkdir(parents=True, exist_ok=True)
    rows, stable, counts, checked = [], [], {}, {}
    for case in CASES:
        right, known = truth(programs, case)
        checked[case.name] = {"its own error": known, **checks(programs, case, right)}
        said(f"{case.name}: truth {checked[case.name]}")
        found, counts[case.name] = scan(programs, case, right, arguments.quick)
        rows += found
        said(f"{case.name}: scanned {counts[case.name]}")
        stable += stability(programs, case, arguments.quick)
        said(f"{case.name}: stability")
    write(arguments.into, "peers_stability.csv", stable)
    costs(programs, CASES, rows, arguments.quick)
    write(arguments.into, "peers.csv", rows)
    said("costs")
    write(arguments.into, "peers_strands.csv", strands(programs, CASES[0], arguments.quick))
    said("strands")
    for program in programs.values():
        program.close()
    write(arguments.into, "peers_about.csv", about(programs, time.monotonic() - began, arguments.quick, counts, checked))


if __name__ == "__main__":
    main()
