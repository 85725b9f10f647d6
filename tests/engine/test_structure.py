"""Code in memory is found by structure: new numbers compile nothing, a class defined anew does.

`structure(part)` has classes, integers and shapes of arrays, but no values of floats: equal ones share their
code. `value(term)` is the torque of a disturbance at rates 1 to 5, by machine code and by Python; HEAD is the
text of a user's class `Own` with a torque to fill in.
"""

import sys
import types
from dataclasses import dataclass
from pathlib import Path

import casadi as ca
import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.checks import LIBRARIES
from biped_adrc.core.errors import InputError
from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.generated import generated
from biped_adrc.engine.program import push_code
from biped_adrc.engine.structure import alike, floats, lasting, structure
from tests.control.conforms import call

HEAD = """
from dataclasses import dataclass
import numpy as np
import biped_adrc as ba
@dataclass(frozen=True)
class Own(ba.Disturbance):
    C = 1.25
    def torque(self, t, step, t_start, q, v):
        return {torque}
"""


def value(term):
    """The torque of a term by its machine code, and by Python."""
    q, v = np.zeros(5), np.arange(1.0, 6.0)
    inp, K = np.concatenate(([0.1, 1.0, 0.0], q, v)), np.array([*floats(term), 0.0])
    code = push_code(term, 5)
    return call(code, "push", K, inp, 7)[:5], term.torque(0.1, 1, 0.0, q, v)


def test_a_class_defined_anew_is_compiled_anew():
    """A class is written again under the same name with another factor, as in a notebook cell that is run
    again: the machine code has the new factor.
    """
    own = types.ModuleType("own")
    for factor in (1.25, 1.75):
        exec(f"def f(x): return {factor} * x" + HEAD.format(torque="f(v)"), vars(own))
        compiled, python = value(own.Own())
        assert np.array_equal(compiled, python)
        assert compiled[0] == factor


def test_functions_in_modules_of_the_user_s_are_compiled_too(tmp_path, monkeypatch):
    """A function in the user's package `tools`, which the torque calls, is traced with the torque."""
    folder = tmp_path / "tools"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "shapes.py").write_text(
        "import numpy as np\nC = 1.25\ndef f(x): return C * np.tanh(x)\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    own = types.ModuleType("own")
    exec("import tools.shapes" + HEAD.format(torque="tools.shapes.f(v)"), vars(own))
    compiled, python = value(own.Own())
    assert compiled == pytest.approx(python, rel=1e-15)
    # else a later import of a `tools` would get this one
    for name in ("tools", "tools.shapes"):
        del sys.modules[name]


@pytest.mark.parametrize("make", [tuple, list, np.array])
def test_numbers_are_no_structure(make):
    """Values of floats do not count, but with exact=True; lengths do, and so do types: 1, True, "1", None and
    1.0 are five structures.
    """
    one, other, shorter = (structure((make(x),)) for x in ([1.5, 2.0], [2.5, 3.0], [2.5]))
    assert one == other
    assert one != shorter
    assert structure((make([1.5]),), exact=True) != structure((make([2.5]),), exact=True)
    assert len({structure(x) for x in (1, True, "1", None, 1.0)}) == 5


def test_alike_is_the_equality_of_structures(gait):
    """For controllers that differ in numbers, in a truth value, in the length of an array or in their class."""
    h, per_joint = gait.constraint, np.full(4, 50.0)
    laws = [
        *(ba.NPDController(h), ba.NPDController(h, ba.Gains(90.0, 5.0))),
        *(ba.NPDController(h, solve_theta=False), ba.NPDController(h, ba.Gains(90.0, per_joint))),
        *(ba.ADRCController(h), ba.ADRCController(h, ba.GPIObserver.from_bandwidth(90.0, 7))),
        *(ba.ADRCController(h, ba.GPIObserver.from_bandwidth(90.0, 2)), h, 1.0, None, (h, 1)),
    ]
    found = [[alike(one, other) for other in laws] for one in laws]
    assert found == [[structure(one) == structure(other) for other in laws] for one in laws]
    assert found[0][:4] == [True, True, False, False]


Gain = float


@dataclass(frozen=True)
class Slope:
    by_alias: Gain
    in_text: "Gain"
    count: int


def test_a_type_of_another_name_is_the_type():
    """A field annotated by an alias of float, or by its name as text, is a float though it holds 2: only the
    integer `count` is a part of the structure.
    """
    assert structure(Slope(2, 3, 4)) == structure(Slope(5, 6, 4)) != structure(Slope(2, 3, 5))


def test_the_same_structure_is_compiled_once():
    """Of two calls with one key the first traces the function, and the second does not."""
    # once: a key that no other call has
    made, once, x, y = [], (object(),), ca.SX.sym("x"), ca.SX.sym("y")
    for _ in range(2):
        # `made` counts the calls of the function that would trace it
        generated(once, {"f": lambda: made.append(1) or SymbolicFunction(x, y, y)})
    assert made == [1]


def test_another_process_finds_what_is_this_packages_own():
    """`lasting` names a structure for code on disk. It is empty for a user's class or function."""
    load, own = structure(ba.TorqueStep([1.0])), types.ModuleType("own")
    exec(HEAD.format(torque="v"), vars(own))
    assert lasting(load) == lasting(structure(ba.TorqueStep([2.0]))) != ""
    assert lasting(load) != lasting(structure(ba.TorqueStep([2.0, 3.0])))
    assert lasting(structure(own.Own())) == lasting((value,)) == ""


@dataclass(frozen=True)
class Wave(ba.Disturbance):
    pair: tuple[float, float]

    def torque(self, t, step, t_start, q, v):
        return np.array([self.pair[0] * np.sin(self.pair[1] * t), 0.0, 0.0, 0.0, 0.0])


@dataclass(frozen=True)
class Short(Wave):
    def torque(self, t, step, t_start, q, v):
        return super().torque(t, step, t_start, q, v)[:1]


@dataclass(frozen=True)
class Random(Wave):
    def torque(self, t, step, t_start, q, v):
        return np.random.default_rng(1).normal(size=5)


def test_two_pushes_of_one_structure_act_by_their_own_numbers_in_one_process(biped, gait):
    """`Wave` is a user's push with two numbers: the second walk finds the code of the first, and is still that
    of Python.
    """
    for pair in ((5.0, 9.0), (9.0, 40.0)):
        walker = ba.Walker(biped, ba.NPDController(gait.constraint), Wave(pair))
        one, two = (
            ba.walk(walker, gait, 1, ba.RK4(2e-3), engine=engine).trajectory
            for engine in ("compiled", "pinocchio")
        )
        assert one.settings["engine"] == "compiled"
        np.testing.assert_allclose(one.final_state, two.final_state, rtol=0, atol=1e-9)


@dataclass(frozen=True)
class Linearising(ba.Controller):
    reference: ba.Reference

    def output(self, s, m):
        r = self.reference(m.t, m.q, m.v)
        f = ba.feedback(ba.TABLE_II, r, m.q_b, m.v_b)
        return m.terms.kappa_inverse @ (ba.solved_acceleration(r, m.terms, f) - m.terms.xi)


def test_functions_of_the_package_compile_also_where_it_is_installed(biped, gait, monkeypatch):
    """After `pip install .` the package is in a folder of libraries (LIBRARIES), and must not be taken for one.
    The controller is a user's that calls functions of the package.
    """
    folder = str(Path(ba.__file__).parents[1])
    monkeypatch.setattr("biped_adrc.engine.structure.LIBRARIES", (*LIBRARIES, folder))
    walk = ba.walk(ba.Walker(biped, Linearising(gait.constraint)), gait, 1)
    assert walk.trajectory.settings["engine"] == "compiled"


@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_a_torque_of_the_wrong_length_is_refused(biped, gait, engine):
    """`Short` returns one of five torques."""
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), Short((5.0, 9.0)))
    with pytest.raises(InputError, match=r"expected (5|\(5,\))"):
        ba.walk(walker, gait, 1, ba.RK4(2e-3), engine=engine)


def test_a_draw_of_random_numbers_is_not_compiled(biped, gait):
    """Machine code would draw once, when it is compiled; so the push runs in Python, and the walk says why."""
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), Random((5.0, 9.0)))
    walk = ba.walk(walker, gait, 1, ba.RK4(2e-3))
    assert "random numbers" in walk.trajectory.settings["why"]
