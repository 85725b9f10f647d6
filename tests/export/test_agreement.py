"""The exported C beside Python: everything of the registry that runs on a robot's computer.

    |x_C(t) - x(t)|  <=  TOLERANCE max |x|       for angles, rates, torques and what sensors and motors hold

x is a walk by Python's laws with Pinocchio's model, x_C the walk in which every sample instant and touchdown is
a call of the C; `difference(walker, source)` is the left side over max |x|. Both start shortly before a
touchdown, on a plant that is not the model, under a push that brings the motors to their limit, and go on after
it.

The C has the operations of the laws in their order, and another model than Pinocchio, so rounding tells the
walks apart: some 1e-16 of the terms that are added, times the gains, carried on for 50 ms. Table I's gains make
1e-10 of the torque of an angle's last place, which grows to 3e-8 with an unknown delay; by all others the walks
differ by at most 3e-11. Another processor may round otherwise. So TOLERANCE is 4e-10, with Table I 1e-6.
"""

from dataclasses import replace
from functools import cache
from itertools import cycle, groupby
from operator import itemgetter

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.core.errors import InputError
from biped_adrc.extras.export import loaded as loading
from biped_adrc.extras.export.computer import Computer
from biped_adrc.extras.export.loaded import ExportedController
from biped_adrc.extras.export.source import source_of
from biped_adrc.hybrid.simulator import simulate
from tests.control.conforms import PERIOD, gait, heavy, robot
from tests.control.test_conformance import ROWS, UNNAMED, made

TOLERANCE, OF_TABLE_I = 4e-10, 1e-6
IN_FLOAT = 1e-3
"""An ulp of float is 5e8 times one of double; angles and their differences stay in double."""
SO_LONG = 0.03
"""From the start to the touchdown [s]."""
KINDS = ("controller", "contact", "around", "observer", "sensor", "touchdown")
"""Kinds of the registry of which the computer has a part, or which decide how it is called."""
PUSH = [40.0, -30.0, 20.0, 10.0, 5.0]
"""Torques of a push [N m]."""
NOT_EXPORTED = ("CLF-QP", "output NPD", "finite time", "delayed")
"""Controllers that run in Python or in continuous time only."""
ENCODERS = ba.Sensors(1e5, filter_time=1e-3)
HARDWARE = {
    "ideal": {},
    "encoders": {"sensors": ENCODERS, "torque_limit": 150.0},
    "known delay": {
        "timing": ba.SampledTime(PERIOD, delay=1.95 * PERIOD, delay_known=True),
        "torque_limit": 80.0,
    },
    "rate limit": {
        "timing": ba.SampledTime(PERIOD, delay=1.95 * PERIOD),
        "motors": ba.Motors(rate_limit=3e4),
    },
    "touchdown noticed": {
        "timing": ba.SampledTime(PERIOD, restart=False),
        "sensors": ENCODERS,
        "touchdown": ba.ByKinematics(after=0.01),
        "torque_limit": 150.0,
    },
}
"""Fields of a walker, by what the robot has."""


def first_things():
    """Kind, name and first thing of every row, and references, which the registry does not name."""
    found = [(kind, name, made(kind, name)[0]) for kind in KINDS for name in ROWS[kind]]
    references = ((name, row(gait().constraint)[0]) for name, row in UNNAMED.items())
    found += [("reference", name, x) for name, x in references if isinstance(x, ba.Reference)]
    return found


def cases():
    """Every row of the registry with one kind of hardware in turn, and ADRC with all kinds."""
    things = groupby(first_things(), key=itemgetter(0))
    each = [(*thing, x) for _, some in things for thing, x in zip(some, cycle(HARDWARE))]
    adrc = ("controller", "ADRC", made("controller", "ADRC")[0])
    each += [(*adrc, x) for x in HARDWARE if (*adrc[:2], x) not in {(*c[:2], c[3]) for c in each}]
    return [pytest.param(*case, id="-".join((*case[:2], case[3]))) for case in each]


def walker_of(kind, thing, hardware):
    """A walker with a thing, on a plant that is not the model, pushed over the touchdown."""
    law = ba.NPDController(gait().constraint)
    fields = {"timing": ba.SampledTime(PERIOD)} | HARDWARE[hardware]
    if kind in ("controller", "contact", "around"):
        law = thing
    elif kind == "observer":
        around = MomentumDOBController if thing.lead == 1 else ba.ADRCController
        law = around(gait().constraint, thing)
    elif kind == "reference":
        law = ba.NPDController(thing)
    elif kind == "sensor":
        fields["sensors"] = thing
    elif kind == "touchdown":
        fields |= {"touchdown": thing, "timing": ba.SampledTime(PERIOD, restart=False)}
    push = ba.TorquePulse(PUSH, step=1, start=0.01, stop=0.3)
    return ba.Walker(heavy(), law, model=robot(), disturbance=push, **fields)


@cache
def before_touchdown(so_long):
    """(q, v), each (n,), so long [s] before the touchdown of the gait's orbit."""
    walker = ba.Walker(robot(), ba.NPDController(gait().constraint))
    arc = ba.walk(walker, gait(), 1).trajectory.arcs[0]
    x = arc.x[np.searchsorted(arc.t, arc.t[-1] - so_long)]
    return x[:5].copy(), x[5:10].copy()


def walked(walker, so_long):
    """Nodes (K, nx) without the controller's state, single support after single support."""
    begin = walker.initial_state(*before_touchdown(so_long), ba.Mode())
    run = simulate(walker, begin, ba.Mode(), ba.RK4(PERIOD), t_end=so_long + 0.02)
    assert len(run.arcs) == 2, run
    x, layout = np.concatenate([arc.x for arc in run.arcs]), walker.layout_of(begin)
    return np.delete(x, layout.place("s"), axis=1)


@pytest.fixture(scope="module", autouse=True)
def _quickly_compiled():
    """Without the compiler's optimization, which takes most of its time and changes no operation of doubles."""
    with pytest.MonkeyPatch.context() as patch:
        flags = ["-O0" if x == "-O2" else x for x in loading.FLAGS]
        patch.setattr(loading, "FLAGS", tuple(flags))
        yield


@cache
def npd_walked():
    """A walker with NPD, its source, and its nodes by Python's laws."""
    walker = walker_of("controller", made("controller", "NPD")[0], "ideal")
    return walker, source_of(Computer(walker)), walked(walker, SO_LONG)


def difference(walker, source, so_long=SO_LONG, by_python=None):
    """Largest difference of the walks by the C and by Python, as a share of each quantity's largest value."""
    by_c = walked(replace(walker, controller=ExportedController(source)), so_long)
    by_python = walked(walker, so_long) if by_python is None else by_python
    assert by_c.shape == by_python.shape
    most = np.max(np.abs(by_python), axis=0)
    return np.max(np.abs(by_c - by_python)[:, most > 0.0] / most[most > 0.0])


@pytest.mark.parametrize(("kind", "name", "thing", "hardware"), cases())
def test_a_walk_over_a_touchdown_is_that_of_python(kind, name, thing, hardware):
    """Each thing of the registry (kind, name) with one kind of hardware in turn, and ADRC with all kinds. What
    runs in Python or in continuous time alone (NOT_EXPORTED) is refused.

    A detector of touchdowns starts 0.11 s before the touchdown, since it listens from 0.1 s after the last one
    on.
    """
    if name in NOT_EXPORTED:
        with pytest.raises(InputError, match=type(thing).__name__):
            source_of(Computer(walker_of(kind, thing, hardware)))
        return
    walker = walker_of(kind, thing, hardware)
    found = difference(
        walker, source_of(Computer(walker)), 0.11 if kind == "touchdown" else SO_LONG
    )
    of_table = ("ADRC", "GPI", "reference reset")  # whose first is Table I
    assert found <= (OF_TABLE_I if name in of_table else TOLERANCE)


@pytest.mark.parametrize("name", ["NPD", "DOB"])
def test_c_in_single_precision_walks_as_python_to_single_precision(name):
    """A place of float is 5e8 times one of double: IN_FLOAT = 1e-3, and more than 1e-9, which doubles never
    reach, shows that floats are used.
    """
    walker = walker_of("controller", made("controller", name)[0], "ideal")
    found = difference(walker, source_of(Computer(walker), real="float32"))
    assert 1e-9 < found <= IN_FLOAT  # more than doubles differ, so floats are used


@pytest.mark.parametrize("number", ["rotor[2]", "curve.stacked[0, 4, 4]", "gains.K_d"])
def test_a_constant_that_is_wrong_by_1e_9_is_seen(number):
    """The comparison is sharp: one constant in the C's text, of the model, the gait or the gains, changed by
    1e-9 of itself, exceeds the tolerance.
    """
    walker, source, by_python = npd_walked()
    text = source.files["controller.c"]
    line = next(x for x in text.splitlines() if f"{number} */" in x)
    value, rest = line.split(",", 1)
    wrong = text.replace(line, f"{float(value) * (1.0 + 1e-9)!r},{rest}")
    files = {**source.files, "controller.c": wrong}
    found = difference(walker, replace(source, files=files), by_python=by_python)
    assert found > TOLERANCE
