"""Settings by preset or by error, and how many elements a strand needs."""

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
    """The settings of a preset for hair of that natural curvature (with twist, rad/m) and length (m), and frames of frame_time seconds. Give
    them to Solver(settings=...), and element_count to the strands.
    """
    settings = Settings()
    check(functions.shx_settings_from_preset(whole("preset", preset), curvature, length, frame_time, ctypes.byref(settings._c)))
    return settings


def suggest_settings(target_error: float, *, curvature: float, length: float, frame_time: float) -> Settings:
    """The cheapest settings that were measured to err by no more than target_error (root mean square distance of the strand's points from where
    they should be, in units of its length), for hair as in preset_settings.
    """
    settings = Settings()
    check(functions.shx_settings_suggest(target_error, curvature, length, frame_time, ctypes.byref(settings._c)))
    return settings


def suggest_elements(strand: StrandDefs, demand: SuggestDef | None = None, *, motion: Any = None) -> Suggestion:
    """The least number of elements for which a strand (one definition) meets demand.tolerance. motion: frames of the root, demand.motion_interval
    seconds apart, to be judged by; None: judged at rest.
    """
    chosen = SuggestDef() if demand is None else demand.copy()
    frames = None
    if motion is not None:
        frames = np.ascontiguousarray(frame_rows("motion", motion).reshape(-1, 7))
        chosen._c.motion, chosen._c.motion_count = address(frames), len(frames)
    suggestion = Suggestion()
    data = np.ascontiguousarray(strand.data)
    if len(data) != 1:
        raise ValueError(f"strand: {len(data)} definitions; 1 expected")
    check(functions.shx_suggest_elements(address(data), ctypes.byref(chosen._c), ctypes.byref(suggestion._c)))
    return suggestion
