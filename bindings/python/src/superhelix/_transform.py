"""Matrices from the library's space to the host's."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
import numpy.typing as npt


def put_transform(structure: Any, transform: npt.ArrayLike | None) -> None:
    """Sets the axes and the translation of a shx_sample_def or a shx_render_view to those of a matrix of 3x3, 3x4 or 4x4 numbers that acts on columns."""
    if transform is None:
        return
    matrix: npt.NDArray[np.float64] = np.asarray(transform, dtype=np.float64)
    if matrix.shape not in ((3, 3), (3, 4), (4, 4)):
        raise ValueError(f"transform: shape {matrix.shape}; (3, 3), (3, 4) or (4, 4) expected")
    if len(matrix) == 4 and not np.array_equal(matrix[3], [0.0, 0.0, 0.0, 1.0]):
        raise ValueError(f"transform: last row {matrix[3]}; 0, 0, 0, 1 expected")
    three = ctypes.c_double * 3
    structure.x_axis, structure.y_axis, structure.z_axis = (three(*matrix[:3, axis]) for axis in range(3))
    if matrix.size > 9:
        structure.translation = three(*matrix[:3, 3])
