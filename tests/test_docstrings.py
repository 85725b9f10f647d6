"""Each public name has an example in its docstring, and the examples run.

They know `ba`, `np` and `dataclass`, the robot and the gait of README, and a folder to write into.
"""

import ast
from dataclasses import dataclass
from doctest import DocTestParser, DocTestRunner
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc import _HOMES
from biped_adrc.core.registry import REGISTRY


def docstring(name):
    """The text below a class, a function or a constant, from the file that defines it."""
    body = ast.parse(Path(find_spec(f"biped_adrc.{_HOMES[name]}").origin).read_text()).body
    for node, after in zip(body, [*body[1:], None], strict=True):
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", None) == name:
            return after.value.value
        if getattr(node, "name", None) == name:
            return ast.get_docstring(node)
    return None


@pytest.mark.parametrize("name", ba.__all__)
def test_the_example_of_a_public_name_runs(name, tmp_path, monkeypatch):
    monkeypatch.setitem(REGISTRY, "controller", dict(REGISTRY["controller"]))
    biped = ba.Biped.load("rabbit")
    names = {"ba": ba, "np": np, "dataclass": dataclass, "folder": tmp_path, "biped": biped}
    names["gait"] = ba.load_gait("v0.8", biped)
    example = DocTestParser().get_doctest(docstring(name), names, name, None, None)
    said = []
    DocTestRunner().run(example, out=said.append)
    assert example.examples
    assert not said, "".join(said)
