"""The binary interface as a table: symbols, signatures, sizes, offsets, numbers. As a model, and as text that is committed."""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bindings"))

import api  # noqa: E402


class DescriptionError(Exception):
    """A line of the table that is not understood."""


@dataclass
class Field:
    """A field of a structure."""

    name: str
    offset: int
    size: int
    type: str

    @property
    def is_reserved(self) -> bool:
        """Whether its bytes are kept for fields to come: hosts leave them zero."""
        return re.fullmatch(r"reserved\d*", self.name) is not None


@dataclass
class Struct:
    """A structure."""

    size: int
    alignment: int
    versioned: bool
    fields: dict[str, Field] = field(default_factory=dict)


@dataclass
class Description:
    """All that a compiled program depends on."""

    constants: dict[str, int] = field(default_factory=dict)
    scalars: dict[str, str] = field(default_factory=dict)
    handles: set[str] = field(default_factory=set)
    callbacks: dict[str, str] = field(default_factory=dict)
    structs: dict[str, Struct] = field(default_factory=dict)
    functions: dict[str, str] = field(default_factory=dict)

    @property
    def abi_version(self) -> int:
        """The number by which a break is announced."""
        return self.constants["SHX_ABI_VERSION"]

    @property
    def version(self) -> str:
        """The release."""
        return ".".join(str(self.constants[f"SHX_VERSION_{part}"]) for part in ("MAJOR", "MINOR", "PATCH"))


def signature(returns: api.Type, parameters: list[api.Parameter]) -> str:
    """Types alone: a parameter may change its name."""
    types = [each.type.text() + (f"[{each.array}]" if each.array else "") for each in parameters]
    return f"{returns.text()} ({', '.join(types) or 'void'})"


def of_header(path: Path) -> Description:
    """The interface that a header declares."""
    model = api.parse(path)
    found = Description()
    found.constants = {each.name: each.value for each in model.constants}
    found.scalars = {each.name: each.type for each in model.aliases}
    found.handles = {each.name for each in model.handles}
    found.callbacks = {each.name: signature(each.returns, each.parameters) for each in model.callbacks}
    found.functions = {each.name: signature(each.returns, each.parameters) for each in model.functions}
    for struct in model.structs:
        fields = {each.name: Field(each.name, each.offset, each.size, each.type.text() + (f"[{each.array}]" if each.array else "")) for each in struct.fields}
        found.structs[struct.name] = Struct(struct.size, struct.alignment, struct.versioned, fields)
    return found


def to_text(described: Description) -> str:
    """The table, a line an item."""
    lines = [f"# The binary interface of superhelix {described.version}, written by `make abi-baseline`. 64-bit sizes and offsets."]
    lines += [f"constant {name} = {value}" for name, value in described.constants.items()]
    lines += [f"scalar {name} = {type_}" for name, type_ in described.scalars.items()]
    lines += [f"handle {name}" for name in sorted(described.handles)]
    lines += [f"callback {name} = {of}" for name, of in described.callbacks.items()]
    for name, struct in described.structs.items():
        lines.append(f"struct {name}: {struct.size} bytes, aligned to {struct.alignment}{', versioned' * struct.versioned}")
        lines += [f"  {each.offset} {each.size} {each.name}: {each.type}" for each in struct.fields.values()]
    lines += [f"function {name} = {of}" for name, of in described.functions.items()]
    return "\n".join(lines) + "\n"


def of_text(text: str) -> Description:
    """The interface that a table tells of."""
    found = Description()
    struct: Struct | None = None
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("#"):
            continue
        if match := re.fullmatch(r"constant (\w+) = (-?\d+)", line):
            found.constants[match[1]] = int(match[2])
        elif match := re.fullmatch(r"handle (\w+)", line):
            found.handles.add(match[1])
        elif match := re.fullmatch(r"(scalar|callback|function) (\w+) = (.+)", line):
            getattr(found, match[1] + "s")[match[2]] = match[3]
        elif match := re.fullmatch(r"struct (\w+): (\d+) bytes, aligned to (\d+)(, versioned)?", line):
            struct = found.structs[match[1]] = Struct(int(match[2]), int(match[3]), match[4] is not None)
        elif (match := re.fullmatch(r"  (\d+) (\d+) (\w+): (.+)", line)) and struct is not None:
            struct.fields[match[3]] = Field(match[3], int(match[1]), int(match[2]), match[4])
        else:
            raise DescriptionError(f"line {number}: {line!r}")
    return found
