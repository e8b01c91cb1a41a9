"""Choosing settings by preset or by error, and the number of elements."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from superhelix._buffers import address, frame_rows, whole
from superhelix._library import functions
from superhelix.enums import Preset
from superhelix.errors import check
from superhelix.records import Settings, SuggestDef, Suggestion
from superhelix.strand_defs import StrandDefs


def preset_settings(preset: Preset, *, curvature: float, length: float, frame_time: float) -> Settings:
    """Returns the settings of a preset for hair of the given natural curvature (with twist, rad/m) and length (m), and frames of frame_time seconds.
    Pass them to Solver(settings=...), and their element_count to the strands.
    """
    settings = Settings()
    check(functions.shx_settings_from_preset(whole("preset", preset), curvature, length, frame_time, ctypes.byref(settings._c)))
    return settings


def suggest_settings(target_error: float, *, curvature: float, length: float, frame_time: float) -> Settings:
    """Returns the cheapest settings whose measured error is at most target_error (root mean square distance of the strand's points from the exact
    motion, in units of its length), for hair as in preset_settings.
    """
    settings = Settings()
    check(functions.shx_settings_suggest(target_error, curvature, length, frame_time, ctypes.byref(settings._c)))
    return settings


def suggest_elements(strand: StrandDefs, demand: SuggestDef | None = None, *, motion: Any = None) -> Suggestion:
    """Finds the smallest number of elements for which a strand (one definition) meets demand.tolerance, at rest or, with motion, in motion. motion:
    frames of the root, demand.motion_interval seconds apart.
    """
    chosen = SuggestDef() if demand is None else demand.copy()
    frames = None
    if motion is not None:
        frames = np.ascontiguousarray(frame_rows("motion", motion).reshape(-1, 7))
        chosen._c.motion, chosen._c.motion_count = address(frames), len(frames)
    suggestion = Suggestion()
    data = strand._ready(1)
    check(functions.shx_suggest_elements(address(data), ctypes.byref(chosen._c), ctypes.byref(suggestion._c)))
    return suggestion
