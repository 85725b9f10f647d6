"""What a notebook prints agrees with the stored numbers of the reproduction."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[1]
CELL = re.compile(r"^```\{code-cell\} ipython3\n(.*?)^```", re.DOTALL | re.MULTILINE)


def cells(name: str) -> list[str]:
    """The code of a notebook without its magic lines."""
    text = (ROOT / "docs" / "notebooks" / name).read_text(encoding="utf-8")
    return [re.sub(r"^%.*$", "", code, flags=re.MULTILINE) for code in CELL.findall(text)]


def test_the_errors_of_the_paper_notebook_are_those_of_the_reproduction(capsys):
    """The same push in an earlier step: the gait is periodic, so the errors are the same."""
    found = cells("paper.md")
    names: dict[str, Any] = {}
    for code in (found[0], "c = gait.constraint", next(c for c in found if "walks = {" in c)):
        exec(compile(code, "paper.md", "exec"), names)
    printed = re.findall(r"^(\w+): largest tracking error (\S+) rad", capsys.readouterr().out, re.M)
    assert [name for name, _ in printed] == ["NPD", "ADRC"]
    assert not any(walk.remarks for walk in names["walks"].values())
    with (ROOT / "docs" / "findings" / "reproduction.csv").open(encoding="utf-8") as file:
        rows = [row[:4] for row in csv.reader(file)]
    for name, error in printed:
        (expected,) = (x for *run, x in rows if run == ["Runs", f"push {name}", "peak error [rad]"])
        assert float(error) == pytest.approx(float(expected), rel=0.01), name
