"""superhelix: a hair engine. Strands are Super-Helices: inextensible rods of helical elements, simulated robustly at large time steps.

Units are SI (m, kg, s, N, Pa), curvature and twist in rad/m, axes right-handed. Gravity is (0, 0, -9.81) unless you say otherwise. A frame
is a row of seven float64: origin, and unit quaternion x, y, z, w (superhelix.frames makes them). Points go in and out as numpy arrays, float32
or float64, without copies. Errors are SuperhelixError and its subclasses, with the library's text. docs/guide/python.md is the guide.
"""

from __future__ import annotations

from superhelix import enums, errors, frames, groom, records
from superhelix._callbacks import Run, log_to_logging, parallel_for_on, set_allocator
from superhelix._library import abi_version, build_info, version
from superhelix.attachments import Attachment
from superhelix.bodies import BodyDef, bake_distance_grid
from superhelix.curves import CurveCache, CurveCacheWriter, CurveData, Curves, write_curves
from superhelix.drawn_inside import DrawnInsideWarning
from superhelix.enums import *  # noqa: F403
from superhelix.errors import *  # noqa: F403
from superhelix.fit import Fit, fit_polyline, fit_strands, sag_free_curvatures, spline_points
from superhelix.friction import fit_friction
from superhelix.groom import Groom, prepare, simulate
from superhelix.hair import hair_strands, hair_type, wisp_material
from superhelix.haptics import Haptic
from superhelix.ids import BodyId, BodyIds, ConstraintId, ConstraintIds, StrandId, StrandIds
from superhelix.interpolation import interpolate
from superhelix.meshes import read_obj_mesh
from superhelix.motion import SmoothMotion, carried, motion_from_samples, read_motion
from superhelix.records import *  # noqa: F403
from superhelix.render import RenderGuides, RenderHair, RenderPose
from superhelix.scalp import Scalp
from superhelix.settings import preset_settings, suggest_elements, suggest_settings
from superhelix.solver import Cancel, Solver
from superhelix.strand_defs import StrandDefs
from superhelix.styling import (
    RingComb,
    adjust_hair_handle,
    hair_handle,
    hair_handle_type,
    run_combing_test,
    tool_frames,
    tool_hot_box,
)

__version__ = version()

__all__ = [
    "Attachment",
    "BodyDef",
    "BodyId",
    "BodyIds",
    "Cancel",
    "ConstraintId",
    "ConstraintIds",
    "CurveCache",
    "CurveCacheWriter",
    "CurveData",
    "Curves",
    "DrawnInsideWarning",
    "Fit",
    "Groom",
    "Haptic",
    "RenderGuides",
    "RenderHair",
    "RenderPose",
    "RingComb",
    "Run",
    "Scalp",
    "SmoothMotion",
    "Solver",
    "StrandDefs",
    "StrandId",
    "StrandIds",
    "abi_version",
    "adjust_hair_handle",
    "bake_distance_grid",
    "build_info",
    "carried",
    "enums",
    "errors",
    "fit_friction",
    "fit_polyline",
    "fit_strands",
    "frames",
    "groom",
    "hair_handle",
    "hair_handle_type",
    "hair_strands",
    "hair_type",
    "interpolate",
    "log_to_logging",
    "motion_from_samples",
    "parallel_for_on",
    "prepare",
    "preset_settings",
    "read_motion",
    "read_obj_mesh",
    "records",
    "run_combing_test",
    "sag_free_curvatures",
    "set_allocator",
    "simulate",
    "spline_points",
    "suggest_elements",
    "suggest_settings",
    "tool_frames",
    "tool_hot_box",
    "version",
    "wisp_material",
    "write_curves",
    *enums.__all__,
    *errors.__all__,
    *records.__all__,
]
