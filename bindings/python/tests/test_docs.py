"""The guide's examples, README's and the notebook run as they stand."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from conftest import ROOT

PAGES = [ROOT / "docs" / "reference" / "python.md", ROOT / "bindings" / "python" / "README.md"]
NOTEBOOK = ROOT / "bindings" / "python" / "examples" / "first_day.ipynb"


def blocks(path: Path) -> list[tuple[int, str]]:
    """The Python of a page, each block with its line."""
    text = path.read_text(encoding="utf-8")
    return [(text[: found.start()].count("\n") + 2, found[1]) for found in re.finditer(r"^```python\n(.*?)^```", text, re.M | re.S)]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_examples_of_a_page_run_in_order(page, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    found = blocks(page)
    assert found
    names: dict[str, object] = {"__name__": "example"}
    for line, source in found:
        exec(compile("\n" * (line - 1) + source, str(page), "exec"), names)


def test_the_notebook_runs_and_was_committed_with_its_outputs(tmp_path) -> None:
    import nbformat
    from nbclient import NotebookClient

    committed = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    code = [cell for cell in committed["cells"] if cell["cell_type"] == "code"]
    assert all(cell["execution_count"] for cell in code)
    assert any("image/png" in output.get("data", {}) for cell in code for output in cell["outputs"])
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    pictures = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs if "image/png" in output.get("data", {})]
    assert pictures
