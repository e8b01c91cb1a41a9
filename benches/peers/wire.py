"""How the peers' programs are asked: one request a line on standard input, one answer a line on standard output, JSON both. ours.rs speaks
the same.

A request: `do`, `case` (cases.py), `elements`, `rate` (steps a second), `records` and `every` (a record follows `every` steps),
`strands` (equal ones, in one world), `settings` (the program's own).
- measure: runs from the start, again and again, until they took `patience` seconds (at least `least_runs`, at most `most_runs`).
  Answer: `processor` and `wall`, the stepping seconds of each run; `tips` and `lengths` (over what it should be) of the first
  strand at each record of the first run; `spread`, how far the strands' tips are from one another at the end (equal strands: 0).
- watch: one run. Answer: `start`, and `pairs`, the points before and after the last step of each record; `lengths`.
- overhead: seconds of a step of a world without strands: the language's share.

A program gives `World(case, elements, step, strands, settings)` with `advance(steps)`, `points(strand)` (an array, clamp to tip) and
`rewind()` (back to the start, bit for bit), and `overhead()`, `VERSION`."""
import json
import math
import os
import sys
import time
from types import SimpleNamespace

import numpy as np

from cases import Case


def relative_length(points, case):
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum() / case.length)


def listed(points):
    return [[float(c) if math.isfinite(c) else None for c in point] for point in points]


def build(program, request):
    case = Case(**request["case"])
    return case, program.World(case, request["elements"], 1.0 / request["rate"], request["strands"], request["settings"])


def measure(program, request):
    case, world = build(program, request)
    every = request["every"]
    processor, wall, tips, lengths, spread = [], [], [], [], 0.0
    while len(processor) < request["least_runs"] or (sum(processor) < request["patience"] and len(processor) < request["most_runs"]):
        first = not processor
        if not first:
            world.rewind()
        processor_seconds = wall_seconds = 0.0
        finite = True
        for _ in range(request["records"]):
            processor_start, wall_start = time.process_time(), time.perf_counter()
            world.advance(every)
            wall_seconds += time.perf_counter() - wall_start
            processor_seconds += time.process_time() - processor_start
            points = world.points(0).copy()
            if first:
                tips.append(points[-1])
                lengths.append(relative_length(points, case))
            finite = bool(np.isfinite(points).all())
            if not finite:
                break
        if finite and not (points[-1] == tips[-1]).all():
            raise RuntimeError(f"the same run ended at {points[-1]} instead of {tips[-1]}")
        processor.append(processor_seconds)
        wall.append(wall_seconds)
        if first and finite and request["strands"] > 1:
            tip = world.points(0)[-1]
            spread = max(float(np.linalg.norm(world.points(k)[-1] - tip)) for k in range(request["strands"]))
        if not finite:
            return {"blown_up": True}
    return {"processor": processor, "wall": wall, "tips": listed(tips), "lengths": lengths, "spread": spread}


def watch(program, request):
    case, world = build(program, request)
    start, pairs, lengths = world.points(0).copy(), [], []
    for _ in range(request["records"]):
        if request["every"] > 1:
            world.advance(request["every"] - 1)
        before = world.points(0).copy()
        world.advance(1)
        points = world.points(0).copy()
        if not np.isfinite(points).all():
            return {"blown_up": True}
        pairs.append([listed(before), listed(points)])
        lengths.append(relative_length(points, case))
    return {"start": listed(start), "pairs": pairs, "lengths": lengths}


def serve(**program):
    program = SimpleNamespace(**program)
    # Whatever the libraries print goes to standard error.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    np.seterr(all="ignore")
    for line in sys.stdin:
        request = json.loads(line)
        try:
            if request["do"] == "overhead":
                answer = {"seconds": program.overhead(), "version": program.VERSION}
            else:
                answer = {"measure": measure, "watch": watch}[request["do"]](program, request)
        except ArithmeticError as error:
            answer = {"blown_up": True, "why": str(error)[:300]}
        except Exception as error:  # The answer to a request that cannot be met is part of the table.
            answer = {"error": f"{type(error).__name__}: {error}"[:300]}
        answers.write(json.dumps(answer) + "\n")
        answers.flush()
