"""Hair in USD: read from and written to .usda, .usdc and .usdz with Pixar's library (pip install "superhelix[usd]").

read_hair and HairStage read BasisCurves and NurbsCurves with their placements, instances and skeletons; HairWriter and write_hair write strands as
BasisCurves; read_deformables and write_deformables exchange curves that other simulators read. docs/guide/usd.md is the guide.
"""

from __future__ import annotations

from superhelix.usd._pxr import UsdError, UsdWarning
from superhelix.usd.deformable import REVISION, DeformableCurves, Stiffness, deformables_from_solver, read_deformables, write_deformables
from superhelix.usd.hair import Hair
from superhelix.usd.read import HairStage, read_hair
from superhelix.usd.skin import SkinMesh, SkinRoots
from superhelix.usd.write import HairWriter, write_hair

__all__ = [
    "REVISION",
    "DeformableCurves",
    "Hair",
    "HairStage",
    "HairWriter",
    "SkinMesh",
    "SkinRoots",
    "Stiffness",
    "UsdError",
    "UsdWarning",
    "deformables_from_solver",
    "read_deformables",
    "read_hair",
    "write_deformables",
    "write_hair",
]
