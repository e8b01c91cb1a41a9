"""The settings of each program in each case: its own options, numbers of elements, steps per second."""
from itertools import product

RATES = [30, 60, 120, 180, 240, 360, 480, 720, 960, 1440, 1920, 3840, 7680]
FEW = {"curl": [3, 4, 5, 6, 7, 8, 10, 12, 15, 20, 30, 40, 60], "coil": [10, 15, 20, 30, 40, 50, 60, 80, 100, 120, 150, 200],
       "cantilever": [2, 3, 4, 5, 6, 7, 8, 10, 12, 15, 20, 30, 40]}
# Explicit steps are stable at these or not at all; the first that is counts.
EXPLICIT_RATES = [1920 * 2**k for k in range(8)]
EXPLICIT_FEW = {"curl": [5, 7, 10, 15, 20, 30, 40], "coil": [30, 50, 80, 120, 160], "cantilever": [3, 5, 7, 10, 15, 20, 30]}
# Clamped along the tangent at the origin, and half an edge before it (cases.vertices): the first is better, the second what one does at first.
AT_THE_ORIGIN, BEFORE = 0.01, 1.0


def ours():
    for tolerance in (1e-1, 1e-2, 1e-3):
        yield {"integrator": "second order", "tolerance": tolerance, "cap": 50}
    yield {"integrator": "second order", "tolerance": 1e-3, "cap": 1}
    for error in (1e-2, 3e-3, 1e-3):
        yield {"integrator": "second order", "tolerance": 1e-2, "cap": 50, "error_tolerance": error}
    yield {"integrator": "implicit Euler", "tolerance": 1e-2, "cap": 50}
    yield {"integrator": "linearly implicit"}


def pypbd():
    for iterations in (1, 2):
        yield {"iterations": iterations, "ghost": AT_THE_ORIGIN}
    yield {"iterations": 1, "ghost": BEFORE}


def mujoco(elements):
    yield {"jacobian": "sparse", "ghost": AT_THE_ORIGIN}
    if elements <= 20:
        yield {"jacobian": "dense", "ghost": AT_THE_ORIGIN}
    yield {"jacobian": "sparse", "ghost": BEFORE}


def pyelastica():
    for soft, inertia in [(1e-2, 1e4), *product([1e-3, 3e-4, 1e-4], [400.0, 1e4]), (1e-4, 1.0)]:
        yield {"soft": soft, "inertia": inertia, "ghost": 0.05}


def grid(case, quick):
    """(program, elements, settings, rates, explicit) to try; explicit: up the rates until one holds."""
    def thinned(values):
        return values[1::3] if quick else values
    rates = thinned(RATES)
    for elements in thinned(FEW[case.name]):
        for settings in ours():
            # Beyond, second order errs by less than anybody asks for.
            yield "superhelix", elements, settings, [rate for rate in rates if rate <= 3840], False
        for settings in pypbd():
            yield "pyPBD", elements, settings, rates, False
        for settings in mujoco(elements):
            yield "MuJoCo", elements, settings, rates, False
    for elements in thinned(EXPLICIT_FEW[case.name]):
        for settings in pyelastica():
            yield "PyElastica", elements, settings, EXPLICIT_RATES, True


# What each is at its ordinary best: for the largest stable step and for many strands.
ORDINARY = {
    "superhelix": {"integrator": "second order", "tolerance": 1e-3, "cap": 50},
    "pyPBD": {"iterations": 1, "ghost": AT_THE_ORIGIN},
    "MuJoCo": {"jacobian": "sparse", "ghost": AT_THE_ORIGIN},
    "PyElastica": {"soft": 1e-3, "inertia": 400.0, "ghost": 0.05},
}
# A realistic hair: only its stable step is measured.
UNCHANGED = {"soft": 1.0, "inertia": 1.0, "ghost": 0.05}
STABLE_ELEMENTS = {"curl": 20, "coil": 80, "cantilever": 10}
STABLE_RATES = [10, 15, 20, 30, 60, 120, 180, 240, 360, 480, 960, 1920, 3840, 7680, 15360, 30720, 61440, 122880, 245760]
# Strands in a world for "many": sixteen are as cheap as they get in pyPBD and PyElastica (their caches hold them), and leave room for
# packs of the engine's that are sixteen wide four times. MuJoCo takes several times as long for many in one world as for one after another.
MANY = {"superhelix": 64, "pyPBD": 16, "PyElastica": 16}
STRANDS = [1, 4, 16, 64, 256, 1000]
