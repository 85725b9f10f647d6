"""The key of compiled code: whatever a law reaches belongs to it, and numbers given at run time do not."""

from __future__ import annotations

import sys
import tomllib
import types
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.engine.fingerprint import law_text, structure_text
from biped_adrc.errors import InputError
from biped_adrc.versions import NEVER_TRACED, source_text

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "biped_adrc"

K = "from typing import NamedTuple\nclass K(NamedTuple):\n  w: float\n  s: object = 0\n"


class Pair(NamedTuple):
    pair: object


REACHED = {
    "a constant": "C = 1.25\ndef law(k, x): return C * x",
    "a default": "def f(x): return 1.25 * x\ndef law(k, x, f=f): return f(x)",
    "a partial": "from functools import partial\ndef f(a, x): return a * x\n"
    "g = partial(f, 1.25)\ndef law(k, x): return g(x)",
    "a long array": "import numpy as np\nT = [np.r_[np.zeros(900), 1.25, np.zeros(900)]]\n"
    "def law(k, x): return T[0][900] * x",
    "a method of the parameters": K + "  def f(self, x): return 1.25 * x\nk = K(2.0)\n"
    "def law(k, x): return k.f(x)",
    "a bound method": "class L:\n  def f(self, k, x): return 1.25 * x\nlaw = L().f",
}


def text_of(source: str) -> str:
    own = types.ModuleType("own")
    exec(source, vars(own))
    return law_text(own.law) + structure_text(vars(own).get("k", ()))


@pytest.mark.parametrize("source", REACHED.values(), ids=REACHED)
def test_what_a_law_reaches_is_seen(source: str) -> None:
    assert text_of(source) == text_of(source), "and nothing else, as an address"
    assert text_of(source) != text_of(source.replace("1.25", "1.75"))


@pytest.mark.parametrize(
    "law",
    [
        "import tools.shapes\ndef law(k, x): return tools.shapes.f(x)",
    ],
)
def test_modules_are_followed(law: str, tmp_path, monkeypatch) -> None:
    folder = tmp_path / "tools"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "shapes.py").write_text("C = 1.25\ndef f(x):\n    return C * x\n")
    monkeypatch.syspath_prepend(tmp_path)
    exec("import tools.shapes")
    before = text_of(law)
    monkeypatch.setattr(sys.modules["tools.shapes"], "C", 1.75)
    assert text_of(law) != before
    for name in ("tools", "tools.shapes"):
        del sys.modules[name]


@pytest.mark.parametrize("make", [tuple, list, np.array])
def test_numbers_are_given_at_run_time(make) -> None:
    texts = [structure_text(Pair(make(numbers))) for numbers in ([1.5, 2.0], [2.5, 3.0], [2.5])]
    assert texts[0] == texts[1]
    assert texts[0] != texts[2]


def ends(walker: ba.Walker, gait: ba.Gait) -> list[np.ndarray]:
    """The final states by either engine."""
    walks = [ba.walk(walker, gait, 1, ba.RK4(2e-3), engine=e) for e in ("compiled", "pinocchio")]
    assert walks[0].trajectory.settings["engine"] == "compiled"
    return [walk.trajectory.final_state for walk in walks]


@dataclass(frozen=True)
class Wave(ba.Disturbance):
    pair: tuple[float, float]

    def torque(self, t, step, t_start, q, v):
        return np.array([self.pair[0] * np.sin(self.pair[1] * t), 0.0, 0.0, 0.0, 0.0])


@dataclass(frozen=True)
class Short(Wave):
    def torque(self, t, step, t_start, q, v):
        return super().torque(t, step, t_start, q, v)[:1]


def test_two_pairs_in_one_process(biped, gait) -> None:
    for pair in ((5.0, 9.0), (9.0, 40.0)):
        one, two = ends(ba.Walker(biped, ba.NPDController(gait.constraint), Wave(pair)), gait)
        np.testing.assert_allclose(one, two, rtol=0, atol=1e-9)


@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_a_law_of_the_wrong_length_is_refused(biped, gait, engine: str) -> None:
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), Short((5.0, 9.0)))
    with pytest.raises(InputError, match=r"expected (5|\(5,\))"):
        ba.walk(walker, gait, 1, ba.RK4(2e-3), engine=engine)


def test_rooms_that_are_left_out_of_the_key_are_those_above_the_engine():
    """By the import contract nothing that is compiled can reach them."""
    contract = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]
    layers = contract["contracts"][0]["layers"]
    above = layers[: layers.index("biped_adrc.engine")]
    names = {name.strip().partition(".")[2] for row in above for name in row.split("|")}
    assert set(NEVER_TRACED) == (names - {""}) | {"campaign"}
    below = [
        p for p in PACKAGE.rglob("*.py") if p.relative_to(PACKAGE).parts[0] not in NEVER_TRACED
    ]
    assert [p for p in below if "biped_adrc.campaign" in p.read_text()] == []


def test_every_other_file_of_the_package_is_in_the_key(tmp_path):
    for name in ("linear.py", "model/biped.py", "viz/style.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("a = 1\n")
    before = source_text(tmp_path, NEVER_TRACED)
    for name, matters in (("linear.py", True), ("model/biped.py", True), ("viz/style.py", False)):
        (tmp_path / name).write_text("a = 2\n")
        assert (source_text(tmp_path, NEVER_TRACED) != before) is matters
        (tmp_path / name).write_text("a = 1\n")
    (tmp_path / "linear.py").rename(tmp_path / "other.py")
    assert source_text(tmp_path, NEVER_TRACED) != before
