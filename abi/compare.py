"""What a change of the binary interface does to programs that were compiled before it: breaks them, or adds to what they know."""

from __future__ import annotations

from dataclasses import dataclass, field

from description import Description, Struct

# They tell which header it is, and are meant to change.
TELL_THE_VERSION = {"SHX_VERSION", "SHX_VERSION_MAJOR", "SHX_VERSION_MINOR", "SHX_VERSION_PATCH", "SHX_ABI_VERSION"}


@dataclass
class Changes:
    """What was found, in words."""

    breaks: list[str] = field(default_factory=list)
    additions: list[str] = field(default_factory=list)


def compare(old: Description, new: Description) -> Changes:
    """All changes from one interface to another."""
    changes = Changes()
    for name, value in old.constants.items():
        if name in TELL_THE_VERSION:
            continue
        if name not in new.constants:
            changes.breaks.append(f"constant {name} is gone")
        elif new.constants[name] != value:
            changes.breaks.append(f"constant {name} was {value} and is {new.constants[name]}")
    for name in sorted(old.handles - new.handles):
        changes.breaks.append(f"handle {name} is gone")
    for kind, before, after in (
        ("scalar", old.scalars, new.scalars),
        ("callback", old.callbacks, new.callbacks),
        ("function", old.functions, new.functions),
    ):
        for name, of in before.items():
            if name not in after:
                changes.breaks.append(f"{kind} {name} is gone")
            elif after[name] != of:
                changes.breaks.append(f"{kind} {name} was {of} and is {after[name]}")
    embedded = {each.type.split("[")[0] for struct in old.structs.values() for each in struct.fields.values()}
    for name, struct in old.structs.items():
        if name in new.structs:
            compare_structs(name, struct, new.structs[name], name in embedded, changes)
        else:
            changes.breaks.append(f"struct {name} is gone")
    for kind, before_names, after_names in (
        ("constant", old.constants, new.constants),
        ("scalar", old.scalars, new.scalars),
        ("handle", old.handles, new.handles),
        ("callback", old.callbacks, new.callbacks),
        ("struct", old.structs, new.structs),
        ("function", old.functions, new.functions),
    ):
        changes.additions += [f"{kind} {name} is new" for name in after_names if name not in before_names]
    return changes


def compare_structs(name: str, old: Struct, new: Struct, is_embedded: bool, changes: Changes) -> None:
    """A structure may grow at its end if it states its size, and may use bytes that were reserved."""
    for before in old.fields.values():
        after = new.fields.get(before.name)
        if before.is_reserved:
            continue
        if after is None:
            changes.breaks.append(f"field {name}.{before.name} is gone")
        elif after.offset != before.offset:
            changes.breaks.append(f"field {name}.{before.name} was at {before.offset} and is at {after.offset}")
        elif (after.size, after.type) != (before.size, before.type):
            changes.breaks.append(f"field {name}.{before.name} was {before.type} and is {after.type}")
    if new.alignment != old.alignment:
        changes.breaks.append(f"struct {name} was aligned to {old.alignment} and is to {new.alignment}")
    if old.versioned and not new.versioned:
        changes.breaks.append(f"struct {name} does not begin with struct_size any more")
    if new.size < old.size:
        changes.breaks.append(f"struct {name} had {old.size} bytes and has {new.size}")
    elif new.size > old.size:
        if not old.versioned:
            changes.breaks.append(f"struct {name} grew from {old.size} to {new.size} bytes and has no struct_size")
        elif is_embedded:
            changes.breaks.append(f"struct {name} grew from {old.size} to {new.size} bytes and lies inside other structures")
        else:
            changes.additions.append(f"struct {name} grew from {old.size} to {new.size} bytes")
    free = {byte for each in old.fields.values() if each.is_reserved for byte in range(each.offset, each.offset + each.size)}
    for after in new.fields.values():
        if after.name in old.fields or after.is_reserved:
            continue
        taken = set(range(after.offset, min(after.offset + after.size, old.size)))
        if taken - free:
            # Older programs leave anything there.
            changes.breaks.append(f"field {name}.{after.name} is new, in bytes at {after.offset} that were not reserved")
        else:
            changes.additions.append(f"field {name}.{after.name} is new" + (", in reserved bytes" if taken else ""))
