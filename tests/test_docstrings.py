"""Each public name has an example in its docstring, and the examples run.

They know `ba`, `np` and `dataclass`, the robot and the gait of README, and a folder to write into.
"""

import ast
import enum
import inspect
import re
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
    """Every name that `import biped_adrc` offers has an example (>>>) whose output is the printed one. What
    it registers is forgotten after the test. A page has no tour, whose walks test_play.py walks."""
    monkeypatch.setattr("biped_adrc.extras.play.page.guided", lambda *_: [])
    monkeypatch.setitem(REGISTRY, "controller", dict(REGISTRY["controller"]))
    biped = ba.Biped.load("rabbit")
    names = {"ba": ba, "np": np, "dataclass": dataclass, "folder": tmp_path, "biped": biped}
    names["gait"] = ba.load_gait("v0.8", biped)
    example = DocTestParser().get_doctest(docstring(name), names, name, None, None)
    said = []
    DocTestRunner().run(example, out=said.append)
    assert example.examples
    assert not said, "".join(said)


def fields_with_texts(cls):
    """Texts below the fields of a class and of its bases, by the name of the field."""
    found = {}
    for base in reversed(cls.__mro__):
        if base.__module__.startswith("biped_adrc"):
            (node,) = (
                node
                for node in ast.parse(inspect.getsource(inspect.getmodule(base))).body
                if getattr(node, "name", None) == base.__name__
            )
            for field, text in zip(node.body, node.body[1:], strict=False):
                if isinstance(field, ast.AnnAssign) and isinstance(text, ast.Expr):
                    found[field.target.id] = text.value.value
    return found


def parameters(thing):
    """Annotations of the parameters of a function or class, by name."""
    if isinstance(thing, type) and issubclass(thing, enum.Enum | Exception):
        return {}
    return {p.name: str(p.annotation) for p in inspect.signature(thing).parameters.values()}


def texts(name, thing):
    """What docstrings say of each parameter: "name (shape) [unit]: text", or the text below a field."""
    text = " ".join((docstring(name) or "").partition(">>>")[0].split())
    aside = r"(?: (?:or )?(?:\([^)]*\)|\[[^\]]*\]))*"
    heads = re.compile(rf"((?:\b\w+{aside}, )*\b\w+{aside}):(?= |$)")
    ends = [*(found.start() for found in heads.finditer(text)), len(text)]
    said = {}
    for found, end in zip(heads.finditer(text), ends[1:], strict=True):
        for word in re.findall(r"\w+", re.sub(r"\([^)]*\)|\[[^\]]*\]", "", found[1])):
            said[word] = text[found.start() : end]
    if hasattr(thing, "model_fields"):  # a record states its units beside its texts
        each = {name: x for name, x in thing.model_fields.items() if x.description}
        of_fields = {k: f"{x.description} [{x.json_schema_extra['unit']}]" for k, x in each.items()}
    else:
        of_fields = fields_with_texts(thing) if isinstance(thing, type) else {}
    return of_fields | said


@pytest.mark.parametrize("name", [name for name in ba.__all__ if callable(getattr(ba, name))])
def test_each_parameter_of_a_public_name_is_in_its_docstring(name):
    """Each parameter is named; a float or an array has a unit in [], or is said to be dimensionless, and an
    array a shape such as (n,)."""
    thing = getattr(ba, name)
    said = texts(name, thing)
    for parameter, annotation in parameters(thing).items():
        assert parameter in said, parameter
        if re.search(r"\b(float|Array|\w*Float)\b", annotation):
            assert re.search(r"\[|dimensionless|units", said[parameter]), said[parameter]
        if "Array" in annotation:
            assert re.search(r"\(\w+, ?\w*\)", said[parameter]), said[parameter]


def test_a_scenario_names_its_records():
    """Editors and help() show the fields of a scenario by name, by Python's own signature, and not as
    pydantic's **data. `dotted` are values such as "run.h"."""
    names = [p.name for p in inspect.signature(ba.Scenario.__init__).parameters.values()]
    assert names == ["self", *ba.Scenario.model_fields, "dotted"]


VERBS = re.compile(
    r"\b(is|are|has|have|lie|gets?|acts?|goes|may|falls|drives?|takes?|ends?|lands|changes?|comes|begins?|"
    r"lasts?|keep|fills|samples|follow|knows|compensates)\b"
)
"""Verbs of the texts; a text with another one adds it here."""


@pytest.mark.parametrize("name", ba.Scenario.names())
def test_the_text_of_a_value_is_a_sentence_with_a_subject(name):
    """The text begins with a noun, not with a preposition or "That", has a verb of `VERBS` in its first part,
    and ends with a full stop.
    """
    text = ba.Scenario.field_of(name).text
    assert re.match(
        r"(?!The same|That |[A-Z][a-z]*: |On |In |Of |From |To |By |Over |Such )[A-Z]", text
    )
    assert text.endswith(".")
    assert VERBS.search(re.split(r"[;:]", text)[0]), text
