"""The three cases: a strand clamped at the origin, let go at rest from its natural shape under gravity along -z, without damping or drag.
Values are those of hair: SI units."""
import math
from dataclasses import asdict, dataclass


@dataclass(frozen=True)
class Case:
    name: str
    title: str
    length: float
    helix_radius: float     # natural shape: a helix about +x through the origin, clamped along its own tangent
    turns: float            # 0: straight
    youngs_modulus: float
    seconds: float          # over which errors are looked at, every 1/60 s
    radius: float = 50e-6
    poisson_ratio: float = 0.48
    density: float = 1300.0
    gravity: float = 9.81

    @property
    def area(self):
        return math.pi * self.radius**2

    @property
    def shear_modulus(self):
        return self.youngs_modulus / (2 * (1 + self.poisson_ratio))

    @property
    def mass(self):
        return self.density * self.area * self.length

    @property
    def frames(self):
        return round(60 * self.seconds)

    def wire(self):
        return asdict(self)


CASES = [
    Case("curl", "one turn of a helix let go", 0.20, 0.015, 1, 2e9, 0.1),
    Case("coil", "a coil of ten turns let go", 0.20, 0.0025, 10, 2e9, 0.1),
    Case("cantilever", "a straight cantilever let go", 0.10, 0.0, 0, 4e9, 0.25),
]


def vertices(case, elements, ghost):
    """elements + 2 points, neighbours length/elements apart: a ghost before the clamp, the clamp, and on to the tip. The ghost's edge
    is `ghost` times as long. A rod of straight edges bends about its points as if over the half edges beside them: with a ghost as long as
    an edge it is clamped half an edge before the origin, and errs at first order; with a short one it is clamped along the helix's
    tangent at the origin, and errs at second."""
    edge = case.length / elements
    angle = 2 * math.pi * case.turns / elements
    rise = math.sqrt(edge * edge - (2 * case.helix_radius * math.sin(angle / 2)) ** 2)

    def at(i):
        return (rise * i, case.helix_radius * (math.cos(angle * i) - 1), case.helix_radius * math.sin(angle * i))
    return [at(-ghost)] + [at(i) for i in range(elements + 1)]
