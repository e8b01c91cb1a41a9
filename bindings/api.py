#!/usr/bin/env python3
"""Describes the C API: parses include/superhelix.h into a model, which every binding is generated from.

    python3 bindings/api.py               write bindings/api.json
    python3 bindings/api.py --check       fail if bindings/api.json is not what the header says
    python3 bindings/api.py --check-c     fail if the C compiler (CC, default cc) lays out a structure in another way

The header is itself generated and very regular, so a line-based parser is enough; a line that it does not know is an error, never
skipped. Sizes and offsets are those of 64-bit little-endian C ABIs (x86-64, AArch64), which agree on everything the API uses.

The model (also the shape of api.json):
    constants   name, value, doc, section, enumeration (the name of the one it belongs to, or null)
    enumerations  name (a prefix such as "SHX_SHAPE_"), flags (members are bits), members (names of constants)
    aliases     name, type, doc, section                     (typedef int32_t shx_result)
    handles     name, doc, section, destroy                  (opaque types; destroy is the function that frees one, or null)
    callbacks   name, returns, parameters, doc, section
    structs     name, doc, section, size, alignment, versioned (begins with struct_size), init (the function that fills it, or null),
                fields: name, type, array (0: none), offset, size, doc, enumeration (whose constants it holds, or null),
                boolean (it holds 0 or 1)
    functions   name, returns, parameters (name, type, array), doc, section, handle (type of the first parameter, if a handle),
                threads ("any", "shared" or "exclusive")
A type is {"name", "const", "pointer"}: const is about what is pointed to (or the value itself), pointer is 0, 1 or 2.
"""

from __future__ import annotations

import argparse
import ast
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADER = ROOT / "include" / "superhelix.h"
DESCRIPTION = ROOT / "bindings" / "api.json"

LINE = 140
POINTER_SIZE = 8
SCALARS = {
    "bool": 1,
    "char": 1,
    "int8_t": 1,
    "uint8_t": 1,
    "int16_t": 2,
    "uint16_t": 2,
    "int32_t": 4,
    "uint32_t": 4,
    "int64_t": 8,
    "uint64_t": 8,
    "size_t": 8,
    "float": 4,
    "double": 8,
}


class HeaderError(Exception):
    """The header has something that this parser does not know."""


@dataclass(frozen=True)
class Type:
    """A C type: a name, whether it (or what it points to) is const, and how many stars it has."""

    name: str
    const: bool = False
    pointer: int = 0

    def text(self) -> str:
        """The type as C writes it."""
        return ("const " if self.const else "") + self.name + (" " + "*" * self.pointer if self.pointer else "")


@dataclass
class Constant:
    """A #define with a value."""

    name: str
    value: int
    doc: str
    section: str
    enumeration: str | None = None


@dataclass
class Enumeration:
    """Constants that share a prefix which the header's comments speak of."""

    name: str
    flags: bool
    members: list[str]


@dataclass
class Alias:
    """A typedef of a scalar."""

    name: str
    type: str
    doc: str
    section: str


@dataclass
class Handle:
    """An opaque type."""

    name: str
    doc: str
    section: str
    destroy: str | None = None


@dataclass
class Parameter:
    """A parameter of a function or a callback."""

    name: str
    type: Type
    array: int = 0


@dataclass
class Callback:
    """A pointer to a function of the host's."""

    name: str
    returns: Type
    parameters: list[Parameter]
    doc: str
    section: str


@dataclass
class Field:
    """A field of a structure."""

    name: str
    type: Type
    array: int
    doc: str
    offset: int = 0
    size: int = 0
    enumeration: str | None = None
    boolean: bool = False


@dataclass
class Struct:
    """A structure that is passed by pointer or value."""

    name: str
    doc: str
    section: str
    fields: list[Field]
    size: int = 0
    alignment: int = 0
    versioned: bool = False
    init: str | None = None


@dataclass
class Function:
    """An exported function."""

    name: str
    returns: Type
    parameters: list[Parameter]
    doc: str
    section: str
    handle: str | None = None
    threads: str = "any"


@dataclass
class Api:
    """All of the header, in its order."""

    constants: list[Constant] = field(default_factory=list)
    enumerations: list[Enumeration] = field(default_factory=list)
    aliases: list[Alias] = field(default_factory=list)
    handles: list[Handle] = field(default_factory=list)
    callbacks: list[Callback] = field(default_factory=list)
    structs: list[Struct] = field(default_factory=list)
    functions: list[Function] = field(default_factory=list)


def parse_type(text: str) -> Type:
    """A type as it stands before a name: `const shx_input *`, `double`, `shx_solver **`."""
    words = text.replace("*", " * ").split()
    pointer = words.count("*")
    const = words[:1] == ["const"]
    names = [word for word in words if word not in ("const", "*", "struct")]
    if len(names) != 1 or words.count("const") > 1:
        raise HeaderError(f"not a type: {text!r}")
    return Type(names[0], const, pointer)


def parse_declarator(text: str) -> tuple[str, Type, int]:
    """`const double origin[3]` as name, type and array length."""
    match = re.fullmatch(r"(.*?[\s*])(\w+)(?:\[(\d+)\])?", text.strip())
    if match is None:
        raise HeaderError(f"not a declaration: {text!r}")
    return match[2], parse_type(match[1]), int(match[3] or 0)


def parse_parameters(text: str) -> list[Parameter]:
    """What stands between a function's parentheses."""
    if text.strip() in ("", "void"):
        return []
    return [Parameter(*parse_declarator(part)) for part in text.split(",")]


def evaluate(expression: str, known: dict[str, int]) -> int:
    """The value of a constant's expression: integers, names of earlier constants, | + - << ( )."""

    def value(node: ast.expr) -> int:
        match node:
            case ast.Constant(value=int(number)):
                return number
            case ast.Name(id=name) if name in known:
                return known[name]
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -value(operand)
            case ast.BinOp(left=left, op=ast.BitOr(), right=right):
                return value(left) | value(right)
            case ast.BinOp(left=left, op=ast.LShift(), right=right):
                return value(left) << value(right)
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return value(left) + value(right)
        raise HeaderError(f"not a constant expression: {expression!r}")

    return value(ast.parse(expression.strip(), mode="eval").body)


class Parser:
    """Reads the header from top to bottom, collecting the comment that stands before each item."""

    def __init__(self, text: str) -> None:
        self.lines = text.splitlines()
        self.place = 0
        self.section = ""
        self.comment: list[str] = []
        self.api = Api()
        self.declared: dict[str, tuple[str, str]] = {}

    def take_doc(self) -> str:
        """The comment collected so far, a line break where the header has one."""
        doc = "\n".join(self.comment)
        self.comment = []
        return doc

    def until(self, end: str) -> str:
        """The statement that begins on this line, joined, without its end."""
        text = self.lines[self.place].strip()
        while not text.endswith(end):
            self.place += 1
            text += " " + self.lines[self.place].strip()
        return text[: -len(end)]

    def parse(self) -> Api:
        """The whole header."""
        while self.place < len(self.lines):
            line = self.lines[self.place]
            try:
                self.item(line)
            except (HeaderError, IndexError, SyntaxError) as error:
                raise HeaderError(f"{HEADER.name}:{self.place + 1}: {error}") from error
            self.place += 1
        for name, (doc, section) in self.declared.items():
            self.api.handles.append(Handle(name, doc, section))
        complete(self.api)
        return self.api

    def item(self, line: str) -> None:
        """One line, or the item that begins there."""
        if match := re.fullmatch(r"// ---- (.*?) -+", line):
            self.section, self.comment = match[1], []
        elif line.startswith("//"):
            self.comment.append(line[2:].strip())
        elif not line.strip():
            # A blank line parts a comment from what follows: it belongs to nothing.
            self.comment = []
        elif line.startswith("#define SHX_API") or line == "#define SUPERHELIX_H":
            pass
        elif match := re.fullmatch(r"#define (SHX_\w+) (.+)", line):
            known = {constant.name: constant.value for constant in self.api.constants}
            self.api.constants.append(Constant(match[1], evaluate(match[2], known), self.take_doc(), self.section))
        elif line.startswith("#") or re.fullmatch(r'extern "C" {|}\s*// extern "C"', line):
            self.comment = []
        elif match := re.fullmatch(r"typedef struct (\w+) (\w+);", line):
            self.declared[match[2]] = (self.take_doc(), self.section)
        elif match := re.fullmatch(r"typedef struct (\w+) \{", line):
            self.struct(match[1])
        elif line.startswith("typedef") and "(*" in line:
            self.callback(self.until(";"))
        elif match := re.fullmatch(r"typedef (\w+) (\w+);", line):
            self.api.aliases.append(Alias(match[2], match[1], self.take_doc(), self.section))
        elif line.startswith("SHX_API "):
            self.function(self.until(";"))
        else:
            raise HeaderError(f"not understood: {line!r}")

    def struct(self, name: str) -> None:
        """A structure's fields, to its closing brace."""
        doc, fields = self.take_doc(), []
        # A structure that was declared earlier is no handle.
        self.declared.pop(name, None)
        while True:
            self.place += 1
            line = self.lines[self.place].strip()
            if line == f"}} {name};":
                break
            if line.startswith("//"):
                self.comment.append(line[2:].strip())
            elif line.endswith(";"):
                field_name, field_type, array = parse_declarator(line[:-1])
                fields.append(Field(field_name, field_type, array, self.take_doc()))
            elif line:
                raise HeaderError(f"not a field: {line!r}")
        self.api.structs.append(Struct(name, doc, self.section, fields))

    def callback(self, text: str) -> None:
        """`typedef void (*shx_log_fn)(void *user, ...)`."""
        match = re.fullmatch(r"typedef (.+?)\(\*(\w+)\)\((.*)\)", text)
        if match is None:
            raise HeaderError(f"not a callback: {text!r}")
        parameters = parse_parameters(match[3])
        self.api.callbacks.append(Callback(match[2], parse_type(match[1]), parameters, self.take_doc(), self.section))

    def function(self, text: str) -> None:
        """`SHX_API shx_result shx_solver_step(shx_solver *solver, ...)`."""
        match = re.fullmatch(r"SHX_API (.+?[\s*])(\w+)\((.*)\)", text)
        if match is None:
            raise HeaderError(f"not a function: {text!r}")
        parameters = parse_parameters(match[3])
        self.api.functions.append(Function(match[2], parse_type(match[1]), parameters, self.take_doc(), self.section))


def complete(api: Api) -> None:
    """Fills in what follows from the rest of the model."""
    lay_out(api)
    functions = {function.name for function in api.functions}
    handles = {handle.name for handle in api.handles}
    for struct in api.structs:
        struct.versioned = struct.fields[0].name == "struct_size"
        struct.init = f"{struct.name}_init" if f"{struct.name}_init" in functions else None
    for handle in api.handles:
        handle.destroy = f"{handle.name}_destroy" if f"{handle.name}_destroy" in functions else None
    for function in api.functions:
        first = function.parameters[0].type if function.parameters else None
        if first is not None and first.pointer == 1 and first.name in handles:
            function.handle = first.name
        function.threads = thread_rule(function)
    check_names(api)
    enumerate_constants(api)


def thread_rule(function: Function) -> str:
    """The rule that the line "Threads: ..." states for the function's handle."""
    rule = re.search(r"^Threads: (any|shared|exclusive)\b", function.doc, re.MULTILINE)
    if rule is None:
        raise HeaderError(f"{function.name} states no thread rule")
    return rule[1]


def lay_out(api: Api) -> None:
    """Sizes and offsets by the rules that C compilers on 64-bit machines share."""
    sizes = dict(SCALARS)
    alignments = dict(SCALARS)
    for alias in api.aliases:
        sizes[alias.name] = alignments[alias.name] = SCALARS[alias.type]
    for callback in api.callbacks:
        sizes[callback.name] = alignments[callback.name] = POINTER_SIZE
    # Structures may hold others that the header has later.
    waiting = list(api.structs)
    while waiting:
        ready = [struct for struct in waiting if all(field.type.pointer or field.type.name in sizes for field in struct.fields)]
        if not ready:
            raise HeaderError(f"types that are nowhere defined: {[struct.name for struct in waiting]}")
        for struct in ready:
            offset, widest = 0, 1
            for member in struct.fields:
                pointer = member.type.pointer > 0
                alignment = POINTER_SIZE if pointer else alignments[member.type.name]
                member.offset = -(-offset // alignment) * alignment
                member.size = (POINTER_SIZE if pointer else sizes[member.type.name]) * max(member.array, 1)
                offset = member.offset + member.size
                widest = max(widest, alignment)
            struct.size, struct.alignment = -(-offset // widest) * widest, widest
            sizes[struct.name], alignments[struct.name] = struct.size, struct.alignment
            waiting.remove(struct)


def check_names(api: Api) -> None:
    """Every type that is used must be known, and no name may be defined twice."""
    groups = (api.constants, api.aliases, api.handles, api.callbacks, api.structs, api.functions)
    names = [item.name for group in groups for item in group]
    doubles = {name for name in names if names.count(name) > 1}
    if doubles:
        raise HeaderError(f"defined twice: {sorted(doubles)}")
    known = {*names, *SCALARS, "void"}
    used = {member.type.name for struct in api.structs for member in struct.fields}
    callables: list[Function | Callback] = [*api.functions, *api.callbacks]
    for function in callables:
        used |= {function.returns.name, *(parameter.type.name for parameter in function.parameters)}
    if used - known:
        raise HeaderError(f"types that are nowhere defined: {sorted(used - known)}")


def enumerate_constants(api: Api) -> None:
    """Groups constants by the prefixes that comments speak of, as in "SHX_SHAPE_."; the longest prefix of a constant has it."""
    docs = [item.doc for group in (api.aliases, api.callbacks, api.structs, api.functions) for item in group]
    docs += [member.doc for struct in api.structs for member in struct.fields]
    text = " ".join(" ".join(docs).split())
    found = set(re.findall(r"\bSHX_[A-Z0-9_]*_(?![A-Za-z0-9_])", text))
    flags = {prefix for prefix in found if f"{prefix} bits" in text}
    # "SHX_FRICTION_INTERNAL, _VISCOSITY and _AIR_DRAG bits"
    constants = {constant.name for constant in api.constants}
    for match in re.finditer(r"\b(SHX_\w+)(?: \(default\))?((?:,? (?:or |and )?_[A-Z0-9_]+)+)( bits)?", text):
        names = re.findall(r"_([A-Z0-9_]+)", match[2])
        parts = match[1].split("_")
        whole = ["_".join(parts[:length]) + "_" for length in range(len(parts) - 1, 1, -1)]
        prefix = next((prefix for prefix in whole if all(prefix + name in constants for name in names)), None)
        if prefix is not None:
            found.add(prefix)
            flags |= {prefix} if match[3] else set()
    prefixes = sorted(found, key=len, reverse=True)
    members: dict[str, list[str]] = {prefix: [] for prefix in prefixes}
    for constant in api.constants:
        constant.enumeration = next((prefix for prefix in prefixes if constant.name.startswith(prefix)), None)
        if constant.enumeration:
            members[constant.enumeration].append(constant.name)
    for prefix in dict.fromkeys(constant.enumeration for constant in api.constants):
        if prefix is not None:
            api.enumerations.append(Enumeration(prefix, prefix in flags, members[prefix]))
    describe_fields(api)


def describe_fields(api: Api) -> None:
    """Finds out which fields hold an enumeration's constants, or 0 and 1: their comments say so."""
    by_name = {constant.name: constant.enumeration for constant in api.constants}
    by_name |= {enumeration.name: enumeration.name for enumeration in api.enumerations}
    for struct in api.structs:
        for member in struct.fields:
            if member.type != Type("uint32_t") or member.array or member.name.startswith(("struct_size", "reserved")):
                continue
            doc = " ".join(member.doc.split())
            # A comment that begins with constants, or has one as its default, is about them.
            words = re.findall(r"(?:^|: |default )(SHX_\w+)", doc, re.IGNORECASE)
            member.enumeration = next((by_name[word] for word in words if by_name.get(word)), None)
            member.boolean = bool(re.match(r"1(?: \(default\)| if\b|:)|.*\b1: [^.]*\. (?:.*[^\d])?0\b|.*\b0: .*\b1\b:", doc)) and not member.enumeration


def parse(path: Path = HEADER) -> Api:
    """The model of a header."""
    return Parser(path.read_text(encoding="utf-8")).parse()


def rendered(value: object, indent: str = "") -> str:
    """JSON with what fits on a line on one line, so that differences are easy to read."""
    line = json.dumps(value, ensure_ascii=False)
    if len(indent) + len(line) <= LINE or not isinstance(value, (dict, list)):
        return line
    inner = indent + " "
    if isinstance(value, dict):
        items = [f"{inner}{json.dumps(key)}: {rendered(item, inner)}" for key, item in value.items()]
        return "{\n" + ",\n".join(items) + f"\n{indent}}}"
    return "[\n" + ",\n".join(inner + rendered(item, inner) for item in value) + f"\n{indent}]"


def description(api: Api) -> str:
    """The text of api.json."""
    return rendered(asdict(api)) + "\n"


def layout_check(api: Api) -> str:
    """A C11 file that compiles only where structures are laid out as the model says, and constants have its values."""
    lines = ["#include <stddef.h>", "#include <superhelix.h>", ""]
    for struct in api.structs:
        lines.append(f'_Static_assert(sizeof({struct.name}) == {struct.size}, "sizeof({struct.name})");')
        lines.append(f'_Static_assert(_Alignof({struct.name}) == {struct.alignment}, "_Alignof({struct.name})");')
        for member in struct.fields:
            name = f"{struct.name}, {member.name}"
            lines.append(f'_Static_assert(offsetof({name}) == {member.offset}, "offsetof({name})");')
            size = f"sizeof((({struct.name} *)0)->{member.name})"
            lines.append(f'_Static_assert({size} == {member.size}, "{struct.name}.{member.name}");')
    for constant in api.constants:
        lines.append(f'_Static_assert(({constant.name}) == ({constant.value}), "{constant.name}");')
    for alias in api.aliases:
        lines.append(f'_Static_assert(sizeof({alias.name}) == {SCALARS[alias.type]}, "sizeof({alias.name})");')
    # Assigning each function to a pointer of the parsed type checks the parsed signatures.
    for number, function in enumerate(api.functions):
        parameters = ", ".join(parameter.type.text() + ("*" if parameter.array else "") for parameter in function.parameters)
        lines.append(f"extern {function.returns.text()} (*check_{number})({parameters or 'void'});")
        lines.append(f"{function.returns.text()} (*check_{number})({parameters or 'void'}) = {function.name};")
    return "\n".join(lines) + "\n"


def check_layout(api: Api) -> None:
    """Compiles layout_check; raises with the compiler's message where it does not compile."""
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "layout_check.c"
        source.write_text(layout_check(api), encoding="utf-8")
        compiler = shlex.split(os.environ.get("CC", "cc"))
        options = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{HEADER.parent}"]
        subprocess.run([*compiler, *options, str(source)], check=True)


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="Describes the C API for the bindings: include/superhelix.h as bindings/api.json.")
    parser.add_argument("--check", action="store_true", help="write nothing, fail if api.json is not what the header says")
    parser.add_argument("--check-c", action="store_true", help="fail if the C compiler disagrees with sizes, offsets and values")
    arguments = parser.parse_args()
    api = parse()
    text = description(api)
    if arguments.check:
        if not DESCRIPTION.exists() or DESCRIPTION.read_text(encoding="utf-8") != text:
            print("bindings/api.json is not what include/superhelix.h says: run python3 bindings/api.py", file=sys.stderr)
            return 1
    elif not arguments.check_c:
        DESCRIPTION.write_text(text, encoding="utf-8")
    if arguments.check_c:
        check_layout(api)
    return 0


if __name__ == "__main__":
    sys.exit(main())
