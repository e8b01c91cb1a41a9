#!/usr/bin/env python3
"""Makes the C# layer that calls the C library from bindings/api.json: P/Invoke signatures, structures, enumerations, handles, definitions, a check of
their layout; and the .meta files that Unity wants beside every file of a package.

    python3 bindings/csharp/generate.py            write com.superhelix.hair/Runtime/Generated and the .meta files
    python3 bindings/csharp/generate.py --check    fail if they are not what api.json gives

A C structure without pointers becomes a C# structure of the same layout. One with pointers becomes two: a raw one of the same layout, and a class whose
properties are arrays, which it pins for the length of a call.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
import textwrap
from pathlib import Path
from xml.sax.saxutils import escape

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from tables import API, ARRAYS, STRUCTS, Item, differences, enumeration_of, group_of, is_bool, is_reserved  # noqa: E402

PACKAGE = HERE / "com.superhelix.hair"
GENERATED = PACKAGE / "Runtime" / "Generated"

# Names of enumerations where the prefix is not a good one by itself.
ENUMERATIONS = {
    "SHX_LOG_": "LogLevel",
    "SHX_STRAND_": "StrandStatus",
    "SHX_STOP_": "StopReason",
    "SHX_STIFFEN_": "StiffenBy",
    "SHX_CONTACT_": "ContactModel",
    "SHX_CONTACT_EVENT_": "ContactEventKind",
    "SHX_PARTNER_": "ContactPartner",
    "SHX_CONSTRAINT_": "ConstraintKind",
    "SHX_SIDES_": "MeshSides",
    "SHX_FRICTION_": "FrictionCoefficients",
    "SHX_COEFFICIENT_": "CoefficientStatus",
    "SHX_DOF_": "Dofs",
    "SHX_ERROR_": "ErrorCode",
}
# In C a typedef of int32_t.
SIGNED = {"SHX_ERROR_", "SHX_STRAND_"}

# Written by hand in Types.cs, by C name.
BY_HAND = {
    "shx_strand_id": "StrandId",
    "shx_body_id": "BodyId",
    "shx_constraint_id": "ConstraintId",
    "shx_frame": "Frame",
    "shx_input": "RawView",
    "shx_output": "RawView",
}

# Fields of classes that code by hand puts in place (Definitions.cs).
EXTRA = {
    "shx_solver_def": {"parallel_for", "parallel_for_user", "log", "log_user"},
    "shx_fit_options": {"parallel_for", "parallel_for_user"},
    "shx_render_settings": {"parallel_for", "parallel_for_user"},
    "shx_step_limits": {"cancel"},
    "shx_scatter_def": {"density", "density_width", "density_height"},
    "shx_hair_strands_def": {"strand_count", "element_counts", "element_lengths"},
}
# Counts that a host may set by themselves; others come with their arrays.
SETTABLE = {("shx_strand_def", "element_count"), ("shx_render_guides", "guide_count")}

DESTROY = {"shx_curve_cache_writer": "shx_curve_cache_writer_abandon"}
# Take what they are given away from its owner.
TAKING = {"shx_curve_cache_writer_finish"}

SCALARS = {
    "uint8_t": "byte",
    "uint32_t": "uint",
    "int32_t": "int",
    "uint64_t": "ulong",
    "int64_t": "long",
    "size_t": "UIntPtr",
    "float": "float",
    "double": "double",
    "char": "byte",
    "void": "void",
    "bool": "byte",
    "shx_result": "int",
    "shx_strand_status": "StrandStatus",
}
VECTORS = {("double", 2): "Vec2", ("double", 3): "Vec3", ("double", 4): "Quat"}
ITEMS = {
    "double": "double",
    "float": "float",
    "uint32_t": "uint",
    "uint8_t": "byte",
    "curvature": "Curvature",
    "triangle": "Triangle",
    "frame": "Frame",
    "float2": "Float2",
    "float3": "Float3",
    "double6": "TriangleUvs",
}
HANDLES = {handle["name"]: handle for handle in API["handles"]}
CALLBACKS = {callback["name"] for callback in API["callbacks"]}
HEADER = "// Generated from bindings/api.json by bindings/csharp/generate.py: do not edit.\n"


def pascal(name: str) -> str:
    """A name in C#'s spelling."""
    return "".join(part[:1].upper() + part[1:] for part in name.removeprefix("shx_").split("_"))


def enumeration_name(prefix: str) -> str:
    """What an enumeration is called."""
    return ENUMERATIONS.get(prefix) or pascal(prefix.removeprefix("SHX_").rstrip("_").lower())


def summary(doc: str, indent: str = "") -> str:
    """The text of an item as a comment."""
    lines = textwrap.wrap(escape(" ".join(doc.split())), 140 - len(indent) - 4)
    if not lines:
        return ""
    if len(lines) == 1 and len(indent) + len(lines[0]) < 110:
        return f"{indent}/// <summary>{lines[0]}</summary>\n"
    return f"{indent}/// <summary>\n" + "".join(f"{indent}/// {line}\n" for line in lines) + f"{indent}/// </summary>\n"


def needs_class(name: str) -> bool:
    """Whether a structure has pointers, views or callbacks in it."""
    if name in BY_HAND:
        return False
    return any(
        field["type"]["pointer"] or field["type"]["name"] in CALLBACKS or field["type"]["name"] in ("shx_input", "shx_output")
        for field in STRUCTS[name]["fields"]
    )


def struct_name(name: str) -> str:
    """The C# structure with the layout of a C structure."""
    return BY_HAND.get(name) or pascal(name) + ("Raw" if needs_class(name) else "")


def enumerations() -> str:
    """All enumerations."""
    constants = {constant["name"]: constant for constant in API["constants"]}
    text = ""
    for enumeration in API["enumerations"]:
        prefix = enumeration["name"]
        flags = "  [Flags]\n" if enumeration["flags"] else ""
        kind = "int" if prefix in SIGNED else "uint"
        text += f"  /// <summary>{prefix} of the C interface.</summary>\n{flags}  public enum {enumeration_name(prefix)} : {kind}\n  {{\n"
        for member in enumeration["members"]:
            name = pascal(member.removeprefix(prefix).lower())
            text += summary(constants[member]["doc"], "    ") + f"    {name} = {constants[member]['value']},\n"
        text += "  }\n\n"
    return text


def field_type(struct: str, field: Item) -> str:
    """The type of a field."""
    kind = field["type"]
    if kind["pointer"] or kind["name"] in CALLBACKS:
        return "IntPtr"
    if field["array"]:
        return VECTORS[kind["name"], field["array"]]
    if enumeration := enumeration_of(struct, field):
        return enumeration_name(enumeration["name"])
    return SCALARS.get(kind["name"]) or struct_name(kind["name"])


def fields(struct: str, public: bool) -> str:
    """The members in their order. Reserved words are private, and so are numbers that say yes or no, which get a property."""
    text = ""
    for field in STRUCTS[struct]["fields"]:
        doc = summary(field["doc"], "    ") if public else ""
        if is_reserved(field):
            names = [field["name"]] if not field["array"] else [f"{field['name']}_{i}" for i in range(field["array"])]
            text += "".join(f"    internal {SCALARS[field['type']['name']]} {name};\n" for name in names)
        elif field["name"] == "struct_size":
            text += "    internal uint StructSize;\n"
        elif public and is_bool(struct, field):
            name = pascal(field["name"])
            text += f"    internal uint {field['name']};\n{doc}    public bool {name}\n    {{\n      get {{ return {field['name']} != 0; }}\n"
            text += f"      set {{ {field['name']} = value ? 1u : 0u; }}\n    }}\n"
        else:
            text += f"{doc}    {'public' if public else 'internal'} {field_type(struct, field)} {pascal(field['name'])};\n"
    return text


def structure(struct: Item) -> str:
    """A structure of the same layout."""
    name = struct["name"]
    public = not needs_class(name)
    text = summary(struct["doc"], "  ") if public else ""
    text += f"  [StructLayout(LayoutKind.Sequential)]\n  {'public' if public else 'internal'} struct {struct_name(name)}\n  {{\n"
    text += fields(name, public)
    if public and struct["init"]:
        text += "\n    /// <summary>One with the defaults.</summary>\n" + (
            f"    public static unsafe {struct_name(name)} Default\n    {{\n      get\n      {{\n        {struct_name(name)} value;\n"
            f"        Error.Check(Native.{struct['init']}(&value, (UIntPtr)sizeof({struct_name(name)})));\n        return value;\n      }}\n    }}\n"
        )
    return text + "  }\n\n"


def class_property(struct: str, field: Item) -> str:
    """The property for a field of a class."""
    name, kind = pascal(field["name"]), field["type"]
    doc = summary(field["doc"], "    ")
    if group := group_of(struct, field["name"]):
        return f"{doc}    public {ITEMS[group[1][field['name']]]}[] {name} {{ get; set; }}\n"
    if kind["name"] == "shx_input":
        return f"{doc}    public Items {name} {{ get; set; }}\n"
    if kind["pointer"] and kind["name"] in HANDLES:
        return f"{doc}    public {pascal(kind['name'])} {name} {{ get; set; }}\n"
    if kind["pointer"]:
        return f"{doc}    public {struct_name(kind['name'])}? {name} {{ get; set; }}\n"
    if is_bool(struct, field):
        return f"{doc}    public bool {name}\n    {{\n      get {{ return Raw.{name} != 0; }}\n      set {{ Raw.{name} = value ? 1u : 0u; }}\n    }}\n"
    if kind["name"] == "size_t":
        return f"{doc}    public ulong {name}\n    {{\n      get {{ return Raw.{name}.ToUInt64(); }}\n      set {{ Raw.{name} = (UIntPtr)value; }}\n    }}\n"
    return f"{doc}    public {field_type(struct, field)} {name}\n    {{\n      get {{ return Raw.{name}; }}\n      set {{ Raw.{name} = value; }}\n    }}\n"


def pinning(struct: str) -> str:
    """Statements that put the properties' arrays into the raw structure."""
    text = ""
    for field in STRUCTS[struct]["fields"]:
        if field["type"]["name"] == "shx_input":
            text += f"      raw.{pascal(field['name'])} = pins.AddItems({pascal(field['name'])});\n"
    for count, arrays in ARRAYS.get(struct, {}).items():
        holder = "raw." + ".".join(pascal(part) if i == 0 else part for i, part in enumerate(count.split(".")))
        field = next(f for f in STRUCTS[struct]["fields"] if f["name"] == count.split(".")[0])
        kind = "UIntPtr" if "." in count else SCALARS[field["type"]["name"]]
        number = f"{holder}.ToUInt64()" if kind == "UIntPtr" else holder
        fixed = "true" if "." in count else "false"
        for name in arrays:
            agreed = f'Pins.Agree("{pascal(struct)}.{pascal(name)}", {pascal(name)}, {number}, {fixed})'
            text += f"      {holder} = ({kind}){agreed};\n      raw.{pascal(name)} = pins.Add({pascal(name)});\n"
    for field in STRUCTS[struct]["fields"]:
        name, kind = pascal(field["name"]), field["type"]
        if field["name"] in EXTRA.get(struct, set()) or group_of(struct, field["name"]) or not kind["pointer"]:
            continue
        if kind["name"] in HANDLES:
            text += f"      raw.{name} = {name} == null ? IntPtr.Zero : pins.Add({name}.Handle);\n"
        else:
            text += f"      raw.{name} = {name}.HasValue ? pins.Add(new[] {{ {name}.Value }}) : IntPtr.Zero;\n"
    return text


def definition(struct: Item) -> str:
    """A structure with its defaults and setters."""
    name = struct["name"]
    raw = struct_name(name)
    text = summary(struct["doc"], "  ") + f"  public sealed unsafe partial class {pascal(name)}\n  {{\n    internal {raw} Raw;\n\n"
    text += f"    /// <summary>One with the defaults.</summary>\n    public {pascal(name)}()\n    {{\n      fixed ({raw}* raw = &Raw)\n"
    text += f"        Error.Check(Native.{struct['init']}(raw, (UIntPtr)sizeof({raw})));\n    }}\n"
    counts = {count for count in ARRAYS.get(name, {}) if (name, count) not in SETTABLE}
    for field in struct["fields"]:
        skipped = field["name"] == "struct_size" or is_reserved(field) or field["name"] in EXTRA.get(name, set()) | counts
        if not skipped:
            text += "\n" + class_property(name, field)
    text += f"\n    // What the C library reads during a call.\n    internal {raw} Pin(Pins pins)\n    {{\n      {raw} raw = Raw;\n{pinning(name)}"
    if name in EXTRA:
        text += "      PinByHand(pins, ref raw);\n"
    text += "      return raw;\n    }\n"
    if name in EXTRA:
        text += f"\n    partial void PinByHand(Pins pins, ref {raw} raw);\n"
    return text + "  }\n\n"


def parameter(function: Item, parameter: Item) -> str:
    """A parameter of a P/Invoke signature."""
    kind, name = parameter["type"], parameter["name"]
    stars = kind["pointer"] + (1 if parameter["array"] else 0)
    if kind["name"] in HANDLES:
        destroys = function["name"] in TAKING or function["name"] in DESTROY.values() or function["name"] == HANDLES[kind["name"]]["destroy"]
        text = "IntPtr*" if stars == 2 else "IntPtr" if destroys else pascal(kind["name"]) + "Handle"
    else:
        text = (SCALARS.get(kind["name"]) or struct_name(kind["name"])) + "*" * stars
    return f"{text} {'@' if name in ('def', 'object', 'params', 'out', 'in') else ''}{name}"


def native() -> str:
    """The P/Invoke signatures."""
    abi = next(constant["value"] for constant in API["constants"] if constant["name"] == "SHX_ABI_VERSION")
    text = f"  internal static unsafe partial class Native\n  {{\n    internal const uint AbiVersion = {abi};\n\n"
    for function in API["functions"]:
        returned = function["returns"]
        kind = "IntPtr" if returned["pointer"] else SCALARS[returned["name"]]
        listed = ", ".join(parameter(function, p) for p in function["parameters"])
        text += "    [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]\n"
        text += f"    internal static extern {kind} {function['name']}({listed});\n\n"
    return text.rstrip() + "\n  }\n"


def handles() -> str:
    """The owners of handles."""
    text = ""
    for name, handle in HANDLES.items():
        destroy = DESTROY.get(name) or handle["destroy"]
        text += f"""  /// <summary>Owns a {name}: frees it when it is disposed, or when nothing names it any more.</summary>
  public sealed class {pascal(name)}Handle : SafeHandle
  {{
    // Callbacks that the library may call as long as this lives.
    internal readonly Hooks Hooks;

    internal {pascal(name)}Handle(IntPtr raw, Hooks hooks) : base(IntPtr.Zero, true)
    {{
      Hooks = hooks;
      SetHandle(raw);
    }}

    /// <summary>Whether it owns nothing.</summary>
    public override bool IsInvalid
    {{
      get {{ return handle == IntPtr.Zero; }}
    }}

    /// <summary>Frees what it owns.</summary>
    protected override bool ReleaseHandle()
    {{
      Native.{destroy}(handle);
      if (Hooks != null)
        Hooks.Dispose();
      return true;
    }}
  }}

"""
    return text


def layout() -> str:
    """The check of sizes and offsets."""
    text = """  /// <summary>Compares the structures' sizes and offsets with those of the C library.</summary>
  public static unsafe class Layout
  {
    /// <summary>The first difference, or null. For 64-bit processes, whose layouts are known.</summary>
    public static string Difference()
    {
      if (IntPtr.Size != 8)
        return null;
      string first = null;
"""
    for struct in API["structs"]:
        name = struct_name(struct["name"])
        if struct["name"] == "shx_output":
            continue
        text += f"      {{\n        {name} x = default({name});\n        byte* at = (byte*)&x;\n"
        text += f'        Compare(ref first, "sizeof {name}", sizeof({name}), {struct["size"]});\n'
        for field in struct["fields"]:
            if name in BY_HAND.values():
                member = field["name"] if name == "RawView" else pascal(field["name"])
            elif field["name"] == "struct_size":
                member = "StructSize"
            elif is_reserved(field):
                member = field["name"] + ("_0" if field["array"] else "")
            else:
                member = field["name"] if not needs_class(struct["name"]) and is_bool(struct["name"], field) else pascal(field["name"])
            text += f'        Compare(ref first, "{name}.{member}", (byte*)&x.{member} - at, {field["offset"]});\n'
        text += "      }\n"
    return (
        text
        + """      return first;
    }

    private static void Compare(ref string first, string what, long here, long there)
    {
      if (first == null && here != there)
        first = what + " is " + here + " here and " + there + " in the C library";
    }
  }
"""
    )


def file(body: str) -> str:
    """A whole file."""
    return (
        HEADER + "#pragma warning disable 169, 649\nusing System;\nusing System.Runtime.InteropServices;\n\nnamespace Superhelix\n{\n" + body.rstrip() + "\n}\n"
    )


def check_tables() -> None:
    """Checks that everything in the tables exists."""
    prefixes = {enumeration["name"] for enumeration in API["enumerations"]}
    by_hand = EXTRA | {name: {"data"} for name in ("shx_input", "shx_output")}
    wrong = [prefix for prefix in ENUMERATIONS if prefix not in prefixes] + differences(by_hand)
    names = [enumeration_name(e["name"]) for e in API["enumerations"]] + [pascal(name) for name in STRUCTS]
    wrong += [f"{name} is the name of two things" for name in sorted(set(names)) if names.count(name) > 1]
    if wrong:
        sys.exit("bindings/csharp/generate.py: api.json and the tables differ: " + ", ".join(wrong))


# ---- .meta files ----


def guid(path: Path) -> str:
    """Unity names assets by a number; the same path always has the same one."""
    return hashlib.md5(f"superhelix/{path.relative_to(PACKAGE).as_posix()}".encode()).hexdigest()


def meta(path: Path) -> str:
    """A file's or folder's .meta file."""
    text = f"fileFormatVersion: 2\nguid: {guid(path)}\n"
    if path.is_dir():
        return text + "folderAsset: yes\nDefaultImporter:\n  externalObjects: {}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n"
    importer = {".cs": "MonoImporter", ".asmdef": "AssemblyDefinitionImporter", ".md": "TextScriptImporter"}.get(path.suffix, "DefaultImporter")
    if path.name == "package.json":
        importer = "PackageManifestImporter"
    return text + f"{importer}:\n  externalObjects: {{}}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n"


def metas(files: set[Path]) -> dict[Path, str]:
    """A .meta file for every file and folder of the package. Unity does not see folders that end in ~."""
    items = {path for path in PACKAGE.rglob("*") if path.suffix != ".meta"} | files
    items = {path for path in items if not any(part.endswith("~") for part in path.relative_to(PACKAGE).parts)}
    return {path.with_name(path.name + ".meta"): meta(path) for path in items}


def outputs() -> dict[Path, str]:
    """The generated text of each file."""
    check_tables()
    structs = [struct for struct in API["structs"] if struct["name"] not in BY_HAND]
    made = {
        GENERATED / "Native.cs": file(native()),
        GENERATED / "Handles.cs": file(handles()),
        GENERATED / "Enumerations.cs": file(enumerations()),
        GENERATED / "Structures.cs": file("".join(structure(struct) for struct in structs)),
        GENERATED / "Definitions.cs": file("".join(definition(struct) for struct in structs if needs_class(struct["name"]))),
        GENERATED / "Layout.cs": file(layout()),
    }
    return made | metas(set(made))


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    check = parser.parse_args().check
    GENERATED.mkdir(parents=True, exist_ok=True)
    made = outputs()
    stray = [path for path in PACKAGE.rglob("*.meta") if path not in made]
    for path, text in made.items():
        if not check:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            sys.exit(f"{path} is out of date: run python3 bindings/csharp/generate.py")
    if stray:
        sys.exit(f"{stray[0]} belongs to nothing: remove it")


if __name__ == "__main__":
    main()
