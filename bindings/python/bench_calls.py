#!/usr/bin/env python3
"""The cost of a call through Python, beside the same call from C: the table of docs/reference/python.md.

    python bindings/python/bench_calls.py [--rounds 5]

Both run the same shared library (the one that the package has loaded) on one thread: C from bench_calls.c, which this compiles. Processor time
counts, and the best of some rounds, in which the two take turns.
"""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import superhelix as shx
from superhelix._library import library_path

HERE = Path(__file__).resolve().parent
INCLUDE = HERE.parent.parent / "include"

#: What, strands, calls a round.
CASES = (
    ("count", 1, 20_000, "strand_count, which does nothing"),
    ("step", 1, 5_000, "step of 1 strand"),
    ("step", 100, 100, "step of 100 strands"),
    ("step", 10_000, 1, "step of 10,000 strands"),
    ("sample", 150_000, 1, "sampling 150,000 strands at 16 points"),
)


def compile_c(folder: Path, library: Path) -> Path:
    """bench_calls.c, linked to a library."""
    program = folder / "bench_calls"
    compiler = shlex.split(os.environ.get("CC", "cc"))
    options = ["-std=c99", "-O2", "-D_DEFAULT_SOURCE", "-Wall", "-Wextra", "-Werror", f"-I{INCLUDE}"]
    command = [*compiler, *options, str(HERE / "bench_calls.c"), str(library), f"-Wl,-rpath,{library.parent}", "-o", str(program)]
    subprocess.run(command, check=True)
    # The library is looked for by its SONAME.
    return program


def python_time(what: str, count: int, calls: int) -> float:
    """Seconds a call, one round."""
    with shx.Solver() as solver:
        roots = shx.frames.frames(np.c_[np.zeros(count), 0.001 * np.arange(count), np.zeros(count)])
        elements = 4 if what == "sample" else 8
        solver.add_strands(shx.StrandDefs(count, element_count=elements, length=0.2, root=roots))
        report, points = shx.StepReport(), np.zeros((count, 16, 3), dtype=np.float32)
        solver.strand_ids()
        points.fill(0.0)
        began = time.thread_time()
        if what == "step":
            for _ in range(calls):
                solver.step(1.0 / 240.0, 1, report=report)
        elif what == "sample":
            for _ in range(calls):
                solver.sample_strands(16, out=points)
        else:
            for _ in range(calls):
                solver.strand_count()
        return (time.thread_time() - began) / calls


def c_time(program: Path, what: str, count: int, calls: int, library: Path) -> float:
    """The same from C."""
    command = [str(program), what, str(count), str(calls), "1"]
    environment = {**os.environ, "LD_LIBRARY_PATH": str(library.parent)}
    return float(subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout)


def shown(seconds: float) -> str:
    """Seconds in a unit that suits them."""
    return f"{seconds * 1e6:.3g} µs" if seconds < 1e-3 else f"{seconds * 1e3:.4g} ms"


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="What a call costs through Python, beside the same call from C.")
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    with tempfile.TemporaryDirectory() as folder:
        # A copy by the name that the loader looks for.
        library = Path(folder) / "libsuperhelix.so.0"
        library.write_bytes(library_path().read_bytes())
        program = compile_c(Path(folder), library)
        print(shx.build_info())
        print("| call | C | Python | Python / C |\n|---|---|---|---|")
        for what, count, calls, name in CASES:
            pairs = [(c_time(program, what, count, calls, library), python_time(what, count, calls)) for _ in range(rounds)]
            ours, theirs = min(pair[1] for pair in pairs), min(pair[0] for pair in pairs)
            print(f"| {name} | {shown(theirs)} | {shown(ours)} | {ours / theirs:.3f} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
