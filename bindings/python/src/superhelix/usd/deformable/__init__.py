"""Curves ready for simulation, after the deformable body proposal for UsdPhysics (OpenUSD-proposals, pull request 111), which Newton and Isaac Lab read.

The proposal moves. Written is REVISION, of August 2026: thicknesses and masses on the simulation geometry, each with an element type; structural
stiffnesses on the material. The two revisions before it are read too (READ_REVISIONS).
"""

from __future__ import annotations

from superhelix.usd.deformable.model import READ_REVISIONS, REVISION, DeformableCurves, Stiffness
from superhelix.usd.deformable.reading import read_deformables
from superhelix.usd.deformable.strands import deformables_from_solver
from superhelix.usd.deformable.writing import write_deformables

__all__ = ["READ_REVISIONS", "REVISION", "DeformableCurves", "Stiffness", "deformables_from_solver", "read_deformables", "write_deformables"]
