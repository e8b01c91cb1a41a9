#!/usr/bin/env python3
"""Generates the low-level layer of the Python binding from the API description.

    python3 bindings/python/generate.py           write src/superhelix/_capi.py, enums.py, records.py
    python3 bindings/python/generate.py --check   fail if they are not what bindings/api.json says

_capi.py has the C API as ctypes sees it. enums.py has the constants. records.py has a class for each structure of plain data: options and
reports (a Record: one structure, attributes with types and documentation) and arrays that functions write (a Table: a column a field).
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import api as description  # noqa: E402
from api import Field, Struct, Type  # noqa: E402

WIDTH = 132
# Lines that the formatter does not break.
LONGEST = 160

CTYPES = {
    "bool": "ctypes.c_bool",
    "char": "ctypes.c_char",
    "int8_t": "ctypes.c_int8",
    "uint8_t": "ctypes.c_uint8",
    "int16_t": "ctypes.c_int16",
    "uint16_t": "ctypes.c_uint16",
    "int32_t": "ctypes.c_int32",
    "uint32_t": "ctypes.c_uint32",
    "int64_t": "ctypes.c_int64",
    "uint64_t": "ctypes.c_uint64",
    "size_t": "ctypes.c_size_t",
    "float": "ctypes.c_float",
    "double": "ctypes.c_double",
}

# Enumerations whose prefix alone is no good name for a class.
ENUM_NAMES = {
    "SHX_LOG_": "LogLevel",
    "SHX_STOP_": "StopReason",
    "SHX_CONTACT_": "ContactModel",
    "SHX_CONTACT_EVENT_": "ContactEventKind",
    "SHX_CONSTRAINT_": "ConstraintKind",
    "SHX_SPLINE_": "SplineKind",
    "SHX_FRICTION_": "FrictionCoefficient",
    "SHX_COEFFICIENT_": "CoefficientStatus",
    "SHX_STRAND_": "StrandStatus",
    "SHX_DOF_": "Dofs",
    "SHX_DEBUG_": "DebugLayers",
    "SHX_ERROR_": "ErrorCode",
}

# What functions write many of: a Table.
TABLES = ("shx_contact", "shx_contact_event", "shx_constraint_state", "shx_debug_vertex", "shx_fitted_strand", "shx_hair_strand", "shx_follicle")

# Structures that the hand-written layer takes apart itself.
NOT_RECORDS = (
    "shx_input",
    "shx_output",
    "shx_strand_id",
    "shx_body_id",
    "shx_constraint_id",
    "shx_strand_def",
    "shx_step_limits",
    "shx_sample_def",
    "shx_fit_input",
    "shx_spline_def",
    "shx_curve_data",
    "shx_scalp_def",
    "shx_scatter_def",
    "shx_render_guides",
    "shx_render_view",
    "shx_distance_grid_def",
    "shx_push_out_def",
    "shx_target_def",
    "shx_hair_strands_def",
    "shx_snapshot_def",
    "shx_restore_def",
    "shx_debug_draw_def",
)

# Fields that say how long an array is that another field points to, by structure: set by the layer above together with the array.
COUNTS = {
    "shx_pose_options": ("movable_count",),
    "shx_body_def": ("triangle_count", "grid_size"),
    "shx_friction_fit_def": ("root_count",),
    "shx_suggest_def": ("motion_count",),
}

# What Python calls functions that are not the solver's, where comments speak of them.
FUNCTION_NAMES = {
    "shx_distance_grid_bake": "bake_distance_grid",
    "shx_last_error": "errors.last_error",
    "shx_render_pose_evaluate": "RenderPose.evaluate",
    "shx_suggest_elements": "suggest_elements",
}

IDS = {"shx_strand_id": "StrandId", "shx_body_id": "BodyId", "shx_constraint_id": "ConstraintId"}


def camel(name: str) -> str:
    """shx_step_report as StepReport."""
    return "".join(word.capitalize() for word in name.removeprefix("shx_").split("_"))


def enum_name(prefix: str) -> str:
    """The class of an enumeration."""
    return ENUM_NAMES.get(prefix) or camel(prefix.removeprefix("SHX_").lower().rstrip("_"))


def member_name(constant: str, prefix: str) -> str:
    """A constant's name within its class."""
    name = constant.removeprefix(prefix)
    return f"N{name}" if name[0].isdigit() else name


class Generator:
    """Holds the model and writes the three files."""

    def __init__(self) -> None:
        self.api = description.parse()
        self.enumerations = {enumeration.name: enumeration for enumeration in self.api.enumerations}
        self.structs = {struct.name: struct for struct in self.api.structs}
        self.callbacks = {callback.name for callback in self.api.callbacks}
        self.aliases = {alias.name: alias.type for alias in self.api.aliases}
        self.constants = {constant.name: constant for constant in self.api.constants}
        stale = [name for name in (*TABLES, *NOT_RECORDS, *COUNTS) if name not in self.structs]
        stale += [prefix for prefix in ENUM_NAMES if prefix not in self.enumerations]
        stale += [
            f"{struct}.{name}"
            for struct, names in COUNTS.items()
            if struct in self.structs
            for name in names
            if name not in {member.name for member in self.structs[struct].fields}
        ]
        if stale:
            raise SystemExit(f"generate.py names what the header has not: {stale}")

    # ---- documentation ----

    def python_words(self, text: str) -> str:
        """A comment with C's names made Python's."""

        def function(match: re.Match[str]) -> str:
            name = match[0]
            if name in self.structs:
                return "StrandDefs" if name == "shx_strand_def" else IDS.get(name) or camel(name)
            if name.startswith("shx_solver_"):
                return "Solver." + name.removeprefix("shx_solver_")
            return FUNCTION_NAMES.get(name, "Solver" if name == "shx_solver" else name)

        def constant(match: re.Match[str]) -> str:
            name = match[0]
            if name in self.constants and self.constants[name].enumeration:
                prefix = str(self.constants[name].enumeration)
                return f"{enum_name(prefix)}.{member_name(name, prefix)}"
            return enum_name(name) if name in self.enumerations else name

        text = re.sub(r"\bshx_\w+", function, text)
        text = re.sub(r"\bSHX_\w+", constant, text)
        # "Shape.BOX, _HULL or _MESH" lists members by their endings.
        text = re.sub(r"(?<=[ (])_([A-Z][A-Z0-9_]+)\b", r"\1", text)
        return text.replace("\\", "\\\\").replace('"""', "'''")

    def doc(self, text: str, indent: str, end: str = "") -> list[str]:
        """A docstring, wrapped."""
        text = re.sub(r"(?:Fill|Prepare|Filled|Prepared) (?:it )?(?:with|by) \w+_init[^.;]*[.;] ?", "", " ".join(text.split()))
        text = self.python_words(text).strip()
        if not text:
            text = "See the C header."
        if not text.endswith((".", "!", "?", ")")):
            text += "."
        words, lines, line = text.split(" "), [], indent + '"""'
        fresh = True
        for word in words:
            if not fresh and len(line) + 1 + len(word) > WIDTH:
                lines.append(line)
                line, fresh = indent, True
            line += word if fresh else " " + word
            fresh = False
        if len(line) + 3 > WIDTH:
            lines.append(line)
            line = indent
        return [*lines, line + '"""' + end]

    @staticmethod
    def header(what: str) -> list[str]:
        """How a generated file begins."""
        return [f'"""{what}', "", "Generated by bindings/python/generate.py from include/superhelix.h: do not edit.", '"""', ""]

    # ---- _capi.py ----

    def ctype(self, kind: Type, array: int = 0) -> str:
        """A type for a field or parameter. All pointers are void pointers: the layer above passes addresses."""
        if kind.pointer or kind.name in self.callbacks or (kind.name not in CTYPES and kind.name not in self.structs and kind.name not in self.aliases):
            return "ctypes.c_void_p"
        name = self.aliases.get(kind.name, kind.name)
        base = CTYPES.get(name, name)
        return f"{base} * {array}" if array else base

    def python_type(self, kind: Type, array: int = 0) -> str:
        """The type of an argument or result of the C API, for the type checker."""
        if kind.pointer or array or kind.name in self.callbacks:
            return "Pointer"
        if kind.name in self.structs:
            return kind.name
        name = self.aliases.get(kind.name, kind.name)
        return {"bool": "bool", "float": "float", "double": "float", "void": "None"}.get(name, "int")

    def ordered_structs(self) -> list[Struct]:
        """Structures, those that others hold first."""
        done: dict[str, Struct] = {}

        def visit(struct: Struct) -> None:
            for member in struct.fields:
                if not member.type.pointer and member.type.name in self.structs and member.type.name not in done:
                    visit(self.structs[member.type.name])
            done[struct.name] = struct

        for struct in self.api.structs:
            if struct.name not in done:
                visit(struct)
        return list(done.values())

    def capi(self) -> str:
        """The C API for ctypes."""
        lines = self.header("The C API as ctypes sees it: constants, structures, functions.")
        lines += ["from __future__ import annotations", "", "import ctypes", "from collections.abc import Callable"]
        lines += ["from typing import Any", "", "#: What ctypes takes for a pointer: an address, None, byref(...), an array, a Handle.", "Pointer = Any", ""]
        for constant in self.api.constants:
            lines.append(f"{constant.name} = {constant.value}")
        for struct in self.ordered_structs():
            lines += ["", "", f"class {struct.name}(ctypes.Structure):"]
            # Slots: a name that is no field is an error, not a new attribute. kept holds what a pointer points to.
            lines += [f'    """{struct.size} bytes."""', "", '    __slots__ = ("kept",)', "    _fields_ = ["]
            for member in struct.fields:
                lines.append(f'        ("{member.name}", {self.ctype(member.type, member.array)}),')
            lines.append("    ]")
        for callback in self.api.callbacks:
            result = "None" if callback.returns == Type("void") else self.ctype(callback.returns)
            text = Type("char", True, 1)
            arguments = ["ctypes.c_char_p" if parameter.type == text else self.ctype(parameter.type) for parameter in callback.parameters]
            lines += ["", f"{callback.name} = ctypes.CFUNCTYPE({', '.join([result, *arguments])})"]
        lines += ["", "", "class Functions:", '    """The functions of a loaded library, with their C types set."""', ""]
        for function in self.api.functions:
            result = "bytes" if function.returns == Type("char", True, 1) else self.python_type(function.returns)
            parameters = ", ".join(self.python_type(parameter.type, parameter.array) for parameter in function.parameters)
            line = f"    {function.name}: Callable[[{parameters}], {result}]"
            if len(line) > WIDTH:
                line = f"    {function.name}: Callable[\n        [{parameters}], {result}\n    ]"
            lines.append(line)
        lines += ["", "    def __init__(self, library: ctypes.CDLL) -> None:"]
        lines += ["        for name, (result, parameters) in SIGNATURES.items():", "            function = getattr(library, name)"]
        lines += ["            function.restype = result", "            function.argtypes = parameters", "            setattr(self, name, function)"]
        lines += ["", "", "#: Each function's result and parameters.", "SIGNATURES: dict[str, tuple[Any, list[Any]]] = {"]
        for function in self.api.functions:
            result = "None" if function.returns == Type("void") else self.ctype(function.returns)
            if function.returns == Type("char", True, 1):
                result = "ctypes.c_char_p"
            ctypes = ["ctypes.c_void_p" if parameter.array else self.ctype(parameter.type) for parameter in function.parameters]
            line = f'    "{function.name}": ({result}, [{", ".join(ctypes)}]),'
            if len(line) > WIDTH:
                listed = f"        [{', '.join(ctypes)}],"
                if len(listed) > LONGEST:
                    listed = "\n".join(["        [", *(f"            {each}," for each in ctypes), "        ],"])
                line = f'    "{function.name}": (\n        {result},\n{listed}\n    ),'
            lines.append(line)
        lines.append("}")
        lines += ["", "#: Each versioned structure's function that fills it with defaults.", "INITIALIZERS: dict[type[ctypes.Structure], str] = {"]
        lines += [f'    {struct.name}: "{struct.init}",' for struct in self.api.structs if struct.init]
        lines.append("}")
        return "\n".join(lines) + "\n"

    # ---- enums.py ----

    def enums(self) -> str:
        """The constants as enumerations."""
        lines = self.header("Constants of the API: what options choose and reports say.")
        lines += ["from enum import IntEnum, IntFlag", ""]
        names = []
        first_uses = self.first_uses()
        for enumeration in self.api.enumerations:
            if enumeration.name == "SHX_FORMAT_":
                continue
            name = enum_name(enumeration.name)
            names.append(name)
            lines += ["", f"class {name}({'IntFlag' if enumeration.flags else 'IntEnum'}):"]
            lines += [f'    """{first_uses.get(enumeration.name, self.constants[enumeration.members[0]].section)}."""', ""]
            for member in enumeration.members:
                constant = self.constants[member]
                lines.append(f"    {member_name(member, enumeration.name)} = {constant.value}")
                lines += self.doc(constant.doc, "    ")
            lines.append("")
        lines += ["", "__all__ = [", *(f'    "{name}",' for name in sorted(names)), "]"]
        return "\n".join(lines) + "\n"

    def first_uses(self) -> dict[str, str]:
        """Where each enumeration is used, for its class's documentation."""
        uses: dict[str, str] = {}
        for struct in self.api.structs:
            for member in struct.fields:
                if member.enumeration and member.enumeration not in uses:
                    uses[member.enumeration] = f"What {camel(struct.name)}.{member.name} may be"
        return uses

    # ---- records.py ----

    def descriptor(self, member: Field) -> tuple[str, str] | None:
        """A record's descriptor for a field and the type that its constructor takes, or None where the layer above sets it."""
        if member.type.pointer or member.type.name in self.callbacks or member.type.name in ("shx_input", "shx_output"):
            return None
        if member.name == "struct_size" or re.fullmatch(r"reserved\d*", member.name):
            return None
        name = self.aliases.get(member.type.name, member.type.name)
        if member.enumeration:
            enum = enum_name(member.enumeration)
            return f"EnumField({enum}, ", enum
        if member.boolean:
            return "BoolField(", "bool"
        if name in IDS:
            return f"IdField({IDS[name]}, ", IDS[name]
        if name in self.structs:
            return f"RecordField({camel(name)}, ", camel(name)
        if member.array:
            return f"VectorField({member.array}, ", "Sequence[float]"
        if name in ("float", "double"):
            return "FloatField(", "float"
        return "IntField(", "int"

    def column(self, member: Field) -> str | None:
        """A table's descriptor for a field."""
        if re.fullmatch(r"reserved\d*", member.name):
            return None
        if member.type.name in IDS:
            return f"IdColumn({IDS[member.type.name]}s, "
        if member.type.name == "shx_frame":
            return "FrameColumn("
        name = self.aliases.get(member.type.name, member.type.name)
        kinds = {"double": "FloatColumn(", "uint32_t": "UintColumn(", "int32_t": "IntColumn("}
        return kinds[name]

    def field_lines(self, member: Field, call: str) -> list[str]:
        """`    density = FloatField("kg/m^3; ...")`, wrapped."""
        text = self.python_words(" ".join(member.doc.split())).replace('"', '\\"')
        line = f'    {member.name} = {call}"{text}")'
        if len(line) <= WIDTH:
            return [line]
        lines, piece = [f"    {member.name} = {call.rstrip()}" if call.endswith("(") else f"    {member.name} = {call.rstrip(', ')},"], ""
        pieces = []
        for word in re.findall(r"\S+ ?", text):
            if len(piece) + len(word) > WIDTH - 12:
                pieces.append(piece)
                piece = ""
            piece += word
        pieces.append(piece)
        if call.endswith("("):
            return [*lines, *(f'        "{part}"' for part in pieces), "    )"]
        first, argument = call.rstrip(", ").split("(", 1)
        return [f"    {member.name} = {first}(", f"        {argument},", *(f'        "{part}"' for part in pieces), "    )"]

    def records(self) -> str:
        """A class for each structure of plain data."""
        body: list[str] = []
        names: list[str] = []
        used_enums: set[str] = set()
        kinds: set[str] = set()
        for struct in self.ordered_structs():
            if struct.name in NOT_RECORDS:
                continue
            name = camel(struct.name)
            if struct.name in TABLES:
                names.append(name + "Table")
                body += ["", "", f"class {name}Table(Table):"]
                body += self.doc(f"A row each: {struct.doc[0].lower()}{struct.doc[1:]}", "    ")
                body += ["", "    __slots__ = ()", f"    _STRUCT = _capi.{struct.name}"]
                for member in struct.fields:
                    if column := self.column(member):
                        kinds.add(column.split("(")[0])
                        body += self.field_lines(member, column)
                continue
            names.append(name)
            body += ["", "", f"class {name}(Record):", *self.doc(struct.doc, "    "), "", "    __slots__ = ()"]
            body += [f"    _STRUCT = _capi.{struct.name}"]
            given: list[tuple[str, str]] = []
            for member in struct.fields:
                found = self.descriptor(member)
                if found is None or member.name in COUNTS.get(struct.name, ()):
                    continue
                call, kind = found
                kinds.add(call.split("(")[0])
                if member.enumeration:
                    used_enums.add(kind)
                given.append((member.name, kind))
                body += self.field_lines(member, call)
            if struct.versioned or struct.name == "shx_frame":
                body += ["", "    def __init__(", "        self,", "        *,"]
                body += [f"        {field}: {kind} | None = None," for field, kind in given]
                body += ["    ) -> None:", "        super().__init__()", "        self._set("]
                identity = "(0.0, 0.0, 0.0, 1.0) if rotation is None else rotation"
                whole = struct.name == "shx_frame"
                body += [f"            {field}={identity if whole and field == 'rotation' else field}," for field, _ in given]
                body += ["        )"]
        lines = self.header("Structures of the API as classes: options that functions take, reports and tables that they give.")
        lines += ["from __future__ import annotations", "", "from collections.abc import Sequence", "", "from superhelix import _capi"]
        lines += ["from superhelix._record import (", *(f"    {kind}," for kind in sorted(kinds | {"Record", "Table"})), ")"]
        lines += ["from superhelix.enums import (", *(f"    {enum}," for enum in sorted(used_enums)), ")"]
        ids = sorted({*IDS.values(), *(f"{name}s" for name in IDS.values())})
        lines += ["from superhelix.ids import (", *(f"    {name}," for name in ids if any(re.search(rf"\b{name}\b", line) for line in body)), ")"]
        # bodies.BodyDef, which also has the arrays, goes by that name.
        public = sorted(name for name in names if name != "BodyDef")
        lines += [*body, "", "", "__all__ = [", *(f'    "{name}",' for name in public), "]"]
        return "\n".join(lines) + "\n"

    def files(self) -> dict[Path, str]:
        """Every generated file's text."""
        folder = HERE / "src" / "superhelix"
        return {folder / "_capi.py": self.capi(), folder / "enums.py": self.enums(), folder / "records.py": self.records()}


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="Generates the low-level layer of the Python binding.")
    parser.add_argument("--check", action="store_true", help="write nothing, fail if a file is not what would be written")
    arguments = parser.parse_args()
    stale: list[Any] = []
    for path, text in Generator().files().items():
        if not arguments.check:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            stale.append(path.name)
    if stale:
        print(f"stale: {', '.join(stale)}: run python3 bindings/python/generate.py", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
