"""Deformable curves from the strands of a solver."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from superhelix import frames as turned
from superhelix.solver import Solver
from superhelix.strand_defs import StrandDefs
from superhelix.usd.curves.bases import Numbers
from superhelix.usd.deformable.model import SHEAR_FACTOR, DeformableCurves

if TYPE_CHECKING:
    from superhelix.solver._base import StrandsLike


def deformables_from_solver(
    solver: Solver, ids: StrandsLike = None, *, points_per_strand: int = 16, levels: int = 8, name: str = "strands", attach_roots: bool = True
) -> list[DeformableCurves]:
    """Makes curves of a solver's strands: state, velocities, material frames, and as rest shape the natural one, with their roots where they are now.

    A prim has one material, so strands are put together by bending stiffness: at most levels prims of equal steps on a logarithmic scale, each with
    the geometric mean; stiffness_error says how far a strand is from it. attach_roots: the first two points of each curve are attached to the head,
    which holds the root's direction too. An elliptic section becomes the circle of the same area, with the mean of both bending stiffnesses.
    """
    if not 2 <= points_per_strand <= 100_000:
        raise ValueError(f"points_per_strand: {points_per_strand}; 2 to 100000 expected")
    if not 1 <= levels <= 10_000:
        raise ValueError(f"levels: {levels}; 1 to 10000 expected")
    chosen = solver.strand_ids() if ids is None else ids
    strands = list(chosen)  # type: ignore[arg-type]
    if not strands:
        raise ValueError("ids: no strands; at least one expected")
    count = len(strands)
    now = _state(solver, chosen, points_per_strand)
    velocities = solver.sample_velocities(points_per_strand, chosen)
    rest = _rest_state(solver, chosen, points_per_strand)
    materials = [solver.material(strand) for strand in strands]
    radius = np.array([material.radius for material in materials], dtype=np.float64)
    modulus = np.array([material.youngs_modulus for material in materials])
    ratio = np.array([material.poisson_ratio for material in materials])
    density = np.array([material.density for material in materials])
    first, second = radius[:, 0], radius[:, 1]
    area = np.pi * first * second
    shear = modulus / (2.0 * (1.0 + ratio))
    bend = modulus * np.pi * first * second * (first**2 + second**2) / 8.0
    stiffness = {
        "stretch": modulus * area,
        "shear": SHEAR_FACTOR * shear * area,
        "bend": bend,
        "twist": shear * np.pi * first**3 * second**3 / (first**2 + second**2),
    }
    low, high = float(np.log(bend.min())), float(np.log(bend.max()))
    level = np.zeros(count, dtype=np.int64) if high - low < 1e-9 else np.minimum(((np.log(bend) - low) / (high - low) * levels).astype(np.int64), levels - 1)
    # Strands of another density or ratio have another material too.
    other = np.unique(np.stack([density, ratio]), axis=1, return_inverse=True)[1].reshape(-1)
    kinds = np.stack([level, other])
    keys = np.unique(kinds, axis=1)
    made: list[DeformableCurves] = []
    for key in keys.T:
        own = np.flatnonzero((kinds == key[:, None]).all(axis=0))
        mean = {mode: float(np.exp(np.log(values[own]).mean())) for mode, values in stiffness.items()}
        thickness = 2.0 * np.sqrt(first[own] * second[own])
        starts = np.arange(len(own)) * points_per_strand
        made.append(
            DeformableCurves(
                now[0][own].reshape(-1, 3),
                np.full(len(own), points_per_strand, dtype=np.uint32),
                now[1][own].reshape(-1, 3),
                velocities[own].reshape(-1, 3),
                rest[0][own].reshape(-1, 3),
                rest[1][own].reshape(-1, 3),
                thickness[:1] if np.ptp(thickness) == 0.0 else thickness,
                "constant" if np.ptp(thickness) == 0.0 else "curve",
                density=float(density[own[0]]),
                youngs_modulus=float(np.exp(np.log(modulus[own]).mean())),
                poissons_ratio=float(ratio[own[0]]),
                stretch_stiffness=mean["stretch"],
                shear_stiffness=mean["shear"],
                bend_stiffness=mean["bend"],
                twist_stiffness=mean["twist"],
                attached=np.stack([starts, starts + 1], axis=1).reshape(-1) if attach_roots else None,
                name=name if keys.shape[1] == 1 else f"{name}_{len(made)}",
                stiffness_error=float(np.max(np.abs(bend[own] / mean["bend"] - 1.0))),
                strands=own,
            )
        )
    return made


def _state(solver: Solver, ids: StrandsLike, count: int) -> tuple[Numbers, Numbers]:
    """Points, and at each the normal in the middle of the segment after it."""
    fine = solver.sample_frames(2 * count - 1, ids)
    normals = turned.rotate(fine[..., 3:], (0.0, 1.0, 0.0))
    return fine[:, ::2, :3], np.concatenate([normals[:, 1::2], normals[:, -1:]], axis=1)


def _rest_state(solver: Solver, ids: StrandsLike, count: int) -> tuple[Numbers, Numbers]:
    """The same of the strands in their natural shapes."""
    chosen = solver.strand_ids() if ids is None else ids
    roots = solver.root_frames(ids)
    lengths, curvatures, counts = [], [], []
    for strand in list(chosen):  # type: ignore[arg-type]
        lengths.append(solver.element_lengths(strand))
        curvatures.append(solver.natural_curvatures(strand))
        counts.append(len(lengths[-1]))
    shapes = np.concatenate(curvatures)
    with Solver() as other:
        other.add_strands(
            StrandDefs(
                len(counts), element_count=counts, element_lengths=np.concatenate(lengths), natural_curvatures=shapes, initial_curvatures=shapes, root=roots
            )
        )
        return _state(other, None, count)
