"""Pictures of strands with matplotlib: pip install superhelix[plot]."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from superhelix.solver import Solver


def plot_curves(
    points: npt.ArrayLike,
    *,
    ax: Axes | None = None,
    colors: Any = None,
    linewidth: float = 0.8,
    up: str = "z",
    **style: Any,
) -> Axes:
    """Draws curves, (curves, points, 3) in m, as lines with equal scales along the axes, shaded from root to tip. colors: one for all, or one for
    each curve (default: by its number). up: the axis that points up, "y" or "z". style goes to mpl_toolkits.mplot3d.art3d.Line3DCollection.
    """
    import matplotlib.pyplot as plt
    from matplotlib.colors import to_rgb
    from mpl_toolkits.mplot3d.art3d import Line3DCollection

    rows = np.asarray(points, dtype=np.float64)
    if rows.ndim != 3 or rows.shape[-1] != 3 or rows.shape[1] < 2:
        raise ValueError(f"points: shape {rows.shape}; (curves, points, 3) expected")
    if up not in ("y", "z"):
        raise ValueError(f"up: {up!r}; 'y' or 'z' expected")
    if up == "y":
        # Right-handed: y up becomes z up, z towards the viewer becomes -y.
        rows = np.stack([rows[..., 0], -rows[..., 2], rows[..., 1]], axis=-1)
    if ax is None:
        ax = plt.figure(figsize=(5, 5)).add_subplot(projection="3d")
    if colors is None:
        base = plt.get_cmap("copper")(np.linspace(0.3, 0.9, max(len(rows), 1)))[:, :3]
    elif isinstance(colors, str):
        base = np.tile(to_rgb(colors), (len(rows), 1))
    else:
        base = np.array([to_rgb(color) for color in colors])
        if len(base) != len(rows):
            raise ValueError(f"colors: {len(base)} colours; {len(rows)} expected")
    edges = rows.shape[1] - 1
    shade = np.linspace(0.55, 1.0, edges)[None, :, None]
    tints = np.clip(base[:, None, :] * shade, 0.0, 1.0).reshape(-1, 3)
    segments = np.stack([rows[:, :-1], rows[:, 1:]], axis=2).reshape(-1, 2, 3)
    ax.add_collection(Line3DCollection(segments, colors=tints, linewidths=linewidth, **style))
    if len(rows):
        _fit_axes(ax, rows.reshape(-1, 3))
    ax.set_xlabel("x, m")
    ax.set_ylabel("-z, m" if up == "y" else "y, m")
    # mplot3d's axes have a third label that the type of plain axes does not know.
    getattr(ax, "set_zlabel")("y, m" if up == "y" else "z, m")  # noqa: B009
    return ax


def _fit_axes(ax: Any, points: npt.NDArray[np.float64]) -> None:
    """Equal scales, with all points in view, also those that the axes hold already."""
    low, high = points.min(axis=0), points.max(axis=0)
    if getattr(ax, "_superhelix_bounds", None) is not None:
        before = ax._superhelix_bounds
        low, high = np.minimum(low, before[0]), np.maximum(high, before[1])
    ax._superhelix_bounds = (low, high)
    middle, half = (low + high) / 2, max(float((high - low).max()) / 2, 1e-6) * 1.02
    ax.set_xlim(middle[0] - half, middle[0] + half)
    ax.set_ylim(middle[1] - half, middle[1] + half)
    ax.set_zlim(middle[2] - half, middle[2] + half)
    ax.set_box_aspect((1, 1, 1), zoom=1.1)
    ax.locator_params(nbins=4)


def plot_solver(solver: Solver, ids: Any = None, *, points_per_strand: int = 24, ax: Axes | None = None, **style: Any) -> Axes:
    """Draws a solver's strands as they are now; style as in plot_curves. Up is against gravity only if you say so: up="y"."""
    return plot_curves(solver.sample_strands(points_per_strand, ids, dtype=np.float64), ax=ax, **style)
