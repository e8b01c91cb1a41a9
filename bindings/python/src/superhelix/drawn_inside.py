"""The warning of curves that are drawn inside a body."""

from __future__ import annotations

import os
import sys
import warnings
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from superhelix.solver.contact import PushedOut

# What counts as inside a body, m: roots lie in the skin, and a grid rounds off what is finer than its cells.
_INSIDE = 2e-3


class DrawnInsideWarning(UserWarning):
    """Curves of a groom are drawn inside the body: they are pushed out of it, or stay inside."""


def warn_of(pushed: PushedOut) -> None:
    """Warns of curves that had to be moved out of a body, or stay inside, where code outside of this package called it."""
    moved, stuck = float(pushed.displacements.max(initial=0.0)), int(pushed.stuck.sum())
    if moved <= _INSIDE and not stuck:
        return
    inside, deepest = int((pushed.depths > 0.0).sum()), float(pushed.depths.max())
    text = f"{inside} of {len(pushed.depths)} curves are drawn up to {1e3 * deepest:.1f} mm inside the body"
    if moved > 0.0:
        text += f", and pushed out of it by up to {1e3 * moved:.1f} mm"
    if stuck:
        text += f"; no way out was found for {stuck} of them"
    package = os.path.dirname(__file__) + os.sep
    level, frame = 1, sys._getframe()
    while frame.f_code.co_filename.startswith(package) and (above := frame.f_back) is not None:
        level, frame = level + 1, above
    warnings.warn(f"{text}. push_out=False leaves all as drawn", DrawnInsideWarning, stacklevel=level)
