"""Any numbers in any order of calls, and numbers so small that some processors take them for zero."""

import numpy as np
import pytest

from biped_adrc.deploy.apart import TIMES, PythonController, python_calls, walk
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.loaded import NO_RESULT, NOT_MEASURED, OK, UNOPTIMISED, Loaded
from biped_adrc.deploy.rounding import PythonComputer, proof
from biped_adrc.deploy.source import source_of
from biped_adrc.hybrid.simulator import RunOptions
from tests.deploy.fuzz import answers, attack, program
from tests.deploy.pairs import Pair, before_touchdown, made

TINY = [5e-324, -1e-310, 2e-308]
"""Denormal doubles [rad, rad/s]."""


@pytest.fixture(
    scope="module", params=[("NPD", "ideal"), ("LESO", "known delay")], ids=lambda x: x[0]
)
def case(request):
    """Computer, C and the calls of a short walk."""
    name, hardware = request.param
    computer = Computer(Pair("controller", name, made("controller", name)[0], hardware).walker)
    python, begin = PythonController(PythonComputer(computer)), before_touchdown(0.03)
    run = walk(computer.walker, python, begin, RunOptions(0.05))
    return computer, source_of(computer), python_calls(computer, run)


@pytest.mark.parametrize("real", ["float64", "float32"])
def test_calls_of_any_numbers_in_any_order_end_as_the_header_says(case, real):
    seen = attack(*case, 1500, real=real)
    assert seen >= {("s", flag) for flag in (OK, NOT_MEASURED, NO_RESULT)}
    assert seen >= {(kind, flag) for kind in "it" for flag in (OK, NOT_MEASURED)}


def test_denormals_are_numbers_like_others_and_as_zero_they_make_no_difference(case, tmp_path):
    computer, source, calls = case
    random, tiny = np.random.default_rng(0), []
    for call in calls:
        q, v = call.q.copy(), call.v.copy()
        q[np.argmin(np.abs(q))], v[random.integers(len(v))] = random.choice(TINY, 2)
        tiny.append(call._replace(q=q, v=v))
    assert proof(computer, Loaded(source, flags=UNOPTIMISED), tiny, every=3).worst <= TIMES
    given = [(call.kind[0], *call[1:4]) for call in tiny]
    one, other = (
        answers(program(source, tmp_path, UNOPTIMISED, flush), given) for flush in (False, True)
    )
    assert set(one[0]) == {OK}
    assert np.array_equal(one[2], other[2])
