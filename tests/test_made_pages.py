"""API pages and notebook are as `make docs` would write them now, and pages are whole without a build."""

from __future__ import annotations

import ast
import importlib
import json
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
NOTEBOOK = ROOT / "examples" / "first_walk.ipynb"
API = sorted((ROOT / "docs" / "api").glob("*.md"))
BUILT_PAGES = ROOT / "docs" / "_build"
PAGES = [
    ROOT / "README.md",
    *(p for p in sorted((ROOT / "docs").rglob("*.md")) if BUILT_PAGES not in p.parents),
]
RAW = re.compile(r"\{[a-z]+(:[a-z]+)?\}`|^```\{|^:::|^\([\w-]+\)=$", re.MULTILINE)
"""Roles, directives and targets, which only Sphinx understands."""
PLACE = re.compile(r"^<!-- (?:built:|(?:table|names|help|fields) of )", re.MULTILINE)
BUILT = re.compile(r"^<!-- built:\n.*?^-->\n", re.MULTILINE | re.DOTALL)


@pytest.fixture
def scripts(monkeypatch):
    """Gives a script of docs/ as a module."""
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    return importlib.import_module


@pytest.mark.parametrize("page", API, ids=lambda path: path.name)
def test_the_api_pages_are_those_of_the_package(page, scripts):
    """`make docs` would change nothing."""
    text = page.read_text(encoding="utf-8")
    assert scripts("expand").written(text) == text, "run make docs"


def test_the_notebook_is_that_of_the_page(scripts):
    """`make docs` would change nothing, and no output is stored."""
    made = scripts("make_notebook")
    text = NOTEBOOK.read_text(encoding="utf-8")
    assert made.notebook(made.PAGE.read_text(encoding="utf-8")) == text, "run make docs"
    for cell in json.loads(text)["cells"]:
        assert not cell.get("outputs")


def test_the_notebook_runs(tmp_path, monkeypatch):
    """Its code cells in order, in one namespace and an empty folder. One ends with what Jupyter draws."""
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "__main__"}
    cells = [c for c in json.loads(NOTEBOOK.read_text())["cells"] if c["cell_type"] == "code"]
    assert cells
    drawn = 0
    for number, cell in enumerate(cells, 1):
        source = "".join(cell["source"])
        exec(compile(source, f"cell {number}", "exec", dont_inherit=True), names)
        last = ast.parse(source).body[-1]
        if isinstance(last, ast.Expr) and isinstance(last.value, ast.Name):
            drawn += hasattr(names[last.value.id], "_repr_html_")
    assert drawn == 1


def linked() -> list[Path]:
    """README and the pages that it links to."""
    readme = ROOT / "README.md"
    links = re.findall(r"\]\(((?!https?:)[^)#]+\.md)", readme.read_text(encoding="utf-8"))
    return [readme, *(ROOT / link for link in dict.fromkeys(links))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_a_page_is_whole_where_it_lies(page):
    """No role or directive but in a comment for the built page, after which a text stands in its place."""
    text = page.read_text(encoding="utf-8")
    assert text.count("\n<!-- end -->\n") == len(PLACE.findall(text))
    found = RAW.search(BUILT.sub("", text))
    assert found is None, found[0]


@pytest.mark.parametrize("page", linked(), ids=lambda page: str(page.relative_to(ROOT)))
def test_links_of_a_page_lead_to_files(page):
    """Relative ones, from README and from the pages that it links to."""
    for link in re.findall(r"\]\(((?!https?:|#)[^)#\s]+)", page.read_text(encoding="utf-8")):
        assert (page.parent / link).exists(), link
