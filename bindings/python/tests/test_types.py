"""Type checkers see the package's types: right programs pass, mixed-up ids do not."""

from __future__ import annotations

import subprocess
import sys

from conftest import ROOT

RIGHT = """
import numpy as np
import superhelix as shx

with shx.Solver(gravity=(0.0, -9.81, 0.0), worker_count=2) as solver:
    strands: shx.StrandIds = solver.add_strands(shx.StrandDefs(2, element_count=4, length=0.1))
    first: shx.StrandId = strands[0]
    report: shx.StepReport = solver.step(1 / 60, substeps=2, cancel=shx.Cancel())
    energy: float = report.kinetic_energy
    reason: shx.StopReason = report.stop_reason
    points = solver.sample_strands(8, strands[:1], dtype=np.float64)
    material = shx.Material(density=1200.0, radius=(1e-4, 1e-4))
    wide: tuple[float, ...] = material.radius
    table: shx.ContactTable = solver.contacts()
    met: shx.BodyIds = table.body
"""

WRONG = """
import superhelix as shx

solver = shx.Solver()
body = solver.add_body(shx.BodyDef.sphere(1.0))
solver.strand_status(body)
solver.user_data(solver.strand_ids())
shx.Material(weight=3.0)
shx.Material(density="heavy")
shx.Material().densty = 3.0
"""


def test_right_programs_pass_and_wrong_ones_are_refused(tmp_path) -> None:
    (tmp_path / "right.py").write_text(RIGHT)
    (tmp_path / "wrong.py").write_text(WRONG)
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", str(ROOT / "build" / "mypy_cache"), "."]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    errors = [line.split(":")[:2] for line in done.stdout.splitlines() if ": error:" in line]
    assert errors == [["wrong.py", str(line)] for line in range(6, 11)], done.stdout
