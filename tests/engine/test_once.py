"""Walks share what does not differ between them, and nothing is remembered of what may change.

`once(f)` keeps the results of f(part, ..) in the part itself, if `constant(part)`: nothing in it can change. A
part is a frozen record such as a controller, a constraint or a walker.
"""

import os
import pickle
import subprocess
import sys
from dataclasses import dataclass, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.part import constant, once, shared
from biped_adrc.engine.program import CompiledWalker

METHOD = ba.RK4(1e-3)


@pytest.fixture(scope="module")
def walker(biped, gait):
    law = ba.ADRCController(gait.constraint)
    return ba.Walker(biped, law, timing=ba.SampledTime(1e-3))


def compiled(walker, gait):
    x = walker.initial_state(*gait.start(walker.plant))
    return CompiledWalker.of(walker, METHOD, walker.layout_of(x))


def test_walkers_that_differ_in_a_push_share_their_program(walker, gait):
    """A push is no part of a program; gains are numbers K of it, so the walker with other gains has a program
    of its own.
    """
    pushed = replace(walker, disturbance=ba.TorquePulse([0.0, 9.0, 0.0, 0.0, 0.0], 2, 0.1, 0.2))
    other = replace(walker, controller=replace(walker.controller, gains=ba.Gains(3000.0, 90.0)))
    assert pushed.undisturbed is walker.undisturbed
    assert pushed.law is walker.law
    assert compiled(pushed, gait).program is compiled(walker, gait).program
    assert compiled(other, gait).program is not compiled(walker, gait).program
    assert compiled(other, gait).program.K.tolist() != compiled(walker, gait).program.K.tolist()


def test_a_start_is_the_callers_own(walker, gait):
    """initial_state remembers its result: the caller gets a copy, which he may overwrite, and another velocity
    another start.
    """
    q, v = gait.start(walker.plant)
    x = walker.initial_state(q, v)
    first = x.copy()
    x[:] = 0.0
    assert walker.initial_state(q, v).tolist() == first.tolist()
    assert walker.initial_state(q, 0.5 * v).tolist() != first.tolist()


@dataclass(frozen=True)
class Outside(ba.Controller):
    torque: object

    def output(self, s, m):
        return self.torque + 0.0 * m.q_b


def test_what_may_change_is_not_remembered(biped, gait):
    """`once` is asked again for a part with a user's class, and not for one of the package with fixed arrays:
    two questions of the first, one of the second.
    """
    array = np.zeros(4)
    # a read-only view, whose numbers change with `array`
    view = array.view()
    view.flags.writeable = False
    fixed = np.zeros(4)
    fixed.flags.writeable = False
    assert [constant(x) for x in (array, view, fixed)] == [False, False, True]
    assert constant(ba.ADRCController(gait.constraint))
    assert not constant(Outside(fixed))  # a class of the user's
    asked = []
    first = once(lambda part: asked.append(part))
    for _ in range(2):
        first(Outside(fixed))
        first(gait.constraint)
    assert len(asked) == 3


def test_a_controller_with_an_array_from_outside_walks_by_its_numbers_of_now(biped, gait):
    """The torque of `Outside` is an array of the caller's, who changes it between two walks: nothing of the
    first may be used in the second.
    """
    torque = np.zeros(4)
    walker = ba.Walker(biped, Outside(torque), timing=ba.SampledTime(1e-3))
    case = ba.Case(walker, *gait.start(biped), METHOD, 1)
    (still,) = ba.simulate_many([case], 1)
    torque[0] = 20.0
    (moved,) = ba.simulate_many([case], 1)
    assert not np.array_equal(still.final_state, moved.final_state)


def test_the_same_fields_give_the_same_copy_and_another_process_gets_none_of_it(walker):
    """`shared` makes one copy per set of fields. What a part remembers (`_once`, `undisturbed`) is not pickled:
    it stays in its process.
    """
    a, b = shared(walker, slope=0.01), shared(walker, slope=0.02)
    assert shared(walker, slope=a.slope) is a
    assert b.slope == 0.02
    # now the walker remembers them
    _ = walker.undisturbed, walker.law, hash(walker.controller)
    again = pickle.loads(pickle.dumps(walker))
    assert again.controller == walker.controller
    assert vars(walker.controller)["_once"]
    assert not vars(again.controller)["_once"]
    assert not {"undisturbed", "_once"} & vars(again).keys()


def test_a_part_from_another_process_is_found_among_equal_ones_and_asked_again_whether_it_can_change(
    gait,
):
    """Hashes of texts and classes are others there, and NumPy's arrays come back writable."""
    law = ba.ADRCController(gait.constraint)
    assert constant(law)
    data = pickle.dumps({law: "found"})
    code = (
        "import pickle, sys; import biped_adrc as ba; from biped_adrc.core.part import constant\n"
        "(law,) = found = pickle.load(sys.stdin.buffer)\n"
        "fresh = ba.ADRCController(law.reference)\n"
        "print(fresh == law, found.get(fresh), constant(law), law.reference.curve.coefficients.flags.writeable)"
    )
    for seed in ("1", "2"):
        done = subprocess.run(
            [sys.executable, "-c", code],
            input=data,
            capture_output=True,
            env=os.environ | {"PYTHONHASHSEED": seed},
        )
        assert done.stdout.split() == [b"True", b"found", b"False", b"True"], done.stderr


def test_a_part_keeps_the_last_results_and_drops_the_oldest(gait):
    """64 results are kept: of 0 to 79, 16 to 79 are left, so 20 to 79 are found and 0 is asked for again."""
    asked = []
    squared = once(lambda part, x: asked.append(x) or x * x)
    results = [squared(gait.constraint, x) for x in (*range(80), *range(20, 80), 0)]
    assert results == [x * x for x in (*range(80), *range(20, 80), 0)]
    assert asked == [*range(80), 0]
