"""Meshes of heads from files."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from superhelix.curves import Path


def read_obj_mesh(path: Path, scale: float = 1.0) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.uint32]]:
    """Reads vertices (times scale: metres per file unit) and triangles of a Wavefront .obj with faces, for BodyDef.mesh, bake_distance_grid and Scalp.
    Faces of more than three corners are split into fans: they should be convex.
    """
    vertices: list[list[float]] = []
    triangles: list[tuple[int, int, int]] = []
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            words = line.split()
            if not words or words[0] not in ("v", "f"):
                continue
            try:
                if words[0] == "v":
                    vertices.append([float(word) for word in words[1:4]])
                    continue
                corners = [int(word.split("/")[0]) for word in words[1:]]
                corners = [corner - 1 if corner > 0 else len(vertices) + corner for corner in corners]
            except ValueError as error:
                raise ValueError(f"{path}:{number}: {error}") from None
            if len(corners) < 3 or not all(0 <= corner < len(vertices) for corner in corners):
                raise ValueError(f"{path}:{number}: a face whose corners are not there")
            triangles += [(corners[0], corners[place], corners[place + 1]) for place in range(1, len(corners) - 1)]
    return np.array(vertices, dtype=np.float64).reshape(-1, 3) * scale, np.array(triangles, dtype=np.uint32).reshape(-1, 3)
