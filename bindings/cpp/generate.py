#!/usr/bin/env python3
"""Makes the C++ definitions and enumerations from bindings/api.json.

    python3 bindings/cpp/generate.py            write include/superhelix/enumerations.hpp and definitions.hpp
    python3 bindings/cpp/generate.py --check    fail if they are not what api.json gives

Each C structure with an _init function becomes a C++ structure of the same name without shx_ that is derived from it, is filled when it is made,
and has a setter with_NAME for each field. What api.json cannot say is in bindings/tables.py, and here: names, and the setters that need code of their own.
"""

from __future__ import annotations

import argparse
import sys
import textwrap
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from tables import API, ARRAYS, OUTPUTS, STRUCTS, Item, differences, enumeration_of, group_of, is_bool, is_reserved  # noqa: E402

INCLUDE = HERE / "include" / "superhelix"

# Names of enumerations where the prefix is not a good one by itself.
ENUMERATIONS = {
    "SHX_LOG_": "log_level",
    "SHX_STRAND_": "strand_state",
    "SHX_STOP_": "stop_reason",
    "SHX_STIFFEN_": "stiffen_by",
    "SHX_CONTACT_": "contact_model",
    "SHX_CONTACT_EVENT_": "contact_event_kind",
    "SHX_PARTNER_": "contact_partner",
    "SHX_CONSTRAINT_": "constraint_kind",
    "SHX_FRICTION_": "friction_coefficient",
    "SHX_COEFFICIENT_": "coefficient_status",
    "SHX_ERROR_": "error_code",
}

# C++ types of items of arrays.
ITEMS = {
    "curvature": "curvature",
    "triangle": "triangle",
    "frame": "frame",
    "float2": "std::array<float, 2>",
    "float3": "std::array<float, 3>",
    "double6": "std::array<double, 6>",
}

# Written by hand in types.hpp.
BY_HAND = {"shx_input", "shx_output", "shx_frame"}

HOOK = """
  // The host's parallel loop: parallel_for(count, min_range, task) calls task(begin, end, worker) over disjoint ranges that cover 0 to count - 1, from
  // any threads, and returns when all of them have returned. It must not throw: the program would end. It is kept as long as it is needed.
  template <class F>
  {name} &with_parallel_for(F &&loop) {{
    loop_ = std::make_shared<detail::parallel_for_hook>(std::forward<F>(loop));
    parallel_for = &detail::parallel_for_hook::call;
    parallel_for_user = loop_.get();
    return *this;
  }}
  const std::shared_ptr<void> &loop() const {{ return loop_; }}
"""

# Setters written out, and the fields that they stand for.
EXTRA = {
    "shx_solver_def": (
        {"parallel_for", "parallel_for_user", "log", "log_user"},
        HOOK.format(name="solver_def")
        + """
  // Receives messages, as log(level, text); level is a log_level. It must not throw: the program would end. It is kept as long as the solver.
  template <class F>
  solver_def &with_log(F &&receiver) {
    log_ = std::make_shared<detail::log_hook>(std::forward<F>(receiver));
    log = &detail::log_hook::call;
    log_user = log_.get();
    return *this;
  }
  const std::shared_ptr<void> &receiver() const { return log_; }

 private:
  std::shared_ptr<void> loop_, log_;
""",
    ),
    "shx_fit_options": (
        {"parallel_for", "parallel_for_user"},
        HOOK.format(name="fit_options") + "\n private:\n  std::shared_ptr<void> loop_;\n",
    ),
    "shx_render_settings": (
        {"parallel_for", "parallel_for_user"},
        HOOK.format(name="render_settings") + "\n private:\n  std::shared_ptr<void> loop_;\n",
    ),
    "shx_step_limits": (
        {"cancel"},
        """
  // Another thread sets it to anything but 0 to cancel the step. It must live until the step ends.
  step_limits &with_cancel(const std::atomic<std::uint32_t> &flag) {
    static_assert(sizeof flag == sizeof(std::uint32_t) && std::atomic<std::uint32_t>::is_always_lock_free, "an atomic number is a number");
    cancel = reinterpret_cast<const std::uint32_t *>(&flag);
    return *this;
  }
""",
    ),
    "shx_scatter_def": (
        {"density", "density_width", "density_height"},
        """
  // Relative densities, 0 or above, one for each vertex.
  scatter_def &with_density(kept<const double> of_vertices) {
    density = of_vertices.data();
    density_width = density_height = 0;
    density_size_ = of_vertices.size();
    return *this;
  }
  // Relative densities, 0 or above: a picture over the texture coordinates, row by row from v = 0 on.
  scatter_def &with_density_picture(kept<const double> pixels, std::size_t width, std::size_t height) {
    detail::agree("scatter_def.density", pixels.size(), width * height, true);
    density = pixels.data();
    density_width = width;
    density_height = height;
    density_size_ = pixels.size();
    return *this;
  }
  std::size_t density_size() const { return density_size_; }

 private:
  std::size_t density_size_ = 0;
""",
    ),
    "shx_hair_strands_def": (
        {"element_counts", "element_lengths", "strand_count"},
        """
  // For each strand its number of elements, and the lengths of all elements, m, strand after strand.
  hair_strands_def &with_elements(kept<const std::uint32_t> counts, kept<const double> lengths) {
    strand_count = counts.size();
    element_counts = counts.data();
    element_lengths = lengths.data();
    element_length_count_ = lengths.size();
    return *this;
  }
  std::size_t element_length_count() const { return element_length_count_; }

 private:
  std::size_t element_length_count_ = 0;
""",
    ),
    "shx_strand_def": (
        set(),
        """
  // A round section, m.
  strand_def &with_radius(double value) { return with_radius({value, value}); }
""",
    ),
    "shx_material": (
        set(),
        """
  // A round section, m.
  material &with_radius(double value) { return with_radius({value, value}); }
""",
    ),
}

KEYWORDS = {"and", "auto", "bool", "default", "double", "explicit", "float", "int", "new", "not", "or", "register", "short", "static", "this", "union", "xor"}
SCALARS = {"uint8_t", "uint16_t", "uint32_t", "uint64_t", "int32_t", "int64_t"}


def comment(doc: str, indent: str = "") -> str:
    """The text of an item as a comment."""
    lines = textwrap.wrap(" ".join(doc.split()), 140 - len(indent) - 3)
    return "".join(f"{indent}// {line}\n" for line in lines)


def plain(name: str) -> str:
    """The name without shx_."""
    return name.removeprefix("shx_")


def enumeration_name(prefix: str) -> str:
    """What an enumeration is called."""
    return ENUMERATIONS.get(prefix, prefix.removeprefix("SHX_").rstrip("_").lower())


def enumerations() -> str:
    """All enumerations."""
    docs = {constant["name"]: constant for constant in API["constants"]}
    text = ""
    for enumeration in API["enumerations"]:
        values = [docs[member]["value"] for member in enumeration["members"]]
        kind = "std::int32_t" if min(values) < 0 else "std::uint32_t"
        text += f"// {enumeration['name']}\nstruct {enumeration_name(enumeration['name'])} {{\n  enum type : {kind} {{\n"
        for member in enumeration["members"]:
            name = member.removeprefix(enumeration["name"]).lower()
            name += "_" if name in KEYWORDS else ""
            text += comment(docs[member]["doc"], "    ") + f"    {name} = {member},\n"
        text += "  };\n};\n\n"
    return text


def item_type(field: Item) -> str:
    """The type of a field or of the items that it points to."""
    name = field["type"]["name"]
    return f"std::{name}" if name in SCALARS or name == "size_t" else name


def setter(struct: str, signature: str, body: str, doc: str) -> str:
    """A setter, from its signature after with_ and its statements."""
    return comment(doc, "  ") + f"  {plain(struct)} &with_{signature} {{\n{textwrap.indent(body, '    ')}    return *this;\n  }}\n"


def others_set(arrays: Item, but: str) -> str:
    """The condition that another array of a group is there."""
    return " || ".join(f"{name} != nullptr" for name in arrays if name != but) or "false"


def field_setter(struct: str, field: Item) -> str:
    """The setter of a field."""
    name, kind, doc = field["name"], field["type"], field["doc"]
    label = f'"{plain(struct)}.{name}"'
    if group := group_of(struct, name):
        count, arrays = group
        item = ITEMS.get(arrays[name], f"std::{arrays[name]}" if arrays[name] in SCALARS else arrays[name])
        of_view = "." in count
        body = f"detail::agree({label}, values.size(), {count}, {'true' if of_view else others_set(arrays, name)});\n"
        if not of_view:
            types = {f["name"]: item_type(f) for f in STRUCTS[struct]["fields"]}
            body += f"{count} = static_cast<{types[count]}>(values.size());\n"
        inner = "->data()" if arrays[name] in ITEMS and item != "frame" else ""
        pointer = f"values.empty() ? nullptr : values.data(){inner}" if inner else "values.data()"
        return setter(struct, f"{name}(kept<const {item}> values)", body + f"{name} = {pointer};\n", doc)
    if kind["pointer"]:
        const = "const " if kind["const"] else ""
        return setter(struct, f"{name}({const}{kind['name']} *value)", f"{name} = value;\n", doc)
    if kind["name"] == "shx_input":
        sized = ARRAYS.get(struct, {}).get(f"{name}.count")
        body = f"detail::agree({label}, value.count, {name}.count, {others_set(sized, '')});\n" if sized else ""
        return setter(struct, f"{name}(const kept_input &value)", body + f"{name} = value;\n", doc)
    if field["array"]:
        size = field["array"]
        item = "vec3" if size == 3 and kind["name"] == "double" else f"std::array<{item_type(field)}, {size}>"
        return setter(struct, f"{name}(const {item} &value)", f"detail::copy(value, {name});\n", doc)
    if kind["name"].startswith("shx_"):
        return setter(struct, f"{name}(const {plain(kind['name'])} &value)", f"{name} = value;\n", doc)
    if enumeration := enumeration_of(struct, field):
        item = "std::uint32_t" if enumeration["flags"] else f"superhelix::{enumeration_name(enumeration['name'])}::type"
        return setter(struct, f"{name}({item} value)", f"{name} = value;\n", doc)
    if is_bool(struct, field):
        return setter(struct, f"{name}(bool value)", f"{name} = value ? 1 : 0;\n", doc)
    body = f"{name} = value;\n"
    if counted := ARRAYS.get(struct, {}).get(name):
        body = f"detail::agree({label}, value, {name}, {others_set(counted, '')});\n" + body
    return setter(struct, f"{name}({item_type(field)} value)", body, doc)


def definition(struct: Item) -> str:
    """A structure with its defaults and setters."""
    name = struct["name"]
    if not struct["init"]:
        return comment(struct["doc"]) + f"using {plain(name)} = {name};\n\n"
    text = comment(struct["doc"]) + f"struct {plain(name)} : {name} {{\n"
    text += f"  {plain(name)}() : {name}{{}} {{ detail::prepared({struct['init']}(this, sizeof({name}))); }}\n"
    without, extra = EXTRA.get(name, (set(), ""))
    if name not in OUTPUTS:
        for field in struct["fields"]:
            if field["name"] == "struct_size" or is_reserved(field) or field["name"] in without:
                continue
            text += "\n" + field_setter(name, field)
    return text + extra + "};\n\n"


def file(guard: str, about: str, includes: str, body: str) -> str:
    """A whole file."""
    return (
        f"// {about}\n//\n// Generated from bindings/api.json by bindings/cpp/generate.py: do not edit.\n"
        f"#ifndef SUPERHELIX_{guard}_HPP\n#define SUPERHELIX_{guard}_HPP\n\n{includes}\n"
        f"namespace superhelix {{\ninline namespace SUPERHELIX_WAY {{\n\n{body}}}  // namespace SUPERHELIX_WAY\n}}  // namespace superhelix\n\n"
        f"#endif  // SUPERHELIX_{guard}_HPP\n"
    )


def check_tables() -> None:
    """Checks that everything in the tables exists."""
    prefixes = {enumeration["name"] for enumeration in API["enumerations"]}
    by_hand = {name: without for name, (without, _) in EXTRA.items()} | {name: {"data"} for name in ("shx_input", "shx_output")}
    wrong = [prefix for prefix in ENUMERATIONS if prefix not in prefixes] + differences(by_hand)
    if wrong:
        sys.exit("bindings/cpp/generate.py: api.json and the tables differ: " + ", ".join(wrong))


def outputs() -> dict[Path, str]:
    """The generated text of each file."""
    check_tables()
    structs = "".join(definition(struct) for struct in API["structs"] if struct["name"] not in BY_HAND)
    return {
        INCLUDE / "enumerations.hpp": file(
            "ENUMERATIONS",
            "The numbered choices of the C interface by name: integrator::second_order is SHX_INTEGRATOR_SECOND_ORDER. They convert to the C\n"
            "// structures' numbers by themselves.",
            '#include "result.hpp"\n',
            enumerations(),
        ),
        INCLUDE / "definitions.hpp": file(
            "DEFINITIONS",
            "What calls take and give: the C structures, filled with the defaults when they are made, with a setter for each field; setters chain.\n"
            "// The fields themselves are those of the C structures. Arrays that setters point to must live until the definition has been used.",
            '#include "enumerations.hpp"\n#include "hooks.hpp"\n#include "types.hpp"\n\n#include <atomic>\n#include <memory>\n',
            structs,
        ),
    }


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    check = parser.parse_args().check
    for path, text in outputs().items():
        if not check:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            sys.exit(f"{path} is out of date: run python3 bindings/cpp/generate.py")


if __name__ == "__main__":
    main()
