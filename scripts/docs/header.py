"""The C interface as pages of the site: bindings/api.json, which describes include/superhelix.h, a page a section."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from pages import ROOT, slug

Item = dict[str, Any]
NAME = re.compile(r"\b(?:shx_[a-z0-9_]+|SHX_[A-Z0-9_]+)\b")


class Reference:
    """The header's declarations, and their places on the site."""

    def __init__(self) -> None:
        self.api: dict[str, list[Item]] = json.loads((ROOT / "bindings" / "api.json").read_text(encoding="utf-8"))
        self.places: dict[str, str] = {}
        self.sections: list[str] = []
        for kind in ("constants", "aliases", "handles", "callbacks", "structs", "functions"):
            for item in self.api[kind]:
                self.places[item["name"]] = slug(item["section"])
        order = re.findall(r"^(?:// |/\* )?[-=/ ]*([A-Z][\w ,/-]+?)[-=/ ]*(?:\*/)?$", (ROOT / "include" / "superhelix.h").read_text(encoding="utf-8"), re.M)
        known = {item["section"] for kind in self.api if kind != "enumerations" for item in self.api[kind]}
        self.sections = [section for section in dict.fromkeys(order) if section in known]
        self.sections += sorted(known - set(self.sections))

    def text(self, doc: str, here: str) -> str:
        """A comment as Markdown: names become links, everything else stays the same."""

        def name(found: re.Match[str]) -> str:
            place = self.places.get(found[0])
            if place is None:
                return f"`{found[0]}`"
            return f"[`{found[0]}`]({'' if place == here else place + '.md'}#{found[0].lower()})"

        parts = []
        end = 0
        for found in NAME.finditer(doc):
            parts += [escaped(doc[end : found.start()]), name(found)]
            end = found.end()
        parts.append(escaped(doc[end:]))
        lines = "".join(parts).split("\n")
        # Errors, threads and the like are paragraphs of their own.
        return "\n".join(f"\n{line}" if re.match(r"(Errors|Threads|Valid|Default)\b.*", line) else line for line in lines)

    def page(self, section: str) -> str:
        """The page of a section."""
        here = slug(section)
        lines = [f"# {section}", "", "From [superhelix.h](../../include/superhelix.h); [all sections](index.md).", ""]
        constants = [item for item in self.api["constants"] if item["section"] == section]
        for struct in self.of("structs", section):
            lines += self.heading(struct, here)
            if struct["init"] and struct["init"] not in struct["doc"]:
                lines += [f"Fill it with {self.text(struct['init'], here)}.", ""]
            lines += ["| field | type | meaning |", "|---|---|---|"]
            for field in struct["fields"]:
                lines.append(f"| `{field['name']}` | `{declared(field)}` | {cell(self.text(field['doc'], here))} |")
            lines.append("")
        for kind in ("aliases", "handles", "callbacks"):
            for item in self.of(kind, section):
                lines += self.heading(item, here)
        for function in self.of("functions", section):
            lines += [f"## {function['name']}", "", "```c", signature(function), "```", "", self.text(function["doc"], here), ""]
        if constants:
            lines += ["## Constants", "", "| constant | value | meaning |", "|---|---|---|"]
            for item in constants:
                lines.append(f'| <a id="{item["name"].lower()}"></a>`{item["name"]}` | `{item["value"]}` | {cell(self.text(item["doc"], here))} |')
        return "\n".join(lines).rstrip() + "\n"

    def of(self, kind: str, section: str) -> Iterable[Item]:
        """The entries of one type in a section."""
        return (item for item in self.api[kind] if item["section"] == section)

    def heading(self, item: Item, here: str) -> list[str]:
        """A heading with its comment."""
        return [f"## {item['name']}", "", self.text(item["doc"], here), ""]

    def contents(self) -> str:
        """The page that lists all sections."""
        lines = ["# The C interface", "", "Every item of [superhelix.h](../../include/superhelix.h), by section.", ""]
        for section in self.sections:
            names = [item["name"] for kind in ("structs", "handles", "callbacks", "functions") for item in self.of(kind, section)]
            linked = ", ".join(f"[`{name}`]({slug(section)}.md#{name})" for name in names)
            lines.append(f"- [{section}]({slug(section)}.md){': ' if linked else ''}{linked}")
        return "\n".join(lines) + "\n"

    def write(self, folder: Path) -> list[tuple[str, str]]:
        """Writes all pages into a folder; their titles and names."""
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "README.md").write_text(self.contents(), encoding="utf-8")
        for section in self.sections:
            (folder / f"{slug(section)}.md").write_text(self.page(section), encoding="utf-8")
        return [(section, f"{slug(section)}.md") for section in self.sections]


def escaped(text: str) -> str:
    """Text in which nothing is Markdown."""
    return re.sub(r"([\\*_`\[\]<>#|])", r"\\\1", text)


def cell(text: str) -> str:
    """Text on one line."""
    return " ".join(text.split())


def typed(kind: Item) -> str:
    """A type in C."""
    return f"{'const ' if kind['const'] else ''}{kind['name']}{' ' if kind['pointer'] else ''}{'*' * kind['pointer']}"


def declared(member: Item) -> str:
    """The type of a field, with the number of its items."""
    return typed(member["type"]) + (f"[{member['array']}]" if member["array"] else "")


def signature(function: Item) -> str:
    """A function's declaration."""
    parameters = []
    for item in function["parameters"]:
        kind = typed(item["type"])
        array = f"[{item['array']}]" if item["array"] else ""
        parameters.append(f"{kind}{'' if kind.endswith('*') else ' '}{item['name']}{array}")
    returns = typed(function["returns"])
    head = f"{returns}{'' if returns.endswith('*') else ' '}{function['name']}("
    line = f"{head}{', '.join(parameters) or 'void'});"
    return line if len(line) <= 100 else head + "\n    " + ",\n    ".join(parameters) + ");"
