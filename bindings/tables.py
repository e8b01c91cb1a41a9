"""What the C interface's description lacks, for the generators of C++ and C#: which arrays of a structure share a count, and what their items are.

A count with a point is that of a view and is set with it. Items: a C type, or one of "curvature" (three doubles), "triangle" (three indices), "frame",
"float2", "float3", "double6".
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

#: An item of api.json.
Item = dict[str, Any]

API: Item = json.loads((Path(__file__).resolve().parent / "api.json").read_text(encoding="utf-8"))
STRUCTS: dict[str, Item] = {struct["name"]: struct for struct in API["structs"]}

ARRAYS: dict[str, dict[str, dict[str, str]]] = {
    "shx_strand_def": {
        "element_count": {
            "element_lengths": "double",
            "natural_curvatures": "curvature",
            "initial_curvatures": "curvature",
            "initial_rates": "curvature",
        }
    },
    "shx_pose_options": {"movable_count": {"movable": "uint8_t"}},
    "shx_body_def": {"triangle_count": {"triangles": "triangle"}, "grid_size": {"grid": "uint8_t"}},
    "shx_fit_input": {
        "curve_count": {"point_counts": "uint32_t"},
        "points.count": {"arclengths": "double", "widths": "double"},
    },
    "shx_curve_data": {
        "strand_count": {"point_counts": "uint32_t", "strand_thickness": "float", "strand_uvs": "float2"},
        "points.count": {"thickness": "float", "transparency": "float", "colors": "float3", "pinned": "uint8_t"},
    },
    "shx_friction_fit_def": {"root_count": {"root_times": "double", "root_frames": "frame"}},
    "shx_suggest_def": {"motion_count": {"motion": "frame"}},
    "shx_scalp_def": {"triangle_count": {"triangles": "triangle", "uvs": "double6"}},
    "shx_distance_grid_def": {"triangle_count": {"triangles": "triangle"}},
    "shx_push_out_def": {"curve_count": {"point_counts": "uint32_t"}},
    "shx_target_def": {
        "curve_count": {"point_counts": "uint32_t", "strand_weights": "double"},
        "points.count": {"arclengths": "double"},
        "weight_count": {"weight_positions": "double", "weights": "double"},
    },
    "shx_render_guides": {"guide_count": {"point_counts": "uint32_t"}},
    "shx_restore_def": {"shapes_size": {"shapes": "uint8_t"}},
}

# Structures that calls fill in.
OUTPUTS = {"shx_step_report", "shx_settle_report", "shx_friction_fit_report", "shx_polyline_fit", "shx_suggestion"}

# Fields of an enumeration whose text does not name its prefix alone.
PREFIXES = {
    ("shx_solver_def", "log_level"): "SHX_LOG_",
    ("shx_constraint_def", "kind"): "SHX_CONSTRAINT_",
    ("shx_spline_def", "kind"): "SHX_SPLINE_",
    ("shx_tool_def", "kind"): "SHX_TOOL_",
    ("shx_clip_def", "kind"): "SHX_CONSTRAINT_",
    ("shx_heat_def", "shape"): "SHX_HEAT_",
    ("shx_friction_fit_def", "coefficients"): "SHX_FRICTION_",
}

# Numbers that say yes or no, whose text does not begin with one of them.
BOOLS = {("shx_suggestion", "meets_tolerance")}


def enumeration_of(struct: str, field: Item) -> Item | None:
    """The enumeration that a field's numbers are of: its text names the prefix."""
    if field["type"]["name"] != "uint32_t" or field["type"]["pointer"]:
        return None
    prefix = PREFIXES.get((struct, field["name"]))
    named = [
        enumeration for enumeration in API["enumerations"] if enumeration["name"] == prefix or re.search(rf"\b{enumeration['name']}(?![A-Z0-9])", field["doc"])
    ]
    return named[0] if named else None


def is_bool(struct: str, field: Item) -> bool:
    """Whether a number says yes or no."""
    if (struct, field["name"]) in BOOLS:
        return True
    kind = field["type"]
    return kind["name"] == "uint32_t" and not kind["pointer"] and re.match(r"[01]( \(default\))?:", field["doc"]) is not None


def group_of(struct: str, name: str) -> tuple[str, dict[str, str]] | None:
    """The count and the arrays of the group that an array belongs to."""
    for count, arrays in ARRAYS.get(struct, {}).items():
        if name in arrays:
            return count, arrays
    return None


def is_reserved(field: Item) -> bool:
    """Whether a field is room for later versions."""
    return str(field["name"]).startswith("reserved")


def differences(by_hand: dict[str, set[str]]) -> list[str]:
    """Where the tables and the description differ. by_hand: fields of structures that a generator's own tables know."""
    fields = {name: {field["name"] for field in struct["fields"]} for name, struct in STRUCTS.items()}
    wrong = [name for name in [*OUTPUTS, *ARRAYS, *by_hand] if name not in STRUCTS]
    for name, groups in ARRAYS.items():
        for count, arrays in groups.items():
            wrong += [f"{name}.{field}" for field in [count.split(".")[0], *arrays] if field not in fields.get(name, set())]
    wrong += [f"{name}.{field}" for name, known in by_hand.items() for field in known if field not in fields.get(name, set())]
    for name, struct in STRUCTS.items():
        for field in struct["fields"]:
            plain_pointer = field["type"]["pointer"] and not field["type"]["name"].startswith("shx_")
            if plain_pointer and name not in OUTPUTS and not group_of(name, field["name"]) and field["name"] not in by_hand.get(name, set()):
                wrong.append(f"{name}.{field['name']} is a pointer that no table knows")
    return wrong
